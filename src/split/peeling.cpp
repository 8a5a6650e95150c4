#include "split/peeling.h"

#include <cmath>

#include "base/disjoint_sets.h"
#include "base/search.h"
#include "base/sort.h"
#include "split/crossing.h"
#include "split/inner_point.h"

namespace dsw {
namespace {

/** An edge as one triangle runs along it. */
struct Side {
  uint32_t from, to, triangle;
  bool operator<(const Side& o) const { return from != o.from ? from < o.from : to < o.to; }
};

uint32_t third_of(const PartSide<3>& t, uint32_t a, uint32_t b) {
  uint32_t k = 0;
  while (t.v[k] == a || t.v[k] == b) ++k;
  return t.v[k];
}

/** A tetrahedron at a convex edge a b: its outer triangles are a b c and b a d. */
struct Corner {
  uint32_t a, b, c, d;
  double merit;

  PartSide<3> inner(int k) const { return k == 0 ? make_simplex(c, b, d) : make_simplex(a, c, d); }
  PartHull<3> boundary(const Memory* memory) const {
    return PartHull<3>({make_simplex(a, b, c), make_simplex(b, a, d), inner(0), inner(1)}, memory);
  }
  bool has(uint32_t v) const { return v == a || v == b || v == c || v == d; }
};

/** What is left of a surface. */
class Rest {
 public:
  Rest(const PartPoints<3>& at, const PartHull<3>& surface, uint32_t order)
      : at_(at), order_(order), triangles_(surface), sides_(at.memory()), vertices_(at.memory()) {
    dsw::sort(triangles_.begin(), triangles_.end());
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      const uint32_t* const v = triangles_[t].v;
      for (int k = 0; k < 3; ++k) {
        sides_.push_back({v[k], v[(k + 1) % 3], t});
        vertices_.push_back(v[k]);
      }
    }
    dsw::sort(sides_.begin(), sides_.end());
    dsw::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const uint32_t v : vertices_) {
      for (int k = 0; k < 3; ++k) scale_ = std::max(scale_, std::fabs(at_[v][k] / 2 - at_[vertices_[0]][k] / 2));
    }
  }

  const PartHull<3>& triangles() const { return triangles_; }
  /** Whether each edge has two triangles. */
  bool is_closed() const {
    for (size_t i = 0; i < sides_.size(); ++i) {
      if (i != 0 && !(sides_[i - 1] < sides_[i])) return false;
      if (find(sides_[i].to, sides_[i].from) == nullptr) return false;
    }
    return true;
  }
  /** Surfaces that hang together by edges. */
  Array<PartHull<3>> pieces() const {
    DisjointSets sets(static_cast<uint32_t>(triangles_.size()), at_.memory());
    for (const Side& side : sides_) sets.join(side.triangle, find(side.to, side.from)->triangle);
    Array<PartHull<3>> pieces(triangles_.size(), PartHull<3>(at_.memory()), at_.memory());
    for (uint32_t t = 0; t < triangles_.size(); ++t) pieces[sets.root(t)].push_back(triangles_[t]);
    const auto is_empty = [](const PartHull<3>& piece) { return piece.empty(); };
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), is_empty), pieces.end());
    return pieces;
  }
  /** The best tetrahedron that can be taken off. */
  bool find_corner(Corner& best) const {
    Array<Corner> corners(at_.memory());
    for (const Side& side : sides_) {
      if (side.from > side.to) continue;
      Corner corner{side.from, side.to, third_of(triangles_[side.triangle], side.from, side.to), 0, 0};
      corner.d = third_of(triangles_[find(side.to, side.from)->triangle], side.from, side.to);
      if (!is_convex(corner)) continue;
      corner.merit = merit_of(corner);
      corners.push_back(corner);
    }
    std::stable_sort(corners.begin(), corners.end(),
                     [](const Corner& x, const Corner& y) { return x.merit > y.merit; });
    const auto found = dsw::find_if(corners.begin(), corners.end(), [this](const Corner& x) { return is_free(x); });
    if (found == corners.end()) return false;
    best = *found;
    return true;
  }
  PartHull<3> without(const Corner& corner) const {
    PartHull<3> left(triangles_);
    for (const PartSide<3>& side : corner.boundary(at_.memory())) {
      const auto place = dsw::find(left.begin(), left.end(), side);
      if (place != left.end()) {
        left.erase(place);
      } else {
        left.push_back(turned(side));
      }
    }
    return left;
  }

 private:
  const Side* find(uint32_t from, uint32_t to) const {
    const auto place = std::lower_bound(sides_.begin(), sides_.end(), Side{from, to, 0});
    return place != sides_.end() && place->from == from && place->to == to ? &*place : nullptr;
  }
  bool has(const PartSide<3>& triangle) const {
    return std::binary_search(triangles_.begin(), triangles_.end(), triangle);
  }
  bool is_convex(const Corner& x) const {
    const double* const points[3] = {at_[x.a], at_[x.b], at_[x.c]};
    return x.c != x.d && orient<3>(points, at_[x.d]) < 0;
  }

  size_t triangles_at(uint32_t v) const {
    const auto from = std::lower_bound(sides_.begin(), sides_.end(), Side{v, 0, 0});
    return static_cast<size_t>(std::lower_bound(from, sides_.end(), Side{v + 1, 0, 0}) - from);
  }
  /** By the places of its edge among the vertices and the number of the order. */
  double mixed(const Corner& x) const {
    const auto place = [this](uint32_t v) {
      return static_cast<uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
    };
    uint32_t bits = (place(x.a) * 0x9e3779b1u + place(x.b)) * 0x85ebca77u + order_ * 0xc2b2ae3du;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    return static_cast<double>(bits ^ bits >> 13);
  }

  /** In units of its longest edge, so that no size overflows. */
  double merit_of(const Corner& x) const {
    const double* const p[4] = {at_[x.a], at_[x.b], at_[x.c], at_[x.d]};
    double e[6][3], scale = 0, squares = 0;
    int count = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j, ++count) {
        for (int k = 0; k < 3; ++k) {
          e[count][k] = p[j][k] / 2 - p[i][k] / 2;
          scale = std::max(scale, std::fabs(e[count][k]));
        }
      }
    }
    for (auto& edge : e) {
      for (double& along : edge) {
        along /= scale;
        squares += along * along;
      }
    }
    const double volume = std::fabs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                                    e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
    const double roundness = volume * volume / (squares * squares * squares);
    const double size = scale / scale_;
    switch (static_cast<PeelOrder>(order_)) {
      case PeelOrder::kFewest:
        return roundness - static_cast<double>(std::min(triangles_at(x.a), triangles_at(x.b)));
      case PeelOrder::kRoundest:
        return roundness;
      case PeelOrder::kLargest:
        return volume * size * size * size;
      case PeelOrder::kFlattest:
        return -roundness;
      default:
        return mixed(x);
    }
  }

  /** Whether the surface that is left when a tetrahedron is taken off meets itself no more than before. */
  bool is_free(const Corner& x) const {
    const bool has_inner[2] = {has(x.inner(0)), has(x.inner(1))};
    if (has(turned(x.inner(0))) || has(turned(x.inner(1)))) return false;
    const bool is_new_edge = !has_inner[0] && !has_inner[1];
    if (is_new_edge && (find(x.c, x.d) != nullptr || find(x.d, x.c) != nullptr)) return false;
    if (dsw::any_of(vertices_.begin(), vertices_.end(), [&](uint32_t v) { return !x.has(v) && is_in(x, v); })) {
      return false;
    }
    for (int k = 0; k < 2; ++k) {
      if (has_inner[k]) continue;
      const PartSide<3> inner = x.inner(k);
      const bool meets = dsw::any_of(sides_.begin(), sides_.end(), [&](const Side& side) {
        return side.from < side.to && edge_meets(at_, side.from, side.to, inner);
      });
      if (meets) return false;
    }
    return !is_new_edge || dsw::none_of(triangles_.begin(), triangles_.end(), [&](const PartSide<3>& triangle) {
      return edge_meets(at_, x.c, x.d, triangle);
    });
  }
  bool is_in(const Corner& x, uint32_t v) const {
    const uint32_t sides[4][3] = {{x.a, x.b, x.c}, {x.b, x.a, x.d}, {x.c, x.b, x.d}, {x.a, x.c, x.d}};
    return dsw::all_of(sides, sides + 4, [&](const uint32_t(&side)[3]) {
      const double* const points[3] = {at_[side[0]], at_[side[1]], at_[side[2]]};
      return orient<3>(points, at_[v]) <= 0;
    });
  }

  const PartPoints<3>& at_;
  uint32_t order_;
  double scale_ = 0;       // how far vertices are apart
  PartHull<3> triangles_;  // sorted
  Array<Side> sides_;      // sorted
  Array<uint32_t> vertices_;
};

}  // namespace

