// FCL's continuous tests of moving vertices and edges, which its continuous collision of deforming meshes is made of:
// cubics, by Newton's method in an interval, or solved in closed form; and with its filters before them.
#include "pairs.h"

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

namespace dsw::curves {

namespace {

using Test = fcl::detail::Intersect<double>;

fcl::Vector3d to_fcl(const Vec& p) { return {p[0], p[1], p[2]}; }

PairAnswer answer(bool hit, double time, const fcl::Vector3d& point) {
  if (!hit) return {};
  return {time, true, {point[0], point[1], point[2]}, {}};
}

PairAnswer vertex_face(const Pair& pair, bool filtered, bool newton) {
  const fcl::Vector3d a = to_fcl(pair.corners[0]), b = to_fcl(pair.corners[1]), c = to_fcl(pair.corners[2]),
                      p = to_fcl(pair.from), to = to_fcl(pair.to);
  double time = -1;
  fcl::Vector3d point(0, 0, 0);
  const auto test = filtered ? Test::intersect_VF_filtered : Test::intersect_VF;
  const bool hit = test(a, b, c, p, a, b, c, to, &time, &point, newton);
  return answer(hit, time, point);
}

PairAnswer edge_edge(const Pair& pair, bool filtered, bool newton) {
  const fcl::Vector3d a = to_fcl(pair.corners[0]), b = to_fcl(pair.corners[1]), p = to_fcl(pair.from),
                      to = to_fcl(pair.to), q = to_fcl(pair.fixed);
  double time = -1;
  fcl::Vector3d point(0, 0, 0);
  const auto test = filtered ? Test::intersect_EE_filtered : Test::intersect_EE;
  const bool hit = test(p, q, a, b, to, q, a, b, &time, &point, newton);
  return answer(hit, time, point);
}

}  // namespace

void add_fcl(PairMethods& methods) {
  const auto test = methods.pairs().kind == PairKind::kVertexFace ? vertex_face : edge_edge;
  const struct {
    const char* setting;
    bool filtered, newton;
  } settings[] = {{"Newton", false, true},
                  {"closed form", false, false},
                  {"Newton, filtered", true, true},
                  {"closed form, filtered", true, false}};
  for (const auto& s : settings) {
    methods.add("FCL cubic", s.setting, "solver",
                [test, s](const Pair& pair) { return test(pair, s.filtered, s.newton); });
  }
}

}  // namespace dsw::curves
