#include "environment/validity.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/moving_pair.h"

namespace dsw {
namespace {

/** Where the vertices of one cell are; of a large cell they are looked up each time. */
template <int D>
class CellPoints {
 public:
  CellPoints(const Environment<D>& env, Cell c, const Shape& shape) : env_(env), cell_(c) {
    is_kept_ = shape.vertex_count() <= kMost;
    if (!is_kept_) return;
    const double** at = at_;
    env.map.for_each_vertex(c, [&](uint32_t vertex) { *at++ = env.point(vertex); });
  }
  const double* operator[](uint32_t local) const { return is_kept_ ? at_[local] : env_.point(cell_, local); }
  /** Computes the cell's centre as centre() does. */
  void centre(const Shape& shape, double* out) const {
    mean_point<D>(
        shape.vertex_count(), [&](uint32_t i) { return (*this)[i]; }, out);
  }
  void read(const Shape& shape, uint32_t simplex, const double* (&out)[D]) const {
    const uint16_t* const local = shape.simplices() + simplex * static_cast<uint32_t>(D);
    for (int k = 0; k < D; ++k) out[k] = (*this)[local[k]];
  }

  static constexpr uint32_t kMost = 64;  // vertices that are kept

 private:
  const Environment<D>& env_;
  Cell cell_;
  bool is_kept_;
  const double* at_[kMost];
};

/** A bound for the determinants of any three differences between vertices of a cell and its centre; infinite if the
 * filter is not to be used. No rounded difference is longer than that of the ends of a box round all of them. */
double bound_of_cell(const Shape& shape, const CellPoints<3>& at, const double* apex) noexcept {
  double lower[3], upper[3];
  for (int k = 0; k < 3; ++k) lower[k] = upper[k] = apex[k];
  for (uint32_t i = 0, count = shape.vertex_count(); i < count; ++i) {
    const double* const p = at[i];
    for (int k = 0; k < 3; ++k) {
      lower[k] = filter::smaller(lower[k], p[k]);
      upper[k] = filter::larger(upper[k], p[k]);
    }
  }
  const filter::Vec<3> m = filter::difference<3>(upper, lower);
  return filter::lowest(m) >= kFilterMin && filter::highest(m) <= kFilterMax ? filter::bound(m) : HUGE_VAL;
}

/** On which side of the plane of three points of a cell others are, as orient<3>. */
class FacetPlane {
 public:
  FacetPlane(const double* const (&triangle)[3], double bound) noexcept
      : triangle_{triangle[0], triangle[1], triangle[2]},
        normal_(filter::cross(filter::difference<3>(triangle[1], triangle[0]),
                              filter::difference<3>(triangle[2], triangle[0]))),
        bound_(bound) {}
  int side(const double* q) const noexcept {
    const double det = filter::dot(normal_, filter::difference<3>(q, triangle_[0]));
    if (std::fabs(det) > bound_) return filter::sign_of(det);
    return is_level(q) || is_along_axis() ? 0 : orient<3>(triangle_, q);
  }

 private:
  /** Whether a plane across an axis holds all four points: many facets lie in such planes, and many points in those. */
  bool is_level(const double* q) const noexcept {
    for (int k = 0; k < 3; ++k) {
      const double at = triangle_[0][k];
      if (triangle_[1][k] == at && triangle_[2][k] == at && q[k] == at) return true;
    }
    return false;
  }

  /** Whether the three points lie on a line along an axis: faces that were split have many such corners. */
  bool is_along_axis() const noexcept {
    int equal = 0;
    for (int k = 0; k < 3; ++k) {
      equal += triangle_[1][k] == triangle_[0][k] && triangle_[2][k] == triangle_[0][k] ? 1 : 0;
    }
    return equal >= 2;
  }

