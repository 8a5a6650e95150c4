#include "capi/environment_build.h"

#include <algorithm>
#include <new>
#include <optional>

#include "capi/convert.h"
#include "environment/boundary_check.h"
#include "environment/builder.h"
#include "environment/mesh_reader.h"
#include "environment/validity.h"
#include "map/integrity.h"

namespace dsw::capi {
namespace {

constexpr size_t kMostPoints = kVertexMask;

template <int D>
void check_cells(const dsw_environment_desc& d) {
  if (d.volume_count == 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->volume_count is 0, must be at least 1");
  if (d.volume_count > kMostPoints) {
    fail(DSW_STATUS_TOO_LARGE, "desc->volume_count is %zu, must be at most %zu", d.volume_count, kMostPoints);
  }
  if (d.index_bytes != 0 && d.index_bytes != 4 && d.index_bytes != 8) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->index_bytes is %u, must be 0, 4 or 8", d.index_bytes);
  }
  if (d.cell_types == nullptr) {
    if (cell_type<D>(d.uniform_cell_type).vertex_count == 0) {
      fail(DSW_STATUS_BAD_CELL_TYPE, "desc->uniform_cell_type is %u, must be %s without desc->cell_types",
           d.uniform_cell_type, D == 2 ? "5 or 9" : "10, 12, 13 or 14");
    }
  } else if (d.offsets == nullptr) {
    fail(DSW_STATUS_NULL_ARGUMENT, "desc->offsets is null, which needs a uniform cell type");
  }
  require_array(d.connectivity, d.connectivity_count, "desc->connectivity");
  require_array(d.faces, d.faces_count, "desc->faces");
  if ((d.faces == nullptr) != (d.face_locations == nullptr)) {
    fail(DSW_STATUS_WRONG_SIZE, "desc->faces and desc->face_locations must be set both or none");
  }
}

template <int D>
void check_points(const dsw_environment_desc& d) {
  if (d.point_count == 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->point_count is 0, must be at least 1");
  if (d.point_count > kMostPoints) {
    fail(DSW_STATUS_TOO_LARGE, "desc->point_count is %zu, must be at most %zu", d.point_count, kMostPoints);
  }
  to_points<D>(d.points, d.point_count, d.point_stride_bytes, "desc->points");
  if ((d.flags & DSW_ENVIRONMENT_BORROW_POINTS) != 0 && d.point_stride_bytes > D * sizeof(double)) {
    fail(DSW_STATUS_WRONG_SIZE, "desc->point_stride_bytes is %zu, must be 0 or %zu for borrowed points",
         d.point_stride_bytes, D * sizeof(double));
  }
}

bool is_planar(const dsw_environment_desc& d) {
  if (d.dimension != 0 && d.dimension != 2 && d.dimension != 3) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->dimension is %u, must be 2 or 3", d.dimension);
  }
  return d.dimension == 2;
}

template <int D>
MeshInput read_input(const dsw_environment_desc& d) {
  check_flags(d.flags,
              DSW_ENVIRONMENT_BORROW_POINTS | DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_LOCATE_TREE |
                  DSW_ENVIRONMENT_CHECK_BOUNDARY | DSW_ENVIRONMENT_NO_LOCATE_TREE,
              "desc->flags");
  if (d.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "desc->reserved is %u, must be 0", d.reserved);
  check_points<D>(d);
  check_cells<D>(d);
  MeshInput input;
  input.points = d.points;
  input.point_count = d.point_count;
  input.point_stride_bytes = d.point_stride_bytes == 0 ? D * sizeof(double) : d.point_stride_bytes;
  input.borrow_points = (d.flags & DSW_ENVIRONMENT_BORROW_POINTS) != 0;
  input.reorient = (d.flags & DSW_ENVIRONMENT_REORIENT) != 0;
  input.cell_types = d.cell_types;
  input.uniform_cell_type = d.uniform_cell_type;
  input.cell_count = d.volume_count;
  input.index_bytes = d.index_bytes == 0 ? 8 : d.index_bytes;
  input.offsets = d.offsets;
  input.connectivity = d.connectivity;
  input.connectivity_count = d.connectivity_count;
  input.faces = d.faces;
  input.faces_count = d.faces_count;
  input.face_locations = d.face_locations;
  input.regions = d.regions;
  input.tags = d.tags;
  return input;
}

TreeUse tree_use(uint32_t flags) {
  if ((flags & DSW_ENVIRONMENT_NO_LOCATE_TREE) != 0) return TreeUse::kLeftOut;
  return (flags & DSW_ENVIRONMENT_LOCATE_TREE) != 0 ? TreeUse::kAtOnce : TreeUse::kAtNeed;
}

/** Fills the caller's report, whatever ended the work. */
class ReportWriter {
 public:
  explicit ReportWriter(dsw_build_report* out) : out_(out) {}

