#include "conform/facet_pairs.h"

#include <cmath>

#include "base/search.h"
#include "base/sort.h"
#include "predicates/turn.h"

namespace dsw {
namespace {

bool has(VertexRange loop, uint32_t vertex) { return dsw::find(loop.begin(), loop.end(), vertex) != loop.end(); }

/** Corners of a triangle in a unit near its size, a power of two, so that no product of differences overflows or vanishes. */
struct ScaledTriangle {
  double corners[3][3];
  ScaledTriangle(const double* const (&t)[3], int exponent) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) corners[i][k] = exponent == 0 ? t[i][k] : std::ldexp(t[i][k], -exponent);
    }
  }
  double difference(int axis, int i, int j) const { return corners[j][axis] - corners[i][axis]; }
  /** Twice the area with a coordinate left out, rounded. */
  double area(int axis) const {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return std::fabs(difference(i, 0, 1) * difference(j, 0, 2) - difference(j, 0, 1) * difference(i, 0, 2));
  }
};

/** The exponent of that unit for all triangles in a box: 0 where products need none. */
int unit_exponent(const ClosedBox<3>& box) {
  double half = 0;  // of the size, which may overflow
  for (int k = 0; k < 3; ++k) half = std::fmax(half, box.upper[k] / 2 - box.lower[k] / 2);
  int exponent = 0;
  std::frexp(half, &exponent);
  return exponent > -400 && exponent < 400 ? 0 : exponent;
}

bool is_in_box(const ClosedBox<3>& box, const double* p, double room) {
  for (int k = 0; k < 3; ++k) {
    if (p[k] < box.lower[k] - room || p[k] > box.upper[k] + room) return false;
  }
  return true;
}

}  // namespace

FacetPairs::FacetPairs(const Environment<3>& env, const OuterFacets<3>& outer, double room, HangingPoints<3>& hanging)
    : env_(env),
      outer_(outer),
      room_(room),
      hanging_(hanging),
      faces_(env.memory),
      pairs_(env.memory),
      first_(outer.count() + 1, 0, env.memory),
      partners_(env.memory),
      loops_(env.memory) {
  const Array<uint32_t> inner = find_inner();
  faces_.resize(outer.count());
  for (const uint32_t i : inner) faces_[i] = face_of(i);
  find_pairs(inner);
  for (const ItemPair& pair : pairs_) {
    hang(pair.low, outer_.loop(pair.high));
    hang(pair.high, outer_.loop(pair.low));
  }
  // Points on edges of a facet may lie on edges of its partners, too, until there are no more of these.
  fill_loops();
  for (uint32_t before = 0; before != hanging_.count();) {
    before = hanging_.count();
    for (const ItemPair& pair : pairs_) {
      if (loop(pair.low).size() != outer_.loop(pair.low).size()) hang(pair.high, loop(pair.low));
      if (loop(pair.high).size() != outer_.loop(pair.high).size()) hang(pair.low, loop(pair.high));
    }
    if (before != hanging_.count()) fill_loops();
  }
}

/** The facets that may have partners. A facet that lies in a side of the box round the mesh has none: their cells would be beyond. */
Array<uint32_t> FacetPairs::find_inner() const {
  ClosedBox<3> all;
  for (uint32_t i = 0; i < outer_.count(); ++i) {
    all.add(outer_.box(i).lower);
    all.add(outer_.box(i).upper);
  }
  Array<uint32_t> inner{env_.memory};
  inner.reserve(outer_.count());
  for (uint32_t i = 0; i < outer_.count(); ++i) {
    const ClosedBox<3>& box = outer_.box(i);
    bool is_beside = false;
    for (int k = 0; k < 3; ++k) is_beside |= box.upper[k] == all.lower[k] || box.lower[k] == all.upper[k];
    if (!is_beside || room_ > 0) inner.push_back(i);
  }
  return inner;
}

void FacetPairs::points_of(const uint32_t* triangle, const double* (&points)[3]) const {
  for (int k = 0; k < 3; ++k) points[k] = point(triangle[k]);
}

