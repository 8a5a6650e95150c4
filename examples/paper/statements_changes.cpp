// 4.4, 5.1 and 5.2 of [JCD10].
#include <algorithm>
#include <set>

#include "statements.h"

namespace paper {
namespace {

constexpr std::uint32_t kSide = 8;

std::vector<dsw_particle_id> add_particles(dsw_scene* scene, std::size_t count, Random* random) {
  std::vector<dsw_particle_id> ids(count);
  for (dsw_particle_id& id : ids) {
    const Point at = {random->between(0.1, kSide - 0.1), random->between(0.1, kSide - 0.1),
                      random->between(0.1, kSide - 0.1)};
    physics::check(dsw_particle_create(scene, at.data(), {0, 0}, &id), "adding a particle");
  }
  return ids;
}

dsw_statistics statistics_of(dsw_scene* scene) {
  dsw_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  physics::check(dsw_scene_get_statistics(scene, &statistics), "reading counters");
  physics::check(dsw_scene_reset_statistics(scene), "resetting counters");
  return statistics;
}

}  // namespace

// The library has no counter of the tests of END_STATE. Its casts, from the centres of the cells to what they held, are made again by
// particles at the centres.
void deformations(Statements* out) {
  constexpr std::size_t kParticles = 1000;
  for (const double by : {1e-9, 0.05}) {
    Random random(3);
    const Tetrahedra mesh(kSide, &random);
    dsw_environment* const environment = mesh.environment.get();
    const physics::Scene scene = make_scene(environment, DSW_FEATURE_DEFORMING | DSW_FEATURE_STATISTICS);
    const std::vector<dsw_particle_id> particles = add_particles(scene.get(), kParticles, &random);
    std::vector<dsw_volume_id> before(kParticles), after(kParticles);
    std::vector<double> places(3 * kParticles), next = mesh.points;
    const auto read = [&](std::vector<dsw_volume_id>* volumes) {
      physics::check(dsw_scene_get_particle_positions(scene.get(), particles.data(), kParticles, places.data(), 0,
                                                      volumes->data()),
                     "reading particles");
    };
    read(&before);
    for (double& x : next) {
      x += x != 0 && x != kSide ? random.between(-by, by) : 0;
    }
    dsw_deform_options options;
    dsw_deform_options_init(&options, sizeof options);
    options.method = DSW_DEFORM_END_STATE;
    physics::check(dsw_environment_deform(environment, next.data(), next.size() / 3, &options, nullptr), "bending");
    read(&after);
    std::vector<dsw_particle_id> centres(kParticles);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < kParticles; ++i) {
      changed += before[i].index != after[i].index ? 1u : 0u;
      Point centre;
      physics::check(dsw_environment_get_centre(environment, before[i], centre.data()), "reading a centre");
      physics::check(dsw_particle_create(scene.get(), centre.data(), before[i], &centres[i]), "adding a particle");
    }
    std::vector<dsw_flight> flights(kParticles);
    statistics_of(scene.get());
    physics::check(dsw_scene_cast_from_particles(scene.get(), centres.data(), kParticles, places.data(), 0, nullptr,
                                                 flights.data()),
                   "casting from the centres");
    const double tests = static_cast<double>(statistics_of(scene.get()).orientation_tests) / kParticles;
    const bool small = by < 1e-3;
    const std::string name = small ? "a small motion" : "a larger motion";
    out->push_back(
        {"5.1", name + ": particles in another cell, of 1000", static_cast<double>(changed), "", small ? 0.0 : 1000.0});
    out->push_back(
        {"5.1", name + ": orientation tests of a cast from the centre", tests, small ? "4" : "", small ? 4.0 : 8.0});
    const auto end = std::count_if(flights.begin(), flights.end(),
                                   [](const dsw_flight& flight) { return flight.outcome != DSW_OUTCOME_REACHED; });
    out->push_back({"5.1", name + ": casts that do not end where the particle is", static_cast<double>(end), "0", 0});
  }
}

namespace {

// Where the vertices of an edge lie after some points of the floor, z = 0, have risen by 0.3.
template <class Rises>
std::vector<Point> raise_floor(const Point* ends, std::uint32_t flags, dsw_deform_method method,
                               dsw_wall_response response, Rises rises) {
  Random random(3);
  const Tetrahedra mesh(kSide, &random);
  const physics::Scene scene = make_scene(mesh.environment.get(), DSW_FEATURE_DEFORMING);
  dsw_body_id body;
  physics::check(add_edge(scene.get(), ends, DSW_LEVEL_EDGES_SWEPT, flags, &body), "adding an edge");
  std::vector<double> next = mesh.points;
  for (std::size_t i = 0; i < next.size(); i += 3) {
    next[i + 2] += next[i + 2] == 0 && rises(next[i], next[i + 1]) ? 0.3 : 0;
  }
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.method = method;
  options.response = response;
  physics::check(dsw_environment_deform(mesh.environment.get(), next.data(), next.size() / 3, &options, nullptr),
                 "raising a floor");
  std::vector<Point> places(64);
  std::size_t count = 0;
  physics::check(dsw_body_get_positions(scene.get(), body, places[0].data(), places.size(), 0, nullptr, &count),
                 "reading an edge");
  places.resize(count);
  return places;
}

}  // namespace

