#include "together/rigid_pairs.h"

namespace dsw {
namespace {

/** The piece of a way at a slice of the time. */
template <int D>
uint32_t piece_at(const RigidWay<D>& way, uint32_t slice) noexcept {
  return slice * way.pieces() / RigidWay<D>::kMostPieces;
}

}  // namespace

template <int D>
FirstTouch RigidPairs<D>::find_first(const Body<D>& a, const RigidWay<D>& way_a, const Body<D>& b,
                                     const RigidWay<D>& way_b, const FirstTouch& earlier) {
  first_ = earlier;
  is_earlier_ = touches_at_start_ = false;
  if (!way_a.box().overlaps(way_b.box())) return first_;
  collect(a, way_a, way_b, parts_[0]);
  collect(b, way_b, way_a, parts_[1]);
  for (const Part& mine : parts_[0]) {
    for (const Part& other : parts_[1]) {
      for (uint32_t slice = 0; slice < kSlices; ++slice) {
        if (first_.touches && static_cast<double>(slice) > first_.time * kSlices) break;
        if (!mine.boxes[slice].overlaps(other.boxes[slice])) continue;
        if (ask(mine, way_a, other, way_b)) {
          is_earlier_ = true;
          touched_[0] = mine.name;
          touched_[1] = other.name;
        }
        break;
      }
    }
  }
  return first_;
}

/** Collects the parts of a body that come near the other one. */
template <int D>
void RigidPairs<D>::collect(const Body<D>& body, const RigidWay<D>& way, const RigidWay<D>& other, Array<Part>& parts) {
  parts.clear();
  for_each_simplex(body, [&](const Simplex& simplex) {
    Part part{simplex, SimplexCorners<D>(body, simplex), {}};
    bool is_near = false;
    for (uint32_t slice = 0; slice < kSlices; ++slice) {
      part.boxes[slice] = way.box(piece_at(way, slice), part.corners.vertices, part.corners.count);
      is_near = is_near || part.boxes[slice].overlaps(other.box(piece_at(other, slice)));
    }
    if (is_near) parts.push_back(part);
    return true;
  });
}

/** Asks about two parts. Sides of triangles and ends of edges are parts of their own. Whether this touch is the first so far. */
template <int D>
bool RigidPairs<D>::ask(const Part& a, const RigidWay<D>& way_a, const Part& b, const RigidWay<D>& way_b) {
  const uint32_t count_a = a.corners.count, count_b = b.corners.count;
  const bool are_edges = D == 3 && count_a == 2 && count_b == 2;
  if (!are_edges && !(count_a == 1 && count_b == D)) {
    return count_a == D && count_b == 1 && ask(b, way_b, a, way_a);
  }
  TurningPair<D> pair{};
  pair.kind = are_edges ? PairKind::kEdgeEdge : D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge;
  pair.way[0] = &way_a.exact();
  pair.way[1] = &way_b.exact();
  for (uint32_t i = 0; i < count_a; ++i) pair.start[i] = pair.end[i] = way_a.origin(a.corners.vertices[i]);
  for (uint32_t i = 0; i < count_b; ++i)
    pair.start[count_a + i] = pair.end[count_a + i] = way_b.origin(b.corners.vertices[i]);
  const FirstTouch touch = first_touch(pair);
  if (!touch.touches) return false;
  if (touch.time == 0) {
    touches_at_start_ = true;
    return false;
  }
  if (first_.touches && !(touch.time < first_.time)) return false;
  first_ = touch;
  return true;
}

template class RigidPairs<2>;
template class RigidPairs<3>;

}  // namespace dsw
