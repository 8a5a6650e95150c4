#include "calls.h"

#include <algorithm>

namespace dsw_fuzz {

Calls::Calls(dsw_scene* scene, const World& world, Bytes* bytes)
    : scene_(scene),
      environment_(dsw_scene_get_environment(scene)),
      bytes_(*bytes),
      dimension_(world.is_planar() ? 2 : 3) {
  for (int k = 0; k < 3; ++k) size_[k] = world.boxes[k];
  const dsw_environment_info info = info_of(environment_);
  most_volumes_ = 2 * info.volume_count + 10;
  most_vertices_ = info.vertex_count + 8;
}

dsw_status Calls::make() {
  constexpr uint32_t kChanges = 56;
  const uint32_t choice = bytes_.byte(), which = choice % kChanges;
  if (choice >= 4 * kChanges) return look(which % 7);
  if (which < 7) return change_marks(which);
  if (which < 18) return change_topology(which - 7);
  if (which < 26) return cut(which - 18);
  if (which < 33) return use_particles(which - 26);
  if (which < 38) return make_bodies(which - 33);
  if (which < 46) return edit_body(which - 38);
  if (which < 53) return move_bodies(which - 46);
  return deform();
}

dsw_volume_id Calls::volume() {
  dsw_volume_id id = {bytes_.byte(), bytes_.below(4)};
  if (!wild()) dsw_environment_get_volume_id(environment_, id.index % most_volumes_, &id);
  return id;
}

dsw_face_id Calls::face() {
  const dsw_volume_id of = volume();
  return {of.index, of.generation, bytes_.below(8)};
}

dsw_edge_id Calls::edge() {
  const dsw_volume_id of = volume();
  return {of.index, of.generation, bytes_.below(14)};
}

dsw_vertex_id Calls::vertex() {
  dsw_vertex_id id = {bytes_.byte(), bytes_.below(4)};
  if (!wild()) dsw_environment_get_vertex_id(environment_, id.index % most_vertices_, &id);
  return id;
}

dsw_particle_id Calls::particle() {
  dsw_particle_id ids[64];
  size_t count = 0;
  const uint32_t i = bytes_.byte();
  if (wild() || dsw_scene_get_particle_ids(scene_, ids, 64, &count) != DSW_STATUS_OK || count == 0) return {i, 1};
  return ids[i % count];
}

dsw_body_id Calls::body() {
  dsw_body_id ids[64];
  size_t count = 0;
  const uint32_t i = bytes_.byte();
  if (wild() || dsw_scene_get_body_ids(scene_, ids, 64, &count) != DSW_STATUS_OK || count == 0) return {i, 1};
  return ids[i % count];
}

dsw_body_vertex_id Calls::body_vertex(dsw_body_id of) {
  dsw_body_vertex_id id = {bytes_.below(12), bytes_.below(4)};
  if (!wild()) dsw_body_get_vertex_id(scene_, of, id.index, &id);
  return id;
}

dsw_body_edge_id Calls::body_edge(dsw_body_id of) {
  dsw_body_edge_id ids[64];
  size_t count = 0;
  const uint32_t i = bytes_.byte();
  if (wild() || dsw_body_get_edge_ids(scene_, of, ids, 64, &count) != DSW_STATUS_OK || count == 0) return {i, 1};
  return ids[i % count];
}

dsw_body_face_id Calls::body_face(dsw_body_id of) {
  dsw_body_face_id ids[64];
  size_t count = 0;
  const uint32_t i = bytes_.byte();
  if (wild() || dsw_body_get_face_ids(scene_, of, ids, 64, &count) != DSW_STATUS_OK || count == 0) return {i, 1};
  return ids[i % count];
}

void Calls::place(double* xyz) {
  const bool any = wild();
  for (size_t k = 0; k < dimension_; ++k) {
    xyz[k] = any ? bytes_.number() : bytes_.byte() * size_[k] / 240;  // a little beyond, too
  }
}

dsw_status Calls::change_marks(uint32_t which) {
  switch (which) {
    case 0: {
      const dsw_volume_id ids[] = {volume(), volume()};
      const uint32_t count = 1 + bytes_.below(2);
      const dsw_mark wanted = mark();
      return dsw_environment_mark_volumes(environment_, ids, count, wanted, bytes_.below(3), nullptr);
    }
    case 1: {
      const dsw_face_id id = face();
      return dsw_environment_mark_faces(environment_, &id, 1, mark());
    }
    case 2: {
      const dsw_edge_id id = edge();
      return dsw_environment_mark_edges(environment_, &id, 1, mark());
    }
    case 3: {
      const dsw_vertex_id id = vertex();
      return dsw_environment_mark_vertices(environment_, &id, 1, mark());
    }
    case 4: {
      const auto region = static_cast<int32_t>(bytes_.below(3));
      const dsw_mark wanted = mark();
      return dsw_environment_mark_region(environment_, region, wanted, bytes_.below(2), nullptr, nullptr);
    }
    case 5: {
      const auto region = static_cast<int32_t>(bytes_.below(3));
      return dsw_environment_mark_between(environment_, 0, region, mark(), nullptr);
    }
    default: {
      const dsw_volume_id id = volume();
      return dsw_environment_set_tag(environment_, id, bytes_.byte());
    }
  }
}

dsw_status Calls::change_topology(uint32_t which) {
  switch (which) {
    case 0: {
      const dsw_face_id a = face(), b = face();
      return dsw_environment_sew_faces(environment_, &a, &b, 1);
    }
    case 1:
      return dsw_environment_unsew_face(environment_, face());
    case 2: {
      const dsw_volume_id id = volume();
      return dsw_environment_remove_volumes(environment_, &id, 1);
    }
    case 3:
      return dsw_environment_merge_volumes(environment_, face(), nullptr);
    case 4: {
      dsw_vertex_id loop[5];
      const uint32_t count = bytes_.below(6);
      for (uint32_t i = 0; i < count; ++i) loop[i] = vertex();
      return dsw_environment_split_volume(environment_, volume(), loop, count, nullptr, nullptr);
    }
    case 5:
      return dsw_environment_merge_faces(environment_, edge(), nullptr);
    case 6: {
      const dsw_face_id id = face();
      const dsw_cell cell = {DSW_CELL_FACE, id.volume, id.generation, id.local};
      dsw_vertex_id corners[32];
      size_t count = 0;
      if (dsw_environment_copy_vertices(environment_, cell, corners, 32, &count) != DSW_STATUS_OK || count < 4) {
        const dsw_vertex_id from = vertex();
        return dsw_environment_split_face(environment_, id, from, vertex(), nullptr, nullptr);
      }
      const uint32_t first = bytes_.byte();
      return dsw_environment_split_face(environment_, id, corners[first % count], corners[(first + 2) % count], nullptr,
                                        nullptr);
    }
    case 7: {
      const dsw_edge_id id = edge();
      return dsw_environment_split_edge(environment_, id, bytes_.below(9) / 8.0, nullptr, nullptr);
    }
    case 8: {
      const dsw_edge_id id = edge();
      return dsw_environment_merge_edges(environment_, id, vertex(), nullptr);
    }
    case 9: {
      const dsw_edge_id id = edge();
      const dsw_cell cell = {DSW_CELL_EDGE, id.volume, id.generation, id.local};
      dsw_vertex_id ends[2] = {vertex(), {0, 0}};
      size_t count = 0;
      dsw_environment_copy_vertices(environment_, cell, ends, 2, &count);
      return dsw_environment_collapse_edge(environment_, id, ends[bytes_.below(2)]);
    }
    default:
      return add_volumes();
  }
}

/** A tetrahedron or triangle on the corners of a face of the outer boundary, or somewhere else. */
dsw_status Calls::add_volumes() {
  const dsw_face_id id = face();
  const dsw_cell cell = {DSW_CELL_FACE, id.volume, id.generation, id.local};
  dsw_vertex_id corners[32];
  size_t count = 0;
  if (dsw_environment_copy_vertices(environment_, cell, corners, 32, &count) != DSW_STATUS_OK) count = 0;
  const size_t needed = dimension_ + 1;
  count = std::min(count, dimension_);
  double points[12];
  for (size_t i = 0; i + count < needed; ++i) place(points + dimension_ * i);
  const int64_t tetrahedron[] = {0, 2, 1, 3}, triangle[] = {1, 0, 2};
  dsw_volumes_desc desc;
  dsw_volumes_desc_init(&desc, sizeof desc);
  desc.vertices = corners;
  desc.vertex_count = count;
  desc.points = points;
  desc.point_count = needed - count;
  desc.uniform_cell_type = dimension_ == 3 ? DSW_CELL_TYPE_TETRA : DSW_CELL_TYPE_TRIANGLE;
  desc.volume_count = 1;
  desc.connectivity = dimension_ == 3 ? tetrahedron : triangle;
  desc.connectivity_count = needed;
  if (bytes_.below(2) == 0) {
    desc.sew_to = &id;
    desc.sew_count = 1;
  }
  return dsw_environment_add_volumes(environment_, &desc, nullptr, nullptr);
}

dsw_status Calls::cut(uint32_t which) {
  double points[27];
  places(points);
  const uint32_t flags = bytes_.below(3);
  const double snap = bytes_.below(5) / 16.0;
  const dsw_volume_id start = bytes_.below(2) == 0 ? dsw_volume_id{0, 0} : volume();
  switch (which) {
    case 0:
    case 1: {
      dsw_cut_desc d;
      dsw_cut_desc_init(&d, sizeof d);
      d.flags = flags;
      d.points = points;
      d.rows = 2 + bytes_.below(2);
      d.columns = 2 + bytes_.below(2);
      d.snap = snap;
      d.start = start;
      return dsw_environment_cut(environment_, &d, nullptr);
    }
    case 2: {
      const dsw_face_id faces[] = {face(), face()};
      const double loads[] = {bytes_.number(), bytes_.number()};
      return dsw_environment_tear_faces(environment_, faces, loads, 2, bytes_.number(), nullptr);
    }
    case 3: {
      dsw_change change;
      change.struct_size = sizeof change;
      dsw_environment_get_change(environment_, &change);
      const std::vector<dsw_cut_face> crack(change.faces, change.faces + change.face_count);
      dsw_open_crack_desc d;
      dsw_open_crack_desc_init(&d, sizeof d);
      d.faces = crack.data();
      d.face_count = crack.size();
      d.width = bytes_.below(16) / 32.0;
      return dsw_environment_open_crack(environment_, &d, nullptr);
    }
    case 4: {
      const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
      dsw_carve_desc d;
      dsw_carve_desc_init(&d, sizeof d);
      d.flags = flags == 2 ? 4 : flags;  // 4 is refused
      d.points = points;
      d.point_count = 4;
      d.triangles = triangles;
      d.triangle_count = 4;
      d.start = start;
      d.snap = snap;
      return dsw_environment_carve(environment_, &d, nullptr);
    }
    case 5: {
      dsw_tie_desc d;
      dsw_tie_desc_init(&d, sizeof d);
      d.points = points;
      d.point_count = 3 + bytes_.below(4);
      d.start = start;
      d.snap = snap;
      return dsw_environment_tie(environment_, &d, nullptr);
    }
    case 6: {
      dsw_detach_desc d;
      dsw_detach_desc_init(&d, sizeof d);
      d.volume = volume();
      d.level = static_cast<dsw_level>(bytes_.below(5));
      dsw_body_id body_id;
      return dsw_environment_detach(dsw_scene_get_environment(scene_), &d, &body_id, nullptr);
    }
    default:
      return remesh();
  }
}

dsw_status Calls::remesh() {
  dsw_remesh_desc d;
  dsw_remesh_desc_init(&d, sizeof d);
  const dsw_volume_id wanted = volume();
  if (bytes_.below(2) == 0) {
    d.volumes = &wanted;
    d.volume_count = 1;
  }
  d.radius = bytes_.below(4);
  return dsw_environment_remesh(environment_, &d, nullptr);
}

/** Some vertices to other places, in an array that has room for more, or not. */
dsw_status Calls::deform() {
  const double* now = nullptr;
  size_t count = 0;
  dsw_environment_get_points(environment_, &now, &count);
  std::vector<double>& next = lent_[now == lent_[0].data() ? 1 : 0];
  dsw_deform_options o;
  dsw_deform_options_init(&o, sizeof o);
  o.method = static_cast<dsw_deform_method>(bytes_.below(2));
  o.response = static_cast<dsw_wall_response>(bytes_.below(4));
  o.invalid = static_cast<dsw_invalid_response>(bytes_.below(3));
  o.most_halvings = 1 + bytes_.below(4);
  o.max_holds = o.most_halvings == 4 ? 3 : 0;
  o.point_room = bytes_.below(2) == 0 ? 0 : count + 40;
  next.assign(dimension_ * (count + 40), 0);
  std::copy_n(now, dimension_ * count, next.begin());
  for (uint32_t i = 0, moved = bytes_.below(6); i < moved; ++i) {
    const size_t v = bytes_.byte() % count;
    for (size_t k = 0; k < dimension_; ++k) next[dimension_ * v + k] += static_cast<int8_t>(bytes_.byte()) / 100.0;
  }
  if (wild()) next[dimension_ * (bytes_.byte() % count)] = bytes_.number();
  if (bytes_.below(2) == 0) return dsw_environment_deform(environment_, next.data(), count, &o, nullptr);
  const dsw_body_id ids[] = {body(), body()};
  const uint32_t bodies = bytes_.below(3);
  const std::vector<double> targets = targets_of(ids, bodies);
  dsw_scene_deform_options together;
  dsw_scene_deform_options_init(&together, sizeof together);
  together.point_room = o.point_room;
  together.max_work = o.max_holds == 0 ? 0 : 1;
  together.stop = o.method == DSW_DEFORM_SWEPT ? DSW_TOGETHER_STOP_ALL : DSW_TOGETHER_STOP_FEATURE;
  if (together.stop == DSW_TOGETHER_STOP_FEATURE)
    together.response = static_cast<dsw_together_response>(o.response % 3);
  if (o.response == DSW_WALL_INSERT && together.stop == DSW_TOGETHER_STOP_ALL) {
    dsw_rigid_motion motions[2] = {{{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}}};
    for (dsw_rigid_motion& motion : motions) {
      motion.rotation[2] = static_cast<int8_t>(bytes_.byte()) / 256.0;
      place(motion.centre);
      for (size_t k = 0; k < dimension_; ++k) motion.translation[k] = static_cast<int8_t>(bytes_.byte()) / 100.0;
    }
    return dsw_scene_deform_rigid(scene_, next.data(), count, ids, bodies, motions, &together, nullptr, nullptr);
  }
  return dsw_scene_deform(scene_, next.data(), count, ids, bodies, targets.data(), targets.size() / dimension_, 0,
                          &together, nullptr, nullptr);
}

}  // namespace dsw_fuzz
