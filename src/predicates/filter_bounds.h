// The constants of the floating-point filters and their proof. SIMD kernels elsewhere use them too.
//
// Let u = 2^-53. Without underflow fl(x op y) = (x op y)(1+d) = (x op y)/(1+d'), |d|, |d'| <= u. A difference of two
// doubles never underflows inexactly, so a true difference is its rounded value times (1+d): zero stays zero.
//
// Space. det = w.(e1 x e2) with rounded differences, expanded along any row, in any order, the 2x2 minors shared or
// not. m_k = any value >= |component k| of the three rounded vectors, M = mx*my*mz. The determinant has six products
// of three differences, each at most M.
//   - true det against the same six products of rounded differences:  <= 6M((1+u)^3 - 1)
//   - their evaluation: one product, one subtraction (minor), one product, at most two sums, so each of the six
//     meets at most five roundings:                                    <= 6M((1+u)^5 - 1)
//   - together < 6M(8u + 14u^2) < (48u + 84u^2)M.
//   - the bound itself, three products in any order, loses at most (1-u)^3: fl(50u*M) > (50u - 150u^2)M.
//   - underflow: a product of two differences errs by <= 2^-1075 more, carried on by a factor <= m_k (two such for
//     each k), and the three last products by 2^-1075 each. With 2^-320 <= m_k that is less than (2^-379 + 2^-60)uM;
//     the 1.9uM left above covers it. The bound is >= 2^-1008 and so does not underflow itself.
//   - overflow: 6*(2^340)^3*(1+u)^5 < 2^1023.
// So |det| > fl(50u*M) gives the sign of det, for m_k in [kFilterMin, kFilterMax]. Contraction to FMA leaves out
// roundings and would not break the bound. If some m_k is 0, det is exactly 0.
//
// Plane, and every 2x2 minor: two products of two differences, two roundings each: < 2(4u + 2u^2)mx*my; bound
// fl(10u*mx*my) > (10u - 20u^2)mx*my; the same range leaves underflow (2^-1074 against 2^-693) and overflow no room.
//
// Times. N = -n.(p-a), d = n.(q-p), |N - N~| <= E, |d - d~| <= E as above with m_k over e1, e2, a-p, q-p. The true
// X = N_a d_b - N_b d_a differs from N~_a d~_b - N~_b d~_a by at most
//   E_a(|N~_b| + |d~_b|) + E_b(|N~_a| + |d~_a|) + 2 E_a E_b,
// and its evaluation (two products, one subtraction) by less than 3u(|N~_a d~_b| + |N~_b d~_a|). The sum of both,
// all terms >= 0, is evaluated with less than ten roundings each, and kTimeSlack = 1 + 2^-40 covers them. The signs
// of d_a and d_b are known when |d~| > E. Range: with m_k in [2^-140, 2^160] the bound is >= E_a E_b > 2^-940 (in the
// plane more), so that 2^-40 of it covers the 2^-1075 of each product that underflows; nothing exceeds 2^970.
#pragma once

namespace dsw {

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kPlaneFilter3 = 50 * kUnitRoundoff;  // times mx*my*mz
constexpr double kPlaneFilter2 = 10 * kUnitRoundoff;  // times mx*my; also for the minors in space
constexpr double kFilterMin = 0x1p-320;               // every m_k must lie in [kFilterMin, kFilterMax]
constexpr double kFilterMax = 0x1p+340;
constexpr double kTimeFilterMin = 0x1p-140;
constexpr double kTimeFilterMax = 0x1p+160;
constexpr double kTimeSlack = 1 + 0x1p-40;

}  // namespace dsw
