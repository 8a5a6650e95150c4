// Random scenes in which an environment bends while bodies move, for each of some kinds.
#pragma once

#include "together_deform_support.h"

#include <cmath>

namespace dsw::oracle {

struct Kind {
  const char* name;
  int dimension;
  dsw_level level;
  double marked;
  bool thin, boxes;
  double reach, wall_reach;  // of moves
};
inline std::ostream& operator<<(std::ostream& out, const Kind& each) { return out << each.name; }

class BendingTest : public WaysTest<Kind> {
 protected:
  explicit BendingTest(uint64_t seed) : WaysTest(seed) {}

  static constexpr int kSteps = 6;

  Ground make(Rng& rng, bool ties = false) {
    if (GetParam().boxes) return make_box_ground(dimension(), 3, ties ? 0 : 0.1, GetParam().marked, rng);
    Ground ground = make_ground(dimension(), 3, ties ? 0 : 0.2, GetParam().marked, GetParam().thin, rng);
    mark_faces(ground, GetParam().marked, rng);
    return ground;
  }
  uint32_t flags(bool self) {
    uint32_t all = self ? DSW_BODY_SELF_CONTACTS : 0;
    if (rng_.chance(0.3)) {
      all |= DSW_BODY_SEQUENCES;
    } else if (rng_.chance(0.3)) {
      all |= DSW_BODY_NO_SEQUENCES;
    }
    if (rng_.chance(0.3)) all |= DSW_BODY_SKIP_BY_CLEARANCE | DSW_BODY_SKIP_BY_ENVIRONMENT;
    return all;
  }
  std::vector<Walker> make_walkers(dsw_scene* scene, size_t bodies, size_t particles) {
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 200 && walkers.size() < bodies; ++tries) {
      Walker walker{};
      walker.level = GetParam().level;
      walker.self = rng_.chance(0.7);
      if (create_body(scene, plan(0.5), walker.level, flags(walker.self), {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
      walkers.push_back(walker);
    }
    for (size_t i = 0; i < particles; ++i) {
      bool made = false;
      const Walker walker = make_particle(scene, sheared(random_point(0.1, 2.9), dimension()), &made);
      if (made) walkers.push_back(walker);
    }
    return walkers;
  }
  /// x to A x + b, near the unit matrix: such that no volume turns over on the way.
  struct Affine {
    double a[3][3], b[3];
    Vec operator()(const Vec& p) const {
      Vec to = {b[0], b[1], b[2]};
      for (size_t i = 0; i < 3; ++i) {
        for (size_t k = 0; k < 3; ++k) to[i] += a[i][k] * (p[k] - 1.5);
      }
      if (is_plane) to[2] = 0;
      return to;
    }
    bool is_plane;
  };
  Affine affine(double size) {
    Affine made{};
    made.is_plane = dimension() == 2;
    for (size_t i = 0; i < 3; ++i) {
      made.b[i] = 1.5 + rng_.range(-size, size);
      for (size_t k = 0; k < 3; ++k) made.a[i][k] = (i == k ? 1 : 0) + rng_.range(-size, size);
    }
    return made;
  }
  /// A rotation by less than a right angle, and a way along.
  Affine rigid() {
    Affine made = affine(0.8);
    Vec q = {rng_.range(-1, 1), rng_.range(-1, 1), rng_.range(-1, 1)};
    if (dimension() == 2) q = {0, 0, 1};
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), angle = rng_.range(-1.4, 1.4);
    const double c = std::cos(angle), s = std::sin(angle);
    for (double& x : q) x /= length;
    const double across[3][3] = {{0, -q[2], q[1]}, {q[2], 0, -q[0]}, {-q[1], q[0], 0}};
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) made.a[i][k] = (i == k ? c : 0) + (1 - c) * q[i] * q[k] + s * across[i][k];
    }
    return made;
  }
  void choose_ends(Ground& ground, std::vector<Walker>& walkers) {
    const uint32_t kind = rng_.below(4u);
    const double sizes[] = {1, 1, 0.1, 0.01, 1e-6, 1e-15};
    const double of_walls = GetParam().wall_reach * sizes[rng_.below(6u)],
                 of_bodies = GetParam().reach * sizes[rng_.below(6u)];
    const double share = rng_.chance(0.5) ? 1 : 0.2;
    const Affine carry = affine(rng_.chance(0.5) ? 0.1 : 0.001);
    const bool carries = kind == 0;
    speed_ = std::max(of_walls, of_bodies);
    is_coarse_ = !carries && std::min(of_walls, of_bodies) > 1e-7;
    ground.next = ground.points;
    for (Vec& p : ground.next) {
      if (carries) p = carry(p);
      if (kind != 1 && rng_.chance(share)) p = beside(p, of_walls);
    }
    for (Walker& each : walkers) {
      each.end = each.state.at;
      if (!each.alone) each.stands = kind == 2 || rng_.chance(0.2);
      if (each.stands) continue;
      const Vec way = beside({0, 0, 0}, of_bodies);
      for (Vec& p : each.end) {
        if (carries) p = carry(p);
        if (rng_.chance(0.1)) continue;
        for (size_t k = 0; k < 3; ++k) p[k] += way[k];
        p = beside(p, of_bodies * 0.3);
      }
    }
  }
  double first_time(const Ground& ground, const std::vector<Walker>& walkers, bool exact) {
    return dimension() == 2 ? oracle::first_time<2>(ground, walkers, exact)
                            : oracle::first_time<3>(ground, walkers, exact);
  }
  bool all_stay_valid(const Ground& ground, bool exact) {
    return dimension() == 2 ? stay_valid<2>(ground, exact) : stay_valid<3>(ground, exact);
  }
  /// Whether the volumes that hold vertices stay valid.
  bool occupied_stay_valid(const Ground& ground, const std::vector<BodyState>& all, bool exact) {
    std::vector<bool> held(ground.cells.size());
    for (const BodyState& each : all) {
      for (const dsw_volume_id volume : each.volumes) held[volume.index] = true;
    }
    return dimension() == 2 ? stay_valid<2>(ground, exact, held) : stay_valid<3>(ground, exact, held);
  }

