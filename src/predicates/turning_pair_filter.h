// The first touch of a pair that turns by doubles, where their errors leave one answer. Private to this folder.
//
// Volume and areas are those of turning_terms.h, by their coefficients in the basis of Bernstein (touch_search.h).
//
// Errors. Let u = 2^-53. A value is a sum of products of inputs, in which each product meets at most k roundings. Then it
// errs by less than ((1+u)^k - 1) T, where T bounds the sum of the magnitudes of the products. In the basis of Bernstein
// coefficients of a product are means of products of coefficients, so bounds of magnitudes are multiplied and added.
//   - Let Q be the largest component of a quaternion, so |q|^2 and entries of R(q) have T = 4 Q^2. With two turns r has
//     T = 4 Q_a Q_b, R(r) has 64 Q_a^2 Q_b^2, and n has 16 Q_a^2 Q_b^2. The bounds of lengths are written where they are used.
//   - Roundings: 5 for an entry of R(q), 16 for one of R(r); a difference, a product and two sums for a turned point, 5 to raise
//     its degree, 2 to add the place of the centre: 27. A normal or edge of B has 4, its product with the above 6 more. To
//     Bernstein's basis 2: 39 in all.
//   - The cut at the time after which nothing matters takes 15, and each of 24 halvings five means in a row: 120. The evaluation at
//     the root takes 23, and the step to the next double counts 10. Together less than 210; the bound has 320, and pays for its own
//     roundings.
//   - The volume at one time, by double-double: a product loses 8u^2, a sum 3u^2, and errors of factors are added. It is 11u^2
//     for q, 39u^2 for r, 95u^2 for an entry of R(r), 120u^2 for a turned point, 170u^2 T for the volume. The slope errs by
//     700u T and is at most 10T, so that its products and sums lose 20u T more: 46,080u^2 T over 64 doubles. The second derivative is at
//     most 80T, which counts 163,840u^2 T. Together less than 2^-88 T = 262,144u^2 T.
// With lengths in [2^-100, 2^100] and components of quaternions near 1 nothing over- or underflows that counts. Others are scaled by a
// power of two first.
#pragma once

#include "predicates/touch_search.h"
#include "predicates/turning_pair.h"

namespace dsw {

// For kTouches, *time is that of FirstTouch. At least one feature turns. With a time in `asked` kApart means that the pair does not touch
// up to that time, or that it does not touch.
template <int D>
Filtered filter_first_touch(const TurningPair<D>& pair, const Asked& asked, double* time) noexcept;

}  // namespace dsw
