// The first touch of a moving pair by doubles, where their errors leave one answer. Private to this folder.
//
// The volume of the points is of degree 3 in time, and the areas that say whether points in one plane touch are of degree 2.
//
// Errors. Let u = 2^-53 and let m_k be the largest component k of the rounded differences, M = mx my mz.
//   - A determinant of three differences errs by 50u M (filter_bounds.h). The mean of three has 18 products. Each of them passes at
//     most 12 roundings: three differences, two products, five sums, and two where a third is taken. So the mean errs by 72u M.
//     It is at most 6 M. A mean of two coefficients adds 6u M. Halving takes three of them in a row, so 24 halvings add
//     432u M: below 512u M. A part between two times takes three means with other weights, which add 36u M: as much as two halvings.
//   - An area of two differences errs by 10u mi mj, the mean of two by 12u, the sum of three such by 46u. It is at most
//     6 mi mj. Halving adds 12u mi mj, so 24 halvings add 288u mi mj: below 512u mi mj. At the root
//     evaluation adds 60u mi mj, and the step to the next double 24u mi mj: together below 150u mi mj.
//   - In the plane the area replaces the volume and a difference replaces an area. The same bounds hold.
//   - The volume at one time, by double-double: a difference errs by 24u^2 m_k, a product of two of them by 56u^2, a minor
//     by 120u^2, the determinant by 600u^2 M. The slope errs by 720u M. Over four doubles this
//     counts 2880u^2 M, the curvature 1200u^2 M and the roundings of the sum 300u^2 M. Together below 5000u^2 M, less than
//     2^-92 M = 16384u^2 M.
// With m_k in [2^-140, 2^160] nothing over- or underflows that counts.
#pragma once

#include "predicates/touch_search.h"

namespace dsw {

// For kTouches, *time is that of FirstTouch; 0 is exact. A touch after `until` may be left out.
template <int D>
Filtered filter_first_touch(const MovingPair<D>& pair, double until, double* time) noexcept;

// Returns kept_side if *is_sure becomes true. Else returns 0, and integers must decide.
template <int D>
int filter_kept_side(const MovingPair<D>& points, bool* is_sure) noexcept;

}  // namespace dsw
