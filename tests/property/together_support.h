// Bodies of which all vertices move at once, and what is true of their moves: all parts against all, over GMP.
#pragma once

#include "body_support.h"
#include "moving_pair_truth.h"
#include "predicates/moving_pair.h"

#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace dsw::oracle {

/// An environment of simplices, in which some are marked, with its walls. Its corners are moved from a lattice.
struct Ground {
  int dimension;
  std::vector<Vec> points;
  std::vector<std::vector<uint32_t>> walls;  // simplices of impassable facets
  std::vector<std::vector<uint32_t>> thin;   // marked edges and vertices
  EnvironmentPtr environment;
  std::vector<std::vector<uint32_t>> cells = {};  // their corners
  std::vector<bool> is_marked = {};               // by cell
  struct Side {
    uint32_t corners[3], cell;
  };
  std::vector<Side> triangles = {};  // of cells that are no simplices; in the plane their sides
  std::vector<Vec> next = {};        // where the points go; empty: they stand still

  std::vector<std::vector<uint32_t>> features(size_t corners) const {
    std::set<std::vector<uint32_t>> all;
    const auto add = [&](const std::vector<uint32_t>& from) {
      for (uint32_t mask = 1; mask < 1u << from.size(); ++mask) {
        std::vector<uint32_t> chosen;
        for (size_t i = 0; i < from.size(); ++i) {
          if ((mask >> i & 1u) != 0) chosen.push_back(from[i]);
        }
        std::sort(chosen.begin(), chosen.end());
        if (chosen.size() == corners) all.insert(chosen);
      }
    };
    for (const auto& each : walls) add(each);
    for (const auto& each : thin) add(each);
    return {all.begin(), all.end()};
  }
};

/// No plane is normal to an axis afterwards: a rounded position does not lie exactly on a wall.
inline Vec sheared(const Vec& p, int dimension) {
  const double z = dimension == 3 ? p[2] : 0;
  return {p[0] + 0.1371 * p[1] + 0.0523 * z, p[1] + 0.0911 * p[0] - 0.0417 * z,
          dimension == 3 ? z + 0.0713 * p[0] + 0.1137 * p[1] : 0};
}

