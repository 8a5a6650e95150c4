#include "place.h"

#include <cmath>
#include <stdexcept>

namespace dsw::curves {

namespace {

constexpr double kShake = 0.1, kRadius = 2.5;
constexpr double kFaceShare = 0.04, kSpikeShare = 0.015;

/** Where the lumen's middle is. */
Vec centre(double x, int side) {
  const double turn = 6.283185307179586 / side, middle = 0.5 * side;
  return {x, middle + 0.2 * side * std::sin(turn * x), middle + 0.2 * side * std::cos(turn * x)};
}

oracle::Mesh lattice(int side, Rng& rng) {
  oracle::Mesh mesh;
  const int row = side + 1, layer = row * row;
  for (int z = 0; z <= side; ++z) {
    for (int y = 0; y <= side; ++y) {
      for (int x = 0; x <= side; ++x) {
        mesh.points.push_back(
            {x + rng.range(-kShake, kShake), y + rng.range(-kShake, kShake), z + rng.range(-kShake, kShake)});
      }
    }
  }
  const int steps[3] = {1, row, layer};
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int p = x + row * y + layer * z;
        // Six tetrahedra round the diagonal, one for each order of the axes.
        for (int i = 0; i < 6; ++i) {
          const int a = p + steps[orders[i][0]], b = a + steps[orders[i][1]], c = b + steps[orders[i][2]];
          mesh.add_standard(DSW_CELL_TYPE_TETRA, {p, i >= 3 ? b : a, i >= 3 ? a : b, c});
        }
      }
    }
  }
  return mesh;
}

double distance(const Vec& a, const Vec& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

void check(dsw_status status) {
  if (status != DSW_STATUS_OK) {
    throw std::runtime_error(std::string(dsw_status_string(status)) + ": " + dsw_last_error_message());
  }
}

double difference(double a, const mpq_class& b) { return mpq_class(abs(mpq_class(a) - b)).get_d(); }

Place::Place(Kind kind, int side, std::uint64_t seed) : side_(side) {
  Rng rng(seed);
  const oracle::Mesh mesh = lattice(side, rng);
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 1;
  dsw_context* context = nullptr;
  check(dsw_context_create(&desc, &context));
  context_.reset(context);
  environment_ = oracle::create_environment(mesh, {}, DSW_ENVIRONMENT_LOCATE_TREE, context);
  if (environment_ == nullptr) throw std::runtime_error("the lattice was refused");
  world_ = std::make_unique<oracle::World>(mesh, environment_.get());
  if (!world_->fault().empty()) throw std::runtime_error(world_->fault());

  std::vector<char> lumen(mesh.cells.size(), 1);
  if (kind == Kind::kVessel) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const Vec& p = mesh.points[static_cast<std::size_t>(mesh.cells[c - c % 6].vertices[0])];
      const Vec middle = {p[0] + 0.5, p[1] + 0.5, p[2] + 0.5};
      lumen[c] = distance(middle, centre(middle[0], side)) < kRadius ? 1 : 0;
    }
    for (oracle::Face& f : world_->faces) {
      f.marked =
          f.cell[1] >= 0 && lumen[static_cast<std::size_t>(f.cell[0])] != lumen[static_cast<std::size_t>(f.cell[1])];
    }
  } else if (kind == Kind::kFaces) {
    for (oracle::Face& f : world_->faces) f.marked = f.cell[1] >= 0 && rng.chance(kFaceShare);
  } else {
    mark_volumes(kSpikeShare, rng);
  }
  mark_faces();
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    is_open_.push_back(lumen[c] != 0 && world_->cell_marked[c] == 0 ? 1 : 0);
    if (is_open_[c] != 0) open_.push_back(c);
  }
  exact_ = std::make_unique<oracle::SweepWorld>(*world_, std::vector<std::array<int, 2>>{});

  for (const Vec& p : mesh.points) points_.insert(points_.end(), p.begin(), p.end());
  std::vector<scenes::Wall> walls;
  for (const oracle::Triangle& t : world_->triangles) {
    if (!world_->impassable(t.face)) continue;
    scenes::Wall wall;
    for (std::size_t k = 0; k < 3; ++k) wall.vertices[k] = static_cast<std::uint32_t>(t.v[k]);
    wall.vertex_count = 3;
    walls.push_back(wall);
  }
  walls_ = std::make_unique<bench::WallMesh>(points_, std::move(walls));
}

void Place::mark_faces() {
  std::vector<dsw_face_id> ids;
  for (const oracle::Face& f : world_->faces) {
    if (!f.marked) continue;
    const dsw_volume_id owner = world_->ids[static_cast<std::size_t>(f.cell[0])];
    ids.push_back({owner.index, owner.generation, static_cast<std::uint32_t>(f.local[0])});
  }
  check(dsw_environment_mark_faces(environment_.get(), ids.data(), ids.size(), DSW_MARK_IMPASSABLE));
}

void Place::mark_volumes(double share, Rng& rng) {
  std::vector<dsw_volume_id> ids;
  for (std::size_t c = 0; c < world_->ids.size(); ++c) {
    if (!rng.chance(share)) continue;
    world_->cell_marked[c] = 1;
    ids.push_back(world_->ids[c]);
  }
  check(dsw_environment_mark_volumes(environment_.get(), ids.data(), ids.size(), DSW_MARK_IMPASSABLE, 0, nullptr));
}

oracle::ScenePtr Place::scene(std::uint32_t features) const {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = features;
  dsw_scene* scene = nullptr;
  check(dsw_scene_create(environment_.get(), &desc, &scene));
  return oracle::ScenePtr(scene);
}

Vec Place::point(Rng& rng) {
  const oracle::Cell& cell = world_->mesh.cells[open_[rng.below(open_.size())]];
  double weights[4], sum = 0;
  for (double& w : weights) sum += w = -std::log(1 - rng.unit());
  Vec p = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec& corner = world_->mesh.points[static_cast<std::size_t>(cell.vertices[i])];
    for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] / sum * corner[k];
  }
  return p;
}

Vec Place::point_at_wall(Rng& rng, double distance) {
  const auto& walls = walls_->triangles;
  for (;;) {
    const auto& wall = walls[rng.below(walls.size())];
    double weights[3], sum = 0;
    for (double& w : weights) sum += w = -std::log(1 - rng.unit());
    Vec p = direction(rng, distance * rng.unit());
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] / sum * walls_->point(wall[i])[k];
    }
    if (holds(p) && is_open(p)) return p;
  }
}

bool Place::is_open(const Vec& p) const {
  dsw_volume_id volume;
  check(dsw_environment_locate(environment_.get(), p.data(), {0, 0}, &volume, nullptr));
  return volume.generation != 0 && is_open_[volume.index] != 0;
}

Vec Place::direction(Rng& rng, double length) {
  for (;;) {
    Vec d = {rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1)};
    const double size = std::hypot(d[0], d[1], d[2]);
    if (!(size > 0.1 && size < 1)) continue;
    for (double& x : d) x *= length / size;
    return d;
  }
}

bool Place::is_free(const std::vector<Vec>& polyline) {
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    if (exact_->blocked(polyline[i], polyline[i + 1])) return false;
  }
  return true;
}

bool Place::holds(const Vec& p, double margin) const {
  return std::all_of(p.begin(), p.end(), [&](double x) { return x > margin && x < side_ - margin; });
}

}  // namespace dsw::curves