// What a floor that rises makes of an edge: rigid and just under where the floor ends; over two bumps.
void walls_that_push(Statements* out) {
  constexpr double kLeft = 0.001;  // of the floor's way, after it has touched
  const Point rigid[2] = {{2.3, 2.6, 0.3 - kLeft}, {4.6, 3.2, 0.3 - kLeft}},
              soft[2] = {{1.4, 3.05, 0.1}, {6.6, 3.05, 0.1}};
  for (const dsw_deform_method method : {DSW_DEFORM_END_STATE, DSW_DEFORM_SWEPT}) {
    const std::string name = method == DSW_DEFORM_SWEPT ? "SWEPT" : "END_STATE";
    const std::vector<Point> pushed =
        raise_floor(rigid, DSW_BODY_RIGID, method, DSW_WALL_PUSH, [](double, double) { return true; });
    const auto off = [&](std::size_t i) { return std::fabs((pushed[i][2] - rigid[i][2]) / kLeft - 1); };
    out->push_back({"5.1", name + ": way of a rigid edge, off from what is left of the floor's, share",
                    std::max(off(0), off(1)), "a correct position", 0.01});
    out->push_back({"5.1", name + ": the same, tilt of the edge", std::fabs(pushed[0][2] - pushed[1][2]), "0", 1e-9});
    const std::vector<Point> bent = raise_floor(soft, 0, method, DSW_WALL_INSERT, [](double x, double y) {
      return std::fabs(y - 3) < 0.5 && (std::fabs(x - 3) < 0.5 || std::fabs(x - 5) < 0.5);
    });
    out->push_back(
        {"5.1", name + ": vertices that an edge over two bumps gets", static_cast<double>(bent.size()) - 2, "2"});
  }
}

namespace {

// A prism of height 2 over a regular polygon of radius 1 round the origin, one cell with walls all round: a face stream.
physics::Environment make_prism(int corners) {
  std::vector<double> points;
  std::vector<std::int64_t> stream = {corners + 2};
  for (const double z : {-1.0, 1.0}) {
    stream.push_back(corners);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners;
      points.insert(points.end(), {std::cos(angle), std::sin(angle), z});
      stream.push_back(z < 0 ? corners - 1 - i : corners + i);
    }
  }
  for (std::int64_t i = 0; i < corners; ++i) {
    const std::int64_t next = (i + 1) % corners;
    stream.insert(stream.end(), {4, i, next, corners + next, corners + i});
  }
  const std::uint8_t type = DSW_CELL_TYPE_POLYHEDRON;
  const std::int64_t offsets[2] = {0, static_cast<std::int64_t>(stream.size())};
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.cell_types = &type;
  desc.volume_count = 1;
  desc.offsets = offsets;
  desc.connectivity = stream.data();
  desc.connectivity_count = stream.size();
  dsw_environment* made = nullptr;
  physics::check(dsw_environment_create(nullptr, &desc, &made, nullptr), "making a prism");
  return physics::Environment(made);
}

}  // namespace

// A particle that presses on one wall remembers it; one that is new at each move does not.
void forecasts(Statements* out) {
  constexpr int kMoves = 1000;
  for (const int corners : {4, 12}) {
    const physics::Environment environment = make_prism(corners);
    for (const bool remembers : {false, true}) {
      const physics::Scene scene = make_scene(environment.get(), DSW_FEATURE_STATISTICS);
      const Point start = {0.1, 0.05, 0.02}, target = {1.7, 0.4, 0.3};
      dsw_particle_id particle;
      physics::check(dsw_particle_create(scene.get(), start.data(), {0, 0}, &particle), "adding a particle");
      dsw_flight flight = {};
      const auto move = [&] {
        physics::check(dsw_particle_move(scene.get(), particle, target.data(), nullptr, &flight), "moving a particle");
      };
      move();
      double tests = 0;
      for (int i = 0; i < kMoves; ++i) {
        if (!remembers) {
          physics::check(dsw_particle_destroy(scene.get(), particle), "removing a particle");
          physics::check(dsw_particle_create(scene.get(), flight.position, {0, 0}, &particle), "adding a particle");
        }
        statistics_of(scene.get());
        move();
        tests += static_cast<double>(statistics_of(scene.get()).orientation_tests);
      }
      out->push_back({"3.3",
                      std::string("cell aimed at ") + (remembers ? "kept" : "forgotten") + ", " +
                          std::to_string(corners + 2) + " faces: orientation tests of a move to a wall",
                      tests / kMoves, ""});
    }
  }
}