  const double* triangle_[3];
  filter::Vec<3> normal_;
  double bound_;
};

/** Exactly flat facets, and no vertex beyond a facet across any of its edges: with positive stars that cover every
 * direction once, locally convex is convex. Facets have to be convex too, which says more if two lie in one plane. If
 * both are flat and convex, and the neighbour's vertex is below the facet, then the facet's vertex is not above the
 * neighbour: that is asked only of vertices in one plane. The last facets are looked at first: where a cell was split,
 * the new one is last, and it is seldom flat. */
bool is_flat_and_convex(const Shape& shape, const CellPoints<3>& at, const double* apex) noexcept {
  const double bound = bound_of_cell(shape, at, apex);
  const auto plane_of = [&](uint32_t f) {
    const double* triangle[3];
    at.read(shape, shape.simplex_first(f), triangle);
    return FacetPlane(triangle, bound);
  };
  for (uint32_t f = shape.facet_count(); f-- != 0;) {
    if (shape.facet_size(f) == 3) continue;
    const uint16_t* const triangle = shape.simplices() + 3 * shape.simplex_first(f);
    const FacetPlane plane = plane_of(f);
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      const uint32_t corner = shape.dart_vertex(d);
      const bool is_of_plane = corner == triangle[0] || corner == triangle[1] || corner == triangle[2];
      if (!is_of_plane && plane.side(at[corner]) != 0) return false;
    }
  }
  for (uint32_t f = shape.facet_count(); f-- != 0;) {
    const uint32_t first = shape.facet_first(f), end = shape.facet_first(f + 1);
    const FacetPlane plane = plane_of(f);
    for (uint32_t d = first; d < end; ++d) {
      const uint32_t other = shape.dart_beta2(d), before = d == first ? end - 1 : d - 1;
      if (other < d) {
        const int side = plane.side(at[shape.dart_vertex(shape.beta0(other))]);
        if (side > 0) return false;
        if (side == 0 && plane_of(shape.dart_facet(other)).side(at[shape.dart_vertex(before)]) > 0) return false;
      }
      if (end - first == 3) continue;
      const double* const turn[3] = {at[shape.dart_vertex(before)], at[shape.dart_vertex(d)],
                                     at[shape.dart_vertex(d + 1 == end ? first : d + 1)]};
      if (FacetPlane(turn, bound).side(apex) > 0) return false;
    }
  }
  return true;
}

bool is_flat_and_convex(const Shape& shape, const CellPoints<2>& at, const double*) noexcept {
  const uint32_t n = shape.vertex_count();
  for (uint32_t i = 0; i < n; ++i) {
    const double* const edge[2] = {at[i], at[(i + 1) % n]};
    if (orient<2>(edge, at[(i + 2) % n]) > 0) return false;
  }
  return true;
}

/** How many boundary simplices the ray from `from` (strictly inside all of them) through `through` pierces, both
 * shifted. `read(s, points)` gives the points of a simplex. */
template <int D, class Read>
uint32_t count_pierced(uint32_t simplex_count, Read read, const double* from, const double* through) noexcept {
  NoTally none;
  uint32_t count = 0;
  for (uint32_t s = 0; s < simplex_count; ++s) {
    const double* points[D];
    read(s, points);
    bool pierced = true;
    for (int k = 0; k < D && pierced; ++k) pierced = ridge_side(from, through, points, k, none) > 0;
    count += pierced ? 1u : 0u;
  }
  return count;
}

/** Where a ray goes that counts simplices. Any direction will do, since the shift makes it generic; one off the edges
 * needs no exact arithmetic. */
template <int D>
void some_direction(const double* const (&points)[D], double* through) noexcept {
  for (int k = 0; k < D; ++k) {
    through[k] = (D == 3 ? 0.41 : 0.54) * points[0][k] + (D == 3 ? 0.34 : 0.46) * points[1][k];
    if (D == 3) through[k] += 0.25 * points[D - 1][k];
  }
}

/** Whether these simplices make a star with this apex: all positive, and no direction covered twice. */
template <int D, class Read>
CellState check_simplices(uint32_t simplex_count, Read read, const double* apex) noexcept {
  uint32_t inside = 0, outside = 0;
  const double* points[D];
  for (uint32_t s = 0; s < simplex_count; ++s) {
    read(s, points);
    const int side = orient<D>(points, apex);
    inside += side < 0 ? 1u : 0u;
    outside += side > 0 ? 1u : 0u;
    if (inside != s + 1 && outside != s + 1) return CellState::kInvalid;  // neither all of them nor none can be inside
  }
  if (outside == simplex_count) return CellState::kInverted;

  read(0, points);
  double through[D];
  some_direction<D>(points, through);
  if (count_pierced<D>(simplex_count, read, apex, through) != 1 &&
      count_pierced<D>(simplex_count, read, apex, points[0]) != 1) {
    return CellState::kInvalid;
  }
  return CellState::kValid;
}

/** Whether a tetrahedron or a hexahedron is valid, and so clearly that the filter sees it. Of a tetrahedron the side is asked for that
 * check_star asks for. Any three vertices of a facet of a hexahedron, in its order, have a positive volume with the centre. Then seen from
 * there facets are convex, however they are cut, and a vertex has three angles of less than pi. Round it that makes less than 3 pi, so once;
 * and a sphere that covers a sphere without a branch covers it once. */
bool is_plainly_valid(const Environment<3>& env, Cell c) noexcept {
  const uint32_t* const w = env.map.record(c);
  if (form_of(w[0]) == Form::kSimplex) {
    const double* const facet[3] = {env.point(w[0] & kVertexMask), env.point(w[1] & kVertexMask),
                                    env.point(w[3] & kVertexMask)};
    const filter::Plane<3> plane(facet, env.point(w[2] & kVertexMask));
    const double det = plane.det();
    return det < 0 && filter::certain(det, plane.reach());
  }
  if (form_of(w[0]) != Form::kBox) return false;
  double apex[3];
  centre(env, c, apex);
  filter::Vec<3> of[8], m{0, 0, 0};
  for (uint32_t i = 0; i < 8; ++i) {
    of[i] = filter::difference<3>(env.point(w[kUnitWords<3> + i]), apex);
    m = filter::extent(m, of[i]);
  }
  if (!(filter::lowest(m) >= kFilterMin && filter::highest(m) <= kFilterMax)) return false;
  const double bound = filter::bound(m);
  bool sure = true;
  for (const auto& facet : kBoxFacets) {
    const filter::Vec<3>&p = of[facet[0]], &q = of[facet[1]], &r = of[facet[2]], &s = of[facet[3]];
    const filter::Vec<3> pr = filter::cross(p, r), qs = filter::cross(q, s);
    sure &= filter::dot(pr, s) > bound;
    sure &= filter::dot(pr, q) < -bound;
    sure &= filter::dot(qs, p) > bound;
    sure &= filter::dot(qs, r) < -bound;
  }
  return sure;
}

bool is_plainly_valid(const Environment<2>&, Cell) noexcept { return false; }

/** What the filter alone proves of what check_simplices() proves. */
enum class Plainly { kStar, kNoStar, kUnknown };

/** One bound serves all determinants of the star. */
Plainly look_at_star(const Shape& shape, const CellPoints<3>& at, const double* apex) noexcept {
  const uint32_t count = shape.vertex_count();
  if (count > CellPoints<3>::kMost) return Plainly::kUnknown;
  const uint16_t* local = shape.simplices();
  const double* const first[3] = {at[local[0]], at[local[1]], at[local[2]]};
  double through[3];
  some_direction<3>(first, through);
  const filter::Vec<3> ray = filter::difference<3>(through, apex);
  filter::Vec<3> of[CellPoints<3>::kMost], across[CellPoints<3>::kMost], m = filter::extent(ray);
  for (uint32_t i = 0; i < count; ++i) {
    of[i] = filter::difference<3>(at[i], apex);
    across[i] = filter::cross(ray, of[i]);
    m = filter::extent(m, of[i]);
  }
  if (!(filter::lowest(m) >= kFilterMin && filter::highest(m) <= kFilterMax)) return Plainly::kUnknown;
  const double bound = filter::bound(m);
  uint32_t pierced = 0;
  bool sure = true;
  for (const uint16_t* const end = local + 3 * shape.simplex_count(); local != end; local += 3) {
    const filter::Vec<3>&p = of[local[0]], &q = of[local[1]], &r = of[local[2]];
    const double volume = filter::dot(filter::cross(p, q), r);
    if (volume < -bound) return Plainly::kNoStar;
    sure &= volume > bound;
    const double sides[3] = {filter::dot(across[local[0]], q), filter::dot(across[local[1]], r),
                             filter::dot(across[local[2]], p)};
    if (sides[0] < -bound || sides[1] < -bound || sides[2] < -bound) continue;
    sure &= sides[0] > bound && sides[1] > bound && sides[2] > bound;
    ++pierced;
  }
  return sure && pierced == 1 ? Plainly::kStar : Plainly::kUnknown;
}

Plainly look_at_star(const Shape&, const CellPoints<2>&, const double*) noexcept { return Plainly::kUnknown; }

/** Checks a cell as check_cell does, but does not look whether a valid cell is convex.
 * @param tells_inverted else an inverted cell may be called invalid. */
template <int D>
CellState check_star(const Environment<D>& env, Cell c, const Shape& shape, const CellPoints<D>& at, const double* apex,
                     bool tells_inverted) noexcept {
  if (env.map.form(c) == Form::kSimplex) {
    const double* points[D];
    at.read(shape, 0, points);
    const int side = orient<D>(points, at[2]);  // facet 0 joins vertices 0 1 (3): vertex 2 is the apex
    return side < 0 ? CellState::kValidConvex : side > 0 ? CellState::kInverted : CellState::kInvalid;
  }
  if (is_plainly_valid(env, c)) return CellState::kValid;
  const Plainly plainly = look_at_star(shape, at, apex);
  if (plainly == Plainly::kStar) return CellState::kValid;
  if (plainly == Plainly::kNoStar && !tells_inverted) return CellState::kInvalid;
  return check_simplices<D>(
      shape.simplex_count(), [&](uint32_t s, const double*(&points)[D]) { at.read(shape, s, points); }, apex);
}

/** Nobody has looked at the host's numbers. */
template <int D>
bool is_valid(const Environment<D>& env, Cell c) noexcept {
  for (uint32_t i = 0, count = env.map.vertices_of(c); i < count; ++i) {
    for (int k = 0; k < D; ++k) {
      if (!std::isfinite(env.point(c, i)[k])) return false;
    }
  }
  const Shape shape = env.map.shape(c);
  const CellPoints<D> at(env, c, shape);
  double apex[D];
  at.centre(shape, apex);
  const CellState state = check_star(env, c, shape, at, apex, false);
  return state == CellState::kValid || state == CellState::kValidConvex;
}

/** The vertices of a facet, bits of a set. */
constexpr uint32_t corners_of(const uint8_t (&facet)[4]) {
  return 1u << facet[0] | 1u << facet[1] | 1u << facet[2] | 1u << facet[3];
}

}  // namespace

