#include "response/rigid_touches.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "motion/place_on_way.h"
#include "proximity/part.h"

namespace dsw {

// What the body touches first it comes to through passable cells that meet the region of its way. So obstacles at these
// cells are enough.
//
// What is near early is asked about first: its touch leaves less of the way to look at. Of touches at one time that of the
// first obstacle, and there of the first part, counts, whatever was asked first.
template <int D>
FirstTouch RigidTouches<D>::find_first(const Body<D>& body, const RigidWay<D>& way, const Partners<D>* partners,
                                       double until, const double* reached, double beside) {
  first_ = {false, until};
  flood_.set_next(reached == nullptr ? next_ : reached);
  is_open_ = false;
  obstacles_.clear();
  parts_.clear();
  others_.clear();
  turns_.clear();
  find_obstacles(body, way, beside);
  for (const WallFeature& obstacle : obstacles_.obstacles()) add_obstacle(way, obstacle);
  for (uint32_t i = 0; partners != nullptr && i < partners->all.size(); ++i) {
    if (partners->all[i].body != &body) add_body(way, *partners, i);
  }
  if (turns_.empty()) return first_;
  find_parts(body);
  dsw::sort(turns_.begin(), turns_.end(),
            [](const Turn& a, const Turn& b) { return a.piece != b.piece ? a.piece < b.piece : a.number < b.number; });
  for (const Turn& turn : turns_) {
    if (turn.piece > last_piece(way)) break;
    if (others_[turn.number].ends[0] != others_[turn.number].points[0]) {
      meet_moving(way, turn);
    } else {
      meet(body, way, turn);
    }
  }
  return first_;
}

/** Parts of a body that are not joined may be in different rooms. */
template <int D>
void RigidTouches<D>::find_obstacles(const Body<D>& body, const RigidWay<D>& way, double beside) {
  uint32_t v = 0;
  while (v < body.vertices.size() && !body.has_vertex(v)) ++v;
  if (v == body.vertices.size()) return;
  Box<D> all;
  for (uint32_t piece = 0; piece <= last_piece(way); ++piece) all.add(way.box(piece));
  const double* const corners[2] = {all.lower, all.upper};
  NearRegion<D> region(corners, 1, beside);
  region.add_box(all.lower, all.upper);
  flood_.find(&body.vertices[v].cell, 1, region, obstacles_);
  while (++v < body.vertices.size()) {
    if (body.has_vertex(v)) flood_.find_from(body.vertices[v].cell, region, obstacles_);
  }
}

template <int D>
void RigidTouches<D>::add_obstacle(const RigidWay<D>& way, const WallFeature& obstacle) {
  RigidTouch<D> wall;
  wall.count = obstacle.count;
  wall.facet = obstacle.facet;
  wall.cell = obstacle.cell;
  bool moves = false;
  for (uint32_t i = 0; i < obstacle.count; ++i) {
    const uint32_t v = obstacle.vertices[i];
    wall.vertices[i] = v;
    wall.points[i] = wall.ends[i] = env_.point(v);
    if (next_ == nullptr) continue;
    wall.ends[i] = next_ + size_t{D} * v;
    moves = moves || !std::equal(wall.points[i], wall.points[i] + D, wall.ends[i]);
  }
  if (!moves) std::copy_n(wall.points, 3, wall.ends);
  add(way, wall);
}

/** The box of an obstacle, or of a part of another body, in a piece. */
template <int D>
Box<D> RigidTouches<D>::box_of(const RigidTouch<D>& other, const RigidWay<D>& way, uint32_t piece) noexcept {
  Box<D> box;
  const double number = way.pieces();
  for (uint32_t i = 0; i < other.count; ++i) {
    if (other.ends[0] == other.points[0]) {
      box.add(other.points[i]);
      continue;
    }
    for (const uint32_t time : {piece, piece + 1}) {
      double low[D], high[D];
      place_on_way<D>(other.points[i], other.ends[i], time / number, low);
      for (int k = 0; k < D; ++k) {
        const double room = 0x1p-40 * std::max(std::fabs(other.points[i][k]), std::fabs(other.ends[i][k]));
        high[k] = low[k] + room;
        low[k] -= room;
      }
      box.add(low);
      box.add(high);
    }
  }
  return box;
}

/** Takes note of an obstacle, or of a part of another body: a triangle, a segment or a point. */
template <int D>
void RigidTouches<D>::add(const RigidWay<D>& way, const RigidTouch<D>& other) {
  const bool moves = other.ends[0] != other.points[0];
  const auto is_near = [&](const Box<D>& box) { return box.overlaps(other.points, static_cast<int>(other.count)); };
  if (!moves && !is_near(way.box())) return;
  uint32_t piece = 0;
  const auto is_near_in = [&] {
    return moves ? way.box(piece).overlaps(box_of(other, way, piece)) : is_near(way.box(piece));
  };
  while (piece < way.pieces() && !is_near_in()) ++piece;
  if (piece == way.pieces()) return;
  turns_.push_back({piece, static_cast<uint32_t>(others_.size())});
  others_.push_back(other);
}

/** A body that stands: of its parts those that can touch something. */
template <int D>
void RigidTouches<D>::add_body(const RigidWay<D>& way, const Partners<D>& partners, uint32_t number) {
  const Body<D>& other = *partners.all[number].body;
  RigidTouch<D> both;
  both.partner = number;
  for_each_simplex(other, [&](const Simplex& simplex) {
    const dsw::Part<D> part(other, simplex);
    both.other = simplex;
    both.count = part.corners.count;
    std::copy_n(part.points, 3, both.points);
    std::copy_n(part.points, 3, both.ends);
    add(way, both);
    return true;
  });
}

template <int D>
void RigidTouches<D>::find_parts(const Body<D>& body) {
  for_each_simplex(body, [&](const Simplex& simplex) {
    parts_.push_back({simplex, SimplexCorners<D>(body, simplex)});
    return true;
  });
  beyond_.assign(2 * body.vertices.size(), ObstacleSides<D>::kApart);
}

/** The last piece in which something earlier can be touched. */
template <int D>
uint32_t RigidTouches<D>::last_piece(const RigidWay<D>& way) const noexcept {
  return std::min(static_cast<uint32_t>(first_.time * way.pieces()), way.pieces() - 1);
}

/** Where vertices are at the begin of a piece. */
template <int D>
void RigidTouches<D>::look_from(const Body<D>& body, const RigidWay<D>& way, const ObstacleSides<D>& sides,
                                uint32_t piece, uint16_t* beyond) const {
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) beyond[v] = static_cast<uint16_t>(sides.beyond(way.place(piece, v), way.room(v)));
  }
}

