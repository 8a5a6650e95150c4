// Environments that long edges cross, what is impassable in them, what an edge touches on its way, and what rings say.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "corridor/ridge_rings.h"
#include "environment/marking.h"
#include "environment/moving.h"
#include "environment/test_mesh.h"
#include "predicates/moving_pair.h"

namespace dsw::test {

template <int D>
using Point = std::array<double, D>;

/** How both ends of an edge move. */
template <int D>
struct Way {
  Point<D> from[2], to[2];
};

/** Blocks of a lattice. Simple: cut into triangles or tetrahedra. Mixed: in space boxes, then pyramids with tetrahedra
 * beside them, then tetrahedra among which some blocks are polyhedra; in the plane also squares, pairs of them that have
 * corners in the middle of a straight side, and three of them that are not convex. */
inline void fill(Mesh2& mesh, int nx, int ny, bool mixed, Random& random) {
  for (int y = 0; y <= ny; ++y) {
    for (int x = 0; x <= nx; ++x) mesh.point({x * 1.0, y * 1.0});
  }
  const auto at = [&](int x, int y) { return int64_t{x} + int64_t{nx + 1} * y; };
  const auto square = [&](int x, int y, bool cut) {
    const int64_t c[4] = {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
    if (!cut) {
      mesh.cell(kQuad, {c[0], c[1], c[2], c[3]});
      return;
    }
    const int first = random.below(2);
    for (const int i : {first, first + 2}) mesh.cell(kTriangle, {c[i], c[(i + 1) % 4], c[(i + 2) % 4]});
  };
  // Two by two squares. Around them are eight points, seen from the middle.
  constexpr int kRound[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
  for (int y = 1; y < ny; y += 2) {
    for (int x = 1; x < nx; x += 2) {
      const auto round = [&](int i) { return at(x + kRound[i % 8][0], y + kRound[i % 8][1]); };
      const int kind = mixed ? random.below(4) : 0, turn = 2 * random.below(4);
      if (kind < 2) {
        for (int i = 0; i < 4; ++i) square(x - 1 + i % 2, y - 1 + i / 2, kind == 0);
      } else if (kind == 2) {
        for (const int half : {turn, turn + 4}) {
          mesh.cell(kPolygon,
                    {round(half + 7), round(half), round(half + 1), round(half + 2), round(half + 3), at(x, y)});
        }
      } else {
        std::vector<int64_t> three;
        for (int i = 1; i <= 7; ++i) three.push_back(round(turn + i));
        three.push_back(at(x, y));
        mesh.cell(kPolygon, three);
        mesh.cell(kQuad, {round(turn), round(turn + 1), at(x, y), round(turn + 7)});
      }
    }
  }
}

inline void fill(Mesh3& mesh, int nx, int ny, int nz, bool mixed, Random& random) {
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) mesh.point({x * 1.0, y * 1.0, z * 1.0});
    }
  }
  // The corners of six tetrahedra, of which each goes along the axes in another order; bit k: one step along axis k.
  constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                     {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}};
  constexpr int kSquares[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const auto at = [&](int bits) {
          const int i = x + (bits & 1), j = y + (bits >> 1 & 1), k = z + (bits >> 2);
          return int64_t{i} + int64_t{nx + 1} * (j + int64_t{ny + 1} * k);
        };
        // The triangles of a square, which is cut from its lowest corner to its highest.
        const auto triangles = [&](const int(&s)[4]) {
          const int low = static_cast<int>(std::min_element(s, s + 4) - s);
          const auto corner = [&](int i) { return at(s[(low + i) % 4]); };
          return std::vector<std::vector<int64_t>>{{corner(0), corner(1), corner(2)},
                                                   {corner(0), corner(2), corner(3)}};
        };
        if (mixed && x == 0) {
          mesh.cell(kHexahedron, {at(0), at(1), at(3), at(2), at(4), at(5), at(7), at(6)});
        } else if (mixed && x == 1) {
          const int64_t middle = mesh.point({x + 0.5, y + 0.5, z + 0.5});
          for (const auto& s : kSquares) {
            if (s[0] == 0 && s[1] == 4) {
              mesh.cell(kPyramid, {at(s[3]), at(s[2]), at(s[1]), at(s[0]), middle});
              continue;
            }
            for (const auto& t : triangles(s)) mesh.cell(kTetra, {t[0], t[2], t[1], middle});
          }
        } else if (mixed && random.below(8) == 0) {
          std::vector<std::vector<int64_t>> faces;
          for (const auto& s : kSquares) {
            for (const auto& t : triangles(s)) faces.push_back(t);
          }
          mesh.polyhedron(faces);
        } else {
          for (const auto& t : kTetrahedra) mesh.cell(kTetra, {at(t[0]), at(t[1]), at(t[2]), at(t[3])});
        }
      }
    }
  }
}

