#include "dartsweep/environment.h"

#include <algorithm>
#include <new>
#include <vector>

#include "capi/convert.h"
#include "capi/recorded.h"
#include "capi/scene_handle.h"
#include "conform/conform.h"
#include "environment/builder.h"
#include "environment/find_facets.h"
#include "environment/mesh_reader.h"
#include "split/split.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** Runs body(found), which returns the environment. Fills the caller's report, whatever ended the work. */
template <class Body>
void with_report(dsw_build_report* out, const Body& body) {
  dsw::BuildReport found;
  dsw_face_id touching[2] = {};
  const auto write = [&](dsw_status status, uint32_t part_count, uint32_t boundary_face_count) {
    if (out == nullptr) return;
    dsw_build_report r{};
    r.status = status;
    r.offender_count = found.offenders.count;
    std::copy_n(found.offenders.index, r.offender_count, r.offenders);
    r.reoriented_count = found.reoriented_count;
    r.unused_point_count = found.unused_point_count;
    r.convex_volume_count = found.convex_volume_count;
    r.part_count = part_count;
    r.boundary_face_count = boundary_face_count;
    r.reoriented_face_count = found.turned_face_count;
    r.merged_point_count = found.merged_point_count;
    r.changed_count = found.changed_count;
    std::copy_n(found.changed.index, found.changed.count, r.changed);
    r.touching_face_count = found.touching.count;
    r.touching_face = touching[0];
    r.touched_face = touching[1];
    r.split_count = found.split_count;
    r.added_point_count = found.added_point_count;
    capi::write_struct(out, r);
  };
  try {
    const auto& env = body(found);
    if (found.touching.count != 0) {
      touching[0] = dsw::face_id(env.map, canonical(env.map, found.touching.first));
      touching[1] = dsw::face_id(env.map, canonical(env.map, found.touching.other));
    }
    write(DSW_STATUS_OK, env.part_count, env.map.boundary_facet_count);
  } catch (const dsw::Error& error) {
    write(error.status(), 0, 0);
    throw;
  } catch (const std::bad_alloc&) {
    write(DSW_STATUS_OUT_OF_MEMORY, 0, 0);
    throw;
  }
}

/** An environment that is read, and read again as what its cells become. */
template <int D>
class Creation {
 public:
  /** Reads what `input`, which was checked, describes. */
  Creation(dsw_context* context, const dsw_environment_desc& input, dsw::BuildReport& found)
      : context_(context), input_(input), found_(found) {
    owner_ = capi::make_environment(context_, D);
    read_mesh(engine(), input_, found_, owner_->parallel);
  }
  dsw::Environment<D>& engine() { return std::get<dsw::Environment<D>>(owner_->engine); }
  capi::EnvironmentOwner& owner() { return owner_; }

  /** Splits facets that cover each other. */
  void conform() { dsw::conform(engine(), input_.merge_distance, found_); }
  /** Splits cells that are not valid, and parts of these that rounding spoils. */
  void split() {
    constexpr int kMostPasses = 4;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      dsw::SplitMesh<D> mesh(engine(), input_, found_);
      if (!mesh.has_changed()) return;
      read_anew(mesh.description(), mesh.parents());
      input_ = mesh.description();
      meshes_.push_back(std::move(mesh));
    }
  }
  void finish() { finish_mesh(engine(), input_, found_, owner_->parallel); }

 private:
  void read_anew(const dsw_environment_desc& made, const dsw::Array<uint32_t>& parents) {
    capi::EnvironmentOwner next = capi::make_environment(context_, D);
    auto& env = std::get<dsw::Environment<D>>(next->engine);
    read_mesh(env, made, found_, owner_->parallel);
    env.parents.assign(parents.begin(), parents.end());
    owner_ = std::move(next);
  }

  dsw_context* context_;
  dsw_environment_desc input_;
  dsw::BuildReport& found_;
  capi::EnvironmentOwner owner_;
  std::vector<dsw::SplitMesh<D>> meshes_;  // input_ points into them
};

/** Fails if parts lie on each other that could not be sewn. `is_known`: the report says which. */
template <int D>
void require_sewn(const dsw::Environment<D>& env, bool is_known, dsw::BuildReport& found) {
  const dsw::Touching touching = is_known ? found.touching : find_touching(env);
  if (touching.count == 0) return;
  const uint32_t a = env.map.index(env.map.cell_of(touching.first)), b = env.map.index(env.map.cell_of(touching.other));
  found.offenders = {2, {a, b}};
  fail(DSW_STATUS_NOT_CONFORMING, "faces of cells %u and %u lie on each other and can't be sewn", a, b);
}

