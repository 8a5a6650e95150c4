#include "scene/change.h"

#include "contact/names.h"

namespace dsw {
namespace {

template <int D>
void name_cells(const Map<D>& map, const Array<Cell>* cells, Array<dsw_volume_id>& ids) noexcept {
  for (size_t i = 0; cells != nullptr && i < cells->size(); ++i) ids.push_back(volume_id(map, (*cells)[i]));
}

}  // namespace

dsw_change ChangeResults::change() const noexcept {
  dsw_change all = numbers;
  all.struct_size = sizeof all;
  const auto give = [](const auto& from, auto*& items, size_t& count) {
    items = from.data();
    count = from.size();
  };
  give(volumes, all.volumes, all.volume_count);
  give(vertices, all.vertices, all.vertex_count);
  give(faces, all.faces, all.face_count);
  give(whole, all.whole, all.whole_count);
  give(carved, all.carved, all.carved_count);
  give(unrepaired, all.unrepaired, all.unrepaired_count);
  give(detached, all.detached, all.detached_count);
  give(body_vertices, all.body_vertices, all.body_vertex_count);
  give(body_faces, all.body_faces, all.body_face_count);
  return all;
}

uint64_t ChangeResults::memory_bytes() const noexcept {
  return array_bytes(volumes) + array_bytes(vertices) + array_bytes(body_vertices) + array_bytes(faces) +
         array_bytes(whole) + array_bytes(carved) + array_bytes(unrepaired) + array_bytes(detached) +
         array_bytes(body_faces);
}

template <int D>
bool Site<D>::change(Edit<D>& edit, const Told& told, const Meanwhile* meanwhile) const {
  const Map<D>& map = env.map;
  ChangeResults next(env.memory);
  next.numbers = told.numbers;
  next.volumes.reserve(edit.most_changes());
  if (told.faces != nullptr) next.faces.reserve(told.faces->size());
  if (told.whole != nullptr) next.whole.reserve(told.whole->size());
  if (told.carved != nullptr) next.carved.reserve(told.carved->size());
  if (told.vertices != nullptr) {
    next.vertices.reserve(told.vertices->size());
    KeyTable made(env.memory);
    const auto id_of = [&](uint32_t vertex) {  // of one that comes: not known yet
      return dsw_vertex_id{vertex, made.find(vertex) != KeyTable::kNone ? 0 : map.vertex_generation(vertex)};
    };
    for (const NewVertex& v : *told.vertices) {  // what they come from may go
      const dsw_vertex_id ends[2] = {id_of(v.a), id_of(v.b)};
      made.insert(v.vertex);
      next.vertices.push_back({{v.vertex, 0}, {ends[0], ends[1]}, {1 - v.share, v.share}});
    }
  }
  if (scene == nullptr) {
    edit.apply();
    edit.finish();
  } else if (!carry_out_prepared(edit, *scene, meanwhile)) {
    results = ChangeResults(env.memory);
    return false;
  }
  for (const VolumeChange& c : edit.changes()) {
    next.volumes.push_back({{c.before.index, c.before.generation}, {c.after.index, c.after.generation}});
  }
  for (size_t i = 0; told.faces != nullptr && i < told.faces->size(); ++i) {
    const CutFace& f = (*told.faces)[i];
    next.faces.push_back({face_id(map, f.front), face_id(map, f.back)});
  }
  for (dsw_vertex_origin& v : next.vertices) {
    for (dsw_vertex_id* id : {&v.vertex, &v.from[0], &v.from[1]}) {
      if (id->generation == 0) id->generation = map.vertex_generation(id->index);
    }
  }
  name_cells(map, told.whole, next.whole);
  name_cells(map, told.carved, next.carved);
  results = std::move(next);
  return true;
}

template struct Site<2>;
template struct Site<3>;

}  // namespace dsw
