#include "cross_check/report.h"

#include <algorithm>

#include "cross_check/second_opinion.h"

namespace dsw {
namespace {

dsw_no_opinion to_reason(NoFeatures why) {
  switch (why) {
    case NoFeatures::kParallel:
      return DSW_NO_OPINION_PARALLEL;
    case NoFeatures::kOutsideCone:
      return DSW_NO_OPINION_OUTSIDE_CONE;
    default:
      return DSW_NO_OPINION_NOT_CONVERGED;
  }
}

dsw_opinion kind_asked(TouchKind kind) {
  switch (kind) {
    case TouchKind::kPoint:
      return DSW_OPINION_PLANE;
    case TouchKind::kCorner:
      return DSW_OPINION_VERTEX;
    default:
      return DSW_OPINION_EDGE;
  }
}

}  // namespace

dsw_contact_opinion opinion_on(const Environment<3>& env, const Touch& touch, bool has_wall) {
  dsw_contact_opinion answer{};
  if (!has_wall) {
    answer.reason = DSW_NO_OPINION_WIRE;
    return answer;
  }
  Features features(env.memory);
  const NoFeatures why = find_features(env, touch, features);
  if (why != NoFeatures::kFound) {
    answer.reason = to_reason(why);
    return answer;
  }
  const SecondOpinion second = second_opinion(features, touch.normal);
  if (second.verdict != Verdict::kGiven) {
    answer.reason = second.verdict == Verdict::kNotUnique ? DSW_NO_OPINION_NOT_UNIQUE : DSW_NO_OPINION_NOT_CONVERGED;
    return answer;
  }
  std::copy_n(second.normal, 3, answer.normal);
  answer.depth = second.depth;
  answer.pushed_in = second.pushed_in;
  answer.angle_rad = second.angle;
  answer.opinion = kind_asked(touch.kind);
  return answer;
}

}  // namespace dsw