/** Positive to the left, seen from outside of the facet that has the view. */
int FacetPairs::turn(LoopView view, uint32_t a, uint32_t b, uint32_t c) const {
  if (a == c || b == c) return 0;
  return turn_sign<3>(point(a), point(b), point(c), view.axis) * view.sense;
}

/** A facet is looked at where one of its triangles is seen largest. */
FacetPairs::Face FacetPairs::face_of(uint32_t i) const {
  const VertexRange loop = outer_.loop(i), triangles = outer_.simplices(i);
  Face made{{}, 0, true, loop.size() <= 4};
  const int exponent = unit_exponent(outer_.box(i));
  const double* points[3];
  double largest = -1;
  for (uint32_t t = 0; t < triangles.size(); t += 3) {
    points_of(triangles.first + t, points);
    const ScaledTriangle triangle(points, exponent);
    for (int axis = 0; axis < 3; ++axis) {
      const double seen = triangle.area(axis);
      if (!(seen > largest)) continue;
      largest = seen;
      made.largest = t;
      made.view.axis = axis;
    }
  }
  points_of(triangles.first + made.largest, points);
  made.view.sense = turn_sign<3>(points[0], points[1], points[2], made.view.axis);
  const VertexRange corners{triangles.first + made.largest, triangles.first + made.largest + 3};
  for (const uint32_t v : loop) made.is_flat = made.is_flat && (has(corners, v) || orient<3>(points, point(v)) == 0);
  for (uint32_t k = 0; k < loop.size() && made.is_convex; ++k) {
    made.is_convex = turn(made.view, loop[k], loop.after(k), loop[(k + 2) % loop.size()]) > 0;
  }
  return made;
}

/** Whether a point is not farther than the room from the plane of a triangle. */
bool FacetPairs::is_in_plane(const uint32_t* triangle, const double* p) const {
  const double* t[3];
  points_of(triangle, t);
  if (orient<3>(t, p) == 0) return true;
  if (!(room_ > 0)) return false;
  ClosedBox<3> box;
  for (const double* corner : t) box.add(corner);
  const ScaledTriangle scaled(t, unit_exponent(box));
  const filter::Vec<3> normal = filter::cross(filter::difference<3>(scaled.corners[1], scaled.corners[0]),
                                              filter::difference<3>(scaled.corners[2], scaled.corners[0]));
  const double length = std::sqrt(filter::dot(normal, normal));
  return std::fabs(filter::dot(normal, filter::difference<3>(p, t[0]))) <= room_ * length;
}

/** Whether a vertex is a corner of facet i, or lies on an edge or in the planes of all of its triangles. */
bool FacetPairs::lies_on(uint32_t i, uint32_t vertex) const {
  const VertexRange loop = outer_.loop(i), triangles = outer_.simplices(i);
  if (has(loop, vertex)) return true;
  const Face& face = faces_[i];
  if (face.is_flat && !(room_ > 0)) return is_in_plane(triangles.first + face.largest, point(vertex));
  bool is_in_all = true;
  for (uint32_t t = 0; t < triangles.size() && is_in_all; t += 3) {
    is_in_all = is_in_plane(triangles.first + t, point(vertex));
  }
  for (uint32_t k = 0; k < loop.size() && !is_in_all; ++k) {
    is_in_all = lies_on_edge<3>(point(loop[k]), point(loop.after(k)), point(vertex), room_);
  }
  return is_in_all;
}

bool FacetPairs::all_lie_on(uint32_t i, uint32_t j) const {
  const VertexRange corners = outer_.loop(j);
  return dsw::all_of(corners.begin(), corners.end(), [&](uint32_t v) { return lies_on(i, v); });
}

/** Whether a triangle of facet j is turned against facet i. */
bool FacetPairs::are_opposite(uint32_t i, uint32_t j) const {
  const Face &a = faces_[i], &b = faces_[j];
  if (b.is_convex && b.is_flat && a.view.axis == b.view.axis) return a.view.sense * b.view.sense < 0;
  const VertexRange triangles = outer_.simplices(j);
  for (uint32_t t = 0; t < triangles.size(); t += 3) {
    if (turn(faces_[i].view, triangles[t], triangles[t + 1], triangles[t + 2]) < 0) return true;
  }
  return false;
}