template <int D>
CellState check_cell(const Environment<D>& env, Cell c) noexcept {
  const Shape shape = env.map.shape(c);
  const CellPoints<D> at(env, c, shape);
  double apex[D];
  at.centre(shape, apex);
  const CellState state = check_star(env, c, shape, at, apex, true);
  if (state != CellState::kValid) return state;
  return is_flat_and_convex(shape, at, apex) ? CellState::kValidConvex : state;
}

/** Simplices that are positive all the time cover every direction as often at the end as at the start. */
template <int D>
bool stays_valid(const Environment<D>& env, Cell c, const double* next) {
  const Shape shape = env.map.shape(c);
  // A simplex is looked at from its vertex 2, as in check_star.
  const bool is_simplex = env.map.form(c) == Form::kSimplex;
  const uint32_t* const w = env.map.record(c);  // the form is asked once
  const auto vertex = [&](uint32_t local) { return is_simplex ? w[local] & kVertexMask : env.map.vertex(c, local); };
  const auto start = [&](uint32_t local) { return env.point(vertex(local)); };
  const auto end = [&](uint32_t local) { return next + size_t{D} * vertex(local); };
  double centres[2][D];
  if (!is_simplex) {
    mean_point<D>(shape.vertex_count(), start, centres[0]);
    mean_point<D>(shape.vertex_count(), end, centres[1]);
  }
  MovingPair<D> simplex{};
  simplex.start[0] = is_simplex ? start(2) : centres[0];
  simplex.end[0] = is_simplex ? end(2) : centres[1];
  for (uint32_t s = 0, count = is_simplex ? 1 : shape.simplex_count(); s < count; ++s) {
    const uint16_t* const local = shape.simplices() + s * static_cast<uint32_t>(D);
    for (int k = 0; k < D; ++k) {
      simplex.start[k + 1] = start(local[k]);
      simplex.end[k + 1] = end(local[k]);
    }
    if (kept_side(simplex) <= 0) return false;
  }
  return true;
}