/// n cubes or squares along each axis, cut into simplices; a share of these is marked.
inline Ground make_ground(int dimension, int n, double jitter, double marked, bool thin, Rng& rng) {
  Ground ground;
  ground.dimension = dimension;
  const auto index = [&](int x, int y, int z) { return static_cast<uint32_t>(x + (n + 1) * (y + (n + 1) * z)); };
  const int layers = dimension == 3 ? n : 0;
  for (int z = 0; z <= layers; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) {
        Vec p = {double(x), double(y), double(z)};
        const bool inner = x % n != 0 && y % n != 0 && (dimension == 2 || z % n != 0);
        for (int k = 0; inner && k < dimension; ++k) p[static_cast<size_t>(k)] += rng.range(-jitter, jitter);
        if (jitter > 0) p = sheared(p, dimension);
        ground.points.push_back(p);
      }
    }
  }
  std::vector<std::vector<uint32_t>> cells;
  for (int z = 0; z < std::max(1, layers); ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        if (dimension == 2) {
          cells.push_back({index(x, y, 0), index(x + 1, y, 0), index(x + 1, y + 1, 0)});
          cells.push_back({index(x, y, 0), index(x + 1, y + 1, 0), index(x, y + 1, 0)});
          continue;
        }
        // One tetrahedron for each order of the axes, with the corners counter-clockwise.
        constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        for (int k = 0; k < 6; ++k) {
          int at[3] = {x, y, z};
          std::vector<uint32_t> cell = {index(x, y, z)};
          for (const int axis : kOrders[k]) {
            ++at[axis];
            cell.push_back(index(at[0], at[1], at[2]));
          }
          if (k >= 3) std::swap(cell[1], cell[2]);
          cells.push_back(cell);
        }
      }
    }
  }
  std::vector<double> flat;
  for (const Vec& p : ground.points) flat.insert(flat.end(), p.begin(), p.begin() + dimension);
  std::vector<int32_t> corners;
  for (const auto& cell : cells) corners.insert(corners.end(), cell.begin(), cell.end());
  ground.environment = create_from(uniform_desc(static_cast<uint32_t>(dimension),
                                                dimension == 3 ? DSW_CELL_TYPE_TETRA : DSW_CELL_TYPE_TRIANGLE,
                                                static_cast<size_t>(dimension) + 1, flat, corners));
  std::map<std::vector<uint32_t>, std::vector<size_t>> sides;
  for (size_t c = 0; c < cells.size(); ++c) {
    for (size_t leave = 0; leave < cells[c].size(); ++leave) {
      std::vector<uint32_t> side = cells[c];
      side.erase(side.begin() + static_cast<std::ptrdiff_t>(leave));
      std::sort(side.begin(), side.end());
      sides[side].push_back(c);
    }
  }
  std::vector<bool> is_marked(cells.size());
  for (size_t c = 0; c < cells.size(); ++c) {
    is_marked[c] = rng.chance(marked);
    const dsw_volume_id volume = {static_cast<uint32_t>(c), 1};
    if (is_marked[c]) {
      EXPECT_EQ(dsw_environment_mark_volumes(ground.environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                DSW_STATUS_OK);
    }
  }
  for (const auto& [side, of] : sides) {
    if (of.size() == 1 || is_marked[of[0]] || is_marked[of[1]]) ground.walls.push_back(side);
  }
  ground.cells = cells;
  ground.is_marked = is_marked;
  if (!thin) return ground;
  for (uint32_t v = 0; v < ground.points.size(); v += 5) {
    const dsw_vertex_id vertex = {v, 1};
    EXPECT_EQ(dsw_environment_mark_vertices(ground.environment.get(), &vertex, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    ground.thin.push_back({v});
    const uint32_t ends[2] = {v, v + 1};
    if (dimension == 2 || ground.points[v][0] > ground.points[v + 1 < ground.points.size() ? v + 1 : v][0]) continue;
    if (v + 1 == ground.points.size()) continue;
    dsw_edge_id edge;
    if (dsw_environment_find_edges(ground.environment.get(), 1, ends, &edge, nullptr) != DSW_STATUS_OK) continue;
    if (dsw_environment_mark_edges(ground.environment.get(), &edge, 1, DSW_MARK_IMPASSABLE) != DSW_STATUS_OK) continue;
    ground.thin.push_back({v, v + 1});
  }
  return ground;
}

/// A test of random bodies on their ways, for each of some kinds that have a dimension.
template <class Kind>
class WaysTest : public testing::TestWithParam<Kind> {
 protected:
  explicit WaysTest(uint64_t seed) : rng_(seed) {}

  int dimension() const { return this->GetParam().dimension; }
  Vec random_point(double low, double high) {
    Vec p = {0, 0, 0};
    for (int k = 0; k < dimension(); ++k) p[static_cast<size_t>(k)] = rng_.range(low, high);
    return p;
  }
  Vec beside(Vec p, double reach) {
    for (int k = 0; k < dimension(); ++k) p[static_cast<size_t>(k)] += rng_.range(-reach, reach);
    return p;
  }
  /// A walk, a tree, a strip of triangles or lone vertices.
  BodyPlan plan(double step) {
    BodyPlan made;
    const uint32_t kind = rng_.below(4u);
    const auto count = static_cast<uint32_t>(rng_.between(2, 8));
    made.at.push_back(sheared(random_point(0.2, 2.8), dimension()));
    for (uint32_t i = 1; i < count; ++i) {
      const uint32_t from = kind == 1 ? rng_.below(i) : i - 1;
      made.at.push_back(beside(made.at[from], step));
      if (kind == 0 || kind == 1 || (kind == 2 && dimension() == 2)) made.edges.push_back({from, i});
      if (kind == 2 && i >= 2 && dimension() == 3) {
        made.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i}
                                        : std::vector<uint32_t>{i - 1, i - 2, i});
      }
    }
    return made;
  }

  Rng rng_;
};

