#include "fig11_case.h"

#include <algorithm>
#include <unordered_set>

namespace dsw::bench {

namespace {

constexpr std::size_t kObstacles = 16;  // that appear together

scenes::HexGrid make_grid(std::size_t cells) {
  scenes::HexGridOptions options;
  options.size = scenes::hex_grid_size(cells);
  return scenes::make_hex_grid(options);
}

BodyShape torus() {
  BodyShape shape;
  shape.vertices = scenes::kTorusVertices;
  for (const auto& edge : scenes::torus_edges()) {
    shape.edges.insert(shape.edges.end(), edge.begin(), edge.end());
  }
  for (const auto& face : scenes::torus_faces()) {
    shape.corners.insert(shape.corners.end(), face.begin(), face.end());
  }
  return shape;
}

WallMesh marked_walls(const scenes::HexGrid& grid, World& world) {
  mark_cells(world, grid.obstacle);
  auto walls = scenes::hex_grid_walls(grid);
  adopt_triangulation(world, grid.mesh, walls);
  return {grid.mesh.points, std::move(walls)};
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const BodyShape& shape) {
  Neighbours of(shape.vertices);
  for (std::size_t e = 0; e < shape.edges.size(); e += 2) {
    of[shape.edges[e]].push_back(shape.edges[e + 1]);
    of[shape.edges[e + 1]].push_back(shape.edges[e]);
  }
  return of;
}

/** Cells that vertices or edges of the bodies are in. */
std::unordered_set<std::uint32_t> met_cells(const World& world, const BodyShape& shape,
                                            const std::vector<double>& positions,
                                            const std::vector<dsw_volume_id>& volumes) {
  std::unordered_set<std::uint32_t> cells;
  dsw_crossing crossings[64];
  dsw_cast_options options;
  dsw_cast_options_init(&options, sizeof options);
  options.flags = DSW_CAST_START_KNOWN;
  for (std::size_t first = 0; first < volumes.size(); first += shape.vertices) {
    for (std::size_t e = 0; e < shape.edges.size(); e += 2) {
      const std::size_t a = first + shape.edges[e], b = first + shape.edges[e + 1];
      std::size_t count = 0;
      check(dsw_environment_cast_path(world.environment(), volumes[a], &positions[3 * a], &positions[3 * b], &options,
                                      crossings, 64, &count, nullptr));
      for (std::size_t i = 0; i < count; ++i) {
        cells.insert(crossings[i].volume.index);
      }
    }
  }
  return cells;
}

}  // namespace

void mark(const World& world, const WallChange& change) {
  check(dsw_environment_mark_volumes(world.environment(), change.volumes.data(), change.volumes.size(),
                                     change.impassable ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE, 0, nullptr));
}

Fig11Case::Fig11Case(std::size_t cells)
    : shape(torus()), grid(make_grid(cells)), world(grid.mesh, 1), walls(marked_walls(grid, world)) {}

Script Fig11Case::record(std::size_t steps, bool changed) {
  scenes::TorusMotion motion(grid, {});
  Script script;
  script.particles = motion.vertex_count();
  script.steps = steps;
  script.segments.batch = kCastsPerParticle * script.particles;
  ChangeList list(grid, world, walls);
  const Neighbours neighbours = neighbours_of(shape);
  scenes::Random random(23);
  Flock flock(world.environment(), {"driver", DSW_LEVEL_FACES, 0}, shape, motion.starts());
  std::vector<double> before, after;
  std::vector<dsw_volume_id> from, to;
  flock.places(after, to);
  std::vector<std::uint8_t> arrived(motion.body_count());
  std::vector<std::uint32_t> added;
  constexpr std::size_t kWarmUp = 100;  // steps until as many bodies press against something as will ever do
  for (std::size_t step = 0; step < kWarmUp + steps; ++step) {
    before = after;
    from = to;
    if (step == kWarmUp) {
      script.starts = before;
    }
    const bool recorded = step >= kWarmUp;
    if (recorded && changed && (step - kWarmUp) % kStepsPerChange == 0) {
      script.changes.emplace_back();
      auto& [gone, come] = script.changes.back();
      gone = list.turn(added, false);
      added.clear();
      auto met = met_cells(world, shape, before, from);
      while (added.size() < kObstacles) {
        const auto cell = static_cast<std::uint32_t>(random.index(grid.obstacle.size()));
        if (list.passable(cell) && met.insert(cell).second) {
          added.push_back(cell);
          for (std::uint32_t side = 0; side < 6; ++side) {  // no two side by side: their wall would come and go
            met.insert(scenes::neighbour(grid, cell, side));
          }
        }
      }
      come = list.turn(added, true);
      mark(world, gone);
      mark(world, come);
    }
    flock.move(motion.targets().data());
    flock.places(after, to);
    if (recorded) {
      script.targets.push_back(motion.targets());
      for (std::size_t v = 0; v < script.particles; ++v) {
        const std::size_t first = v / shape.vertices * shape.vertices;
        const double* const target = &motion.targets()[3 * v];
        const auto cast = [&](const double* start, dsw_volume_id volume) {
          script.segments.from.insert(script.segments.from.end(), start, start + 3);
          script.segments.to.insert(script.segments.to.end(), target, target + 3);
          script.segments.starts.push_back(volume);
        };
        cast(&before[3 * v], from[v]);
        for (const std::uint32_t neighbour : neighbours[v - first]) {
          const std::size_t q = first + neighbour;
          cast(q < v ? &after[3 * q] : &before[3 * q], q < v ? to[q] : from[q]);
        }
      }
    }
    for (std::size_t body = 0; body < arrived.size(); ++body) {
      arrived[body] = flock.report(body).vertices_stopped == 0 ? 1 : 0;
    }
    motion.advance(arrived);
  }
  if (changed) {
    script.undo.push_back(list.turn(added, false));
    mark(world, script.undo.back());
  }
  script.slots = list.slots();
  return script;
}

}  // namespace dsw::bench
