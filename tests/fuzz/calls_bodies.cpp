// What is called for particles and bodies.

#include "calls.h"

namespace dsw_fuzz {

dsw_status Calls::use_particles(uint32_t which) {
  double points[9];
  places(points);
  dsw_flight flights[3];
  dsw_cast_options o;
  dsw_cast_options_init(&o, sizeof o);
  o.max_volumes = bytes_.below(4);
  switch (which) {
    case 0: {
      dsw_particle_id id;
      return dsw_particle_create(scene_, points, volume(), &id);
    }
    case 1: {
      dsw_particle_id ids[3];
      return dsw_scene_create_particles(scene_, points, 1 + bytes_.below(3), 0, nullptr, ids, nullptr);
    }
    case 2:
      return dsw_particle_destroy(scene_, particle());
    case 3:
      return dsw_particle_move(scene_, particle(), points, &o, nullptr);
    case 4: {
      const dsw_particle_id ids[] = {particle(), particle(), particle()};
      return dsw_scene_move_particles(scene_, ids, 1 + bytes_.below(3), points, 0, nullptr, nullptr);
    }
    case 5: {
      const dsw_particle_id ids[] = {particle(), particle()};
      return dsw_scene_cast_from_particles(scene_, ids, 2, points, 0, nullptr, flights);
    }
    default:
      return dsw_scene_reset_statistics(scene_);
  }
}

dsw_status Calls::make_bodies(uint32_t which) {
  switch (which) {
    case 0:
    case 1:
    case 2: {
      double positions[12];
      place(positions);
      for (size_t i = dimension_; i < 4 * dimension_; ++i) {
        positions[i] = positions[i % dimension_] + static_cast<int8_t>(bytes_.byte()) / 300.0;
      }
      const uint32_t edges[] = {0, 1, 1, 2, 2, 3}, offsets[] = {0, 3, 6}, corners[] = {0, 1, 2, 0, 2, 3};
      const bool with_faces = bytes_.below(dimension_ == 3 ? 2 : 16) == 0;
      dsw_body_desc d;
      dsw_body_desc_init(&d, sizeof d);
      d.level = static_cast<dsw_level>(bytes_.below(5));
      d.flags = bytes_.byte();
      if (bytes_.below(2) == 0) d.flags &= 0x4fu;
      d.positions = positions;
      d.vertex_count = 4;
      d.edges = edges;
      const uint8_t choice = bytes_.byte();
      d.edge_count = choice % 4;
      d.radius = choice < 192 ? 0 : radius();
      d.face_offsets = offsets;
      d.face_corners = corners;
      d.face_count = with_faces ? 2 : 0;
      d.face_corner_count = with_faces ? 6 : 0;
      dsw_body_id id;
      return dsw_body_create(scene_, &d, &id);
    }
    case 3: {
      const dsw_body_id id = body();
      return dsw_body_set_level(scene_, id, static_cast<dsw_level>(bytes_.below(5)));
    }
    default: {
      const uint8_t choice = bytes_.byte();
      const dsw_body_id id = body();
      if (choice >= 192) return dsw_body_set_radius(scene_, id, radius());
      if (choice % 2 != 0) return dsw_body_destroy(scene_, id);
      const uint8_t category = bytes_.byte();
      return dsw_body_set_filter(scene_, id, category, bytes_.byte());
    }
  }
}

dsw_status Calls::edit_body(uint32_t which) {
  const dsw_body_id id = body();
  switch (which) {
    case 0: {
      double point[3];
      place(point);
      dsw_body_vertex_id made;
      return dsw_body_add_vertex(scene_, id, point, {0, 0}, &made);
    }
    case 1: {
      const dsw_body_vertex_id ends[] = {body_vertex(id), body_vertex(id)};
      dsw_body_edge_id made;
      return dsw_body_add_edge(scene_, id, ends[0], ends[1], &made);
    }
    case 2: {
      const dsw_body_vertex_id corners[] = {body_vertex(id), body_vertex(id), body_vertex(id)};
      dsw_body_face_id made;
      return dsw_body_add_face(scene_, id, corners[0], corners[1], corners[2], &made);
    }
    case 3:
      return dsw_body_remove_face(scene_, id, body_face(id));
    case 4:
      return dsw_body_remove_edge(scene_, id, body_edge(id));
    case 5:
      return dsw_body_remove_vertex(scene_, id, body_vertex(id));
    case 6: {
      const dsw_body_edge_id split = body_edge(id);
      return dsw_body_split_edge(scene_, id, split, bytes_.below(9) / 8.0, nullptr);
    }
    default: {
      const dsw_body_edge_id collapsed = body_edge(id);
      return dsw_body_collapse_edge(scene_, id, collapsed, body_vertex(id), nullptr);
    }
  }
}

dsw_move_options Calls::options() {
  dsw_move_options o;
  dsw_move_options_init(&o, sizeof o);
  o.vertex_response = bytes_.below(2) == 0 ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
  o.edge_response = static_cast<dsw_response>(bytes_.below(7));
  const uint32_t search = bytes_.below(4);
  o.search = static_cast<dsw_search>(search == 3 ? 4 : search);  // 4 is refused, as 3 was in 2.0
  o.bisection_depth = bytes_.below(12);
  o.flags = o.bisection_depth % 2 != 0 ? DSW_MOVE_KEEP_WALLS : 0;
  o.passes = o.bisection_depth % 3;
  o.max_volumes = bytes_.below(8) == 0 ? bytes_.below(20) : 0;
  o.min_length = 0.01;  // or edges are split for ever
  o.noise_share = bytes_.below(2) * 0.02;
  o.stand_off = wild() ? bytes_.number() : 0;
  return o;
}

std::vector<double> Calls::targets_of(const dsw_body_id* ids, uint32_t count) {
  std::vector<double> targets;
  for (uint32_t i = 0; i < count; ++i) {
    dsw_body_counts counts;
    counts.struct_size = sizeof counts;
    if (dsw_body_get_counts(scene_, ids[i], &counts) != DSW_STATUS_OK) continue;
    std::vector<double> positions(dimension_ * counts.vertex_slots);
    size_t got = 0;
    dsw_body_get_positions(scene_, ids[i], positions.data(), counts.vertex_slots, 0, nullptr, &got);
    const bool together = bytes_.below(2) == 0;
    double by[3] = {};
    for (size_t k = 0; k < positions.size(); ++k) {
      if (k < dimension_ || !together) by[k % dimension_] = static_cast<int8_t>(bytes_.byte()) / 50.0;
      positions[k] += by[k % dimension_];
    }
    if (wild() && !positions.empty()) positions[bytes_.byte() % positions.size()] = bytes_.number();
    targets.insert(targets.end(), positions.begin(), positions.end());
  }
  return targets;
}

dsw_status Calls::move_bodies(uint32_t which) {
  dsw_body_id ids[] = {body(), body()};
  if (which == 0) {
    dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}};
    for (double& q : motion.rotation) q += static_cast<int8_t>(bytes_.byte()) / 256.0;
    place(motion.centre);
    for (double& t : motion.translation) t = static_cast<int8_t>(bytes_.byte()) / 100.0;
    if (dimension_ == 2 && !wild()) motion.rotation[0] = motion.rotation[1] = motion.translation[2] = 0;
    dsw_move_options slides;
    dsw_move_options_init(&slides, sizeof slides);
    slides.flags = DSW_MOVE_SLIDE_WHOLE;
    const dsw_status status =
        dsw_body_move_rigid(scene_, ids[0], &motion, motion.translation[0] > 0 ? &slides : nullptr, nullptr);
    dsw_body_get_motion_left(scene_, ids[0], &motion);
    if (motion.translation[1] > 0) return status;
    const dsw_rigid_motion both[] = {motion, motion};
    return dsw_scene_move_rigid(scene_, ids, 2, both, nullptr, nullptr);
  }
  const uint32_t count = which == 1 ? 2 : which == 2 ? 1 + bytes_.below(2) : 1;
  const std::vector<double> targets = targets_of(ids, count);
  if (which == 2) {
    dsw_together_options o;
    dsw_together_options_init(&o, sizeof o);
    o.stop = static_cast<dsw_together_stop>(bytes_.below(4));
    o.max_rounds = bytes_.below(8);
    o.max_work = bytes_.below(4);
    if (o.stop == DSW_TOGETHER_STOP_FEATURE) o.response = static_cast<dsw_together_response>(o.max_rounds % 3);
    return dsw_scene_move_together(scene_, ids, count, targets.data(), targets.size() / dimension_, 0, &o, nullptr);
  }
  dsw_move_options o = options();
  if (count == 2) {
    return dsw_scene_move_bodies(scene_, ids, 2, targets.data(), targets.size() / dimension_, 0, &o, nullptr);
  }
  order_.clear();
  for (uint32_t i = 0, n = bytes_.below(8); i < n && n > 4; ++i) order_.push_back(bytes_.below(8));
  if (!order_.empty()) {
    o.order = order_.data();
    o.order_count = order_.size();
  }
  return dsw_body_move(scene_, ids[0], targets.data(), targets.size() / dimension_, 0, &o, nullptr);
}

}  // namespace dsw_fuzz
