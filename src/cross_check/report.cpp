#include "cross_check/report.h"

#include <algorithm>

#include "cross_check/second_normal.h"

namespace dsw {
namespace {

dsw_no_cross_check to_reason(NoFeatures why) {
  switch (why) {
    case NoFeatures::kParallel:
      return DSW_NO_CROSS_CHECK_PARALLEL;
    case NoFeatures::kOutsideCone:
      return DSW_NO_CROSS_CHECK_OUTSIDE_CONE;
    default:
      return DSW_NO_CROSS_CHECK_NOT_CONVERGED;
  }
}

dsw_cross_check_kind kind_asked(TouchKind kind) {
  switch (kind) {
    case TouchKind::kPoint:
      return DSW_CROSS_CHECK_PLANE;
    case TouchKind::kCorner:
      return DSW_CROSS_CHECK_VERTEX;
    default:
      return DSW_CROSS_CHECK_EDGE;
  }
}

}  // namespace

dsw_cross_check cross_check_of(const Environment<3>& env, const ReportedTouch& touch, bool has_wall) {
  dsw_cross_check answer{};
  if (!has_wall) {
    answer.reason = DSW_NO_CROSS_CHECK_MARKED;
    return answer;
  }
  Features features(env.memory);
  const NoFeatures why = find_features(env, touch, features);
  if (why != NoFeatures::kFound) {
    answer.reason = to_reason(why);
    return answer;
  }
  const SecondNormal second = second_normal(features, touch.normal);
  if (second.answer != Answer::kGiven) {
    answer.reason =
        second.answer == Answer::kNotUnique ? DSW_NO_CROSS_CHECK_NOT_UNIQUE : DSW_NO_CROSS_CHECK_NOT_CONVERGED;
    return answer;
  }
  std::copy_n(second.normal, 3, answer.normal);
  answer.depth = second.depth;
  answer.pushed_in = second.pushed_in;
  answer.angle_rad = second.angle;
  answer.kind = kind_asked(touch.kind);
  return answer;
}

}  // namespace dsw