/// A body on its way.
struct Walker {
  dsw_body_id id;
  dsw_level level;
  bool self;
  BodyState state;       // at the start
  std::vector<Vec> end;  // by slot
  bool alone = false;    // a particle: bodies do not meet it
  bool stands = false;   // not in the call

  std::vector<std::vector<uint32_t>> parts(size_t corners) const {
    std::vector<std::vector<uint32_t>> all;
    if (corners == 1) {
      for (uint32_t v = 0; v < state.at.size(); ++v) {
        if (state.vertices[v].generation != 0) all.push_back({v});
      }
    } else if (corners == 2 && level >= DSW_LEVEL_EDGES) {
      for (const auto& e : state.edges) all.push_back({e[0], e[1]});
    } else if (corners == 3 && level == DSW_LEVEL_FACES) {
      for (const auto& f : state.faces) all.push_back({f[0], f[1], f[2]});
    }
    return all;
  }
};

/// Corners of two parts, at most four. A vector of each would take half of the time of a test.
class Corners {
 public:
  void push_back(const double* p) { at_[size_++] = p; }
  size_t size() const { return size_; }
  const double* const* begin() const { return at_; }
  const double* const* end() const { return at_ + size_; }
  const double* operator[](size_t i) const { return at_[i]; }

 private:
  const double* at_[4] = {};
  size_t size_ = 0;
};

/// The earliest touch of all that is asked.
template <int D>
class Earliest {
 public:
  /// `exact`: by rational numbers; else by the engine's predicate, which these have been compared with.
  explicit Earliest(bool exact) : exact_(exact) {}

  void ask(PairKind kind, const Corners& start, const Corners& end) {
    MovingPair<D> pair{};
    pair.kind = kind;
    std::copy(start.begin(), start.end(), pair.start);
    std::copy(end.begin(), end.end(), pair.end);
    const size_t first = kind == PairKind::kEdgeEdge ? 2 : 1;
    for (int k = 0; k < D; ++k) {
      double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
      for (size_t i = 0; i < start.size(); ++i) {
        double& l = low[i < first ? 0 : 1];
        double& h = high[i < first ? 0 : 1];
        l = std::min({l, start[i][k], end[i][k]});
        h = std::max({h, start[i][k], end[i][k]});
      }
      if (low[0] > high[1] || low[1] > high[0]) return;
    }
    const FirstTouch found = exact_ ? true_first_touch(pair) : first_touch<D>(pair);
    if (found.touches) time = std::min(time, found.time);
  }
  double time = 2;

 private:
  bool exact_;
};

