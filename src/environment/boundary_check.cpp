// Every boundary triangle has a solid inner side, and so has every edge between two mates: the sector between them.
// Where two such solids round a common line overlap, the boundary crosses itself; nothing else needs a look at pairs
// (two equally turned triangles of one plane that overlap do so round an edge of one of them as well). If they never
// do, walking along a connected sheet of the boundary never changes how often the space just inside of it is covered
// (contacts in single points can be walked round), and one ray for every sheet tells whether that is once. In the plane
// sides take the place of triangles, and solids are compared round common points, which cannot be walked round. No
// tolerance, and no shift where contact is tested.

#include "environment/boundary_check.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/sort.h"
#include "environment/boundary_surface.h"
#include "predicates/filtered.h"
#include "predicates/turn.h"

namespace dsw {
namespace {

/** The solid round a ridge: from `from` on, counter-clockwise (in space right-handed about the line), to `to`; all
 * round if both point the same way. */
struct Sector {
  uint32_t from, to;
};

/** Whether the direction of x lies in a sector, its start included and its end not. quarter(from, x): how far it is
 * from one to the other, 0 not at all, 1 less than half a turn, 2 half, 3 more; is_before(x, y): whether y follows x
 * within half a turn. */
template <class Quarter, class IsBefore>
bool starts_in(Sector sector, uint32_t x, Quarter quarter, IsBefore is_before) {
  const int of_x = quarter(sector.from, x), of_end = quarter(sector.from, sector.to);
  if (of_x == 0 || of_end == 0) return true;
  if (of_x != of_end) return of_x < of_end;
  return of_x != 2 && is_before(x, sector.to);
}
template <class Quarter, class IsBefore>
bool sectors_overlap(Sector one, Sector two, Quarter quarter, IsBefore is_before) {
  return starts_in(one, two.from, quarter, is_before) || starts_in(two, one.from, quarter, is_before);
}

/** Whether the solids behind two boundary simplices overlap where these meet. */
template <int D>
class Overlap;

template <>
class Overlap<3> {
 public:
  Overlap(const Environment<3>& env, const BoundarySurface<3>& surface) : env_(env), surface_(surface) {}

