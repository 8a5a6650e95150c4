// Surgery: what is cut, opened, carved, tied and comes off, and what is split and put together.
#include "life.h"

#include "defaults.h"

#include <algorithm>

namespace dsw::portable {

using oracle::defaults;

dsw_status Life::cut() {
  Vec middle;
  const dsw_volume_id start = some_volume();
  if (!centre_of(start, middle)) return DSW_STATUS_NOT_FOUND;
  const Vec across = some_way(2), along = some_way(2);
  dsw_cut_desc desc = defaults(dsw_cut_desc_init);
  desc.rows = 2 + rng_.below(2);
  desc.columns = 2 + rng_.below(2);
  std::vector<double> points;
  for (uint32_t row = 0; row < desc.rows; ++row) {
    for (uint32_t column = 0; column < desc.columns; ++column) {
      const double u = double(row) / (desc.rows - 1) - 0.5, v = double(column) / (desc.columns - 1) - 0.5;
      const Vec bend = some_way(0.1);
      Vec p = {0, 0, 0};
      for (size_t k = 0; k < 3; ++k) p[k] = middle[k] + u * across[k] + v * along[k] + bend[k];
      append(points, p);
    }
  }
  desc.points = points.data();
  desc.flags = rng_.chance(0.6) ? uint32_t{DSW_CUT_UNSEW} : 0;
  desc.snap = rng_.chance(0.5) ? 0 : 0.2;
  desc.start = start;
  return dsw_environment_cut(environment(), &desc, nullptr);
}

/// What the last change has cut or torn.
dsw_status Life::open() {
  const dsw_change change = oracle::change_of(environment());
  const std::vector<dsw_cut_face> faces(change.faces, change.faces + change.face_count);
  if (faces.empty()) return cut();
  dsw_open_crack_desc desc = defaults(dsw_open_crack_desc_init);
  desc.faces = faces.data();
  desc.face_count = faces.size();
  desc.width = rng_.range(0.01, 0.2) * unit();
  desc.region = rng_.chance(0.5) ? 99 : 0;
  return dsw_environment_open_crack(environment(), &desc, nullptr);
}

/// An octahedron in what is impassable, or becomes it.
dsw_status Life::carve() {
  static const double corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  static const uint32_t triangles[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  const dsw_volume_id volume = some_volume();
  Vec middle;
  if (!centre_of(volume, middle)) return DSW_STATUS_NOT_FOUND;
  if (rng_.chance(0.5)) {
    dsw_environment_mark_volumes(environment(), &volume, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, nullptr);
  }
  const Vec aside = some_way(0.3);
  const double radius = rng_.range(0.2, 1) * unit();
  std::vector<double> points;
  for (const auto& corner : corners) {
    for (size_t k = 0; k < 3; ++k) points.push_back(middle[k] + aside[k] + radius * corner[k]);
  }
  dsw_carve_desc desc = defaults(dsw_carve_desc_init);
  desc.points = points.data();
  desc.point_count = 6;
  desc.triangles = triangles;
  desc.triangle_count = 8;
  desc.flags = rng_.chance(0.2) ? uint32_t{DSW_CARVE_WHOLE} : 0;
  return dsw_environment_carve(environment(), &desc, nullptr);
}

dsw_status Life::tie() {
  static const double circle[8][2] = {{1, 0},  {0.7, 0.7},   {0, 1},  {-0.7, 0.7},
                                      {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}};
  Vec middle;
  if (!centre_of(some_volume(), middle)) return DSW_STATUS_NOT_FOUND;
  const size_t axis = rng_.below(3u);
  const double radius = rng_.range(0.3, 1.5) * unit();
  std::vector<double> points;
  for (const auto& corner : circle) {
    Vec p = middle;
    const Vec aside = some_way(0.1);
    p[(axis + 1) % 3] += radius * corner[0];
    p[(axis + 2) % 3] += radius * corner[1];
    for (size_t k = 0; k < 3; ++k) points.push_back(p[k] + aside[k]);
  }
  dsw_tie_desc desc = defaults(dsw_tie_desc_init);
  desc.points = points.data();
  desc.point_count = 8;
  return dsw_environment_tie(environment(), &desc, nullptr);
}

/// A piece, which falls from then on.
dsw_status Life::detach() {
  const dsw_volume_id volume = some_volume();
  dsw_environment_mark_volumes(environment(), &volume, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, nullptr);
  dsw_detach_desc desc = defaults(dsw_detach_desc_init);
  desc.volume = volume;
  desc.level = static_cast<dsw_level>(rng_.between(1, 4));
  desc.max_volumes = 6;
  dsw_body_id body;
  const dsw_status status = dsw_environment_detach(environment(), &desc, &body, nullptr);
  if (status == DSW_STATUS_OK) movers_.push_back({body, some_way(0.2)});
  return status;
}

/// What was torn, or else is torn.
dsw_status Life::sew() {
  const dsw_change change = oracle::change_of(environment());
  if (change.face_count == 0) {
    const dsw_volume_id of = some_volume();
    const dsw_face_id face = {of.index, of.generation, rng_.below(4u)};
    const double load = 1;
    return dsw_environment_tear_faces(environment(), &face, &load, 1, 0.5, nullptr);
  }
  std::vector<dsw_face_id> front, back;
  for (size_t i = 0; i < change.face_count; ++i) {
    front.push_back(change.faces[i].front);
    back.push_back(change.faces[i].back);
  }
  return dsw_environment_sew_faces(environment(), front.data(), back.data(), front.size());
}

dsw_status Life::split_edge() {
  const dsw_volume_id of = some_volume();
  const dsw_edge_id edge = {of.index, of.generation, rng_.below(6u)};
  dsw_vertex_id vertex;
  dsw_edge_id parts[2];
  const dsw_status status = dsw_environment_split_edge(environment(), edge, 0.5, &vertex, parts);
  if (status != DSW_STATUS_OK) return status;
  return rng_.chance(0.5) ? dsw_environment_merge_edges(environment(), parts[0], vertex, nullptr)
                          : dsw_environment_collapse_edge(environment(), parts[0], vertex);
}

dsw_status Life::split_volume() {
  const dsw_volume_id of = some_volume();
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  dsw_environment_get_volume_counts(environment(), of, &type, nullptr, nullptr, nullptr);
  if (type != DSW_CELL_TYPE_HEXAHEDRON) return split_edge();
  dsw_vertex_id v[8];
  size_t count = 0;
  dsw_environment_copy_vertices(environment(), {DSW_CELL_VOLUME, of.index, of.generation, 0}, v, 8, &count);
  // Two opposite faces get diagonals first.
  for (size_t first = 0; first < 8; first += 4) {
    const size_t offsets[2] = {0, 4};
    const uint32_t corners[4] = {v[first].index, v[first + 1].index, v[first + 2].index, v[first + 3].index};
    dsw_face_id face = {0, 0, 0};
    dsw_environment_find_faces(environment(), 1, offsets, corners, &face, nullptr);
    const dsw_status status = dsw_environment_split_face(environment(), face, v[first], v[first + 2], nullptr, nullptr);
    if (status != DSW_STATUS_OK) return status;
  }
  dsw_volume_id again = of;
  dsw_environment_get_volume_id(environment(), of.index, &again);
  const dsw_vertex_id loop[4] = {v[0], v[2], v[6], v[4]};
  return dsw_environment_split_volume(environment(), again, loop, 4, nullptr, nullptr);
}

}  // namespace dsw::portable