/// What the bodies touch on their ways.
template <int D>
double first_time(const Ground& ground, const std::vector<Walker>& walkers, bool exact) {
  Earliest<D> earliest(exact);
  const auto add = [](const Walker& of, const std::vector<uint32_t>& part, Corners& start, Corners& end, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const uint32_t v = part[std::min(i, part.size() - 1)];
      start.push_back(of.state.at[v].data());
      end.push_back(of.end[v].data());
    }
  };
  const auto add_ground = [&](const std::vector<uint32_t>& part, Corners& start, Corners& end) {
    for (const uint32_t v : part) {
      start.push_back(ground.points[v].data());
      end.push_back(ground.next.empty() ? ground.points[v].data() : ground.next[v].data());
    }
  };
  constexpr PairKind kSolid = D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge;
  constexpr size_t kSolidCorners = static_cast<size_t>(D);
  const auto ridges = ground.features(static_cast<size_t>(D) - 1), corners = ground.features(1);
  for (const Walker& of : walkers) {
    for (const auto& part : of.parts(1)) {
      for (const auto& wall : ground.walls) {
        Corners start, end;
        add(of, part, start, end, 1);
        add_ground(wall, start, end);
        earliest.ask(kSolid, start, end);
      }
    }
    for (const auto& part : of.parts(2)) {
      for (const auto& feature : ridges) {
        Corners start, end;
        if (D == 2) add_ground(feature, start, end);
        add(of, part, start, end, 2);
        if (D == 3) add_ground(feature, start, end);
        earliest.ask(D == 3 ? PairKind::kEdgeEdge : PairKind::kVertexEdge, start, end);
      }
    }
    for (const auto& part : of.parts(3)) {
      for (const auto& feature : corners) {
        Corners start, end;
        add_ground(feature, start, end);
        add(of, part, start, end, 3);
        earliest.ask(kSolid, start, end);
      }
    }
  }
  for (size_t i = 0; i < walkers.size(); ++i) {
    for (size_t j = 0; j < walkers.size(); ++j) {
      if (i == j ? !walkers[i].self : walkers[i].alone || walkers[j].alone) continue;
      const Walker &a = walkers[i], &b = walkers[j];
      const std::vector<std::vector<uint32_t>> of_b[] = {b.parts(1), b.parts(2), b.parts(3)};
      const auto shared = [&](const std::vector<uint32_t>& one, const std::vector<uint32_t>& other) {
        size_t count = 0;
        for (const uint32_t v : one) count += i == j && std::count(other.begin(), other.end(), v) != 0 ? 1 : 0;
        return count;
      };
      // A vertex against solids of the other, and against its edges and vertices where these are no solids.
      for (const auto& one : a.parts(1)) {
        for (size_t count = 1; count <= kSolidCorners; ++count) {
          for (const auto& other : of_b[count - 1]) {
            if (shared(one, other) != 0) continue;
            Corners start, end;
            const bool solid = count == kSolidCorners || D == 2;
            add(a, one, start, end, solid ? 1 : 2);
            add(b, other, start, end, solid ? kSolidCorners : 2);
            earliest.ask(solid ? kSolid : PairKind::kEdgeEdge, start, end);
          }
        }
      }
      if (D == 2) continue;
      for (const auto& one : a.parts(2)) {
        for (const auto& other : of_b[1]) {
          if (shared(one, other) != 0) continue;
          Corners start, end;
          add(a, one, start, end, 2);
          add(b, other, start, end, 2);
          earliest.ask(PairKind::kEdgeEdge, start, end);
        }
      }
    }
  }
  return earliest.time;
}

/// Figures of a test, which its report keeps for the benchmark. What was passed counts as missed.
inline void record_moves(size_t moves, size_t missed, size_t not_free, size_t different) {
  const auto record = [](const char* name, size_t count) {
    testing::Test::RecordProperty(name, static_cast<int>(count));
  };
  record("moves", moves);
  record("missed", missed);
  record("not_free", not_free);
  record("different", different);
}

/// Calls dsw_scene_move_together for bodies that go to their ends; whether it did as it should.
struct TogetherAnswer {
  std::vector<dsw_move_report> reports;
  std::vector<BodyState> after;
  std::vector<std::vector<dsw_body_contact>> contacts;
};
inline TogetherAnswer move_together(dsw_scene* scene, const std::vector<Walker>& walkers, dsw_together_stop stop,
                                    uint32_t rounds = 0, uint32_t response = 0) {
  TogetherAnswer answer;
  dsw_together_options options = defaults(dsw_together_options_init);
  options.stop = stop;
  options.max_rounds = rounds;
  options.response = static_cast<dsw_together_response>(stop == DSW_TOGETHER_STOP_FEATURE ? response : 0);
  std::vector<dsw_body_id> ids;
  std::vector<Vec> targets;
  for (const Walker& each : walkers) {
    ids.push_back(each.id);
    targets.insert(targets.end(), each.end.begin(), each.end.end());
  }
  answer.reports.resize(walkers.size());
  EXPECT_EQ(dsw_scene_move_together(scene, ids.data(), ids.size(), targets[0].data(), targets.size(), sizeof(Vec),
                                    &options, answer.reports.data()),
            DSW_STATUS_OK)
      << dsw_last_error_message();
  for (const Walker& each : walkers) {
    BodyState after;
    EXPECT_EQ(read_body(scene, each.id, after), "");
    answer.after.push_back(after);
    const dsw_body_contact* contacts = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contacts(scene, each.id, &contacts, &count), DSW_STATUS_OK);
    answer.contacts.emplace_back(contacts, contacts + count);
  }
  return answer;
}

}  // namespace dsw::oracle