/** Makes an environment; `report` may be null and is filled once the description was found sound. */
template <int D>
dsw_environment* build_environment(dsw_context* context, const dsw_environment_desc& desc, dsw_build_report* report) {
  const dsw_environment_desc d = dsw::check_description<D>(desc);
  capi::EnvironmentOwner owner;
  with_report(
      report, [&](dsw::BuildReport & found) -> const auto& {
        const bool splits = (d.flags & DSW_ENVIRONMENT_SPLIT) != 0, conforms = (d.flags & DSW_ENVIRONMENT_CONFORM) != 0;
        Creation<D> creation(context, d, found);
        if (splits) creation.split();
        if (conforms) creation.conform();
        if (splits && conforms) creation.split();
        creation.finish();
        owner = std::move(creation.owner());
        capi::choose_kernels(*owner);
        auto& env = std::get<dsw::Environment<D>>(owner->engine);
        if (conforms) require_sewn(env, (d.flags & DSW_ENVIRONMENT_FIND_TOUCHING) != 0, found);
        if (found.reoriented_count != 0) {
          capi::log_line(context, DSW_LOG_WARNING,
                         "dsw_environment_create: %u cells were inside out and have been mirrored",
                         found.reoriented_count);
        }
        capi::log_line(context, DSW_LOG_INFO,
                       "dsw_environment_create: %u volumes, %u faces (%u on the boundary), %u parts, %llu bytes",
                       env.map.cell_count, env.map.facet_count, env.map.boundary_facet_count, env.part_count,
                       static_cast<unsigned long long>(env.memory_bytes()));
        return env;
      });
  return owner.release();
}

void check_below(uint32_t given, uint32_t count, const char* name) {
  if (given >= count) fail(DSW_STATUS_OUT_OF_RANGE, "%s is %u, must be 0 .. %u", name, given, count - 1);
}

/** Facet `local` of a volume, or OUT_OF_RANGE. */
template <int D>
dsw::HalfFacet facet_of(const dsw::Map<D>& map, dsw::Cell c, uint32_t local) {
  check_below(local, map.facets_of(c), "local");
  return map.half_facet(c, local);
}

/** Calls visit(vertex) for the vertices of a cell in their documented order. */
template <int D, class Visit>
struct VertexVisitor {
  const dsw::Map<D>& map;
  const Visit& visit;

  void vertex(uint32_t v) const { visit(v); }
  void edge(dsw::Dart d) const {
    visit(dart_vertex(map, d));
    visit(dart_target(map, d));
  }
  void face(dsw::HalfFacet h) const {
    const dsw::Cell c = map.cell_of(h);
    const dsw::Shape shape = map.shape(c);
    dsw::for_each_facet_vertex<D>(shape, map.local_of(h, c), [&](uint32_t local) { visit(map.vertex(c, local)); });
  }
  void volume(dsw::Cell c) const {
    for (uint32_t i = 0, n = map.shape(c).vertex_count(); i < n; ++i) visit(map.vertex(c, i));
  }
};

template <int D, class Visit>
void for_each_vertex(const dsw::Map<D>& map, dsw_cell cell, const Visit& visit) {
  capi::visit_cell(map, cell, VertexVisitor<D, Visit>{map, visit});
}

}  // namespace

dsw_status dsw_environment_create(dsw_context* context, const dsw_environment_desc* desc, dsw_environment** environment,
                                  dsw_build_report* report) {
  return capi::guard(__func__, [&] {
    capi::check_context(context);
    dsw::require(desc, "desc");
    dsw::require(environment, "environment");
    if (report != nullptr) capi::check_size(report, "report");
    const dsw_environment_desc d = capi::read_struct(desc, "desc");
    if (d.dimension != 0 && d.dimension != 2 && d.dimension != 3) {
      fail(DSW_STATUS_OUT_OF_RANGE, "desc->dimension is %u, must be 2 or 3", d.dimension);
    }
    *environment = capi::with_dimension(
        d.dimension, [&](auto dimension) { return build_environment<decltype(dimension)::value>(context, d, report); });
  });
}

dsw_status dsw_environment_destroy(dsw_environment* environment) {
  return capi::guard(__func__, [&] {
    if (environment == nullptr) return;
    const uint32_t scenes = capi::scene_count(capi::check_handle(environment));
    if (scenes != 0) fail(DSW_STATUS_IN_USE, "environment is still used by %u scenes", scenes);
    capi::destroy_environment(environment);
  });
}