bool is_valid_star(const double* const* vertices, uint32_t vertex_count, const uint8_t* triangles,
                   uint32_t triangle_count) noexcept {
  double apex[3];
  mean_point<3>(
      vertex_count, [&](uint32_t i) { return vertices[i]; }, apex);
  const auto read = [&](uint32_t t, const double*(&points)[3]) {
    for (uint32_t k = 0; k < 3; ++k) points[k] = vertices[triangles[3 * t + k]];
  };
  return check_simplices<3>(triangle_count, read, apex) == CellState::kValid;
}

template <int D>
bool is_valid_star(const double* const* simplices, uint32_t simplex_count, const double* apex) noexcept {
  const auto read = [&](uint32_t s, const double*(&points)[D]) { std::copy_n(simplices + size_t{s} * D, D, points); };
  return check_simplices<D>(simplex_count, read, apex) == CellState::kValid;
}

/** Summed over the simplices of its facets, seen from a vertex, in units of the cell's largest extent. */
template <int D>
double rounded_volume(const Environment<D>& env, Cell c) noexcept {
  const Shape shape = env.map.shape(c);
  const double* const origin = env.point(c, 0);
  double scale = 0;
  env.map.for_each_vertex(c, [&](uint32_t v) {
    for (int k = 0; k < D; ++k) scale = std::max(scale, std::fabs(env.point(v)[k] / 2 - origin[k] / 2));
  });
  double sum = 0;
  for (uint32_t s = 0; s < shape.simplex_count() && scale > 0; ++s) {
    const double* points[D];
    simplex_points(env, c, shape, s, points);
    double of[D][D];
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) of[i][k] = (points[i][k] / 2 - origin[k] / 2) / scale;
    }
    if constexpr (D == 2) {
      sum += of[0][0] * of[1][1] - of[0][1] * of[1][0];
    } else {
      sum += of[0][0] * (of[1][1] * of[2][2] - of[1][2] * of[2][1]) +
             of[0][1] * (of[1][2] * of[2][0] - of[1][0] * of[2][2]) +
             of[0][2] * (of[1][0] * of[2][1] - of[1][1] * of[2][0]);
    }
  }
  return sum;
}

