#include "scene/change.h"

#include "contact/names.h"

namespace dsw {
namespace {

template <int D>
void name_cells(const Map<D>& map, const Array<Cell>* cells, Array<dsw_volume_id>& ids, Array<dsw_volume_id>& out) {
  if (cells == nullptr) return;
  for (const Cell c : *cells) ids.push_back(volume_id(map, c));
  out.swap(ids);
}

}  // namespace

uint64_t ChangeResults::memory_bytes() const noexcept {
  return array_bytes(volumes) + array_bytes(vertices) + array_bytes(faces) + array_bytes(whole) + array_bytes(carved) +
         array_bytes(unmended);
}

template <int D>
bool Site<D>::change(Edit<D>& edit, const Told& told, const Meanwhile* meanwhile) const {
  const Map<D>& map = env.map;
  ChangeResults next(env.memory);
  next.volumes.reserve(edit.most_changes());
  if (told.faces != nullptr) next.faces.reserve(told.faces->size());
  if (told.whole != nullptr) next.whole.reserve(told.whole->size());
  if (told.carved != nullptr) next.carved.reserve(told.carved->size());
  if (told.vertices != nullptr) {
    next.vertices.reserve(told.vertices->size());
    for (const NewVertex& v : *told.vertices) {  // what they come from may go
      const dsw_vertex_id ends[2] = {{v.a, map.vertex_generation(v.a)}, {v.b, map.vertex_generation(v.b)}};
      next.vertices.push_back({{v.vertex, 0}, {ends[0], ends[1]}, {1 - v.share, v.share}});
    }
  }
  if (scene == nullptr) {
    edit.apply();
    edit.finish();
  } else if (!carry_out_prepared(edit, *scene, meanwhile)) {
    results.volumes.clear();
    return false;
  }
  for (const VolumeChange& c : edit.changes()) {
    next.volumes.push_back({{c.before.index, c.before.generation}, {c.after.index, c.after.generation}});
  }
  results.volumes.swap(next.volumes);
  if (told.faces != nullptr) {
    for (const CutFace& f : *told.faces) next.faces.push_back({face_id(map, f.front), face_id(map, f.back)});
    results.faces.swap(next.faces);
  }
  if (told.vertices != nullptr) {
    for (dsw_cut_vertex& v : next.vertices) v.vertex.generation = map.vertex_generation(v.vertex.index);
    results.vertices.swap(next.vertices);
  }
  name_cells(map, told.whole, next.whole, results.whole);
  name_cells(map, told.carved, next.carved, results.carved);
  return true;
}

template struct Site<2>;
template struct Site<3>;

}  // namespace dsw
