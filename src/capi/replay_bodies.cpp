// The calls that change particles and bodies, made again.

#include "capi/replay.h"
#include "dartsweep/dartsweep.h"

namespace dsw::capi {
namespace {

/** Room for what a call answers and nobody reads. */
template <class T>
Array<T> room_for(const dsw_replay& r, size_t count) {
  return Array<T>(count, T{}, Allocator<T>(memory_of(r.context)));
}

dsw_status create_particle(dsw_replay& r, Arguments& a) {
  const double* const point = a.get_points(1);
  dsw_particle_id particle;
  return dsw_particle_create(r.scene, point, a.get<dsw_volume_id>(), &particle);
}

dsw_status create_many_particles(dsw_replay& r, Arguments& a) {
  const auto points = a.get_points();
  const auto* const hints = a.get_items<dsw_volume_id>(points.count);
  auto particles = room_for<dsw_particle_id>(r, points.count);
  return dsw_scene_create_particles(r.scene, points.items, points.count, 0, hints, particles.data(), nullptr);
}

dsw_status destroy_one_particle(dsw_replay& r, Arguments& a) {
  return dsw_particle_destroy(r.scene, a.get<dsw_particle_id>());
}

dsw_status move_one_particle(dsw_replay& r, Arguments& a) {
  const auto particle = a.get<dsw_particle_id>();
  const double* const target = a.get_points(1);
  const auto o = a.get_struct<dsw_cast_options>();
  return dsw_particle_move(r.scene, particle, target, &o, nullptr);
}

/** What moves and casts of many particles are given. */
struct Flights {
  Items<dsw_particle_id> particles;
  const double* targets;
  dsw_cast_options options;