/** Along each axis the vertices lie in two planes, four in each. These are the vertices of two opposite facets, of
 * another pair for each axis. The centre must lie between the planes: rounding can put that of a thin cuboid on one. */
bool is_cuboid(const Environment<3>& env, Cell c) noexcept {
  constexpr uint32_t kFirst = corners_of(kBoxFacets[0]), kSecond = corners_of(kBoxFacets[2]),
                     kThird = corners_of(kBoxFacets[4]);  // these meet in vertex 0, the other three in vertex 6
  static_assert((kFirst & kSecond & kThird) == 1 && (kFirst | kSecond | kThird) == (0xffu & ~(1u << 6)));
  const uint32_t* const w = env.map.record(c);
  if (form_of(w[0]) != Form::kBox) return false;
  const double *const corner = env.point(w[kUnitWords<3>]), *const across = env.point(w[kUnitWords<3> + 6]);
  const double* const next = env.point(w[kUnitWords<3> + 1]);  // along an edge: most others leave here
  if ((next[0] == corner[0]) + (next[1] == corner[1]) + (next[2] == corner[2]) != 2) return false;
  uint32_t pairs[3], mirrored = 0;  // pairs[k]: facets across axis k
  for (uint32_t k = 0; k < 3; ++k) {
    uint32_t here = 0, there = 0;
    for (uint32_t i = 0; i < 8; ++i) {
      const double x = env.point(w[kUnitWords<3> + i])[k];
      here |= (x == corner[k] ? 1u : 0u) << i;
      there |= (x == across[k] ? 1u : 0u) << i;
    }
    if ((here ^ there) != 0xffu) return false;
    pairs[k] = here == kFirst ? 0 : here == kSecond ? 1 : here == kThird ? 2 : 3;
    mirrored ^= across[k] < corner[k] ? 1u : 0u;
  }
  if ((1u << pairs[0] | 1u << pairs[1] | 1u << pairs[2]) != 7) return false;
  mirrored ^= (pairs[0] + 1) % 3 == pairs[1] ? 0u : 1u;
  if (mirrored != 0) return false;
  double apex[3];
  centre(env, c, apex);
  bool is_between = true;
  for (uint32_t k = 0; k < 3; ++k) {
    is_between &= std::min(corner[k], across[k]) < apex[k] && apex[k] < std::max(corner[k], across[k]);
  }
  return is_between;
}

template <int D>
CheckedCells::Known find_out_validity(const Environment<D>& env, Cell c) noexcept {
  const CheckedCells::Known known = is_cuboid(env, c)                              ? CheckedCells::Known::kCuboid
                                    : is_plainly_valid(env, c) || is_valid(env, c) ? CheckedCells::Known::kValid
                                                                                   : CheckedCells::Known::kInvalid;
  env.checked.note(env.map.index(c), known);
  return known;
}

DSW_INSTANTIATE(find_out_validity);
DSW_INSTANTIATE(check_cell);
DSW_INSTANTIATE(stays_valid);
DSW_INSTANTIATE(rounded_volume);
template bool is_valid_star<2>(const double* const*, uint32_t, const double*) noexcept;
template bool is_valid_star<3>(const double* const*, uint32_t, const double*) noexcept;

}  // namespace dsw