/** In a piece a vertex is near the line between its places, and a point of a part lies between its corners at all times. */
template <int D>
void RigidTouches<D>::meet(const Body<D>& body, const RigidWay<D>& way, const Turn& turn) {
  constexpr uint32_t kNoPiece = ~0u;
  RigidTouch<D> both = others_[turn.number];
  const ObstacleSides<D> sides(both.points, both.count);
  const auto count = static_cast<uint32_t>(body.vertices.size());
  uint16_t *begin = beyond_.data(), *end = begin + count;
  uint32_t known = kNoPiece;  // the piece that begins where `end` is
  bool has_asked = false;
  for (uint32_t piece = turn.piece; piece <= last_piece(way); ++piece) {
    if (!way.box(piece).overlaps(both.points, static_cast<int>(both.count))) continue;
    std::swap(begin, end);
    if (known != piece) look_from(body, way, sides, piece, begin);
    look_from(body, way, sides, piece + 1, end);
    known = piece + 1;
    uint32_t all = ObstacleSides<D>::kApart;
    for (uint32_t v = 0; v < count; ++v) all &= begin[v] & end[v];
    if (all != 0) continue;
    if (!has_asked) asked_.assign(parts_.size(), 0);
    has_asked = true;
    for (size_t i = 0; i < parts_.size(); ++i) {
      uint32_t beyond = ~0u;
      for (const uint32_t v : parts_[i].corners) beyond &= begin[v] & end[v];
      if ((beyond & ObstacleSides<D>::kApart) != 0) continue;
      asks_ = uint64_t{turn.number} << 32 | i;
      touch(parts_[i], way, both, beyond, &asked_[i]);
    }
  }
}