/** What is impassable, and what of it a way touches: asked of first_touch, of one feature after the other. */
template <int D>
class Obstacles {
 public:
  /** A side of a wall's triangle or a marked edge. In the plane both are the same: a marked vertex, or a wall's corner. */
  struct Line {
    uint32_t ends[2];
    double low[D], high[D];
    bool is_outer;  // at the outer boundary
  };

  explicit Obstacles(const Environment<D>& env) : env_(env) {}

  void collect() {
    lines_.clear();
    walls_.clear();
    const Map<D>& map = env_.map;
    std::vector<std::array<uint32_t, 2>> names;
    std::vector<bool> is_outer(map.vertex_count);
    for_each_cell(map, [&](Cell c) {
      const Shape shape = map.shape(c);
      for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
        const HalfFacet facet = map.half_facet(c, shape.simplex_facets(D)[s]);
        if (!is_impassable(env_, facet)) continue;
        std::array<uint32_t, D> wall;
        for (uint32_t i = 0; i < D; ++i) {
          wall[i] = map.vertex(c, shape.simplices()[D * s + i]);
          if (!map.opposite(facet).valid()) is_outer[wall[i]] = true;
        }
        walls_.push_back(wall);
        for (size_t i = 0; i < D; ++i) names.push_back({wall[i], D == 3 ? wall[(i + 1) % D] : wall[i]});
      }
      for (uint32_t d = 0; D == 3 && d < shape.dart_count(); ++d) {
        const uint32_t a = map.vertex(c, shape.dart_vertex(d)), b = map.vertex(c, shape.dart_vertex(shape.beta1(d)));
        if (edge_marked(env_, a, b)) names.push_back({a, b});
      }
    });
    // In space an edge meets no vertex under the shift.
    for (uint32_t v = 0; D == 2 && v < map.vertex_count; ++v) {
      if (vertex_marked(env_, v)) names.push_back({v, v});
    }
    for (auto& name : names) std::sort(name.begin(), name.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const auto& name : names) {
      Line line{{name[0], name[1]}, {}, {}, is_outer[name[0]] && is_outer[name[1]]};
      for (int k = 0; k < D; ++k) {
        const auto ends = std::minmax(env_.point(name[0])[k], env_.point(name[1])[k]);
        line.low[k] = ends.first;
        line.high[k] = ends.second;
      }
      lines_.push_back(line);
    }
  }

  const std::vector<Line>& lines() const { return lines_; }

  /** Whether an edge touches anything on its way. */
  bool touch(const Way<D>& way) const {
    return touch_line(way) || touch_wall(way.from[0], way.to[0]) || touch_wall(way.from[1], way.to[1]);
  }
  /** The line that an edge touches before all others. Null: there is none, or an end touches something before, or the
   * times are equal as far as doubles tell. */
  const Line* first_line(const Way<D>& way) const {
    const Line* first = nullptr;
    double least = 2;
    for (int i = 0; i < 2; ++i) {
      for (const auto& wall : walls_) {
        const FirstTouch touch = touch_of(way.from[i], way.to[i], wall);
        if (touch.touches) least = std::min(least, touch.time);
      }
      for (const Line& line : lines_) {
        const FirstTouch touch = touch_of({{way.from[i], way.from[i]}, {way.to[i], way.to[i]}}, line);
        if (touch.touches) least = std::min(least, touch.time);
      }
    }
    for (const Line& line : lines_) {
      const FirstTouch touch = touch_of(way, line);
      if (!touch.touches || touch.time > least) continue;
      first = touch.time < least ? &line : nullptr;
      least = touch.time;
    }
    return first;
  }
  /** Whether an end is exactly on something before or after its way. */
  bool have_an_end(const Way<D>& way) const {
    for (const auto* ends : {way.from, way.to}) {
      for (int i = 0; i < 2; ++i) {
        if (touch_line({{ends[i], ends[i]}, {ends[i], ends[i]}}) || touch_wall(ends[i], ends[i])) return true;
      }
    }
    return false;
  }

 private:
  bool touch_line(const Way<D>& way) const {
    double low[D], high[D];
    for (size_t k = 0; k < D; ++k) {
      low[k] = std::min({way.from[0][k], way.from[1][k], way.to[0][k], way.to[1][k]});
      high[k] = std::max({way.from[0][k], way.from[1][k], way.to[0][k], way.to[1][k]});
    }
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
      for (int k = 0; k < D; ++k) {
        if (line.low[k] > high[k] || line.high[k] < low[k]) return false;
      }
      return touch_of(way, line).touches;
    });
  }
  FirstTouch touch_of(const Way<D>& way, const Line& line) const {
    const double *const a = env_.point(line.ends[0]), *const b = env_.point(line.ends[1]);
    const double *const p = way.from[0].data(), *const q = way.from[1].data(), *const p_to = way.to[0].data(),
                        *const q_to = way.to[1].data();
    if constexpr (D == 3) return first_touch<3>({PairKind::kEdgeEdge, {p, q, a, b}, {p_to, q_to, a, b}});
    if constexpr (D == 2) return first_touch<2>({PairKind::kVertexEdge, {a, p, q}, {a, p_to, q_to}});
  }
  MovingPair<D> pair_of(const Point<D>& from, const Point<D>& to, const std::array<uint32_t, D>& wall) const {
    MovingPair<D> pair{D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, {from.data()}, {to.data()}};
    for (size_t i = 0; i < D; ++i) pair.start[i + 1] = pair.end[i + 1] = env_.point(wall[i]);
    return pair;
  }
  FirstTouch touch_of(const Point<D>& from, const Point<D>& to, const std::array<uint32_t, D>& wall) const {
    return first_touch(pair_of(from, to, wall));
  }
  bool touch_wall(const Point<D>& from, const Point<D>& to) const {
    return std::any_of(walls_.begin(), walls_.end(), [&](const std::array<uint32_t, D>& wall) {
      const MovingPair<D> pair = pair_of(from, to, wall);
      for (size_t k = 0; k < D; ++k) {
        double low = pair.start[1][k], high = low;
        for (size_t i = 2; i <= D; ++i) {
          low = std::min(low, pair.start[i][k]);
          high = std::max(high, pair.start[i][k]);
        }
        if (low > std::max(from[k], to[k]) || high < std::min(from[k], to[k])) return false;
      }
      return first_touch(pair).touches;
    });
  }

  const Environment<D>& env_;
  std::vector<Line> lines_;
  std::vector<std::array<uint32_t, D>> walls_;
};