  bool operator()(uint32_t i, uint32_t j) const {
    const Triangle &t = surface_.simplices[i], &s = surface_.simplices[j];
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

 private:
  using Triangle = BoundarySimplex<3>;

  const double* at(uint32_t v) const { return env_.point(v); }

  /** orient3(a, b, c, d): positive if d lies where a right-handed turn about a -> b takes c within half a turn. */
  int orient3(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    if (d == a || d == b || d == c) return 0;
    const double* triangle[3] = {at(a), at(b), at(c)};
    return orient<3>(triangle, at(d));
  }
  int side(const Triangle& t, uint32_t v) const { return orient3(t.vertex[0], t.vertex[1], t.vertex[2], v); }

  /** Turn of a, b, c with coordinate `axis` left out. */
  int turn(uint32_t a, uint32_t b, uint32_t c, int axis) const {
    return c == a || c == b ? 0 : turn_sign<3>(at(a), at(b), at(c), axis);
  }
  int turn(const Triangle& t, int axis) const { return turn(t.vertex[0], t.vertex[1], t.vertex[2], axis); }
  int projection(const Triangle& t) const {
    const double* const points[3] = {at(t.vertex[0]), at(t.vertex[1]), at(t.vertex[2])};
    return dsw::projection(points);
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

  Sector sector_of(uint32_t triangle, uint32_t edge, bool forward) const {
    const Triangle& t = surface_.simplices[triangle];
    const uint32_t own = t.vertex[(edge + 2) % 3], other = surface_.beyond(t.mate[edge]);
    return forward ? Sector{other, own} : Sector{own, other};
  }

  /** Edge k of triangle i, which lies in the plane of triangle j, against that triangle and its edges. */
  bool edge_against(uint32_t i, uint32_t k, uint32_t j) const {
    const Triangle& s = surface_.simplices[j];
    if (edge_in_face(i, k, s)) return true;
    for (uint32_t m = 0; m < 3; ++m) {
      if (surface_.simplices[i].mate[k] != 3 * j + m && edges_overlap(i, k, j, m)) return true;
    }
    return false;
  }

  bool edge_in_face(uint32_t i, uint32_t k, const Triangle& s) const {
    const Triangle& t = surface_.simplices[i];
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
    const Triangle &t = surface_.simplices[i], &s = surface_.simplices[j];
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
    const auto quarter_to = [&](uint32_t from, uint32_t x) { return quarter(a, b, from, x); };
    const auto is_before = [&](uint32_t x, uint32_t y) { return orient3(a, b, x, y) > 0; };
    return sectors_overlap(one, two, quarter_to, is_before);
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

  const Environment<3>& env_;
  const BoundarySurface<3>& surface_;
};

/** Sides cross inside of both, or the solids overlap where one of them ends. */
template <>
class Overlap<2> {
 public:
  Overlap(const Environment<2>& env, const BoundarySurface<2>& surface) : env_(env), surface_(surface) {}

  bool operator()(uint32_t i, uint32_t j) const {
    const Side &t = surface_.simplices[i], &s = surface_.simplices[j];
    int of_t[2], of_s[2];
    for (int k = 0; k < 2; ++k) of_t[k] = side(s, t.vertex[k]);
    if (of_t[0] * of_t[1] > 0) return false;
    for (int k = 0; k < 2; ++k) of_s[k] = side(t, s.vertex[k]);
    if (of_s[0] * of_s[1] > 0) return false;
    if (of_t[0] * of_t[1] < 0 && of_s[0] * of_s[1] < 0) return true;
    for (uint32_t k = 0; k < 2; ++k) {
      if (of_t[k] == 0 && end_against(i, k, j)) return true;
      if (of_s[k] == 0 && end_against(j, k, i)) return true;
    }
    return false;
  }

 private:
  using Side = BoundarySimplex<2>;

  const double* at(uint32_t v) const { return env_.point(v); }
  bool same(uint32_t v, uint32_t w) const { return std::equal(at(v), at(v) + 2, at(w)); }

  /** Tells on which side of the line a -> b the vertex v lies: positive on the left. */
  int turn(uint32_t a, uint32_t b, uint32_t v) const {
    return v == a || v == b ? 0 : turn_sign<2>(at(a), at(b), at(v));
  }
  int side(const Side& s, uint32_t v) const { return turn(s.vertex[0], s.vertex[1], v); }

  Sector sector_at(uint32_t i, uint32_t k) const {
    const Side& t = surface_.simplices[i];
    const uint32_t beyond = surface_.beyond(t.mate[k]);
    return k == 0 ? Sector{t.vertex[1], beyond} : Sector{beyond, t.vertex[0]};
  }

  /** End k of side i, which lies in the line of side j, against that side. */
  bool end_against(uint32_t i, uint32_t k, uint32_t j) const {
    const uint32_t v = surface_.simplices[i].vertex[k];
    const Side& s = surface_.simplices[j];
    for (uint32_t m = 0; m < 2; ++m) {
      if (!same(v, s.vertex[m])) continue;
      return surface_.simplices[i].mate[k] != 2 * j + m && overlap(v, sector_at(i, k), sector_at(j, m));
    }
    const double *p = at(v), *a = at(s.vertex[0]), *b = at(s.vertex[1]);
    for (int x = 0; x < 2; ++x) {
      if (p[x] < std::min(a[x], b[x]) || p[x] > std::max(a[x], b[x])) return false;
    }
    return overlap(v, sector_at(i, k), {s.vertex[1], s.vertex[0]});
  }

  bool overlap(uint32_t v, Sector one, Sector two) const {
    const auto quarter_to = [&](uint32_t from, uint32_t x) { return quarter(v, from, x); };
    const auto is_before = [&](uint32_t x, uint32_t y) { return turn(v, x, y) > 0; };
    return sectors_overlap(one, two, quarter_to, is_before);
  }
  /** How far from `from` to x about v, as starts_in has it. */
  int quarter(uint32_t v, uint32_t from, uint32_t x) const {
    if (x == from) return 0;
    const int order = turn(v, from, x);
    if (order != 0) return order > 0 ? 1 : 3;
    const int axis = at(from)[0] != at(v)[0] ? 0 : 1;
    return (at(from)[axis] > at(v)[axis]) == (at(x)[axis] > at(v)[axis]) ? 0 : 2;
  }

  const Environment<2>& env_;
  const BoundarySurface<2>& surface_;
};

/** Where rays are aimed at in a simplex. */
template <int D>
struct Weights;
template <>
struct Weights<2> {
  static constexpr double of[5][2] = {{0.52, 0.48}, {0.25, 0.75}, {0.75, 0.25}, {1, 0}, {0, 1}};
};
template <>
struct Weights<3> {
  static constexpr double of[7][3] = {{0.34, 0.33, 0.33}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5},
                                      {1, 0, 0},          {0, 1, 0},         {0, 0, 1}};
};

template <int D>
class Check {
 public:
  explicit Check(const Environment<D>& env)
      : env_(env), surface_(env), tree_(tree_of(env, surface_)), overlap_(env, surface_) {
    std::copy_n(at(surface_.simplices[0].vertex[0]), D, lower_);
    std::copy_n(lower_, D, upper_);
    for (const Simplex& t : surface_.simplices) {
      double lower[D], upper[D];
      box_of(t, lower, upper);
      for (int k = 0; k < D; ++k) {
        lower_[k] = std::min(lower_[k], lower[k]);
        upper_[k] = std::max(upper_[k], upper[k]);
      }
    }
  }

  bool run(Offenders* offenders) {
    check_pairs();
    if (bad_cells_.empty()) check_sheets();
    if (offenders != nullptr) {
      dsw::sort(bad_cells_.begin(), bad_cells_.end());
      for (const uint32_t cell : bad_cells_) offenders->add(cell);
    }
    return !bad_cells_.empty();
  }

 private:
  using Simplex = BoundarySimplex<D>;

  const double* at(uint32_t v) const { return env_.point(v); }

  void blame(const Simplex& t) { bad_cells_.push_back(env_.map.index(t.cell)); }

  void check_pairs() {
    for (uint32_t i = 0; i < surface_.simplices.size(); ++i) {
      double lower[D], upper[D];
      box_of(surface_.simplices[i], lower, upper);
      tree_.for_each(lower, upper, [&](uint32_t j) {
        if (j <= i || !overlap_(i, j)) return;
        blame(surface_.simplices[i]);
        blame(surface_.simplices[j]);
      });
    }
  }

  void box_of(const Simplex& t, double* lower, double* upper) const {
    std::copy_n(at(t.vertex[0]), D, lower);
    std::copy_n(lower, D, upper);
    for (const uint32_t v : t.vertex) {
      for (int k = 0; k < D; ++k) {
        lower[k] = std::min(lower[k], at(v)[k]);
        upper[k] = std::max(upper[k], at(v)[k]);
      }
    }
  }

  /** The points of a simplex. */
  struct Points {
    const double* of[D];

    Points(const Check& check, const Simplex& t) {
      for (int k = 0; k < D; ++k) of[k] = check.at(t.vertex[k]);
    }
  };

  /** How a segment goes through a simplex: 1 outwards, -1 inwards, 0 not at all. Its ends are shifted. */
  int pierced(const Simplex& t, const double* p, const double* q) const {
    NoTally none;
    const Points points(*this, t);
    const int from = plane_side<D>(points.of, p, none).sign, to = plane_side<D>(points.of, q, none).sign;
    if (from * to >= 0) return 0;
    for (int k = 0; k < D; ++k) {
      if (ridge_side(p, q, points.of, k, none) != to) return 0;
    }
    return to;
  }

  void check_sheets() {
    Array<uint8_t> done(surface_.simplices.size(), 0, env_.memory);
    for (uint32_t i = 0; i < surface_.simplices.size(); ++i) {
      if (done[surface_.sheet[i]] != 0) continue;
      int covered = 0;
      if (!count_inside(i, &covered)) continue;
      done[surface_.sheet[i]] = 1;
      if (covered != 1) blame(surface_.simplices[i]);
    }
  }

  /** How often what is just inside of a simplex is covered; false if no ray along an axis could be aimed at it, which
   * takes one a few roundings wide: another one of its sheet will do. */
  bool count_inside(uint32_t i, int* covered) const {
    const Simplex& t = surface_.simplices[i];
    const Points points(*this, t);
    for (const auto& w : Weights<D>::of) {
      for (int axis = 0; axis < D; ++axis) {
        double p[D], q[D];
        for (int k = 0; k < D; ++k) {
          p[k] = w[0] * points.of[0][k];
          for (int j = 1; j < D; ++j) p[k] += w[j] * points.of[j][k];
          q[k] = p[k];
        }
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

  /** Coverings that a ray leaves less those it enters behind simplex i; one in the same plane counts or not. */
  int count_behind(uint32_t i, const double* p, const double* q, bool with_same_plane) const {
    const Simplex& t = surface_.simplices[i];
    const Points points(*this, t);
    NoTally none;
    int sum = 0;
    tree_.for_each(p, q, [&](uint32_t j) {
      const Simplex& s = surface_.simplices[j];
      const int through = j == i ? 0 : pierced(s, p, q);
      if (through == 0) return;
      const int order = compare_times<D>(p, q, points.of, Points(*this, s).of, none).sign;
      if (order < 0 || (order == 0 && with_same_plane)) sum += through;
    });
    return sum;
  }

  const Environment<D>& env_;
  BoundarySurface<D> surface_;
  BoxTree<D> tree_;
  Overlap<D> overlap_;
  Array<uint32_t> bad_cells_{env_.memory};
  double lower_[D], upper_[D];  // of the surface, which is that of all points that cells use
};

}  // namespace

template <int D>
bool boundary_crosses(const Environment<D>& env, Offenders* offenders) {
  return Check<D>(env).run(offenders);
}

DSW_INSTANTIATE(boundary_crosses);

}  // namespace dsw