/** An obstacle that moves: in each piece the boxes of the parts are compared with its own. */
template <int D>
void RigidTouches<D>::meet_moving(const RigidWay<D>& way, const Turn& turn) {
  RigidTouch<D> both = others_[turn.number];
  asked_.assign(parts_.size(), 0);
  for (uint32_t piece = turn.piece; piece <= last_piece(way); ++piece) {
    const Box<D> box = box_of(both, way, piece);
    if (!way.box(piece).overlaps(box)) continue;
    for (size_t i = 0; i < parts_.size(); ++i) {
      const SimplexCorners<D>& corners = parts_[i].corners;
      if (!way.box(piece, corners.vertices, corners.count).overlaps(box)) continue;
      asks_ = uint64_t{turn.number} << 32 | i;
      touch(parts_[i], way, both, 0, &asked_[i]);
    }
  }
}

/** Asks about a part and an obstacle, or a part of another body. Sides of triangles and ends of edges count: what only
 * they touch is asked about as well.
 * @param beyond which ends of the obstacle the part does not come to in this piece.
 * @param asked what has been asked about in other pieces. */
template <int D>
void RigidTouches<D>::touch(const Part& part, const RigidWay<D>& way, RigidTouch<D>& touch, uint32_t beyond,
                            uint8_t* asked) {
  const double *const *const points = touch.points, *const *const ends = touch.ends;
  const uint32_t count = touch.count, own = part.corners.count;
  TurningPair<D> pair{};
  const auto mine = [&](uint32_t i) { return way.origin(part.corners.vertices[i]); };
  const auto set = [&](uint32_t at, const double* point) { pair.start[at] = pair.end[at] = point; };
  const auto set_other = [&](uint32_t at, uint32_t i) {
    pair.start[at] = points[i];
    pair.end[at] = ends[i];
  };
  const auto begin = [&](PairKind kind, uint32_t mine_first) {
    touch.part = part.name;
    pair.kind = kind;
    pair.way[mine_first != 0 ? 0 : 1] = &way.exact();
    pair.way[mine_first != 0 ? 1 : 0] = nullptr;
  };
  const auto is_new = [&](uint32_t i) {
    const bool is_first = (*asked & 1u << i) == 0;
    *asked = static_cast<uint8_t>(*asked | 1u << i);
    return is_first;
  };
  if (D == 3 && own == 2 && count >= 2) {
    begin(PairKind::kEdgeEdge, 1);
    set(0, mine(0));
    set(1, mine(1));
    for (uint32_t i = 0; i < (count == 2 ? 1 : count); ++i) {
      if (ObstacleSides<D>::misses_side(beyond, i) || !is_new(i)) continue;
      set_other(2, i);
      set_other(3, (i + 1) % count);
      ask(pair, touch);
    }
  } else if (own == 1 && count == D) {
    if (!is_new(0)) return;
    begin(D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, 1);
    set(0, mine(0));
    for (uint32_t i = 0; i < D; ++i) set_other(i + 1, i);
    ask(pair, touch);
  } else if (own == D) {
    begin(D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, 0);
    for (uint32_t i = 0; i < D; ++i) set(i + 1, mine(i));
    for (uint32_t i = 0; i < count; ++i) {
      if (ObstacleSides<D>::misses_corner(beyond, i) || !is_new(i)) continue;
      set_other(0, i);
      ask(pair, touch);
    }
  }
}

/** Between a body and walls the shift decides. Between bodies touching is a contact; those that touch at the start need not
 * come nearer. */
template <int D>
void RigidTouches<D>::ask(const TurningPair<D>& pair, const RigidTouch<D>& touch) {
  FirstEntry first;
  const Asked asked{first_.touches ? first_.time : 1, true};
  if (touch.partner == kNone) {
    first = first_entry(pair, nullptr, asked);
  } else {
    first.touch = first_touch(pair, nullptr, asked);
    first.is_open = first.touch.touches && first.touch.time == 0;
    if (first.is_open) first.touch.touches = false;
  }
  is_open_ |= first.is_open;
  if (!first.touch.touches || (first_.touches && first_.time < first.touch.time)) return;
  if (first_.touches && first_.time == first.touch.time && first_ask_ <= asks_) return;
  first_ = first.touch;
  first_ask_ = asks_;
  touched_ = touch;
}

template class RigidTouches<2>;
template class RigidTouches<3>;

}  // namespace dsw
