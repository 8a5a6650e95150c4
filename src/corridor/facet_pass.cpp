#include "corridor/facet_pass.h"

#include "base/compiler.h"
#include "base/processor.h"

namespace dsw {

bool passes_facet(const double* const* corners, const double* from, const double* to) noexcept {
  const filter::Vec<3> way = filter::difference<3>(to, from);
  for (int k = 0; k < 4; ++k) {
    const double *const x = corners[k], *const y = corners[k == 3 ? 0 : k + 1];
    if (x != y && !passes_ridge(x, y, from, way)) return false;
  }
  return true;
}

bool keeps_to_facet(const double* const* corners, const EdgeWay& edge) noexcept {
  const auto reach = [&](int axis) {
    double low = edge.first[axis], high = low;
    const double* const others[] = {edge.first_to, edge.other, edge.other_to, corners[0],
                                    corners[1],    corners[2], corners[3]};
    for (const double* each : others) {
      low = filter::smaller(low, each[axis]);
      high = filter::larger(high, each[axis]);
    }
    return high - low;
  };
  const filter::Vec<3> reaches{reach(0), reach(1), reach(2)};
  const auto way = [&](const double* first, const double* other) {
    return edge.from_first ? filter::difference<3>(other, first) : filter::difference<3>(first, other);
  };
  const filter::Vec<3> before = way(edge.first, edge.other), between = way(edge.first_to, edge.other),
                       after = way(edge.first_to, edge.other_to), beside = way(edge.first, edge.other_to);
  for (int k = 0; k < 4; ++k) {
    const double *const x = corners[k], *const y = corners[k == 3 ? 0 : k + 1];
    if (x == y) continue;
    const filter::Vec<3> normal =
                             filter::cross(filter::difference<3>(x, edge.other), filter::difference<3>(y, edge.other)),
                         normal_to = filter::cross(filter::difference<3>(x, edge.other_to),
                                                   filter::difference<3>(y, edge.other_to));
    double least = filter::smaller(filter::smaller(filter::dot(normal, before), filter::dot(normal, between)),
                                   filter::dot(normal_to, after));
    if (edge.at_once) least = filter::smaller(least, filter::dot(normal_to, beside));
    if (!(least > 0) || !filter::certain(least, reaches)) return false;
  }
  return true;
}

const PassesFacet kPassesFacet = DSW_WITH_AVX2(passes_facet);
const KeepsToFacet kKeepsToFacet = DSW_WITH_AVX2(keeps_to_facet);

}  // namespace dsw
