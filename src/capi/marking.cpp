#include "dartsweep/marking.h"

#include "capi/convert.h"
#include "capi/recorded.h"
#include "capi/scene_handle.h"
#include "scene/occupation.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

bool to_bool(dsw_mark mark) {
  if (mark != DSW_MARK_PASSABLE && mark != DSW_MARK_IMPASSABLE) {
    fail(DSW_STATUS_UNSUPPORTED, "mark is %d, must be DSW_MARK_PASSABLE or DSW_MARK_IMPASSABLE",
         static_cast<int>(mark));
  }
  return mark == DSW_MARK_IMPASSABLE;
}

/** Refuses a shared environment and begins a marking call: what the last one said about occupants is over. */
dsw_scene* begin_marking(dsw_environment& environment) {
  dsw_scene* const scene = capi::only_scene(environment);
  if (scene != nullptr) capi::visit(*scene, [](auto& s) { dsw::clear_occupants(&s); });
  return scene;
}

template <int D>
struct CellMarked {
  const dsw::Environment<D>& env;
  bool vertex(uint32_t v) const { return vertex_marked(env, v); }
  bool edge(dsw::Dart d) const { return edge_marked(env, dart_vertex(env.map, d), dart_target(env.map, d)); }
  bool face(dsw::HalfFacet h) const { return env.map.facet_marked(h); }
  bool volume(dsw::Cell c) const { return env.map.marked(c); }
};

template <int D>
struct CellImpassable {
  const dsw::Environment<D>& env;
  bool vertex(uint32_t v) const { return vertex_impassable(env, v); }
  bool edge(dsw::Dart d) const { return edge_impassable(env, d); }
  bool face(dsw::HalfFacet h) const { return is_impassable(env, h); }
  bool volume(dsw::Cell c) const { return is_closed(env, c); }
};

}  // namespace

dsw_status dsw_environment_mark_volumes(dsw_environment* environment, const dsw_volume_id* volumes, size_t count,
                                        dsw_mark mark, uint32_t flags, size_t* skipped) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const bool marked = to_bool(mark);
    dsw::check_flags(flags, DSW_MARK_SKIP_OCCUPIED, "flags");
    capi::Converted cells(env, volumes, count, "volumes");
    dsw_scene* const scene = begin_marking(*environment);
    const bool skip = (flags & DSW_MARK_SKIP_OCCUPIED) != 0;
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_volumes>, volumes, count, mark, flags);
    const size_t left_out = mark_cells(env, capi::engine_of(scene, env), cells.data(), count, marked, skip);
    call.done(uint64_t{left_out});
    if (skipped != nullptr) *skipped = left_out;
  });
}

dsw_status dsw_environment_mark_faces(dsw_environment* environment, const dsw_face_id* faces, size_t count,
                                      dsw_mark mark) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const bool marked = to_bool(mark);
    capi::Converted facets(env, faces, count, "faces");
    dsw_scene* const scene = begin_marking(*environment);
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_faces>, faces, count, mark);
    mark_facets(env, capi::engine_of(scene, env), facets.data(), count, marked);
    call.done();
  });
}

dsw_status dsw_environment_mark_edges(dsw_environment* environment, const dsw_edge_id* edges, size_t count,
                                      dsw_mark mark) {
  return capi::guard(__func__, [&] {
    dsw_environment& handle = capi::check_handle(environment);
    dsw::Environment<3>& env = capi::space(handle);
    const bool marked = to_bool(mark);
    capi::Converted darts(env, edges, count, "edges");
    dsw_scene* const scene = begin_marking(handle);
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_edges>, edges, count, mark);
    mark_edges(env, capi::engine_of(scene, env), darts.data(), count, marked);
    call.done();
  });
}

dsw_status dsw_environment_mark_vertices(dsw_environment* environment, const dsw_vertex_id* vertices, size_t count,
                                         dsw_mark mark) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const bool marked = to_bool(mark);
    capi::Converted all(env, vertices, count, "vertices");
    dsw_scene* const scene = begin_marking(*environment);
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_vertices>, vertices, count, mark);
    mark_vertices(env, capi::engine_of(scene, env), all.data(), count, marked);
    call.done();
  });
}

