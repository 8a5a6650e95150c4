#include "verify.h"

#include <cmath>
#include <vector>

namespace physics {
namespace {

// Whether that is where a search for a point ends, from `hint` or from anywhere, and passable.
bool is_in(const dsw_environment* environment, const double* point, dsw_volume_id volume, dsw_volume_id hint) {
  dsw_volume_id found;
  dsw_location location = DSW_LOCATION_NONE;
  check(dsw_environment_locate(environment, point, hint, &found, &location), "finding a vertex");
  return location == DSW_LOCATION_PASSABLE && found.index == volume.index;
}

bool has_invalid_volume(const dsw_environment* environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  check(dsw_environment_get_info(environment, &info), "reading the environment");
  for (std::uint32_t index = 0; index < info.volume_index_count; ++index) {
    dsw_volume_id volume;
    int valid = 1;
    if (dsw_environment_get_volume_id(environment, index, &volume) == DSW_STATUS_OK) {
      check(dsw_environment_is_valid(environment, volume, &valid), "reading a volume");
    }
    if (valid == 0) {
      return true;
    }
  }
  return false;
}

// Whether a cast from the volume of `from` ends at `to`, in its volume.
bool reaches(const dsw_environment* environment, const double* from, dsw_volume_id start, const double* to,
             dsw_volume_id end) {
  dsw_flight flight;
  check(dsw_environment_cast_segments(environment, 1, &start, from, to, 3 * sizeof(double), nullptr, &flight),
        "casting an edge");
  return flight.outcome == DSW_OUTCOME_REACHED && flight.volume.index == end.index;
}

// Whether a body with the same faces can be created in the same place.
bool is_free_surface(dsw_scene* scene, dsw_body_id body, std::size_t face_slots, const std::vector<double>& positions) {
  std::vector<std::uint32_t> corners(3 * face_slots), offsets = {0}, kept;
  std::vector<double> points;
  std::vector<std::uint32_t> point_of(positions.size() / 3, UINT32_MAX);
  std::size_t count = 0;
  check(dsw_body_get_face_indices(scene, body, corners.data(), face_slots, &count), "reading faces");
  for (const std::uint32_t corner : corners) {
    if (corner == UINT32_MAX) {
      continue;  // a free slot
    }
    if (point_of[corner] == UINT32_MAX) {
      point_of[corner] = static_cast<std::uint32_t>(points.size() / 3);
      const double* at = &positions[std::size_t{3} * corner];
      points.insert(points.end(), at, at + 3);
    }
    kept.push_back(point_of[corner]);
    if (kept.size() % 3 == 0) {
      offsets.push_back(static_cast<std::uint32_t>(kept.size()));
    }
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  check(dsw_body_get_level(scene, body, &desc.level), "reading a level");
  desc.positions = points.data();
  desc.vertex_count = points.size() / 3;
  desc.face_offsets = offsets.data();
  desc.face_corners = kept.data();
  desc.face_count = kept.size() / 3;
  desc.face_corner_count = kept.size();
  dsw_body_id twin;
  const dsw_status status = dsw_body_create(scene, &desc, &twin);
  if (status == DSW_STATUS_OCCUPIED || status == DSW_STATUS_OUTSIDE || status == DSW_STATUS_IMPASSABLE) {
    return false;
  }
  check(status, "creating a surface again");
  check(dsw_body_destroy(scene, twin), "destroying it");
  return true;
}

}  // namespace

Validation verify(dsw_scene* scene, dsw_body_id body) {
  const dsw_environment* environment = dsw_scene_get_environment(scene);
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  check(dsw_body_get_counts(scene, body, &counts), "reading a body");
  std::vector<double> positions(std::size_t{3} * counts.vertex_slots), from, to;
  std::vector<dsw_volume_id> volumes(counts.vertex_slots), start, end;
  std::vector<dsw_body_vertex_id> vertices(counts.vertex_count);
  std::vector<dsw_body_edge_id> edges(counts.edge_count);
  std::size_t count = 0;
  check(dsw_body_get_positions(scene, body, positions.data(), counts.vertex_slots, 3 * sizeof(double), volumes.data(),
                               &count),
        "reading positions");
  check(dsw_body_get_vertex_ids(scene, body, vertices.data(), vertices.size(), &count), "reading vertices");
  check(dsw_body_get_edge_ids(scene, body, edges.data(), edges.size(), &count), "reading edges");

  Validation validation;
  validation.vertices = vertices.size();
  validation.edges = edges.size();
  for (const dsw_body_vertex_id& vertex : vertices) {
    const double* p = &positions[std::size_t{3} * vertex.index];
    validation.nonfinite += std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) ? 0 : 1;
  }
  if (validation.nonfinite > 0) {
    return validation;  // nobody can say where that is
  }
  for (const dsw_body_vertex_id& vertex : vertices) {
    const double* p = &positions[std::size_t{3} * vertex.index];
    const dsw_volume_id reported = volumes[vertex.index];
    // Where walls have folded cells over, a cell that nobody met may lie over the one that holds the vertex: the walk from that one's own
    // centre decides.
    if (!is_in(environment, p, reported, {0, 0})) {
      ++(is_in(environment, p, reported, reported) ? validation.from_own : validation.lost);
    }
  }
  for (const dsw_body_edge_id& edge : edges) {
    dsw_body_vertex_id ends[2];
    check(dsw_body_get_edge_ends(scene, body, edge, ends), "reading an edge");
    const double *p = &positions[std::size_t{3} * ends[0].index], *q = &positions[std::size_t{3} * ends[1].index];
    from.insert(from.end(), p, p + 3);
    to.insert(to.end(), q, q + 3);
    start.push_back(volumes[ends[0].index]);
    end.push_back(volumes[ends[1].index]);
  }
  std::vector<dsw_flight> flights(edges.size());
  if (!edges.empty()) {
    check(dsw_environment_cast_segments(environment, edges.size(), start.data(), from.data(), to.data(),
                                        3 * sizeof(double), nullptr, flights.data()),
          "casting the edges");
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (flights[i].outcome == DSW_OUTCOME_REACHED && flights[i].volume.index == end[i].index) {
      continue;
    }
    const bool other =
        has_invalid_volume(environment) && reaches(environment, &to[3 * i], end[i], &from[3 * i], start[i]);
    ++(other ? validation.from_own : validation.not_free);
  }
  if (counts.face_count > 0) {
    validation.not_free += is_free_surface(scene, body, counts.face_slots, positions) ? 0 : 1;
  }
  return validation;
}

}  // namespace physics