dsw_status dsw_environment_get_info(const dsw_environment* environment, dsw_environment_info* info) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_environment_info i{};
    i.dimension = D;
    i.vertex_count =
        env.map.has_changed() ? static_cast<uint32_t>(env.map.vertex_slots.alive_count()) : env.map.vertex_count;
    i.volume_count = env.map.cell_count;
    i.face_count = env.map.facet_count;
    i.boundary_face_count = env.map.boundary_facet_count;
    i.part_count = env.map.has_changed() ? count_parts(env) : env.part_count;
    i.scene_count = capi::scene_count(*environment);
    i.memory_bytes = capi::memory_bytes(*environment);
    for (int k = 0; k < D; ++k) {
      i.lower[k] = env.lower[k];
      i.upper[k] = env.upper[k];
    }
    i.volume_index_count = env.map.index_count();
    i.vertex_index_count = env.map.vertex_count;
    capi::give_struct(info, "info", i);
  });
}

dsw_status dsw_environment_check(const dsw_environment* environment, dsw_build_report* report) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    if (report != nullptr) capi::check_size(report, "report");
    with_report(
        report, [&](dsw::BuildReport & found) -> const auto& {
          prove(env, found);
          return env;
        });
  });
}

dsw_status dsw_environment_get_volume_id(const dsw_environment* environment, uint32_t index, dsw_volume_id* volume) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    check_below(index, map.index_count(), "index");
    if (!map.cell(index).valid()) fail(DSW_STATUS_NOT_FOUND, "volume %u has been removed", index);
    capi::give(volume, "volume", volume_id(map, map.cell(index)));
  });
}

dsw_status dsw_environment_get_vertex_id(const dsw_environment* environment, uint32_t index, dsw_vertex_id* vertex) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    check_below(index, map.vertex_count, "index");
    const dsw_vertex_id id = capi::vertex_id(map, index);
    if (!map.is_vertex_alive(id.index, id.generation)) fail(DSW_STATUS_NOT_FOUND, "vertex %u has been removed", index);
    capi::give(vertex, "vertex", id);
  });
}

dsw_status dsw_environment_get_vertex_position(const dsw_environment* environment, dsw_vertex_id vertex, double* xyz) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    dsw::require(xyz, "xyz");
    const double* const point = env.point(capi::to_engine(env.map, vertex, "vertex"));
    std::copy_n(point, env.kDimension, xyz);
  });
}

dsw_status dsw_environment_get_volume_counts(const dsw_environment* environment, dsw_volume_id volume,
                                             dsw_cell_type* type, uint32_t* vertices, uint32_t* edges,
                                             uint32_t* faces) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    const dsw::Cell c = capi::to_engine(map, volume, "volume");
    const dsw::Shape shape = map.shape(c);
    if (type != nullptr) *type = dsw::number_of(map.form(c), env.kDimension);
    if (vertices != nullptr) *vertices = shape.vertex_count();
    if (edges != nullptr) *edges = env.kDimension == 2 ? 0 : shape.edge_count();
    if (faces != nullptr) *faces = shape.facet_count();
  });
}

dsw_status dsw_environment_get_face_id(const dsw_environment* environment, dsw_volume_id volume, uint32_t local,
                                       dsw_face_id* face) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    const dsw::Cell c = capi::to_engine(map, volume, "volume");
    capi::give(face, "face", face_id(map, canonical(map, facet_of(map, c, local))));
  });
}

dsw_status dsw_environment_get_neighbour(const dsw_environment* environment, dsw_volume_id volume, uint32_t local,
                                         dsw_volume_id* neighbour, int* impassable) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    const dsw::Cell c = capi::to_engine(map, volume, "volume");
    const dsw::HalfFacet h = facet_of(map, c, local);
    const dsw::HalfFacet o = map.opposite(h);
    if (neighbour != nullptr) *neighbour = volume_id(map, o.valid() ? map.cell_of(o) : dsw::Cell{});
    if (impassable != nullptr) *impassable = is_impassable(env, h) ? 1 : 0;
  });
}

dsw_status dsw_environment_get_centre(const dsw_environment* environment, dsw_volume_id volume, double* xyz) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::Cell c = capi::to_engine(env.map, volume, "volume");
    dsw::require(xyz, "xyz");
    centre(env, c, xyz);
  });
}

dsw_status dsw_environment_get_edge_id(const dsw_environment* environment, dsw_volume_id volume, uint32_t local,
                                       dsw_edge_id* edge) {
  return capi::guard(__func__, [&] {
    const dsw::Map<3>& map = capi::space(capi::check_handle(environment)).map;
    const dsw::Cell c = capi::to_engine(map, volume, "volume");
    check_below(local, map.shape(c).edge_count(), "local");
    capi::give(edge, "edge", capi::edge_id(map, dart_of_edge(map, c, local)));
  });
}

