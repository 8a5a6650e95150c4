#include "fig11_case.h"

#include "scenes/soft_hexahedra.h"

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

BodyShape hexahedron(bool with_faces) {
  BodyShape shape;
  shape.vertices = scenes::kBodyVertices;
  for (const auto& edge : scenes::kEdgeVertices) shape.edges.insert(shape.edges.end(), edge.begin(), edge.end());
  for (const auto& face : scenes::kBodyFaces) {
    if (with_faces) shape.corners.insert(shape.corners.end(), {face[0], face[1], face[2], face[0], face[2], face[3]});
  }
  return shape;
}

WallMesh marked_walls(const scenes::HexGrid& grid, World& world) {
  mark_cells(world, grid.obstacle);
  auto walls = scenes::hex_grid_walls(grid);
  adopt_triangulation(world, grid.mesh, walls);
  return {grid.mesh.points, std::move(walls)};
}

/** Cells that boxes round the bodies meet. */
std::unordered_set<std::uint32_t> met_cells(const scenes::HexGrid& grid, const std::vector<double>& positions) {
  std::unordered_set<std::uint32_t> cells;
  for (std::size_t first = 0; first < positions.size(); first += 3 * scenes::kBodyVertices) {
    const scenes::Box box(&positions[first]);
    std::array<std::uint32_t, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {  // a body that touches the outside may be rounded onto it
      const double last = grid.options.size[k] - 1.0;
      low[k] = static_cast<std::uint32_t>(std::clamp(box.low[k], 0.0, last));
      high[k] = static_cast<std::uint32_t>(std::clamp(box.high[k], 0.0, last));
    }
    for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
        for (std::uint32_t x = low[0]; x <= high[0]; ++x) cells.insert(grid.cell(x, y, z));
      }
    }
  }
  return cells;
}

/** Obstacles that come and go. */
class Obstacles {
 public:
  Obstacles(const scenes::HexGrid& grid, const World& world, const WallMesh& walls)
      : grid_(grid), world_(world), list_(grid, world, walls) {}

  /** Removes the obstacles of the last time, and adds others where no body is. */
  std::array<WallChange, 2> change(const std::vector<double>& positions) {
    std::array<WallChange, 2> made;
    made[0] = list_.turn(added_, false);
    added_.clear();
    auto met = met_cells(grid_, positions);
    for (std::size_t tried = 0; added_.size() < kObstacles && tried < 100 * grid_.obstacle.size(); ++tried) {
      const auto cell = static_cast<std::uint32_t>(random_.index(grid_.obstacle.size()));
      if (list_.passable(cell) && met.insert(cell).second) {
        added_.push_back(cell);
        for (std::uint32_t side = 0; side < 6; ++side) {  // no two side by side: their wall would come and go
          met.insert(scenes::neighbour(grid_, cell, side));
        }
      }
    }
    made[1] = list_.turn(added_, true);
    for (const WallChange& each : made) mark(world_, each);
    return made;
  }

  WallChange undo() {
    const WallChange made = list_.turn(added_, false);
    mark(world_, made);
    return made;
  }
  std::size_t slots() const { return list_.slots(); }

 private:
  const scenes::HexGrid& grid_;
  const World& world_;
  ChangeList list_;
  scenes::Random random_{23};
  std::vector<std::uint32_t> added_;
};

/** Tells the physics what bodies touched. */
void answer_contacts(const Flock& flock, scenes::SoftHexahedra& bodies) {
  for (std::size_t i = 0; i < flock.bodies().size(); ++i) {
    const dsw_body_contact* contacts = nullptr;
    std::size_t count = 0;
    check(dsw_body_get_contacts(flock.scene(), flock.bodies()[i], &contacts, &count));
    for (const dsw_body_contact* contact = contacts; contact != contacts + count; ++contact) {
      const std::size_t p = contact->vertex.index;
      std::size_t q = p;
      if (contact->edge.generation != 0) {
        dsw_body_vertex_id ends[2];
        check(dsw_body_get_edge_ends(flock.scene(), flock.bodies()[i], contact->edge, ends));
        q = ends[0].index == p ? ends[1].index : ends[0].index;
      }
      const std::size_t first = i * scenes::kBodyVertices;
      bodies.bounce(first + p, first + q, contact->edge_parameter, contact->contact.normal);
    }
  }
}

}  // namespace

void mark(const World& world, const WallChange& change) {
  if (!change.volumes.empty()) {
    check(dsw_environment_mark_volumes(world.environment(), change.volumes.data(), change.volumes.size(),
                                       change.impassable ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE, 0, nullptr));
  }
}

Segments Script::casts(std::size_t first_step, std::size_t count) const {
  std::array<std::vector<std::size_t>, scenes::kBodyVertices> neighbours;
  for (const auto& edge : scenes::kEdgeVertices) {
    neighbours[edge[0]].push_back(edge[1]);
    neighbours[edge[1]].push_back(edge[0]);
  }
  Segments segments;
  segments.batch = batch();
  segments.from.reserve(3 * count * batch());
  segments.to.reserve(3 * count * batch());
  segments.starts.reserve(count * batch());
  for (std::size_t step = first_step; step < first_step + count; ++step) {
    for (std::size_t v = 0; v < particles; ++v) {
      const double* const target = &targets[step][3 * v];
      const auto cast = [&](std::size_t q, std::size_t when) {
        const double* const start = &positions[when][3 * q];
        segments.from.insert(segments.from.end(), start, start + 3);
        segments.to.insert(segments.to.end(), target, target + 3);
        segments.starts.push_back(volumes[when][q]);
      };
      cast(v, step);
      const std::size_t local = v % scenes::kBodyVertices;
      for (const std::size_t neighbour : neighbours[local]) {
        cast(v - local + neighbour, neighbour < local ? step + 1 : step);
      }
    }
  }
  return segments;
}

Fig11Case::Fig11Case(std::size_t cells)
    : shape(hexahedron(false)),
      skin(hexahedron(true)),
      grid(make_grid(cells)),
      world(grid.mesh, 1),
      walls(marked_walls(grid, world)) {}

Script Fig11Case::record(std::size_t steps, bool changed) {
  scenes::SoftHexahedraOptions options;
  options.bodies = kBodies;
  scenes::SoftHexahedra bodies(grid, options);
  Script script;
  script.starts = bodies.positions();
  script.particles = script.starts.size() / 3;
  script.steps = steps;
  Obstacles obstacles(grid, world, walls);
  Flock flock(world.environment(), {"driver", DSW_LEVEL_EDGES, 0}, shape, script.starts);
  std::vector<double> positions;
  std::vector<dsw_volume_id> volumes;
  const auto keep = [&] {
    flock.places(positions, volumes);
    script.positions.push_back(positions);
    script.volumes.push_back(volumes);
  };
  keep();
  const double all = static_cast<double>(steps);
  for (std::size_t step = 0; step < steps; ++step) {
    if (changed && step % kStepsPerChange == 0) script.changes.push_back(obstacles.change(positions));
    script.targets.push_back(bodies.aim());
    script.mean_step += bodies.speed() / all;
    script.deformation += bodies.deformation() / all;
    flock.move(script.targets.back().data());
    keep();
    script.stopped_share += static_cast<double>(flock.stopped()) / static_cast<double>(script.particles) / all;
    bodies.reach(positions);
    answer_contacts(flock, bodies);
  }
  if (changed) script.undo.push_back(obstacles.undo());
  script.slots = obstacles.slots();
  return script;
}

}  // namespace dsw::bench