bool fill_round_point(PartPoints<3>& at, const PartHull<3>& surface, Array<PartHull<3>>& parts) {
  double point[3];
  if (!find_inner_point(at, surface, point)) return false;
  const uint32_t v = at.add(point);
  for (const PartSide<3>& s : surface) {
    const uint32_t a = s.v[0], b = s.v[1], c = s.v[2];
    parts.push_back(PartHull<3>({s, make_simplex(b, a, v), make_simplex(c, b, v), make_simplex(a, c, v)}, at.memory()));
  }
  return true;
}

/** Each tetrahedron is positive, and boundaries add up to the surface. So if the surface does not meet itself, they fill it
 * once, whatever was tried on the way. */
bool peel(PartPoints<3>& at, const PartHull<3>& surface, uint32_t order, bool may_add, Array<PartHull<3>>& parts) {
  const size_t parts_before = parts.size();
  const uint32_t points_before = at.end();
  const auto take_back = [&] {
    parts.resize(parts_before, PartHull<3>(at.memory()));
    at.take_back(points_before);
    return false;
  };
  Array<PartHull<3>> left({surface}, at.memory());
  while (!left.empty()) {
    const Rest rest(at, left.back(), order);
    left.pop_back();
    if (rest.triangles().empty()) continue;
    if (!rest.is_closed()) return take_back();
    Array<PartHull<3>> pieces = rest.pieces();
    Corner corner{};
    if (pieces.size() > 1) {
      for (PartHull<3>& piece : pieces) left.push_back(std::move(piece));
    } else if (is_valid_part<3>(at, rest.triangles())) {
      parts.push_back(rest.triangles());
    } else if (rest.find_corner(corner)) {
      parts.push_back(corner.boundary(at.memory()));
      left.push_back(rest.without(corner));
    } else if (!may_add || !fill_round_point(at, rest.triangles(), parts)) {
      return take_back();
    }
  }
  return true;
}

bool meets_itself(const PartPoints<3>& at, const PartHull<3>& surface) {
  return dsw::any_of(surface.begin(), surface.end(), [&](const PartSide<3>& s) {
    return dsw::any_of(surface.begin(), surface.end(), [&](const PartSide<3>& other) {
      for (int k = 0; k < 3; ++k) {
        if (edge_meets(at, s.v[k], s.v[(k + 1) % 3], other)) return true;
      }
      return false;
    });
  });
}

}  // namespace dsw
