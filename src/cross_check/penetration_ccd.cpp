// libccd's GJK and EPA. EPA has no limit of its own, so the support functions count their calls and give up.

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "cross_check/penetration.h"

namespace dsw {
namespace {

static_assert(std::is_same_v<ccd_real_t, double>, "libccd must be built for double");

constexpr unsigned long kMostIterations = 200;
constexpr uint32_t kMostCalls = 1000;  // of both support functions; ordinary contacts take below a hundred

/** libccd compares products of the depth with its tolerance, and squares of it with the machine's epsilon. At this size
 * of features both leave room below a depth of 1e-6 of them. */
constexpr double kSize = 64;
constexpr double kTolerance = 1e-13;

constexpr double kUnit = 1e-9;  // a direction that is no number, or none, has another square

struct Query {
  const Hull* hull;
  uint32_t* calls;
};

/** Past the limit both hulls answer with the origin: EPA then sees nothing farther out, and ends. */
void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& query = *static_cast<const Query*>(object);
  if (++*query.calls > kMostCalls) {
    std::fill_n(out->v, 3, 0.0);
    return;
  }
  const double* const p = farthest(*query.hull, direction->v);
  for (int k = 0; k < 3; ++k) out->v[k] = p[k] * kSize;
}

}  // namespace

void require_libccd() {}

bool find_penetration(const Hull& body, const Hull& obstacle, Penetration& result) {
  uint32_t calls = 0;
  const Query first{&obstacle, &calls}, second{&body, &calls};
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.max_iterations = kMostIterations;
  ccd.epa_tolerance = kTolerance;
  ccd_real_t depth = std::numeric_limits<double>::quiet_NaN();
  ccd_vec3_t direction{}, place{};
  const int status = ccdGJKPenetration(&first, &second, &ccd, &depth, &direction, &place);
  if (status == -2) throw std::bad_alloc();
  const double* const d = direction.v;
  const double length = (d[0] * d[0] + d[1] * d[1]) + d[2] * d[2];
  if (status != 0 || calls > kMostCalls || !(depth > 0) || !(std::fabs(length - 1) < kUnit)) return false;
  std::copy_n(direction.v, 3, result.normal);
  result.depth = depth / kSize;
  return true;
}

}  // namespace dsw
