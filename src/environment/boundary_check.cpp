// Every boundary triangle has a solid inner side, and so has every edge between two mates: the sector between them. Where
// two such solids round a common line overlap, the boundary crosses itself; nothing else needs a look at pairs (two equally
// turned triangles of one plane that overlap do so round an edge of one of them as well). If they never do, walking along
// a connected sheet of the boundary never changes how often the space just inside of it is covered (contacts in single
// points can be walked round), and one ray for every sheet tells whether that is once. No tolerance, and no shift where
// contact is judged.

#include "environment/boundary_check.h"

#include <algorithm>

#include "environment/boundary_surface.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

class Check {
 public:
  explicit Check(const Environment<3>& env)
      : env_(env), surface_(env), tree_(env, surface_), bad_cells_(Allocator<uint32_t>(env.memory)) {
    std::copy_n(at(surface_.triangles[0].vertex[0]), 3, lower_);
    std::copy_n(lower_, 3, upper_);
    for (const Triangle& t : surface_.triangles) {
      double lower[3], upper[3];
      box_of(t, lower, upper);
      for (int k = 0; k < 3; ++k) {
        lower_[k] = std::min(lower_[k], lower[k]);
        upper_[k] = std::max(upper_[k], upper[k]);
      }
    }
  }

  bool run(Offenders* offenders) {
    check_pairs();
    if (bad_cells_.empty()) check_sheets();
    if (offenders != nullptr) {
      std::sort(bad_cells_.begin(), bad_cells_.end());
      for (const uint32_t cell : bad_cells_) offenders->add(cell);
    }
    return !bad_cells_.empty();
  }

 private:
  using Triangle = BoundaryTriangle;

  const double* at(uint32_t v) const { return env_.point(v); }

  void blame(const Triangle& t) { bad_cells_.push_back(env_.map.index(t.cell)); }

