#include "cross_check/second_normal.h"

#include <algorithm>
#include <cmath>

#include "cross_check/penetration.h"

namespace dsw {
namespace {

/** How deep to push in, of the features' size. At exact touch libccd's normals are noise. */
constexpr double kDepths[] = {1e-6, 1e-5};

/** By how much of that depth features that only touch may seem to overlap along a normal of theirs. Where libccd's way
 * out is no normal in this sense it leads through something near, not through the contact. */
constexpr double kSlack = 1e-2;

/** Normals farther apart than this, radians, are two. If both are normals the contact is at the border of a feature. */
constexpr double kSame = 1e-6;

/** acos would lose small angles. */
double angle_between(const double* a, const double* b) {
  double apart = 0, together = 0;
  for (int k = 0; k < 3; ++k) {
    apart += (a[k] - b[k]) * (a[k] - b[k]);
    together += (a[k] + b[k]) * (a[k] + b[k]);
  }
  return 2 * std::atan2(std::sqrt(apart), std::sqrt(together));
}

}  // namespace

SecondNormal second_normal(const Features& features, const double* normal) {
  SecondNormal found_normal;
  for (const double depth : kDepths) {
    Hull pushed = features.body;
    push_in(pushed, normal, depth);
    Penetration found;
    if (!find_penetration(pushed, features.obstacle, found)) continue;
    if (!(way_out(features.body, features.obstacle, found.normal) <= kSlack * depth)) continue;
    const double angle = angle_between(found.normal, normal);
    if (angle > kSame && way_out(features.body, features.obstacle, normal) <= kSlack * depth) {
      found_normal.answer = Answer::kNotUnique;
      continue;
    }
    found_normal.answer = Answer::kGiven;
    std::copy_n(found.normal, 3, found_normal.normal);
    found_normal.depth = found.depth * features.unit;
    found_normal.pushed_in = depth * features.unit;
    found_normal.angle = angle;
    break;
  }
  return found_normal;
}

}  // namespace dsw
