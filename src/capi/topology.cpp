#include "dartsweep/topology.h"

#include "capi/change.h"
#include "environment/mesh_reader.h"
#include "topology/operations.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

template <int D>
void check_arrays(const dsw_volumes_desc& d) {
  if (d.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "desc->reserved is %u, must be 0", d.reserved);
  if (d.index_bytes != 0 && d.index_bytes != 4 && d.index_bytes != 8) {
    fail(DSW_STATUS_UNSUPPORTED, "desc->index_bytes is %u, must be 4 or 8", d.index_bytes);
  }
  if (d.volume_count == 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->volume_count is 0, must be at least 1");
  if (d.volume_count > dsw::kVertexMask || d.point_count > dsw::kVertexMask) {
    fail(DSW_STATUS_TOO_LARGE, "desc->volume_count is %zu and desc->point_count is %zu, must be below 2^28",
         d.volume_count, d.point_count);
  }
  dsw::require_array(d.connectivity, d.connectivity_count, capi::index_bytes(d), "desc->connectivity");
  const dsw::CellType type = dsw::cell_type<D>(d.uniform_cell_type);
  if (d.offsets == nullptr && (d.cell_types != nullptr || (type.known && type.vertex_count == 0))) {
    fail(DSW_STATUS_NULL_ARGUMENT, "desc->offsets is null, which needs one uniform type with a fixed number of points");
  }
}

}  // namespace

dsw_status dsw_environment_add_volumes(dsw_environment* environment, const dsw_volumes_desc* desc,
                                       dsw_volume_id* volumes, dsw_vertex_id* vertices) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    constexpr int D = std::decay_t<decltype(change)>::kDimension;
    const dsw_volumes_desc d = capi::read_required(desc, "desc");
    check_arrays<D>(d);
    const auto points = dsw::to_finite_points(D, d.points, d.point_count, d.point_stride_bytes, "desc->points");
    capi::Converted known(change.env, d.vertices, d.vertex_count, "desc->vertices");
    auto all = change.template array<uint32_t>(0);
    all.reserve(d.vertex_count + d.point_count);
    all.assign(known.begin(), known.end());
    capi::Converted faces(change.env, d.sew_to, d.sew_count, "desc->sew_to");
    const auto index_bytes = static_cast<uint32_t>(capi::index_bytes(d));
    auto& edit = change.begin(capi::row_of<dsw_environment_add_volumes>, &d);
    for (size_t i = 0; i < d.point_count; ++i) all.push_back(edit.add_vertex(points[i]));
    const dsw::NewCells input{all.data(),  all.size(),   d.cell_types,   d.uniform_cell_type,  d.volume_count,
                              index_bytes, d.offsets,    d.connectivity, d.connectivity_count, d.regions,
                              d.tags,      faces.data(), d.sew_count};
    add_cells(edit, input);
    change.carry_out();
    for (size_t i = 0; volumes != nullptr && i < d.volume_count; ++i) volumes[i] = change.volume(i);
    for (size_t i = 0; vertices != nullptr && i < d.point_count; ++i) {
      vertices[i] = capi::vertex_id(change.map(), all[d.vertex_count + i]);
    }
  });
}

dsw_status dsw_environment_sew_faces(dsw_environment* environment, const dsw_face_id* faces_a,
                                     const dsw_face_id* faces_b, size_t count) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    capi::Converted a(change.env, faces_a, count, "faces_a"), b(change.env, faces_b, count, "faces_b");
    auto pairs = change.template array<dsw::FacetPair>(count);
    for (size_t i = 0; i < count; ++i) pairs[i] = {a[i], b[i]};
    auto& edit = change.begin(capi::row_of<dsw_environment_sew_faces>, faces_a, faces_b, count);
    sew(edit, pairs.data(), count);
    change.carry_out();
  });
}

dsw_status dsw_environment_unsew_face(dsw_environment* environment, dsw_face_id face) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const dsw::HalfFacet h = capi::to_engine(change.map(), face, "face");
    unsew(change.begin(capi::row_of<dsw_environment_unsew_face>, face), h);
    change.carry_out();
  });
}

dsw_status dsw_environment_remove_volumes(dsw_environment* environment, const dsw_volume_id* volumes, size_t count) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    capi::Converted cells(change.env, volumes, count, "volumes");
    remove_cells(change.begin(capi::row_of<dsw_environment_remove_volumes>, volumes, count), cells.data(), count);
    change.carry_out();
  });
}

dsw_status dsw_environment_merge_volumes(dsw_environment* environment, dsw_face_id face, dsw_volume_id* volume) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const dsw::HalfFacet h = capi::to_engine(change.map(), face, "face");
    const size_t merged = merge_cells(change.begin(capi::row_of<dsw_environment_merge_volumes>, face), h);
    change.carry_out();
    if (volume != nullptr) *volume = change.volume(merged);
  });
}

