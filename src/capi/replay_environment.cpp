// The calls that change an environment, made again.

#include "capi/replay.h"
#include "dartsweep/dartsweep.h"

namespace dsw::capi {
namespace {

dsw_status mark_volumes(dsw_replay& r, Arguments& a) {
  const auto volumes = a.get_items<dsw_volume_id>();
  const auto mark = a.get<dsw_mark>();
  return dsw_environment_mark_volumes(r.environment, volumes.items, volumes.count, mark, a.get<uint32_t>(), nullptr);
}

dsw_status mark_faces(dsw_replay& r, Arguments& a) {
  const auto faces = a.get_items<dsw_face_id>();
  return dsw_environment_mark_faces(r.environment, faces.items, faces.count, a.get<dsw_mark>());
}

dsw_status mark_edges(dsw_replay& r, Arguments& a) {
  const auto edges = a.get_items<dsw_edge_id>();
  return dsw_environment_mark_edges(r.environment, edges.items, edges.count, a.get<dsw_mark>());
}

dsw_status mark_vertices(dsw_replay& r, Arguments& a) {
  const auto vertices = a.get_items<dsw_vertex_id>();
  return dsw_environment_mark_vertices(r.environment, vertices.items, vertices.count, a.get<dsw_mark>());
}

dsw_status mark_region(dsw_replay& r, Arguments& a) {
  const auto region = a.get<int32_t>();
  const auto mark = a.get<dsw_mark>();
  return dsw_environment_mark_region(r.environment, region, mark, a.get<uint32_t>(), nullptr, nullptr);
}

dsw_status mark_between(dsw_replay& r, Arguments& a) {
  const auto one = a.get<int32_t>(), other = a.get<int32_t>();
  return dsw_environment_mark_between(r.environment, one, other, a.get<dsw_mark>(), nullptr);
}

dsw_status set_tag(dsw_replay& r, Arguments& a) {
  const auto volume = a.get<dsw_volume_id>();
  return dsw_environment_set_tag(r.environment, volume, a.get<uint32_t>());
}

dsw_status add_volumes(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_volumes_desc>();
  // More cells or integers than there are bytes are none of ours.
  if (d.cell_count >= kVertexMask || d.connectivity_count >= SIZE_MAX / 8)
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: new volumes");
  const size_t index_bytes = d.index_bytes == 0 ? 8 : d.index_bytes;
  d.vertices = a.get_items<dsw_vertex_id>(d.vertex_count);
  d.points = a.get_points(d.point_count);
  d.point_stride_bytes = 0;
  d.cell_types = a.get_items<uint8_t>(d.cell_count);
  d.offsets = a.get_items<uint8_t>((d.cell_count + 1) * index_bytes);
  d.connectivity = a.get_items<uint8_t>(d.connectivity_count * index_bytes);
  d.regions = a.get_items<int32_t>(d.cell_count);
  d.tags = a.get_items<uint32_t>(d.cell_count);
  d.sew_to = a.get_items<dsw_face_id>(d.sew_count);
  return dsw_environment_add_volumes(r.environment, &d, nullptr, nullptr);
}

dsw_status remove_volumes(dsw_replay& r, Arguments& a) {
  const auto volumes = a.get_items<dsw_volume_id>();
  return dsw_environment_remove_volumes(r.environment, volumes.items, volumes.count);
}

dsw_status sew_faces(dsw_replay& r, Arguments& a) {
  const auto one = a.get_items<dsw_face_id>();
  return dsw_environment_sew_faces(r.environment, one.items, a.get_items<dsw_face_id>(one.count), one.count);
}

dsw_status unsew_face(dsw_replay& r, Arguments& a) {
  return dsw_environment_unsew_face(r.environment, a.get<dsw_face_id>());
}

dsw_status merge_volumes(dsw_replay& r, Arguments& a) {
  return dsw_environment_merge_volumes(r.environment, a.get<dsw_face_id>(), nullptr);
}

dsw_status split_volume(dsw_replay& r, Arguments& a) {
  const auto volume = a.get<dsw_volume_id>();
  const auto loop = a.get_items<dsw_vertex_id>();
  return dsw_environment_split_volume(r.environment, volume, loop.items, loop.count, nullptr, nullptr);
}

dsw_status merge_faces(dsw_replay& r, Arguments& a) {
  return dsw_environment_merge_faces(r.environment, a.get<dsw_edge_id>(), nullptr);
}

dsw_status split_face(dsw_replay& r, Arguments& a) {
  const auto face = a.get<dsw_face_id>();
  const auto from = a.get<dsw_vertex_id>(), to = a.get<dsw_vertex_id>();
  return dsw_environment_split_face(r.environment, face, from, to, nullptr, nullptr);
}

dsw_status split_edge(dsw_replay& r, Arguments& a) {
  const auto edge = a.get<dsw_edge_id>();
  return dsw_environment_split_edge(r.environment, edge, a.get<double>(), nullptr, nullptr);
}

dsw_status merge_edges(dsw_replay& r, Arguments& a) {
  const auto edge = a.get<dsw_edge_id>();
  return dsw_environment_merge_edges(r.environment, edge, a.get<dsw_vertex_id>(), nullptr);
}

dsw_status collapse_edge(dsw_replay& r, Arguments& a) {
  const auto edge = a.get<dsw_edge_id>();
  return dsw_environment_collapse_edge(r.environment, edge, a.get<dsw_vertex_id>());
}

dsw_status cut(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_cut_desc>();
  d.points = a.get_points(size_t{d.rows} * d.columns);
  d.point_stride_bytes = 0;
  return dsw_environment_cut(r.environment, &d, nullptr);
}

dsw_status tear_faces(dsw_replay& r, Arguments& a) {
  const auto faces = a.get_items<dsw_face_id>();
  const double* const loads = a.get_items<double>(faces.count);
  return dsw_environment_tear_faces(r.environment, faces.items, loads, faces.count, a.get<double>(), nullptr);
}

dsw_status open(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_open_desc>();
  d.faces = a.get_items<dsw_cut_face>(d.face_count);
  return dsw_environment_open(r.environment, &d, nullptr);
}

dsw_status carve(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_carve_desc>();
  d.points = a.get_points(d.point_count);
  d.point_stride_bytes = 0;
  if (d.triangle_count >= kVertexMask) fail(DSW_STATUS_CORRUPT, "the recording is damaged: a surface");
  d.triangles = a.get_items<uint32_t>(a.dimension() * d.triangle_count);
  return dsw_environment_carve(r.environment, &d, nullptr);
}

dsw_status tie(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_tie_desc>();
  d.points = a.get_points(d.point_count);
  d.point_stride_bytes = 0;
  return dsw_environment_tie(r.environment, &d, nullptr);
}

dsw_status detach_piece(dsw_replay& r, Arguments& a) {
  const auto d = a.get_struct<dsw_detach_desc>();
  dsw_body_id body;
  return dsw_scene_detach(r.scene, &d, &body, nullptr);
}

dsw_status remesh(dsw_replay& r, Arguments& a) {
  auto d = a.get_struct<dsw_remesh_desc>();
  d.volumes = a.get_items<dsw_volume_id>(d.volume_count);
  d.next = a.get_points(d.point_count);
  return dsw_environment_remesh(r.environment, &d, nullptr);
}

/** Into the array that the environment does not read. */
dsw_status deform(dsw_replay& r, Arguments& a) {
  auto o = a.get_struct<dsw_deform_options>();
  return visit(*r.environment, [&](const auto& env) {
    constexpr size_t D = kDimension<decltype(env)>;
    const size_t count = env.map.vertex_count;
    Array<double>& next = r.points[env.points == r.points[0].data() ? 1 : 0];
    r.watch.offered = o.point_room;
    o.point_room = made_room(r, r.watch.offered);
    next.resize(D * std::max(count, o.point_room));
    std::copy_n(env.points, D * count, next.data());
    for (auto v = a.get<uint64_t>(); v != kNullArray; v = a.get<uint64_t>()) {
      if (v >= count) fail(DSW_STATUS_CORRUPT, "the recording is damaged: a vertex that moves");
      for (size_t k = 0; k < D; ++k) next[D * static_cast<size_t>(v) + k] = a.get<double>();
    }
    const dsw_status status = dsw_scene_deform(r.scene, next.data(), count, &o, nullptr);
    if (env.points == next.data()) r.watch.room = r.watch.offered;
    return status;
  });
}

}  // namespace

ReplayRow environment_row(Call call) noexcept {
  switch (call) {
    case Call::kMarkVolumes:
      return {"dsw_environment_mark_volumes", mark_volumes};
    case Call::kMarkFaces:
      return {"dsw_environment_mark_faces", mark_faces};
    case Call::kMarkEdges:
      return {"dsw_environment_mark_edges", mark_edges};
    case Call::kMarkVertices:
      return {"dsw_environment_mark_vertices", mark_vertices};
    case Call::kMarkRegion:
      return {"dsw_environment_mark_region", mark_region};
    case Call::kMarkBetween:
      return {"dsw_environment_mark_between", mark_between};
    case Call::kSetTag:
      return {"dsw_environment_set_tag", set_tag};
    case Call::kAddVolumes:
      return {"dsw_environment_add_volumes", add_volumes};
    case Call::kRemoveVolumes:
      return {"dsw_environment_remove_volumes", remove_volumes};
    case Call::kSewFaces:
      return {"dsw_environment_sew_faces", sew_faces};
    case Call::kUnsewFace:
      return {"dsw_environment_unsew_face", unsew_face};
    case Call::kMergeVolumes:
      return {"dsw_environment_merge_volumes", merge_volumes};
    case Call::kSplitVolume:
      return {"dsw_environment_split_volume", split_volume};
    case Call::kMergeFaces:
      return {"dsw_environment_merge_faces", merge_faces};
    case Call::kSplitFace:
      return {"dsw_environment_split_face", split_face};
    case Call::kSplitEdge:
      return {"dsw_environment_split_edge", split_edge};
    case Call::kMergeEdges:
      return {"dsw_environment_merge_edges", merge_edges};
    case Call::kCollapseEdge:
      return {"dsw_environment_collapse_edge", collapse_edge};
    case Call::kCut:
      return {"dsw_environment_cut", cut};
    case Call::kTearFaces:
      return {"dsw_environment_tear_faces", tear_faces};
    case Call::kOpen:
      return {"dsw_environment_open", open};
    case Call::kCarve:
      return {"dsw_environment_carve", carve};
    case Call::kTie:
      return {"dsw_environment_tie", tie};
    case Call::kDetach:
      return {"dsw_scene_detach", detach_piece};
    case Call::kRemesh:
      return {"dsw_environment_remesh", remesh};
    case Call::kDeform:
      return {"dsw_scene_deform", deform};
    default:
      return {nullptr, nullptr};
  }
}

}  // namespace dsw::capi