dsw_status dsw_environment_mark_region(dsw_environment* environment, int32_t region, dsw_mark mark, uint32_t flags,
                                       size_t* marked, size_t* skipped) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const bool impassable = to_bool(mark);
    dsw::check_flags(flags, DSW_MARK_SKIP_OCCUPIED, "flags");
    dsw_scene* const scene = begin_marking(*environment);
    const bool skip = (flags & DSW_MARK_SKIP_OCCUPIED) != 0;
    size_t left_out = 0;
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_region>, region, mark, flags);
    const size_t all = mark_region(env, capi::engine_of(scene, env), region, impassable, skip, &left_out);
    call.done(uint64_t{all}, uint64_t{left_out});
    if (marked != nullptr) *marked = all - left_out;
    if (skipped != nullptr) *skipped = left_out;
  });
}

dsw_status dsw_environment_mark_between(dsw_environment* environment, int32_t a, int32_t b, dsw_mark mark,
                                        size_t* marked) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const bool impassable = to_bool(mark);
    dsw_scene* const scene = begin_marking(*environment);
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_between>, a, b, mark);
    const size_t all = mark_between(env, capi::engine_of(scene, env), a, b, impassable);
    call.done(uint64_t{all});
    if (marked != nullptr) *marked = all;
  });
}

dsw_status dsw_environment_mark_exits(dsw_environment* environment, const dsw_face_id* faces, size_t count,
                                      uint32_t patch) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    capi::Converted facets(env, faces, count, "faces");
    for (size_t i = 0; i < count; ++i) {
      if (!env.map.opposite(facets[i]).valid()) continue;
      fail(DSW_STATUS_BAD_TOPOLOGY, "faces[%zu]: face %u of volume %u is not on the outer boundary", i, faces[i].local,
           faces[i].volume);
    }
    dsw_scene* const scene = begin_marking(*environment);
    capi::Recorded call(scene, capi::row_of<dsw_environment_mark_exits>, faces, count, patch);
    dsw::Array<dsw::Exit> exits(env.memory);
    exits.reserve(count);
    for (size_t i = 0; i < count; ++i) exits.push_back({faces[i].volume, faces[i].local, patch});
    env.exits.reserve(patch != 0 ? count : 0);
    env.exits.set(exits.data(), count);
    call.done();
  });
}

dsw_status dsw_environment_get_exit(const dsw_environment* environment, dsw_face_id face, uint32_t* patch) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    capi::give(patch, "patch", exit_patch(env, capi::to_engine(env.map, face, "face")));
  });
}

dsw_status dsw_environment_get_exit_faces(const dsw_environment* environment, dsw_face_id* faces, size_t capacity,
                                          size_t* count) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::Array<dsw::Exit>& all = env.exits.all();
    capi::check_capacity(all.size(), capacity, faces, count);
    for (size_t i = 0; i < all.size(); ++i) {
      const dsw::Cell c = env.map.cell(all[i].cell);
      faces[i] = {all[i].cell, env.map.generation(c), all[i].local};
    }
  });
}

dsw_status dsw_environment_is_marked(const dsw_environment* environment, dsw_cell cell, int* marked) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::give(marked, "marked", capi::visit_cell(env.map, cell, CellMarked<D>{env}) ? 1 : 0);
  });
}

dsw_status dsw_environment_is_impassable(const dsw_environment* environment, dsw_cell cell, int* impassable) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::give(impassable, "impassable", capi::visit_cell(env.map, cell, CellImpassable<D>{env}) ? 1 : 0);
  });
}

dsw_status dsw_environment_get_mark_count(const dsw_environment* environment, dsw_cell_kind kind, size_t* count) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw::require(count, "count");
    const bool is_there = kind >= DSW_CELL_VERTEX && kind <= DSW_CELL_VOLUME && (D == 3 || kind != DSW_CELL_EDGE);
    if (!is_there) capi::fail_kind("kind", kind, D);
    const uint64_t counts[] = {env.marked_vertices, env.marked_edges, env.marked_facets, env.marked_cells};  // by kind
    *count = static_cast<size_t>(counts[kind - DSW_CELL_VERTEX]);
  });
}
