#include "vessel.h"

#include <array>
#include <unordered_map>

#include "lumen.h"
#include "mesh.h"

namespace insertion {
namespace {

using physics::check;

constexpr std::size_t kMostCorners = 256;

class Mesh {
 public:
  explicit Mesh(const Options& options) {
    const int code =
        options.mesh.empty() ? mesh_make_vessel(options.spacing, &mesh) : mesh_read(options.mesh.c_str(), &mesh);
    if (code != 0) {
      throw BadInput("");
    }
  }
  ~Mesh() { mesh_free(&mesh); }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  demo_mesh mesh = {};
};

void tag_regions(dsw_environment* environment, const demo_mesh& mesh) {
  for (std::uint32_t i = 0; i < mesh.cell_count; ++i) {
    dsw_volume_id volume;
    check(dsw_environment_get_volume_id(environment, i, &volume), "finding a volume");
    check(dsw_environment_set_tag(environment, volume, static_cast<std::uint32_t>(mesh.regions[i])),
          "tagging a volume");
  }
}

// Corners of a face, counter-clockwise seen from outside of `volume`.
std::size_t read_corners(const dsw_environment* environment, dsw_volume_id volume, std::uint32_t local,
                         dsw_vertex_id* corners) {
  dsw_face_id face;
  check(dsw_environment_get_face_id(environment, volume, local, &face), "reading a face");
  const dsw_cell cell = {DSW_CELL_FACE, face.volume, face.generation, face.local};
  std::size_t count = 0;
  check(dsw_environment_copy_vertices(environment, cell, corners, kMostCorners, &count), "reading the wall");
  if (face.volume != volume.index) {
    std::reverse(corners, corners + count);
  }
  return count;
}

}  // namespace

Vessel::Vessel(const Options& options)
    : flow_(new demo_flow(), [](demo_flow* flow) {
        flow_destroy(flow);
        delete flow;
      }) {
  const Mesh mesh(options);
  environment_.reset(create_environment(nullptr, &mesh.mesh));
  mark_wall(environment(), &mesh.mesh);
  tag_regions(environment(), mesh.mesh);
  check(flow_create(environment(), &mesh.mesh, options.route, flow_.get()), "finding the ways through the vessel");
  if (options.route > 0 && options.route >= flow_->end_count) {
    throw BadInput("--route " + std::to_string(options.route) + ": the vessel has " + std::to_string(flow_->end_count) +
                   " ends, which are numbered from 0");
  }
  route_.emplace(environment(), *flow_);
  info_.struct_size = sizeof info_;
  check(dsw_environment_get_info(environment(), &info_), "reading the environment");
}

Wall wall_of(const Vessel& vessel) {
  Wall wall;
  std::unordered_map<std::uint32_t, std::uint32_t> point_of;
  const auto point = [&](dsw_vertex_id vertex) {
    const auto [found, is_new] = point_of.emplace(vertex.index, static_cast<std::uint32_t>(wall.positions.size() / 3));
    if (is_new) {
      std::array<double, 3> at;
      check(dsw_environment_get_vertex_position(vessel.environment(), vertex, at.data()), "reading the wall");
      wall.positions.insert(wall.positions.end(), at.begin(), at.end());
    }
    return found->second;
  };
  std::array<dsw_vertex_id, kMostCorners> corners;
  for (std::size_t i = 0; i < vessel.flow().count; ++i) {
    const dsw_volume_id volume = vessel.flow().volumes[i];
    std::uint32_t faces = 0;
    check(dsw_environment_get_volume_counts(vessel.environment(), volume, nullptr, nullptr, nullptr, &faces),
          "reading a volume");
    for (std::uint32_t local = 0; local < faces; ++local) {
      int impassable = 0;
      check(dsw_environment_get_neighbour(vessel.environment(), volume, local, nullptr, &impassable),
            "reading a neighbour");
      const std::size_t count = impassable != 0 ? read_corners(vessel.environment(), volume, local, corners.data()) : 0;
      for (std::size_t k = 2; k < count; ++k) {
        wall.triangles.insert(wall.triangles.end(), {point(corners[0]), point(corners[k - 1]), point(corners[k])});
      }
    }
  }
  return wall;
}

}  // namespace insertion