  /** Runs `body(report)`, which returns the environment; its failure goes into the report and on to the caller. */
  template <class Body>
  void run(Body body) {
    try {
      const auto& env = body(report_);
      write(DSW_STATUS_OK, env.part_count, env.map.boundary_facet_count);
    } catch (const Error& error) {
      write(error.status(), 0, 0);
      throw;
    } catch (const std::bad_alloc&) {
      write(DSW_STATUS_OUT_OF_MEMORY, 0, 0);
      throw;
    }
  }

 private:
  void write(dsw_status status, uint32_t part_count, uint32_t boundary_face_count) {
    if (out_ == nullptr) return;
    dsw_build_report r{};
    r.status = status;
    r.offender_count = report_.offenders.count;
    std::copy(report_.offenders.index, report_.offenders.index + r.offender_count, r.offenders);
    r.reoriented_count = report_.reoriented_count;
    r.unused_point_count = report_.unused_point_count;
    r.convex_volume_count = report_.convex_volume_count;
    r.part_count = part_count;
    r.boundary_face_count = boundary_face_count;
    write_struct(out_, r);
  }

  dsw_build_report* out_;
  BuildReport report_;
};

template <int D>
void check_boundary(const Environment<D>& env, Offenders& offenders) {
  if (!boundary_crosses(env, &offenders)) return;
  fail(DSW_STATUS_BOUNDARY_CROSSES, "the outer boundary passes through itself; first cell %u",
       offenders.count == 0 ? 0 : offenders.index[0]);
}

/** As build_environment. */
template <int D>
dsw_environment* build_in(dsw_context* context, const dsw_environment_desc& desc, dsw_build_report* report) {
  const MeshInput input = read_input<D>(desc);
  std::optional<EnvironmentOwner> owner;
  ReportWriter writer(report);
  writer.run([&](BuildReport& found) -> const Environment<D>& {
    owner.emplace(context, D);
    Environment<D>& env = std::get<Environment<D>>((*owner)->engine);
    build(env, input, found);
    env.index.set_use(tree_use(desc.flags));
    if (env.index.use() == TreeUse::kAtOnce) env.index.build(env);
    if ((desc.flags & DSW_ENVIRONMENT_CHECK_BOUNDARY) != 0) check_boundary(env, found.offenders);
    if (found.reoriented_count != 0) {
      log_line(context, DSW_LOG_WARNING, "dsw_environment_create: %u cells were inside out and have been mirrored",
               found.reoriented_count);
    }
    log_line(context, DSW_LOG_INFO,
             "dsw_environment_create: %u volumes, %u faces (%u on the boundary), %u parts, %llu bytes",
             env.map.cell_count, env.map.facet_count, env.map.boundary_facet_count, env.part_count,
             static_cast<unsigned long long>(env.memory_bytes()));
    return env;
  });
  return owner->take();
}

/** As check_environment. */
template <int D>
void check(const Environment<D>& env, dsw_build_report* report) {
  ReportWriter(report).run([&](BuildReport& found) -> const Environment<D>& {
    const Map<D>& map = env.map;
    if (const char* const broken = check_integrity(map)) fail(DSW_STATUS_INTERNAL, "the map is broken: %s", broken);
    for_each_cell(map, [&](Cell c) {
      const CellState state = check_cell(env, c);
      if (state == CellState::kInverted || state == CellState::kInvalid) found.offenders.add(map.index(c));
      if (state == CellState::kValidConvex) ++found.convex_volume_count;
    });
    if (found.offenders.count != 0) {
      fail(DSW_STATUS_INVALID_CELL, "cell %u is not valid", found.offenders.index[0]);
    }
    check_boundary(env, found.offenders);
    return env;
  });
}

}  // namespace

dsw_environment* build_environment(dsw_context* context, const dsw_environment_desc& desc, dsw_build_report* report) {
  return is_planar(desc) ? build_in<2>(context, desc, report) : build_in<3>(context, desc, report);
}

uint64_t memory_bytes(const dsw_environment& environment) {
  const uint64_t of_engine = visit(environment, [](const auto& env) { return env.memory_bytes() - sizeof env; });
  return of_engine + environment.results.memory_bytes() + sizeof environment;
}

void check_environment(const dsw_environment& environment, dsw_build_report* report) {
  visit(environment, [&](const auto& env) { check(env, report); });
}

}  // namespace dsw::capi