  explicit Flights(Arguments& a)
      : particles(a.get_items<dsw_particle_id>()),
        targets(a.get_points(particles.count)),
        options(a.get_struct<dsw_cast_options>()) {}
};

dsw_status move_many_particles(dsw_replay& r, Arguments& a) {
  const Flights f(a);
  return dsw_scene_move_particles(r.scene, f.particles.items, f.particles.count, f.targets, 0, &f.options, nullptr);
}

dsw_status cast_from_many_particles(dsw_replay& r, Arguments& a) {
  const Flights f(a);
  auto flights = room_for<dsw_flight>(r, f.particles.count);
  return dsw_scene_cast_from_particles(r.scene, f.particles.items, f.particles.count, f.targets, 0, &f.options,
                                       flights.data());
}

dsw_status reset_statistics(dsw_replay& r, Arguments&) { return dsw_scene_reset_statistics(r.scene); }

dsw_status create_one_body(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_body_desc>();
  if (d.edge_count > kVertexMask || d.face_count > kVertexMask)
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: a body");
  d.positions = a.get_points(d.vertex_count);
  d.stride_bytes = 0;
  d.hints = a.get_items<dsw_volume_id>(d.vertex_count);
  d.edges = a.get_items<uint32_t>(2 * d.edge_count);
  d.face_offsets = a.get_items<uint32_t>(d.face_count == 0 ? 0 : d.face_count + 1);
  d.face_corners = a.get_items<uint32_t>(d.face_corner_count);
  dsw_body_id body;
  return dsw_body_create(r.scene, &d, &body);
}

dsw_status destroy_one_body(dsw_replay& r, Arguments& a) { return dsw_body_destroy(r.scene, a.get<dsw_body_id>()); }

dsw_status set_body_level(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  return dsw_body_set_level(r.scene, body, a.get<dsw_level>());
}

dsw_status set_body_filter(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto category = a.get<uint32_t>();
  return dsw_body_set_filter(r.scene, body, category, a.get<uint32_t>());
}

dsw_status add_vertex(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const double* const point = a.get_points(1);
  dsw_body_vertex_id vertex;
  return dsw_body_add_vertex(r.scene, body, point, a.get<dsw_volume_id>(), &vertex);
}

dsw_status add_edge(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto from = a.get<dsw_body_vertex_id>();
  dsw_body_edge_id edge;
  return dsw_body_add_edge(r.scene, body, from, a.get<dsw_body_vertex_id>(), &edge);
}

dsw_status add_face(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto one = a.get<dsw_body_vertex_id>(), two = a.get<dsw_body_vertex_id>();
  dsw_body_face_id face;
  return dsw_body_add_face(r.scene, body, one, two, a.get<dsw_body_vertex_id>(), &face);
}

dsw_status remove_one_face(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  return dsw_body_remove_face(r.scene, body, a.get<dsw_body_face_id>());
}

dsw_status remove_one_edge(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  return dsw_body_remove_edge(r.scene, body, a.get<dsw_body_edge_id>());
}

dsw_status remove_one_vertex(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  return dsw_body_remove_vertex(r.scene, body, a.get<dsw_body_vertex_id>());
}

dsw_status split_one_edge(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto edge = a.get<dsw_body_edge_id>();
  return dsw_body_split_edge(r.scene, body, edge, a.get<double>(), nullptr);
}

dsw_status collapse_one_edge(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto edge = a.get<dsw_body_edge_id>();
  return dsw_body_collapse_edge(r.scene, body, edge, a.get<dsw_body_vertex_id>(), nullptr);
}

/** Options with the order that stands after them. */
dsw_move_options get_ordered(Arguments& a) {
  auto o = a.get_struct<dsw_move_options>();
  o.order = a.get_items<uint32_t>(o.order_count);
  return o;
}

dsw_status move_one_body(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto targets = a.get_points();
  const dsw_move_options o = get_ordered(a);
  return dsw_body_move(r.scene, body, targets.items, targets.count, 0, &o, nullptr);
}

dsw_status move_many_bodies(dsw_replay& r, Arguments& a) {
  const auto bodies = a.get_items<dsw_body_id>();
  const auto targets = a.get_points();
  const auto o = a.get_struct<dsw_move_options>();
  return dsw_scene_move_bodies(r.scene, bodies.items, bodies.count, targets.items, targets.count, 0, &o, nullptr);
}

dsw_status move_rigid(dsw_replay& r, Arguments& a) {
  const auto body = a.get<dsw_body_id>();
  const auto motion = a.get<dsw_rigid_motion>();
  const dsw_move_options o = get_ordered(a);
  return dsw_body_move_rigid(r.scene, body, &motion, &o, nullptr);
}

}  // namespace

ReplayRow body_row(Call call) noexcept {
  switch (call) {
    case Call::kCreateParticle:
      return {"dsw_particle_create", create_particle};
    case Call::kCreateParticles:
      return {"dsw_scene_create_particles", create_many_particles};
    case Call::kDestroyParticle:
      return {"dsw_particle_destroy", destroy_one_particle};
    case Call::kMoveParticle:
      return {"dsw_particle_move", move_one_particle};
    case Call::kMoveParticles:
      return {"dsw_scene_move_particles", move_many_particles};
    case Call::kCastFromParticles:
      return {"dsw_scene_cast_from_particles", cast_from_many_particles};
    case Call::kResetStatistics:
      return {"dsw_scene_reset_statistics", reset_statistics};
    case Call::kCreateBody:
      return {"dsw_body_create", create_one_body};
    case Call::kDestroyBody:
      return {"dsw_body_destroy", destroy_one_body};
    case Call::kSetLevel:
      return {"dsw_body_set_level", set_body_level};
    case Call::kSetFilter:
      return {"dsw_body_set_filter", set_body_filter};
    case Call::kAddBodyVertex:
      return {"dsw_body_add_vertex", add_vertex};
    case Call::kAddBodyEdge:
      return {"dsw_body_add_edge", add_edge};
    case Call::kAddBodyFace:
      return {"dsw_body_add_face", add_face};
    case Call::kRemoveBodyFace:
      return {"dsw_body_remove_face", remove_one_face};
    case Call::kRemoveBodyEdge:
      return {"dsw_body_remove_edge", remove_one_edge};
    case Call::kRemoveBodyVertex:
      return {"dsw_body_remove_vertex", remove_one_vertex};
    case Call::kSplitBodyEdge:
      return {"dsw_body_split_edge", split_one_edge};
    case Call::kCollapseBodyEdge:
      return {"dsw_body_collapse_edge", collapse_one_edge};
    case Call::kMoveBody:
      return {"dsw_body_move", move_one_body};
    case Call::kMoveBodies:
      return {"dsw_scene_move_bodies", move_many_bodies};
    case Call::kMoveRigid:
      return {"dsw_body_move_rigid", move_rigid};
    default:
      return {nullptr, nullptr};
  }
}

}  // namespace dsw::capi