void local_changes(Statements* out) {
  for (const std::size_t count : {100u, 10000u}) {
    for (const bool live : {false, true}) {
      Random random(5);
      const Tetrahedra mesh(kSide, &random);
      const physics::Scene scene =
          make_scene(mesh.environment.get(), DSW_FEATURE_STATISTICS | (live ? 0u + DSW_FEATURE_LIVE_CHANGES : 0u));
      add_particles(scene.get(), count, &random);
      double looked_at = 0, changes = 0;
      for (std::uint32_t i = 0; i < kSide * kSide * kSide; i += 9) {
        const dsw_volume_id volume = {6 * i, 1};  // of another cube each time, merged with a neighbour
        for (std::uint32_t local = 0; local < 4; ++local) {
          dsw_face_id face;
          if (dsw_environment_get_face_id(mesh.environment.get(), volume, local, &face) == DSW_STATUS_OK &&
              dsw_environment_merge_volumes(mesh.environment.get(), face, nullptr) == DSW_STATUS_OK) {
            looked_at += static_cast<double>(statistics_of(scene.get()).occupants_tested);
            ++changes;
            break;
          }
        }
      }
      out->push_back({"5.2",
                      std::to_string(count) + " particles, " + (live ? "DSW_FEATURE_LIVE_CHANGES" : "by default") +
                          ": looked at for a change",
                      looked_at / changes, "only few", live ? 0.02 * static_cast<double>(count) : HUGE_VAL});
    }
  }
}

namespace {

struct Box {
  Point lower, upper;
};

bool meet(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k]) {
      return false;
    }
  }
  return true;
}

// Cells that a segment enters.
std::vector<std::uint32_t> cells_of(const dsw_environment* environment, const Point& from, const Point& to) {
  std::vector<dsw_crossing> crossings(256);
  std::size_t count = 0;
  physics::check(dsw_environment_cast_path(environment, {0, 0}, from.data(), to.data(), nullptr, crossings.data(),
                                           crossings.size(), &count, nullptr),
                 "walking along an edge");
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < count; ++i) {
    cells.push_back(crossings[i].volume.index);
  }
  return cells;
}

}  // namespace

void registration(Statements* out) {
  constexpr std::size_t kEdges = 1000;
  for (const double length : {0.05, 0.25, 1.0, 2.0}) {
    Random random(9);
    const Tetrahedra mesh(4, &random);
    std::vector<std::vector<std::uint32_t>> registered(mesh.cells.size() / 4);
    std::vector<Box> boxes;
    std::size_t entries = 0;
    for (std::uint32_t e = 0; e < kEdges; ++e) {
      Point from, to;
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] = random.between(0.1, 3.9);
        to[k] = std::clamp(from[k] + random.between(-length, length), 0.05, 3.95);
      }
      for (const std::uint32_t cell : cells_of(mesh.environment.get(), from, to)) {
        registered[cell].push_back(e);
        ++entries;
      }
      Box box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.lower[k] = std::min(from[k], to[k]);
        box.upper[k] = std::max(from[k], to[k]);
      }
      boxes.push_back(box);
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> in_cells;
    for (const std::vector<std::uint32_t>& cell : registered) {
      for (std::size_t i = 0; i < cell.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          in_cells.insert({cell[k], cell[i]});
        }
      }
    }
    std::size_t of_boxes = 0;
    for (std::size_t i = 0; i < kEdges; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        of_boxes += meet(boxes[i], boxes[k]) ? 1u : 0u;
      }
    }
    char name[64];
    std::snprintf(name, sizeof name, "edges up to %g of a cube: ", length);
    out->push_back({"4.4", std::string(name) + "cells that hold an edge", static_cast<double>(entries) / kEdges, ""});
    out->push_back({"4.4", std::string(name) + "pairs that share a cell, an edge",
                    static_cast<double>(in_cells.size()) / kEdges, ""});
    out->push_back({"4.4", std::string(name) + "pairs whose boxes meet (ours), an edge",
                    static_cast<double>(of_boxes) / kEdges, ""});
  }
}

}  // namespace paper
