#include "dartsweep/move.h"

#include <algorithm>
#include <cmath>

#include "capi/given_motion.h"
#include "capi/moved_bodies.h"
#include "capi/recorded.h"
#include "scene/rigid_moves.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr uint32_t kFlags = DSW_MOVE_KEEP_WALLS, kMoveFlags = kFlags | DSW_MOVE_LEAVE, kMostPasses = 64,
                   kRigidRounds = 32;

dsw::MoveSettings to_settings(const dsw_move_options& o) {
  dsw::MoveSettings s;
  const auto to_response = [](const dsw_response& given, const char* name) {
    return static_cast<dsw::Response>(capi::to_number(given, DSW_RESPONSE_ADAPTIVE_SLIDE, name));
  };
  s.vertex = to_response(o.vertex_response, "options->vertex_response");
  if (s.vertex != dsw::Response::kStop && s.vertex != dsw::Response::kSlide) {
    fail(DSW_STATUS_UNSUPPORTED, "options->vertex_response is %u, must be STOP or SLIDE",
         capi::raw_value(o.vertex_response));
  }
  s.edge = to_response(o.edge_response, "options->edge_response");
  s.search = static_cast<dsw::Search>(capi::to_number(o.search, DSW_SEARCH_BISECTION_VERTEX, "options->search"));
  s.keeps_walls = (o.flags & DSW_MOVE_KEEP_WALLS) != 0;
  s.leaves = (o.flags & DSW_MOVE_LEAVE) != 0;
  s.passes = capi::to_count(o.passes, kMostPasses, 0, "options->passes");
  s.max_volumes = o.max_volumes;
  s.bisection_depth = capi::to_count(o.bisection_depth, 52, s.bisection_depth, "options->bisection_depth");
  s.min_part = capi::to_min_part(o.min_part, s.min_part);
  s.min_length = capi::to_length(o.min_length, "options->min_length");
  if (!std::isfinite(o.stand_off)) fail(DSW_STATUS_NON_FINITE, "options->stand_off is %g", o.stand_off);
  s.stand_off = o.stand_off;
  s.noise_share = capi::to_length(o.noise_share, "options->noise_share");
  return s;
}

template <int D>
dsw::MoveOrder to_order(const dsw::Scene<D>& scene, const dsw::Body<D>& body, const dsw_move_options& o) {
  if (o.order == nullptr) {
    if (o.order_count != 0) fail(DSW_STATUS_NULL_ARGUMENT, "options->order is null and order_count %zu", o.order_count);
    return {};
  }
  dsw::require_array(o.order, o.order_count, "options->order");
  dsw::Array<bool> seen(body.vertices.size(), false, scene.memory);
  for (size_t i = 0; i < o.order_count; ++i) {
    const uint32_t v = o.order[i];
    if (!body.has_vertex(v)) fail(DSW_STATUS_OUT_OF_RANGE, "options->order[%zu] is %u, which names no vertex", i, v);
    if (seen[v]) fail(DSW_STATUS_DUPLICATE_ID, "options->order[%zu] is %u, which occurs twice", i, v);
    seen[v] = true;
  }
  return {o.order, o.order_count};
}

/** Without a vertex that has left, parts that it joined could be too near to each other. */
template <int D>
void check_leaves(const dsw::Body<D>& body, const dsw::MoveSettings& settings) {
  if (!settings.leaves || !body.keeps_lengths()) return;
  fail(DSW_STATUS_UNSUPPORTED, "options->flags has DSW_MOVE_LEAVE: not for thick bodies with DSW_BODY_SELF_CONTACTS");
}

}  // namespace

dsw_status dsw_body_move(dsw_scene* scene, dsw_body_id body, const double* targets, size_t target_count,
                         size_t stride_bytes, const dsw_move_options* options, dsw_move_report* report) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    constexpr int D = capi::kDimension<decltype(of)>;
    const dsw_move_options o = capi::read_optional(options, "options", kMoveFlags);
    const dsw::MoveSettings settings = to_settings(o);
    check_leaves(of.body, settings);
    capi::check_target_count(target_count, of.body.vertices.size());
    const dsw::PointArray points = dsw::to_points(of.kDimension, targets, target_count, stride_bytes, "targets");
    const dsw::MoveOrder order = to_order(of.scene, of.body, o);
    capi::check_targets(of.body, points, order, 0);
    capi::Recorded call(scene, capi::row_of<dsw_body_move>, body, targets, target_count, stride_bytes, &o);
    move_body(of.scene, of.record, points, order, settings);
    dsw::BodyRecord<D>* const record = &of.record;
    call.done(capi::Moved<D>{&record, 1});
    if (report != nullptr) *report = capi::to_report(of.record.record);
  });
}

