// The calls that change an environment, with random arguments that do at times.
#include <algorithm>
#include <cmath>
#include <set>

#include "random_edits.h"
#include "topology/repair.h"

namespace dsw::oracle {

template <int D>
dsw_status RandomEdits<D>::sew() {
  if (unsewn_.empty() || rng_.chance(0.1)) {
    const dsw_face_id a = some_face(), b = some_face();
    return dsw_environment_sew_faces(place_.get(), &a, &b, 1);
  }
  const size_t i = rng_.below(unsewn_.size());
  const auto pair = unsewn_[i];
  const dsw_status status = dsw_environment_sew_faces(place_.get(), &pair[0], &pair[1], 1);
  if (status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_OUT_OF_MEMORY)
    unsewn_.erase(unsewn_.begin() + static_cast<ptrdiff_t>(i));
  return status;
}

template <int D>
dsw_status RandomEdits<D>::remove() {
  const Map<D>& map = env().map;
  const dsw::Cell c = some_cell();
  const Shape shape = map.shape(c);
  Gone gone;
  gone.faces.resize(shape.facet_count());
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { gone.faces[f].push_back(local); });
  }
  for (uint32_t k = 0; k < shape.vertex_count(); ++k) {
    const uint32_t v = map.vertex(c, k);
    gone.vertices.push_back({v, map.vertex_generation(v)});
    gone.positions.emplace_back();
    std::copy_n(env().point(v), D, gone.positions.back().begin());
  }
  may_change_ = true;
  const dsw_volume_id id = volume_id(map, c);
  const dsw_status status = dsw_environment_remove_volumes(place_.get(), &id, 1);
  if (status == DSW_STATUS_OK) choices_.gone.push_back(std::move(gone));
  return status;
}

/// Puts a volume back as a polyhedron or polygon, on the vertices that are left, sewn to all that fits.
template <int D>
dsw_status RandomEdits<D>::add() {
  if (choices_.gone.empty()) return DSW_STATUS_STALE_ID;
  const Gone gone = choices_.gone.back();
  const Map<D>& map = env().map;
  std::vector<dsw_vertex_id> vertices;
  std::vector<double> points;
  std::vector<int64_t> index(gone.vertices.size(), -1), stream;
  const auto alive = [&](const dsw_vertex_id& v) {
    return map.is_vertex_alive(v.index, v.generation) &&
           std::equal(env().point(v.index), env().point(v.index) + D,
                      gone.positions[static_cast<size_t>(&v - gone.vertices.data())].begin());
  };
  for (size_t k = 0; k < index.size(); ++k) {
    if (!alive(gone.vertices[k])) continue;
    index[k] = static_cast<int64_t>(vertices.size());
    vertices.push_back(gone.vertices[k]);
  }
  for (size_t k = 0; k < index.size(); ++k) {
    if (index[k] >= 0) continue;
    index[k] = static_cast<int64_t>(vertices.size() + points.size() / D);
    points.insert(points.end(), gone.positions[k].begin(), gone.positions[k].end());
  }
  std::set<std::vector<uint32_t>> wanted;
  if (D == 3) stream.push_back(static_cast<int64_t>(gone.faces.size()));
  for (const auto& face : gone.faces) {
    if (D == 3) stream.push_back(static_cast<int64_t>(face.size()));
    std::vector<uint32_t> sorted;
    for (const size_t k : face) {
      if (D == 3 || sorted.empty()) stream.push_back(index[k]);  // a polygon is its corners
      sorted.push_back(gone.vertices[k].index);
    }
    std::sort(sorted.begin(), sorted.end());
    wanted.insert(sorted);
  }
  std::vector<dsw_face_id> sew_to;
  for_each_cell(map, [&](dsw::Cell c) {
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (map.opposite(h).valid()) continue;
      const Shape shape = map.shape(c);
      std::vector<uint32_t> sorted;
      for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { sorted.push_back(map.vertex(c, local)); });
      std::sort(sorted.begin(), sorted.end());
      if (wanted.erase(sorted) != 0) sew_to.push_back(face_id(map, h));
    }
  });
  const int64_t offsets[2] = {0, static_cast<int64_t>(stream.size())};
  const uint8_t type = D == 3 ? DSW_CELL_TYPE_POLYHEDRON : DSW_CELL_TYPE_POLYGON;
  dsw_volumes_desc desc = defaults(dsw_volumes_desc_init);
  desc.vertices = vertices.data();
  desc.vertex_count = vertices.size();
  desc.points = points.data();
  desc.point_count = points.size() / D;
  desc.cell_types = &type;
  desc.volume_count = 1;
  desc.offsets = offsets;
  desc.connectivity = stream.data();
  desc.connectivity_count = stream.size();
  desc.sew_to = sew_to.data();
  desc.sew_count = sew_to.size();
  may_change_ = true;
  const dsw_status status = dsw_environment_add_volumes(place_.get(), &desc, nullptr, nullptr);
  if (status != DSW_STATUS_OUT_OF_MEMORY) choices_.gone.pop_back();
  return status;
}