dsw_status dsw_environment_copy_vertices(const dsw_environment* environment, dsw_cell cell, dsw_vertex_id* vertices,
                                         size_t capacity, size_t* count) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    dsw::require(count, "count");
    if (capacity != 0) dsw::require(vertices, "vertices");
    size_t needed = 0;
    for_each_vertex(map, cell, [&](uint32_t) { ++needed; });
    *count = needed;
    if (capacity == 0) return;
    if (capacity < needed) {
      fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity is %zu, must be 0 or at least %zu", capacity, needed);
    }
    for_each_vertex(map, cell, [&](uint32_t vertex) { *vertices++ = capi::vertex_id(map, vertex); });
  });
}

dsw_status dsw_environment_get_face_volumes(const dsw_environment* environment, dsw_face_id face,
                                            dsw_volume_id* near_side, dsw_volume_id* far_side) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    const dsw::HalfFacet h = capi::to_engine(map, face, "face"), o = map.opposite(h);
    if (near_side != nullptr) *near_side = volume_id(map, map.cell_of(h));
    if (far_side != nullptr) *far_side = volume_id(map, o.valid() ? map.cell_of(o) : dsw::Cell{});
  });
}

dsw_status dsw_environment_find_faces(const dsw_environment* environment, size_t count, const size_t* offsets,
                                      const uint32_t* indices, dsw_face_id* faces, size_t* missing) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const auto& map = env.map;
    size_t absent = 0;
    if (count != 0) {
      dsw::require_array(offsets, count, "offsets");
      dsw::require_array(faces, count, "faces");
      for (size_t i = 0; i < count; ++i) {
        if (offsets[i] > offsets[i + 1]) {
          fail(DSW_STATUS_WRONG_SIZE, "offsets[%zu] is %zu, must be at least offsets[%zu], which is %zu", i + 1,
               offsets[i + 1], i, offsets[i]);
        }
      }
      dsw::require_array(indices, offsets[count] - offsets[0], "indices");
      dsw::Array<dsw::HalfFacet> found(count, dsw::HalfFacet{}, env.memory);
      find_facets(env, count, offsets, indices, found.data(), &absent);
      for (size_t i = 0; i < count; ++i) {
        faces[i] = found[i].valid() ? face_id(map, canonical(map, found[i])) : dsw_face_id{0, 0, 0};
      }
    }
    if (missing != nullptr) *missing = absent;
  });
}

dsw_status dsw_environment_find_edges(const dsw_environment* environment, size_t count, const uint32_t* indices,
                                      dsw_edge_id* edges, size_t* missing) {
  return capi::guard(__func__, [&] {
    const dsw::Environment<3>& env = capi::space(capi::check_handle(environment));
    const dsw::Map<3>& map = env.map;
    size_t absent = 0;
    if (count != 0) {
      dsw::require_array(indices, count, 2 * sizeof *indices, "indices");
      dsw::require_array(edges, count, "edges");
      dsw::Array<dsw::Dart> found(count, dsw::Dart{}, env.memory);
      find_edges(env, count, indices, found.data(), &absent);
      for (size_t i = 0; i < count; ++i) {
        edges[i] = found[i].cell.valid() ? capi::edge_id(map, found[i]) : dsw_edge_id{0, 0, 0};
      }
    }
    if (missing != nullptr) *missing = absent;
  });
}

dsw_status dsw_environment_get_region(const dsw_environment* environment, dsw_volume_id volume, int32_t* region) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    capi::give(region, "region", env.region(capi::to_engine(env.map, volume, "volume")));
  });
}

dsw_status dsw_environment_get_parent(const dsw_environment* environment, dsw_volume_id volume, uint32_t* index) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const uint32_t parent = env.parent(capi::to_engine(env.map, volume, "volume"));
    if (parent == dsw::kNoCell) fail(DSW_STATUS_NOT_FOUND, "volume %u was added later", volume.index);
    capi::give(index, "index", parent);
  });
}

dsw_status dsw_environment_get_tag(const dsw_environment* environment, dsw_volume_id volume, uint32_t* tag) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    capi::give(tag, "tag", env.tag(capi::to_engine(env.map, volume, "volume")));
  });
}

dsw_status dsw_environment_set_tag(dsw_environment* environment, dsw_volume_id volume, uint32_t tag) {
  return capi::guarded_visit(__func__, environment, [&](auto& env) {
    const dsw::Cell c = capi::to_engine(env.map, volume, "volume");
    if (env.tags.empty()) {
      if (tag == 0) return;
      env.tags.resize(env.map.index_count(), 0u);
    }
    uint32_t& own = env.tags[env.map.index(c)];
    capi::for_each_scene(*environment, [&](dsw_scene& scene) {
      capi::Recorded call(&scene, capi::row_of<dsw_environment_set_tag>, volume, tag);
      own = tag;
      call.done();
    });
    own = tag;  // also without a scene
  });
}