/** Asks rings of what casts pass. */
template <int D>
class KnownRings {
 public:
  explicit KnownRings(const Environment<D>& env) : env_(env), rings_(env) {}

  /** Whether they say that a way is free that begins in a cell. False also where corridors would not ask. */
  bool are_free(const Way<D>& way, Cell start) {
    Corridor<D> passed[3] = {none(), none(), none()};
    if (!passes(way.from[0], way.from[1], start, passed[0])) return false;
    const Cell last = end_;
    if (!passes(way.from[0], way.to[0], start, passed[1])) return false;
    const Cell start_to = end_;
    if (!passes(way.from[1], way.to[1], last, passed[2])) return false;
    for (const Cell c : {start, last, start_to, end_}) {
      if (!env_.map.convex(c)) return false;
    }
    const Array<uint32_t> paths[2] = {passed[1].facets, passed[2].facets};
    const EdgeWay edge = EdgeWay::of_both(way.from[0].data(), way.to[0].data(), way.from[1].data(), way.to[1].data());
    if (!rings_.find(passed[0], edge, paths)) return false;
    const CandidateView<D> found = rings_.features();
    return found.first == found.last;
  }
  /** Notes what a segment passes. Whether all of it is passable. */
  bool passes(const Point<D>& from, const Point<D>& to, Cell start, Corridor<D>& passed) {
    CastRequest request;
    request.from = from.data();
    request.to = to.data();
    request.start = start;
    CastResult result;
    passed.forget();
    while (!passed.known()) {  // the first time there may be no room
      writer_.attach(env_, request);
      result = cast(env_, request, nullptr);
      writer_.finish(passed);
    }
    end_ = result.cell;
    return result.end == CastEnd::kReached;
  }
  static Corridor<D> none() { return Corridor<D>(Array<uint32_t>::allocator_type(nullptr)); }

 private:
  const Environment<D>& env_;
  RidgeRings<D> rings_;
  CorridorWriter<D> writer_{nullptr};
  Cell end_;  // of the last segment
};

}  // namespace dsw::test
