#include "capi/cut_results.h"

namespace dsw::capi {

double to_snap(double given) {
  if (!(given >= 0 && given <= 0.25)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->snap is %g, must be above 0 and at most 0.25, or 0", given);
  }
  return given == 0 ? CutSettings().snap : given;
}

dsw_cut_report to_report(const CutRecord& record, uint32_t visited) noexcept {
  return {record.distance,
          record.met,
          record.split,
          static_cast<uint32_t>(record.whole.size()),
          record.changed,
          visited,
          static_cast<uint32_t>(record.vertices.size()),
          static_cast<uint32_t>(record.faces.size()),
          0};
}

CutResults::CutResults(const Memory* memory, const CutRecord& record, const Edit& edit)
    : changes(Allocator<dsw_volume_change>(memory)),
      vertices(Allocator<dsw_cut_vertex>(memory)),
      faces(Allocator<dsw_cut_face>(memory)),
      whole(Allocator<dsw_volume_id>(memory)) {
  changes.reserve(edit.most_changes());
  vertices.reserve(record.vertices.size());
  faces.reserve(record.faces.size());
  whole.reserve(record.whole.size());
}

void CutResults::fill(const Map<3>& map, const CutRecord& record, Edit& edit) {
  for (const VolumeChange& c : edit.changes()) {
    changes.push_back({{c.before.index, c.before.generation}, {c.after.index, c.after.generation}});
  }
  for (const NewVertex& v : record.vertices) {
    vertices.push_back({vertex_id(map, v.vertex), {vertex_id(map, v.a), vertex_id(map, v.b)}, {1 - v.share, v.share}});
  }
  for (const CutFace& f : record.faces) faces.push_back({face_id(map, f.front), face_id(map, f.back)});
  for (const Cell c : record.whole) whole.push_back(volume_id(map, c));
}

void CutResults::move_faces_to(dsw_environment& handle) noexcept {
  handle.changes.swap(changes);
  handle.cut_faces.swap(faces);
}

void CutResults::move_to(dsw_environment& handle) noexcept {
  move_faces_to(handle);
  handle.cut_vertices.swap(vertices);
  handle.whole_volumes.swap(whole);
}

}  // namespace dsw::capi