dsw_status dsw_scene_move_bodies(dsw_scene* scene, const dsw_body_id* bodies, size_t count, const double* targets,
                                 size_t target_count, size_t stride_bytes, const dsw_move_options* options,
                                 dsw_move_report* reports) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw_move_options o = capi::read_optional(options, "options", kMoveFlags);
    const dsw::MoveSettings settings = to_settings(o);
    if (o.order != nullptr || o.order_count != 0)
      fail(DSW_STATUS_UNSUPPORTED, "options->order must be null for many bodies");
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    for (const dsw::BodyRecord<D>* each : records) check_leaves(each->body, settings);
    const dsw::PointArray points = capi::check_all_targets(records, targets, target_count, stride_bytes);
    capi::Recorded call(scene, capi::row_of<dsw_scene_move_bodies>, bodies, count, targets, target_count, stride_bytes,
                        &o);
    move_bodies(s, records.data(), count, points, settings);
    call.done(capi::Moved<D>{records.data(), count});
    for (size_t i = 0; reports != nullptr && i < count; ++i) reports[i] = capi::to_report(records[i]->record);
  });
}

dsw_status dsw_body_move_rigid(dsw_scene* scene, dsw_body_id body, const dsw_rigid_motion* motion,
                               const dsw_move_options* options, dsw_move_report* report) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    constexpr int D = capi::kDimension<decltype(of)>;
    dsw::require(motion, "motion");
    const dsw_move_options o = capi::read_optional(options, "options", kFlags | DSW_MOVE_SLIDE_WHOLE);
    const uint32_t passes = to_settings(o).passes;
    const uint32_t rounds = (o.flags & DSW_MOVE_SLIDE_WHOLE) == 0 ? 0 : passes != 0 ? passes : kRigidRounds;
    const dsw::MoveOrder order = to_order(of.scene, of.body, o);
    if (order.vertices != nullptr && order.count != of.body.vertex_slots.alive_count()) {
      fail(DSW_STATUS_WRONG_SIZE, "options->order has %zu vertices of %zu: a rigid body moves as a whole", order.count,
           of.body.vertex_slots.alive_count());
    }
    const dsw::RigidMove<D> rigid = capi::to_motion<D>(*motion, "motion->");
    if (!stays_finite(of.body, rigid)) fail(DSW_STATUS_NON_FINITE, "motion leads further than doubles go");
    capi::Recorded call(scene, capi::row_of<dsw_body_move_rigid>, body, motion, &o);
    move_rigid(of.scene, of.record, rigid, order, rounds);
    dsw::BodyRecord<D>* const record = &of.record;
    call.done(capi::Moved<D>{&record, 1});
    if (report != nullptr) *report = capi::to_report(of.record.record);
  });
}

dsw_status dsw_body_get_motion_left(const dsw_scene* scene, dsw_body_id body, dsw_rigid_motion* motion) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    dsw::require(motion, "motion");
    const dsw::PlainMotion& left = of.record.record.left;
    std::copy_n(left.rotation, 4, motion->rotation);
    std::copy_n(left.centre, 3, motion->centre);
    std::copy_n(left.translation, 3, motion->translation);
  });
}

dsw_status dsw_body_get_contacts(const dsw_scene* scene, dsw_body_id body, const dsw_body_contact** contacts,
                                 size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    capi::hand_out(of.record.record.contacts, contacts, count, "contacts");
  });
}

dsw_status dsw_body_get_contact_partners(const dsw_scene* scene, dsw_body_id body, const dsw_contact_partner** partners,
                                         size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    capi::check_enabled(of.scene.features.contacts, "DSW_FEATURE_BODY_CONTACTS");
    capi::hand_out(of.record.record.partners, partners, count, "partners");
  });
}

dsw_status dsw_body_get_previous_contacts(const dsw_scene* scene, dsw_body_id body,
                                          const dsw_previous_contact** previous, size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    capi::hand_out(of.record.record.previous, previous, count, "previous");
  });
}

dsw_status dsw_body_get_edits(const dsw_scene* scene, dsw_body_id body, const dsw_body_edit** edits, size_t* count) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::hand_out(of.record.record.edits, edits, count, "edits"); });
}

dsw_status dsw_body_get_exits(const dsw_scene* scene, dsw_body_id body, const dsw_exit** exits, size_t* count) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::hand_out(of.record.record.exits, exits, count, "exits"); });
}