/** Whether an edge of facet i has all of facet j beyond it. */
bool FacetPairs::is_separating(uint32_t i, uint32_t j, LoopView view) const {
  const VertexRange loop = outer_.loop(i), corners = outer_.loop(j);
  const int sense = turn(view, loop[0], loop[1], loop[2]);
  for (uint32_t k = 0; k < loop.size(); ++k) {
    const bool is_beyond = dsw::all_of(corners.begin(), corners.end(),
                                       [&](uint32_t v) { return turn(view, loop[k], loop.after(k), v) * sense <= 0; });
    if (is_beyond) return true;
  }
  return false;
}

bool FacetPairs::triangles_overlap(uint32_t i, uint32_t j) const {
  const VertexRange of_i = outer_.simplices(i), of_j = outer_.simplices(j);
  const LoopView view = faces_[i].view;
  for (uint32_t t = 0; t < of_i.size(); t += 3) {
    const double *a[3], *b[3];
    points_of(of_i.first + t, a);
    for (uint32_t s = 0; s < of_j.size(); s += 3) {
      points_of(of_j.first + s, b);
      if (turn(view, of_j[s], of_j[s + 1], of_j[s + 2]) < 0 && insides_meet(a, b, view.axis)) return true;
    }
  }
  return false;
}

/** Seen as facet i is. Of convex facets in one plane that do not overlap, an edge has the other facet beyond it. */
bool FacetPairs::overlap(uint32_t i, uint32_t j) const {
  if (!(faces_[i].is_convex && faces_[j].is_convex && faces_[i].is_flat && faces_[j].is_flat) || room_ > 0) {
    return triangles_overlap(i, j);
  }
  return !is_separating(i, j, faces_[i].view) && !is_separating(j, i, faces_[i].view);
}

void FacetPairs::find_pairs(const Array<uint32_t>& inner) {
  outer_.pairs(inner, room_).for_each([&](uint32_t at, uint32_t other) {
    const uint32_t i = inner[at], j = inner[other];
    if (outer_.cell(i) == outer_.cell(j) || !are_opposite(i, j)) return;
    if ((all_lie_on(i, j) || all_lie_on(j, i)) && overlap(i, j)) pairs_.push_back({i, j});
  });
  for (const ItemPair& pair : pairs_) ++first_[pair.low], ++first_[pair.high];
  uint32_t sum = 0;
  for (uint32_t& first : first_) sum += std::exchange(first, sum);
  partners_.resize(sum);
  Array<uint32_t> next(first_);
  for (const ItemPair& pair : pairs_) {
    partners_[next[pair.low]++] = pair.high;
    partners_[next[pair.high]++] = pair.low;
  }
  for (uint32_t i = 0; i < outer_.count(); ++i) {
    dsw::sort(partners_.begin() + first_[i], partners_.begin() + first_[i + 1]);
  }
}

/** Adds those of some points that lie on edges of facet i. */
void FacetPairs::hang(uint32_t i, VertexRange points) {
  const VertexRange loop = outer_.loop(i);
  for (const uint32_t v : points) {
    if (has(loop, v) || !is_in_box(outer_.box(i), point(v), room_)) continue;
    for (uint32_t k = 0; k < loop.size(); ++k) {
      if (lies_on_edge<3>(point(loop[k]), point(loop.after(k)), point(v), room_))
        hanging_.add(loop[k], loop.after(k), v);
    }
  }
}

void FacetPairs::fill_loops() {
  loops_.clear();
  for (uint32_t i = 0; i < outer_.count(); ++i) {
    const VertexRange corners = outer_.loop(i);
    for (uint32_t k = 0; k < corners.size(); ++k) hanging_.append(corners[k], corners.after(k), loops_.vertices);
    loops_.end_loop();
  }
}

}  // namespace dsw
