// Cuts of bodies: the last functions of surgery.h.

#include "capi/moved_bodies.h"
#include "capi/read_blade.h"
#include "capi/recorded.h"
#include "scene/body_cuts.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** Distinct bodies; with none all of a scene. */
template <int D>
dsw::Array<dsw::BodyRecord<D>*> to_records(dsw::Scene<D>& scene, const dsw_body_id* bodies, size_t count) {
  if (bodies != nullptr || count != 0) return capi::check_bodies<D>(scene, bodies, count);
  dsw::Array<dsw::BodyRecord<D>*> all(scene.memory);
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    if (scene.body_slots.alive(slot, scene.body_slots.generation(slot))) all.push_back(&scene.bodies[slot]);
  }
  return all;
}

}  // namespace

dsw_status dsw_scene_cut_bodies(dsw_scene* scene, const dsw_cut_desc* desc, const dsw_body_id* bodies, size_t count,
                                size_t* cut_count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw_cut_desc d = capi::read_required(desc, "desc", 0);
    if (d.start.index != 0 || d.start.generation != 0 || d.snap != 0) {
      fail(DSW_STATUS_UNSUPPORTED, "desc->start and desc->snap must be 0: bodies are cut where the blade crosses them");
    }
    const auto blade = dsw::Blade<D>::of_grid(s.memory, capi::read_blade<D>(d), d.rows, d.columns);
    const dsw::Array<dsw::BodyRecord<D>*> records = to_records(s, bodies, count);
    capi::Recorded call(scene, capi::row_of<dsw_scene_cut_bodies>, &d, bodies, count);
    cut_bodies(s, records.data(), records.size(), blade);
    call.done(capi::Items<dsw_body_cut>{s.body_cuts.data(), s.body_cuts.size()});
    if (cut_count != nullptr) *cut_count = s.body_cuts.size();
  });
}

dsw_status dsw_scene_get_body_cuts(const dsw_scene* scene, const dsw_body_cut** cuts, size_t* count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) { capi::hand_out(s.body_cuts, cuts, count, "cuts"); });
}
