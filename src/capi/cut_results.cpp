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

template <int D>
CutResults<D>::CutResults(Edit<D>& edit, const Array<CutFace>& faces, const Array<NewVertex>* vertices,
                          const Array<Cell>* whole)
    : edit_(edit),
      of_faces_(faces),
      of_vertices_(vertices),
      of_whole_(whole),
      changes_(Allocator<dsw_volume_change>(edit.environment().memory)),
      faces_(Allocator<dsw_cut_face>(edit.environment().memory)),
      vertices_(Allocator<dsw_cut_vertex>(edit.environment().memory)),
      whole_(Allocator<dsw_volume_id>(edit.environment().memory)) {
  const Map<D>& map = edit.environment().map;
  changes_.reserve(edit.most_changes());
  faces_.reserve(faces.size());
  if (whole != nullptr) whole_.reserve(whole->size());
  if (vertices == nullptr) return;
  for (const NewVertex& v : *vertices) {
    vertices_.push_back({{v.vertex, 0}, {vertex_id(map, v.a), vertex_id(map, v.b)}, {1 - v.share, v.share}});
  }
}

template <int D>
void CutResults<D>::give_to(dsw_environment& handle) noexcept {
  const Map<D>& map = edit_.environment().map;
  append_changes(edit_, changes_);
  handle.changes.swap(changes_);
  for (const CutFace& f : of_faces_) faces_.push_back({face_id(map, f.front), face_id(map, f.back)});
  handle.cut_faces.swap(faces_);
  if (of_vertices_ != nullptr) {
    for (dsw_cut_vertex& v : vertices_) v.vertex = vertex_id(map, v.vertex.index);
    handle.cut_vertices.swap(vertices_);
  }
  if (of_whole_ != nullptr) {
    for (const Cell c : *of_whole_) whole_.push_back(volume_id(map, c));
    handle.whole_volumes.swap(whole_);
  }
}

template class CutResults<3>;
template class CutResults<2>;

}  // namespace dsw::capi