/// Between two corners.
template <>
dsw_status RandomEdits<2>::split_volume() {
  const Map<2>& map = env().map;
  const dsw::Cell c = some_cell();
  dsw_vertex_id ends[2];
  for (dsw_vertex_id& end : ends) {
    const uint32_t v = map.vertex(c, rng_.below(map.vertices_of(c)));
    end = {v, map.vertex_generation(v)};
  }
  return dsw_environment_split_volume(place_.get(), volume_id(map, c), ends, 2, nullptr, nullptr);
}

/// Along the boundary of some faces that hang together, when that is one loop.
template <>
dsw_status RandomEdits<3>::split_volume() {
  const Map<3>& map = env().map;
  for (;;) {
    const dsw::Cell c = some_cell();
    const Shape shape = map.shape(c);
    std::set<uint32_t> faces{rng_.below(shape.facet_count())};
    const uint32_t wanted = 1 + rng_.below(shape.facet_count() - 1);
    for (int tries = 0; faces.size() < wanted && tries < 50; ++tries) {
      const uint32_t d = rng_.below(shape.dart_count());
      if (faces.count(shape.dart_facet(d)) != 0) faces.insert(shape.dart_facet(shape.dart_beta2(d)));
    }
    std::map<uint32_t, uint32_t> next;
    size_t darts = 0;
    for (const uint32_t f : faces) {
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        if (faces.count(shape.dart_facet(shape.dart_beta2(d))) != 0) continue;
        next[map.vertex(c, shape.dart_vertex(d))] = map.vertex(c, shape.dart_vertex(shape.beta1(d)));
        ++darts;
      }
    }
    if (next.size() != darts || next.empty()) continue;
    std::vector<dsw_vertex_id> loop;
    for (uint32_t v = next.begin()->first; loop.size() <= darts;) {
      loop.push_back({v, map.vertex_generation(v)});
      v = next[v];
      if (v == next.begin()->first) break;
    }
    if (loop.size() != darts) continue;
    return dsw_environment_split_volume(place_.get(), volume_id(map, c), loop.data(), loop.size(), nullptr, nullptr);
  }
}

template <>
dsw_status RandomEdits<3>::split_face() {
  const Map<3>& map = env().map;
  dsw_face_id face = some_face();
  for (int tries = 0; tries < 30 && map.shape(map.cell(face.volume)).facet_size(face.local) == 3; ++tries)
    face = some_face();
  std::vector<dsw_vertex_id> vertices(100);
  size_t count = 0;
  if (dsw_environment_copy_vertices(place_.get(), cell_of(face), vertices.data(), vertices.size(), &count) != 0) {
    return DSW_STATUS_BUFFER_TOO_SMALL;
  }
  const dsw::Cell c = map.cell(face.volume);
  may_change_ = !map.opposite(map.half_facet(c, face.local)).valid();
  return dsw_environment_split_face(place_.get(), face, vertices[rng_.below(count)], vertices[rng_.below(count)],
                                    nullptr, nullptr);
}

