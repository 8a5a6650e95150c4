#include "catheter_moves.h"

#include "ours.h"

#include "insertion.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace dsw::bench {

namespace {

physics::Scene make_scene(dsw_environment* environment) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  dsw_scene* scene = nullptr;
  check(dsw_scene_create(environment, &desc, &scene));
  return physics::Scene(scene);
}

void append(const physics::Positions& points, std::vector<double>& all) {
  for (const physics::Vector3& point : points) all.insert(all.end(), point.data(), point.data() + 3);
}

}  // namespace

insertion::Options catheter_options(const std::string& mesh) {
  insertion::Options options;
  options.preset = "haptic";
  options.mesh = mesh;
  if (mesh.empty()) options.link = 0.5;  // longer than its route: it folds and presses
  options.slow = true;
  options.vertices = 201;
  options.inserts = false;
  options.statistics = false;
  options.contact_memory = 0;
  return options;
}

CatheterMoves record_moves(const insertion::Vessel& vessel, const insertion::Options& options, std::size_t most) {
  const physics::CatheterOptions made_of = insertion::fit_catheter(options, vessel.radius(), vessel.route().length());
  physics::World world(vessel.environment());
  physics::Catheter catheter(&world, &vessel.route(), made_of);
  const physics::SoftBody& body = catheter.body();
  CatheterMoves moves;
  for (std::size_t step = 0; step < options.steps && moves.count() < most; ++step) {
    const bool all_in = catheter.links() >= made_of.links;
    if (all_in && moves.start.empty()) {
      if (body.count() != body.points.size()) throw std::runtime_error("the catheter has free slots");
      append(body.points.position, moves.start);
      for (const physics::DistanceSpring& spring : body.springs.distances) {
        moves.edges.insert(moves.edges.end(),
                           {static_cast<std::uint32_t>(spring.a), static_cast<std::uint32_t>(spring.b)});
      }
    }
    catheter.step(options.dt);
    if (all_in) append(body.targets, moves.targets);
  }
  if (moves.count() == 0) throw std::runtime_error("not all links of the catheter came in");
  return moves;
}

bool read_moves(const std::string& path, CatheterMoves& moves) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  std::uint64_t sizes[3] = {};
  file.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  constexpr std::uint64_t kMost = 1u << 28;
  if (!file || std::max({sizes[0], sizes[1], sizes[2]}) > kMost) throw std::runtime_error("no moves: " + path);
  const auto read = [&](auto& values, std::uint64_t size) {
    values.resize(size);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size * sizeof(values.front())));
  };
  read(moves.start, sizes[0]);
  read(moves.edges, sizes[1]);
  read(moves.targets, sizes[2]);
  if (!file) throw std::runtime_error("cannot read all of " + path);
  return true;
}

void write_moves(const std::string& path, const CatheterMoves& moves) {
  std::ofstream file(path, std::ios::binary);
  const std::uint64_t sizes[3] = {moves.start.size(), moves.edges.size(), moves.targets.size()};
  file.write(reinterpret_cast<const char*>(sizes), sizeof sizes);
  const auto write = [&](const auto& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(values.front())));
  };
  write(moves.start);
  write(moves.edges);
  write(moves.targets);
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

CatheterReplay::CatheterReplay(dsw_environment* environment, const CatheterMoves& moves)
    : moves_(moves), scene_(make_scene(environment)) {
  dsw_move_options_init(&options_, sizeof options_);
  options_.vertex_response = options_.edge_response = DSW_RESPONSE_SLIDE;
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = moves.start.data();
  desc.vertex_count = moves.start.size() / 3;
  desc.edges = moves.edges.data();
  desc.edge_count = moves.edges.size() / 2;
  desc.level = DSW_LEVEL_EDGES_SWEPT;
  check(dsw_body_create(scene(), &desc, &body_));
}

void CatheterReplay::move(std::size_t i) {
  check(dsw_body_move(scene(), body_, moves_.move(i), moves_.start.size() / 3, 0, &options_, nullptr));
}

}  // namespace dsw::bench