  void check_pairs() {
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      double lower[3], upper[3];
      box_of(surface_.triangles[i], lower, upper);
      tree_.for_each(lower, upper, [&](uint32_t j) {
        if (j <= i || !overlap(i, j)) return;
        blame(surface_.triangles[i]);
        blame(surface_.triangles[j]);
      });
    }
  }

  void box_of(const Triangle& t, double* lower, double* upper) const {
    const double *a = at(t.vertex[0]), *b = at(t.vertex[1]), *c = at(t.vertex[2]);
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min({a[k], b[k], c[k]});
      upper[k] = std::max({a[k], b[k], c[k]});
    }
  }

  /** orient3(a, b, c, d): positive if d lies where a right-handed turn about a -> b takes c within half a turn. */
  int orient3(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    if (d == a || d == b || d == c) return 0;
    const double* triangle[3] = {at(a), at(b), at(c)};
    return orient<3>(triangle, at(d));
  }
  int side(const Triangle& t, uint32_t v) const { return orient3(t.vertex[0], t.vertex[1], t.vertex[2], v); }

  /** Turn of a, b, c with coordinate `axis` left out. */
  int turn(uint32_t a, uint32_t b, uint32_t c, int axis) const {
    if (c == a || c == b) return 0;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double pa[2] = {at(a)[i], at(a)[j]}, pb[2] = {at(b)[i], at(b)[j]}, pc[2] = {at(c)[i], at(c)[j]};
    const double* edge[2] = {pa, pb};
    return -orient<2>(edge, pc);  // orient<2> is positive on the right
  }
  int turn(const Triangle& t, int axis) const { return turn(t.vertex[0], t.vertex[1], t.vertex[2], axis); }
  /** A coordinate that can be left out without making the triangle flat. */
  int projection(const Triangle& t) const { return turn(t, 0) != 0 ? 0 : turn(t, 1) != 0 ? 1 : 2; }

  bool overlap(uint32_t i, uint32_t j) const {
    const Triangle &t = surface_.triangles[i], &s = surface_.triangles[j];
    int of_t[3], of_s[3];
    for (int k = 0; k < 3; ++k) of_t[k] = side(s, t.vertex[k]);
    if (on_one_side(of_t)) return false;
    for (int k = 0; k < 3; ++k) of_s[k] = side(t, s.vertex[k]);
    if (on_one_side(of_s)) return false;
    if (straddles(of_t) && straddles(of_s)) return pierce(t, of_t, s, of_s);
    for (uint32_t k = 0; k < 3; ++k) {
      if (of_t[k] == 0 && of_t[(k + 1) % 3] == 0 && edge_against(i, k, j)) return true;
      if (of_s[k] == 0 && of_s[(k + 1) % 3] == 0 && edge_in_face(j, k, t)) return true;
    }
    return false;
  }

  static bool on_one_side(const int (&of)[3]) { return of[0] != 0 && of[0] == of[1] && of[1] == of[2]; }
  static bool straddles(const int (&of)[3]) {
    return std::min({of[0], of[1], of[2]}) < 0 && std::max({of[0], of[1], of[2]}) > 0;
  }

  /** Each crosses the other's plane. On the common line the ends of both intervals lie on the two edges at the vertex
   * that is alone on its side, and orient3 of two such edges compares two ends, always in the same sense. */
  bool pierce(const Triangle& t, const int (&of_t)[3], const Triangle& s, const int (&of_s)[3]) const {
    const uint32_t a = lone(of_t), b = lone(of_s);
    bool before = false, after = false;
    for (uint32_t m = 1; m < 3; ++m) {
      for (uint32_t n = 1; n < 3; ++n) {
        const int order = orient3(t.vertex[a], t.vertex[(a + m) % 3], s.vertex[b], s.vertex[(b + n) % 3]);
        before = before || order < 0;
        after = after || order > 0;
      }
    }
    return before && after;
  }
  static uint32_t lone(const int (&of)[3]) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (of[k] != 0 && of[(k + 1) % 3] != of[k] && of[(k + 2) % 3] != of[k]) return k;
    }
    return 0;
  }

  /** The solid round a line: from `from` right-handed about the line to `to`; all round if both point the same way. */
  struct Sector {
    uint32_t from, to;
  };
  Sector sector_of(uint32_t triangle, uint32_t edge, bool forward) const {
    const Triangle& t = surface_.triangles[triangle];
    const uint32_t own = t.vertex[(edge + 2) % 3], other = surface_.beyond(t.mate[edge]);
    return forward ? Sector{other, own} : Sector{own, other};
  }

  /** Edge k of triangle i, which lies in the plane of triangle j, against that triangle and its edges. */
  bool edge_against(uint32_t i, uint32_t k, uint32_t j) const {
    const Triangle& s = surface_.triangles[j];
    if (edge_in_face(i, k, s)) return true;
    for (uint32_t m = 0; m < 3; ++m) {
      if (surface_.triangles[i].mate[k] != 3 * j + m && edges_overlap(i, k, j, m)) return true;
    }
    return false;
  }

  bool edge_in_face(uint32_t i, uint32_t k, const Triangle& s) const {
    const Triangle& t = surface_.triangles[i];
    const uint32_t a = t.vertex[k], b = t.vertex[(k + 1) % 3];
    const int axis = projection(s), sense = turn(s, axis);
    for (uint32_t m = 0; m < 3; ++m) {
      const uint32_t u = s.vertex[m], v = s.vertex[(m + 1) % 3];
      if (turn(u, v, a, axis) * sense <= 0 && turn(u, v, b, axis) * sense <= 0) return false;
    }
    uint32_t left = ~0u, right = ~0u;
    for (const uint32_t v : s.vertex) {
      const int where = turn(a, b, v, axis) * sense;
      if (where > 0) left = v;
      if (where < 0) right = v;
    }
    if (left == ~0u || right == ~0u) return false;
    return overlap(a, b, sector_of(i, k, true), {right, left});
  }

  bool edges_overlap(uint32_t i, uint32_t k, uint32_t j, uint32_t m) const {
    const Triangle &t = surface_.triangles[i], &s = surface_.triangles[j];
    const uint32_t a = t.vertex[k], b = t.vertex[(k + 1) % 3], c = s.vertex[m], d = s.vertex[(m + 1) % 3];
    for (int axis = 0; axis < 3; ++axis) {
      if (turn(a, b, c, axis) != 0 || turn(a, b, d, axis) != 0) return false;
    }
    int along = 0;
    while (along < 2 && at(a)[along] == at(b)[along]) ++along;
    const double pa = at(a)[along], pb = at(b)[along], pc = at(c)[along], pd = at(d)[along];
    if (!(std::max(std::min(pa, pb), std::min(pc, pd)) < std::min(std::max(pa, pb), std::max(pc, pd)))) return false;
    return overlap(a, b, sector_of(i, k, true), sector_of(j, m, (pa < pb) == (pc < pd)));
  }

  bool overlap(uint32_t a, uint32_t b, Sector one, Sector two) const {
    return starts_in(a, b, one, two.from) || starts_in(a, b, two, one.from);
  }
  /** Whether the direction of x lies in a sector, its start included and its end not. */
  bool starts_in(uint32_t a, uint32_t b, Sector sector, uint32_t x) const {
    const int of_x = quarter(a, b, sector.from, x), of_end = quarter(a, b, sector.from, sector.to);
    if (of_x == 0 || of_end == 0) return true;
    if (of_x != of_end) return of_x < of_end;
    return of_x != 2 && orient3(a, b, x, sector.to) > 0;
  }
  /** How far from `from` to x about a -> b: 0 not at all, 1 less than half a turn, 2 half, 3 more. */
  int quarter(uint32_t a, uint32_t b, uint32_t from, uint32_t x) const {
    if (x == from) return 0;
    const int order = orient3(a, b, from, x);
    if (order != 0) return order > 0 ? 1 : 3;
    int axis = 0;
    while (axis < 2 && turn(a, b, from, axis) == 0) ++axis;
    return turn(a, b, from, axis) == turn(a, b, x, axis) ? 0 : 2;
  }

  /** How a segment goes through a triangle: 1 outwards, -1 inwards, 0 not at all. Its ends are shifted. */
  int pierced(const Triangle& t, const double* p, const double* q) const {
    NoTally none;
    const double* points[3] = {at(t.vertex[0]), at(t.vertex[1]), at(t.vertex[2])};
    const int from = plane_side<3>(points, p, none).sign, to = plane_side<3>(points, q, none).sign;
    if (from * to >= 0) return 0;
    for (int k = 0; k < 3; ++k) {
      const double* ridge[2] = {points[k], points[(k + 1) % 3]};
      if (line_side<3>(p, q, ridge, none).sign != to) return 0;
    }
    return to;
  }

  void check_sheets() {
    Array<uint8_t> done(surface_.triangles.size(), 0, Allocator<uint8_t>(env_.memory));
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      if (done[surface_.sheet[i]] != 0) continue;
      int covered = 0;
      if (!count_inside(i, &covered)) continue;
      done[surface_.sheet[i]] = 1;
      if (covered != 1) blame(surface_.triangles[i]);
    }
  }

  /** How often the space just inside of a triangle is covered; false if no ray along an axis could be aimed at it, which
   * takes a triangle a few roundings wide: another one of its sheet will do. */
  bool count_inside(uint32_t i, int* covered) const {
    const Triangle& t = surface_.triangles[i];
    const double *a = at(t.vertex[0]), *b = at(t.vertex[1]), *c = at(t.vertex[2]);
    constexpr double kWeights[7][3] = {{0.34, 0.33, 0.33}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5},
                                       {1, 0, 0},          {0, 1, 0},         {0, 0, 1}};
    for (const auto& w : kWeights) {
      for (int axis = 0; axis < 3; ++axis) {
        double p[3], q[3];
        for (int k = 0; k < 3; ++k) p[k] = q[k] = (w[0] * a[k] + w[1] * b[k]) + w[2] * c[k];
        p[axis] = lower_[axis];
        q[axis] = upper_[axis];  // shifted beyond everything
        const int through = pierced(t, p, q);
        if (through == 0) continue;
        *covered = through > 0 ? 1 + count_behind(i, p, q, true) : count_behind(i, p, q, false);
        return true;
      }
    }
    return false;
  }

  /** Coverings that a ray leaves less those it enters behind triangle i; a triangle in the same plane counts or not. */
  int count_behind(uint32_t i, const double* p, const double* q, bool with_same_plane) const {
    const Triangle& t = surface_.triangles[i];
    const double* points[3] = {at(t.vertex[0]), at(t.vertex[1]), at(t.vertex[2])};
    NoTally none;
    int sum = 0;
    tree_.for_each(p, q, [&](uint32_t j) {
      const Triangle& s = surface_.triangles[j];
      const int through = j == i ? 0 : pierced(s, p, q);
      if (through == 0) return;
      const double* others[3] = {at(s.vertex[0]), at(s.vertex[1]), at(s.vertex[2])};
      const int order = compare_times<3>(p, q, points, others, none).sign;
      if (order < 0 || (order == 0 && with_same_plane)) sum += through;
    });
    return sum;
  }

  const Environment<3>& env_;
  BoundarySurface surface_;
  BoundaryTree tree_;
  Array<uint32_t> bad_cells_;
  double lower_[3], upper_[3];  // of the surface, which is that of all points that cells use
};

}  // namespace

bool boundary_crosses(const Environment<3>& env, Offenders* offenders) { return Check(env).run(offenders); }

}  // namespace dsw