/// For a deformation that some vertices of a cell will not come through.
template <>
dsw_status RandomEdits<3>::remesh() {
  const Map<3>& map = env().map;
  std::vector<double> next(env().points, env().points + 3 * size_t{map.vertex_count});
  const dsw::Cell c = some_cell();
  const double reach = rng_.range(0.1, 0.8) * place_.size();
  for (uint32_t k = 0; k < map.vertices_of(c); ++k) {
    const bool moves = rng_.chance(0.4);
    for (size_t axis = 0; axis < 3; ++axis) {
      const double by = rng_.range(-reach, reach);
      if (moves) next[3 * size_t{map.vertex(c, k)} + axis] += by;
    }
  }
  dsw_remesh_desc desc = defaults(dsw_remesh_desc_init);
  desc.next = next.data();
  desc.point_count = map.vertex_count;
  desc.radius = 1 + rng_.below(2);
  dsw_change report = empty_change();
  const dsw_status status = dsw_environment_remesh(place_.get(), &desc, &report);
  if (status != DSW_STATUS_OK) return status;
  if (report.volumes_removed == 0) return DSW_STATUS_NOT_FOUND;
  const dsw_volume_change* changes = change_of(place_.get()).volumes;
  const size_t count = change_of(place_.get()).volume_count;
  for (size_t i = 0; i < count; ++i) {
    if (changes[i].after.generation == 0) continue;
    if (!is_valid_with(dsw::capi::space(*place_.get()), next.data(), map.cell(changes[i].after.index)))
      return DSW_STATUS_INTERNAL;
  }
  return report.volumes_added <= report.volumes_removed ? DSW_STATUS_OK : DSW_STATUS_INTERNAL;
}

template <int D>
dsw_status RandomEdits<D>::call(Operation operation) {
  dsw_environment* const environment = place_.get();
  const Map<D>& map = env().map;
  may_change_ = false;
  switch (operation) {
    case Operation::kSew:
      return sew();
    case Operation::kUnsew: {
      const dsw_face_id face = some_face();
      const HalfFacet h = map.half_facet(map.cell(face.volume), face.local), o = map.opposite(h);
      const dsw_status status = dsw_environment_unsew_face(environment, face);
      if (status == DSW_STATUS_OK) unsewn_.push_back({face_id(map, h), face_id(map, o)});
      return status;
    }
    case Operation::kRemove:
      return remove();
    case Operation::kAdd:
      return add();
    case Operation::kMergeVolumes:
      return dsw_environment_merge_volumes(environment, some_face(), nullptr);
    case Operation::kSplitVolume:
      return split_volume();
    case Operation::kSplitEdge: {
      const double share = rng_.chance(0.5) ? 0.5 : rng_.range(0.1, 0.9);
      const dsw_edge_id edge = some_edge();
      if (D == 2) may_change_ = !map.opposite(map.half_facet(map.cell(edge.volume), edge.local)).valid();
      return dsw_environment_split_edge(environment, edge, share, nullptr, nullptr);
    }
    case Operation::kMergeEdges: {
      // A vertex with two edges, if one is found soon.
      dsw_edge_id edge = some_edge();
      dsw_vertex_id vertex = vertex_of(edge);
      for (int tries = 0; tries < 200 && map.vertex_uses.size() > vertex.index; ++tries) {
        if (D == 2 && map.vertex_uses[vertex.index] <= 2) break;
        const dsw::Cell c = map.cell(edge.volume);
        const Shape shape = map.shape(c);
        uint32_t darts = 0;
        for (uint32_t d = 0; d < shape.dart_count(); ++d) {
          darts += map.vertex(c, shape.dart_vertex(d)) == vertex.index ? 1u : 0u;
        }
        if (darts == 2) break;
        edge = some_edge();
        vertex = vertex_of(edge);
      }
      may_change_ = true;
      return dsw_environment_merge_edges(environment, edge, vertex, nullptr);
    }
    case Operation::kCollapse: {
      const dsw_edge_id edge = some_edge();
      return dsw_environment_collapse_edge(environment, edge, vertex_of(edge));
    }
    default:
      break;
  }
  if constexpr (D == 3) return call_in_space(operation);
  return DSW_STATUS_INTERNAL;
}

template <>
dsw_status RandomEdits<3>::call_in_space(Operation operation) {
  switch (operation) {
    case Operation::kMergeFaces:
      return dsw_environment_merge_faces(place_.get(), some_edge(), nullptr);
    case Operation::kSplitFace:
      return split_face();
    case Operation::kCut:
      return cut();
    case Operation::kCarve:
      return carve();
    case Operation::kTie:
      return tie();
    case Operation::kOpen:
      return open();
    case Operation::kDetach:
      return detach();
    default:
      return remesh();
  }
}

template dsw_status RandomEdits<3>::call(Operation operation);
template dsw_status RandomEdits<2>::call(Operation operation);

}  // namespace dsw::oracle