dsw_status dsw_environment_split_volume(dsw_environment* environment, dsw_volume_id volume, const dsw_vertex_id* loop,
                                        size_t count, dsw_volume_id* volumes, dsw_face_id* face) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const dsw::Cell c = capi::to_engine(change.map(), volume, "volume");
    capi::Converted vertices(change.env, loop, count, "loop");
    auto& edit = change.begin(capi::row_of<dsw_environment_split_volume>, volume, loop, count);
    const dsw::SplitCell split = split_cell(edit, c, vertices.data(), count);
    change.carry_out();
    if (volumes != nullptr) {
      volumes[0] = change.volume(split.left);
      volumes[1] = change.volume(split.right);
    }
    if (face != nullptr) *face = change.face(split.left, split.left_facet);
  });
}

dsw_status dsw_environment_merge_faces(dsw_environment* environment, dsw_edge_id edge, dsw_face_id* face) {
  return capi::guarded_change_of_space(
      __func__, environment, "dsw_environment_merge_edges", nullptr, [&](auto& change) {
        const dsw::Dart d = capi::to_engine(change.map(), edge, "edge");
        const dsw::MergedFacet merged = merge_facets(change.begin(capi::row_of<dsw_environment_merge_faces>, edge), d);
        change.carry_out();
        if (face != nullptr) *face = change.face(merged.draft, merged.facet);
      });
}

dsw_status dsw_environment_split_face(dsw_environment* environment, dsw_face_id face, dsw_vertex_id a, dsw_vertex_id b,
                                      dsw_face_id* faces, dsw_edge_id* edge) {
  return capi::guarded_change_of_space(__func__, environment, "dsw_environment_split_edge", nullptr, [&](auto& change) {
    const dsw::HalfFacet h = capi::to_engine(change.map(), face, "face");
    const uint32_t from = capi::to_engine(change.map(), a, "a");
    const uint32_t to = capi::to_engine(change.map(), b, "b");
    const dsw::SplitFacet split =
        split_facet(change.begin(capi::row_of<dsw_environment_split_face>, face, a, b), h, from, to);
    change.carry_out();
    if (faces != nullptr) {
      faces[0] = change.face(split.draft, split.from_a);
      faces[1] = change.face(split.draft, split.from_b);
    }
    if (edge != nullptr) *edge = change.edge(split.draft, from, to);
  });
}

dsw_status dsw_environment_split_edge(dsw_environment* environment, dsw_edge_id edge, double share,
                                      dsw_vertex_id* vertex, dsw_edge_id* edges) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const auto& map = change.map();
    const dsw::Dart d = capi::to_engine(map, edge, "edge");
    capi::check_edge_parameter(share);
    const uint32_t ends[2] = {dart_vertex(map, d), dart_target(map, d)};
    const uint32_t middle = split_edge(change.begin(capi::row_of<dsw_environment_split_edge>, edge, share), d, share);
    change.carry_out();
    if (vertex != nullptr) *vertex = capi::vertex_id(map, middle);
    if (edges != nullptr) {
      edges[0] = change.edge(0, ends[0], middle);
      edges[1] = change.edge(0, middle, ends[1]);
    }
  });
}

dsw_status dsw_environment_merge_edges(dsw_environment* environment, dsw_edge_id edge, dsw_vertex_id vertex,
                                       dsw_edge_id* merged) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const dsw::Dart d = capi::to_engine(change.map(), edge, "edge");
    const uint32_t middle = capi::to_engine(change.map(), vertex, "vertex");
    const dsw::MergedEdge ends =
        merge_edges(change.begin(capi::row_of<dsw_environment_merge_edges>, edge, vertex), d, middle);
    change.carry_out();
    if (merged != nullptr) *merged = change.edge(0, ends.a, ends.b);
  });
}

dsw_status dsw_environment_collapse_edge(dsw_environment* environment, dsw_edge_id edge, dsw_vertex_id vertex) {
  return capi::guarded_change(__func__, environment, nullptr, [&](auto& change) {
    const dsw::Dart d = capi::to_engine(change.map(), edge, "edge");
    const uint32_t v = capi::to_engine(change.map(), vertex, "vertex");
    collapse_edge(change.begin(capi::row_of<dsw_environment_collapse_edge>, edge, vertex), d, v);
    change.carry_out();
  });
}

dsw_status dsw_environment_get_change(const dsw_environment* environment, dsw_change* change) {
  return capi::guard(__func__,
                     [&] { capi::give_struct(change, "change", capi::check_handle(environment).results.change()); });
}
