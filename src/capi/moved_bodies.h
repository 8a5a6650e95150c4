#pragma once
// Bodies that move, with their targets, and what has become of them.

#include "capi/body_access.h"
#include "dartsweep/move.h"

namespace dsw::capi {

/** Targets of the vertices that move are finite; those of others are not read. */
template <int D>
void check_targets(const Body<D>& body, PointArray targets, const MoveOrder& order, size_t first) {
  const size_t all = body.vertices.size(), count = order.vertices != nullptr ? order.count : all;
  const bool has_all = count == all && body.vertex_slots.alive_count() == all;
  if (has_all && find_non_finite({targets[first], targets.step}, all, D) == all) return;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t v = order.vertices != nullptr ? order.vertices[i] : static_cast<uint32_t>(i);
    if (body.has_vertex(v) && !is_finite<D>(targets[first + v])) {
      fail_non_finite(targets, first + v, D, {"targets", true});
    }
  }
}

inline void check_target_count(size_t given, size_t needed) {
  if (given != needed) fail(DSW_STATUS_WRONG_SIZE, "target_count is %zu, there are %zu vertex slots", given, needed);
}

/** The records of bodies that are distinct. */
template <int D>
Array<BodyRecord<D>*> check_bodies(Scene<D>& scene, const dsw_body_id* bodies, size_t count) {
  require_array(bodies, count, "bodies");
  Array<BodyRecord<D>*> records(scene.memory);
  Array<bool> seen(scene.bodies.size(), false, scene.memory);
  records.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    records.push_back(&check_body(scene, bodies[i], {"bodies", true}, i));
    if (seen[bodies[i].index]) fail(DSW_STATUS_DUPLICATE_ID, "bodies[%zu] occurs twice", i);
    seen[bodies[i].index] = true;
  }
  return records;
}

/** Targets of bodies, one after the other. */
template <int D>
PointArray check_all_targets(const Array<BodyRecord<D>*>& records, const double* targets, size_t count,
                             size_t stride_bytes) {
  size_t needed = 0;
  for (const BodyRecord<D>* each : records) needed += each->body.vertices.size();
  check_target_count(count, needed);
  const PointArray points = to_points(D, targets, count, stride_bytes, "targets");
  size_t first = 0;
  for (const BodyRecord<D>* each : records) {
    check_targets(each->body, points, {}, first);
    first += each->body.vertices.size();
  }
  return points;
}

inline dsw_move_report to_report(const MoveRecord& record) noexcept {
  return {record.fraction,
          record.moved,
          record.stopped,
          static_cast<uint32_t>(record.contacts.size()),
          static_cast<uint32_t>(record.edits.size()),
          record.sweeps.swept,
          record.sweeps.skipped,
          record.limited,
          0};
}

/** What has become of bodies. */
template <int D>
struct Moved {
  BodyRecord<D>* const* records;
  size_t count;
};

template <int D, class Use>
void for_each_part(const Moved<D>& of, const Use& use) {
  for (size_t i = 0; i < of.count; ++i) {
    const dsw_move_report report = to_report(of.records[i]->record);
    use(&report, sizeof report);
    for_each_part(of.records[i]->body, use);
  }
}

}  // namespace dsw::capi
