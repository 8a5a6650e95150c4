#include "walls.h"

#include <algorithm>
#include <set>
#include <utility>

namespace physics {
namespace {

std::vector<dsw_vertex_id> corners_of(const dsw_environment* environment, dsw_face_id face) {
  const dsw_cell cell = {DSW_CELL_FACE, face.volume, face.generation, face.local};
  std::size_t count = 0;
  check(dsw_environment_copy_vertices(environment, cell, nullptr, 0, &count), "reading a face");
  std::vector<dsw_vertex_id> corners(count);
  check(dsw_environment_copy_vertices(environment, cell, corners.data(), count, &count), "reading a face");
  return corners;
}

}  // namespace

Walls::Walls(dsw_scene* scene, const WallOptions& options) : scene_(scene), options_(options) {
  find_wall();
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    points.set(n + i, points.position[i], options.mass);
    points.held[n + i] = 1;
    springs.distances.push_back({i, n + i, 0, options.anchor});
  }
  const double* now = nullptr;
  std::size_t count = 0;
  check(dsw_environment_get_points(dsw_scene_get_environment(scene), &now, &count), "reading points");
  arrays_[0].assign(now, now + 3 * count);
  arrays_[1] = arrays_[0];
}

std::size_t Walls::point_of(dsw_vertex_id vertex) {
  const auto added = point_of_.emplace(vertex.index, vertices_.size());
  if (added.second) {
    Vector3 at;
    check(dsw_environment_get_vertex_position(dsw_scene_get_environment(scene_), vertex, at.data()),
          "reading a vertex");
    points.set(vertices_.size(), at, options_.mass);
    vertices_.push_back(vertex.index);
  }
  return added.first->second;
}

// Faces between a passable volume and whatever stops things there; the outer boundary stays where it is.
void Walls::find_wall() {
  const dsw_environment* environment = dsw_scene_get_environment(scene_);
  dsw_environment_info info;
  info.struct_size = sizeof info;
  check(dsw_environment_get_info(environment, &info), "reading the environment");
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (std::uint32_t index = 0; index < info.volume_index_count; ++index) {
    dsw_volume_id volume;
    if (dsw_environment_get_volume_id(environment, index, &volume) != DSW_STATUS_OK) {
      continue;  // removed
    }
    std::uint32_t faces = 0;
    check(dsw_environment_get_volume_counts(environment, volume, nullptr, nullptr, nullptr, &faces),
          "reading a volume");
    for (std::uint32_t local = 0; local < faces; ++local) {
      dsw_volume_id behind;
      dsw_face_id face;
      int impassable = 0;
      check(dsw_environment_get_neighbour(environment, volume, local, &behind, &impassable), "reading a volume");
      if (impassable == 0 || behind.generation == 0 || behind.index < index) {
        continue;
      }
      check(dsw_environment_get_face_id(environment, volume, local, &face), "reading a face");
      const std::vector<dsw_vertex_id> corners = corners_of(environment, face);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t a = point_of(corners[k]), b = point_of(corners[(k + 1) % corners.size()]);
        if (edges.insert(std::minmax(a, b)).second) {
          springs.distances.push_back({a, b, (points.position[b] - points.position[a]).norm(), options_.stretching});
        }
      }
    }
  }
}

void Walls::take_reactions(const std::vector<Touch>& touches) {
  for (const Touch& touch : touches) {
    if (touch.wall.generation == 0) {
      continue;
    }
    const std::vector<dsw_vertex_id> corners = corners_of(dsw_scene_get_environment(scene_), touch.wall);
    for (const dsw_vertex_id& corner : corners) {
      const auto found = point_of_.find(corner.index);
      if (found != point_of_.end()) {  // else the outer boundary
        const double share = points.inverse_mass(found->second) / static_cast<double>(corners.size());
        points.velocity[found->second] -= share * touch.impulse;
      }
    }
  }
}

dsw_status Walls::step(double dt, dsw_deform_report* report) {
  Points next;
  integrate(points, springs, load, dt, options_.integrator, &next);
  if (!is_finite(next)) {
    points.rest();
    return DSW_STATUS_NON_FINITE;
  }
  std::vector<double>& array = arrays_[next_array_];
  const std::vector<double>& now = arrays_[1 - next_array_];
  array = now;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    std::copy_n(next.position[i].data(), 3, &array[3 * std::size_t{vertices_[i]}]);
  }
  const dsw_status status = dsw_environment_deform(dsw_scene_get_environment(scene_), array.data(), array.size() / 3,
                                                   &options_.deform, report);
  check(status, "bending the environment");
  if (report->outcome == DSW_DEFORM_REFUSED) {
    points.rest();
    return status;
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vector3 reached = Eigen::Map<const Vector3>(&array[3 * std::size_t{vertices_[i]}]);
    points.velocity[i] = reached == next.position[i] ? next.velocity[i] : Vector3((reached - points.position[i]) / dt);
    points.position[i] = reached;
  }
  next_array_ = 1 - next_array_;
  return status;
}

}  // namespace physics