  bool is_coarse_ = true;
  double speed_ = 0;  // of the last move: how far things come nearer to each other
};

inline const Kind kAllKinds[] = {{"Points", 3, DSW_LEVEL_POINTS, 0.1, false, false, 0.8, 0.08},
                                 {"Edges", 3, DSW_LEVEL_EDGES, 0.1, false, false, 0.4, 0.08},
                                 {"EdgesSwept", 3, DSW_LEVEL_EDGES_SWEPT, 0.1, true, false, 0.2, 0.1},
                                 {"Faces", 3, DSW_LEVEL_FACES, 0.05, true, false, 0.2, 0.08},
                                 {"FacesInverted", 3, DSW_LEVEL_FACES, 0.05, false, false, 0.2, 0.33},
                                 {"BoxEdges", 3, DSW_LEVEL_EDGES_SWEPT, 0.1, false, true, 0.3, 0.15},
                                 {"BoxFaces", 3, DSW_LEVEL_FACES, 0.05, false, true, 0.3, 0.33},
                                 {"PlanePoints", 2, DSW_LEVEL_POINTS, 0.1, false, false, 0.8, 0.12},
                                 {"PlaneEdges", 2, DSW_LEVEL_EDGES, 0.1, true, false, 0.4, 0.12},
                                 {"PlaneEdgesSwept", 2, DSW_LEVEL_EDGES_SWEPT, 0.05, true, false, 0.15, 0.3},
                                 {"PlaneBoxes", 2, DSW_LEVEL_EDGES_SWEPT, 0.1, false, true, 0.3, 0.2}};

}  // namespace dsw::oracle
