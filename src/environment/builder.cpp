#include "environment/builder.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "base/error.h"
#include "base/points.h"
#include "base/sort.h"
#include "environment/boundary_check.h"
#include "environment/facet_matcher.h"
#include "environment/mesh_reader.h"
#include "environment/recut.h"
#include "environment/replaced_cells.h"
#include "environment/validity.h"
#include "map/integrity.h"

namespace dsw {
namespace {

/** Whether a cell is turned inside out; of cells that will be split `by_volume`, as their mean need not see them. */
template <int D>
bool is_inverted(const Environment<D>& env, Cell c, bool by_volume) {
  const CellState state = check_cell(env, c);
  return state == CellState::kInverted || (state == CellState::kInvalid && by_volume && rounded_volume(env, c) < 0);
}

template <int D>
void reorient(Environment<D>& env, bool by_volume, BuildReport& report) {
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    if (!is_inverted(env, c, by_volume)) continue;
    mirror_cell(env, c);
    if (!std::binary_search(report.with_turned_faces.begin(), report.with_turned_faces.end(), i))
      ++report.reoriented_count;
  }
}

/** Throws if cells are turned inside out: counts them and names the flag that turns them back. */
template <int D>
void fail_inverted(const Environment<D>& env, BuildReport& report) {
  uint32_t count = 0;
  Offenders inverted;
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    if (check_cell(env, env.map.cell(i)) != CellState::kInverted) continue;
    inverted.add(i);
    ++count;
  }
  if (count == 0) return;
  report.offenders = inverted;
  if (count == 1) {
    fail(DSW_STATUS_INVERTED_CELL, "cell %u is turned inside out; DSW_ENVIRONMENT_REORIENT turns it back",
         inverted.index[0]);
  }
  fail(DSW_STATUS_INVERTED_CELL,
       "%u of %u cells are turned inside out, first cell %u; DSW_ENVIRONMENT_REORIENT turns them back", count,
       env.map.cell_count, inverted.index[0]);
}

/** Two cells on one side of a face are mostly one inverted cell: that is said first, since it is the cause. */
template <int D>
[[noreturn]] void fail_match(const Environment<D>& env, MatchDefect defect, const Offenders& offenders,
                             BuildReport& report) {
  if (defect == MatchDefect::kSameSide) fail_inverted(env, report);
  report.offenders = offenders;
  dsw::sort(report.offenders.index, report.offenders.index + report.offenders.count);
  const uint32_t a = offenders.index[0], b = offenders.index[1];
  if (defect == MatchDefect::kSameSide)
    fail(DSW_STATUS_DUPLICATE_CELL, "cells %u and %u lie on the same side of a face", a, b);
  fail(DSW_STATUS_SHARED_FACE, "cells %u and %u share a face with a third cell", a, b);
}

template <int D>
void link_facets(Environment<D>& env, size_t open_sides, BuildReport& report, const Parallel& parallel) {
  Offenders offenders;
  const MatchDefect defect = match_facets(env, offenders, open_sides, parallel);
  if (defect != MatchDefect::kNone) fail_match(env, defect, offenders, report);
}

/** Notes whether a cell is convex. */
template <int D>
void note_state(Map<D>& map, Cell c, CellState state) noexcept {
  uint32_t& word0 = map.record(c)[0];
  if (form_of(word0) == Form::kSimplex) return;
  word0 = state == CellState::kValidConvex ? word0 | kConvexBit : word0 & ~kConvexBit;
}

/** Looks at all cells and notes which are convex. A cell that fails gets its facets cut anew, which can spoil a cell seen
 * before: those are looked at again. Calls settle(cell, state), for some cells twice; what it says last counts. */
template <int D, class Settle>
void look_at_cells(Environment<D>& env, BuildReport& report, const Settle& settle) {
  Map<D>& map = env.map;
  Array<Cell> changed{env.memory};
  const auto note = [&](Cell c, CellState state) {
    settle(c, state);
    note_state(map, c, state);
  };
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    CellState state = check_cell(env, c);
    if (state == CellState::kInvalid) {
      recut_cell(env, c, changed);
      state = check_cell(env, c);
    }
    note(c, state);
    if (state == CellState::kValidConvex) ++report.convex_volume_count;
  }
  for (const Cell c : changed) {
    const bool was_convex = map.convex(c);
    const CellState state = check_cell(env, c);
    if (was_convex != (state == CellState::kValidConvex)) report.convex_volume_count += was_convex ? ~0u : 1u;
    note(c, state);
  }
}

/** Looks at all cells side by side and notes which are convex. False: some are not valid, and all have to be looked at
 * again in their order. */
template <int D>
bool are_all_valid(Environment<D>& env, BuildReport& report, const Parallel& parallel) {
  Map<D>& map = env.map;
  std::atomic<uint32_t> convex{0};
  std::atomic<bool> are_valid{true};
  auto look = [&](size_t begin, size_t end) noexcept {
    uint32_t count = 0;
    for (size_t i = begin; i < end && are_valid.load(std::memory_order_relaxed); ++i) {
      const Cell c = map.cell(static_cast<uint32_t>(i));
      const CellState state = check_cell(env, c);
      if (state == CellState::kInverted || state == CellState::kInvalid) are_valid = false;
      count += state == CellState::kValidConvex ? 1u : 0u;
      note_state(map, c, state);
    }
    convex += count;
  };
  parallel_chunks(parallel, map.cell_count, kCellsAtOnce, look);
  if (are_valid) report.convex_volume_count = convex;
  return are_valid;
}

/** Throws unless all cells are valid. */
template <int D>
void validate(Environment<D>& env, bool was_split, BuildReport& report, const Parallel& parallel) {
  if (is_shared(env.map, parallel) && are_all_valid(env, report, parallel)) return;
  Offenders inverted, invalid;
  look_at_cells(env, report, [&](Cell c, CellState state) {
    if (state == CellState::kInverted) inverted.add(env.map.index(c));
    if (state == CellState::kInvalid) invalid.add(env.map.index(c));
  });
  if (inverted.count != 0) fail_inverted(env, report);
  if (invalid.count == 0) return;
  dsw::sort(invalid.index, invalid.index + invalid.count);
  invalid.count = static_cast<uint32_t>(std::unique(invalid.index, invalid.index + invalid.count) - invalid.index);
  report.offenders = invalid;
  fail(DSW_STATUS_INVALID_CELL, "cell %u is flat, folded, or not seen whole from the mean of its vertices%s",
       invalid.index[0], was_split ? "" : "; DSW_ENVIRONMENT_SPLIT splits cells that have an inside");
}

template <int D>
void check_cells(const dsw_environment_desc& d) {
  if (d.volume_count == 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->volume_count is 0, must be at least 1");
  if (d.volume_count > size_t{kVertexMask}) {
    fail(DSW_STATUS_TOO_LARGE, "desc->volume_count is %zu, must be at most %zu", d.volume_count, size_t{kVertexMask});
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
  const size_t index_bytes = d.index_bytes == 4 ? 4 : 8;
  require_array(d.connectivity, d.connectivity_count, index_bytes, "desc->connectivity");
  require_array(d.faces, d.faces_count, index_bytes, "desc->faces");
  if ((d.faces == nullptr) != (d.face_locations == nullptr)) {
    fail(DSW_STATUS_WRONG_SIZE, "desc->faces and desc->face_locations must be set both or none");
  }
}

template <int D>
void check_points(const dsw_environment_desc& d) {
  if (d.point_count == 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->point_count is 0, must be at least 1");
  if (d.point_count > size_t{kVertexMask}) {
    fail(DSW_STATUS_TOO_LARGE, "desc->point_count is %zu, must be at most %zu", d.point_count, size_t{kVertexMask});
  }
  to_points(D, d.points, d.point_count, d.point_stride_bytes, "desc->points");
  if ((d.flags & DSW_ENVIRONMENT_BORROW_POINTS) != 0 && d.point_stride_bytes > D * sizeof(double)) {
    fail(DSW_STATUS_WRONG_SIZE, "desc->point_stride_bytes is %zu, must be 0 or %zu for borrowed points",
         d.point_stride_bytes, D * sizeof(double));
  }
}

void check_merging(const dsw_environment_desc& d) {
  if (!std::isfinite(d.merge_distance)) fail(DSW_STATUS_NON_FINITE, "desc->merge_distance is not finite");
  if (d.merge_distance < 0) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->merge_distance is %g, must not be negative", d.merge_distance);
  }
  if (d.merge_distance > 0 && !merges_points(d)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->merge_distance is %g, which needs DSW_ENVIRONMENT_MERGE_POINTS or _CONFORM",
         d.merge_distance);
  }
}

TreeUse tree_use(uint32_t flags) {
  if ((flags & DSW_ENVIRONMENT_NO_LOCATE_TREE) != 0) return TreeUse::kLeftOut;
  return (flags & DSW_ENVIRONMENT_LOCATE_TREE) != 0 ? TreeUse::kAtOnce : TreeUse::kAtNeed;
}

/** Joins cells that have a passable or impassable facet in common. @return how many sets there are. */
template <int D>
uint32_t join_parts(const Map<D>& map, DisjointSets& parts) noexcept {
  uint32_t count = map.cell_count;
  for_each_cell(map, [&](Cell c) {
    const uint32_t i = map.index(c);
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet o = map.opposite(map.half_facet(c, f));
      if (!o.valid()) continue;
      const uint32_t j = map.index(map.cell_of(o));
      if (j < i && parts.join(i, j)) --count;
    }
  });
  return count;
}

/** Sets the box of the vertices that cells have. @param used a bit for each, all 0. @return how many no cell has. */
template <int D>
uint32_t enclose_used(Environment<D>& env, Array<uint64_t>& used) noexcept {
  const Map<D>& map = env.map;
  for_each_cell(map,
                [&](Cell c) { map.for_each_vertex(c, [&](uint32_t v) { used[v / 64] |= uint64_t{1} << v % 64; }); });
  bool any = false;
  uint32_t unused = 0;
  for (uint32_t v = 0; v < map.vertex_count; ++v) {
    if ((used[v / 64] >> (v % 64) & 1) == 0) {
      ++unused;
      continue;
    }
    for (int k = 0; k < D; ++k) {
      const double x = env.point(v)[k];
      env.lower[k] = any ? std::min(env.lower[k], x) : x;
      env.upper[k] = any ? std::max(env.upper[k], x) : x;
    }
    any = true;
  }
  return unused;
}

template <int D>
void check_boundary(const Environment<D>& env, Offenders& offenders) {
  if (!boundary_crosses(env, &offenders)) return;
  fail(DSW_STATUS_BOUNDARY_CROSSES, "the outer boundary passes through itself; first cell %u",
       offenders.count == 0 ? 0 : offenders.index[0]);
}

}  // namespace

template <int D>
dsw_environment_desc check_description(dsw_environment_desc d) {
  check_flags(d.flags,
              DSW_ENVIRONMENT_BORROW_POINTS | DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_LOCATE_TREE |
                  DSW_ENVIRONMENT_CHECK_BOUNDARY | DSW_ENVIRONMENT_NO_LOCATE_TREE | DSW_ENVIRONMENT_MERGE_POINTS |
                  DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING | DSW_ENVIRONMENT_SPLIT,
              "desc->flags");
  if (d.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "desc->reserved is %u, must be 0", d.reserved);
  check_merging(d);
  check_points<D>(d);
  check_cells<D>(d);
  if (d.point_stride_bytes == 0) d.point_stride_bytes = D * sizeof(double);
  if (d.index_bytes == 0) d.index_bytes = 8;
  return d;
}

template <int D>
void read_mesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report, const Parallel& parallel) {
  read_points(env, input, report);
  read_cells(env, input, report, parallel);
  if ((input.flags & DSW_ENVIRONMENT_REORIENT) != 0) reorient(env, (input.flags & DSW_ENVIRONMENT_SPLIT) != 0, report);
  link_facets(env, kAllSides, report, parallel);
}

template <int D>
void replace_cells(Environment<D>& env, const ReplacedCells<D>& cells, BuildReport& report) {
  link_facets(env, rewrite_records(env, cells, report), report, kOneThread);
}

template <int D>
Array<Cell> find_invalid(Environment<D>& env) {
  Array<Cell> failed{env.memory}, invalid{env.memory};
  BuildReport unused;
  look_at_cells(env, unused, [&](Cell c, CellState state) {
    if (state == CellState::kInvalid) failed.push_back(c);
  });
  dsw::sort(failed.begin(), failed.end(), [](Cell a, Cell b) { return a.unit < b.unit; });
  for (const Cell c : failed) {
    const bool is_new = invalid.empty() || invalid.back() != c;
    if (is_new && check_cell(env, c) == CellState::kInvalid) invalid.push_back(c);
  }
  return invalid;
}

template <int D>
void finish_mesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report,
                 const Parallel& parallel) {
  validate(env, (input.flags & DSW_ENVIRONMENT_SPLIT) != 0, report, parallel);
  if (input.regions != nullptr) env.regions.assign(input.regions, input.regions + input.volume_count);
  if (input.tags != nullptr) env.tags.assign(input.tags, input.tags + input.volume_count);
  finish_topology(env, &report, parallel);
  env.index.set_use(tree_use(input.flags));
  if (env.index.use() == TreeUse::kAtOnce) env.index.build(env, parallel);
  if ((input.flags & DSW_ENVIRONMENT_CHECK_BOUNDARY) != 0) check_boundary(env, report.offenders);
  if ((input.flags & DSW_ENVIRONMENT_FIND_TOUCHING) != 0) report.touching = find_touching(env);
}

template <int D>
void prove(const Environment<D>& env, BuildReport& report) {
  const Map<D>& map = env.map;
  if (const char* const broken = check_integrity(map)) fail(DSW_STATUS_INTERNAL, "the map is broken: %s", broken);
  for_each_cell(map, [&](Cell c) {
    const CellState state = check_cell(env, c);
    if (state == CellState::kInverted || state == CellState::kInvalid) report.offenders.add(map.index(c));
    if (state == CellState::kValidConvex) ++report.convex_volume_count;
  });
  if (report.offenders.count != 0) {
    fail(DSW_STATUS_INVALID_CELL, "cell %u is not valid", report.offenders.index[0]);
  }
  check_boundary(env, report.offenders);
  report.touching = find_touching(env);
}

template <int D>
uint32_t count_parts(const Environment<D>& env) {
  DisjointSets parts(env.map.index_count(), env.memory);
  return join_parts(env.map, parts);
}

template <int D>
void finish_topology(Environment<D>& env, BuildReport* report, const Parallel& parallel) {
  DisjointSets parts(env.map.index_count(), env.memory);
  Array<uint64_t> used((size_t{env.map.vertex_count} + 63) / 64, 0, env.memory);
  uint32_t unused = 0;
  // Two tasks: neither writes what the other one reads.
  auto body = [&](size_t begin, size_t end) noexcept {
    if (begin == 0) env.part_count = join_parts(env.map, parts);
    if (end == 2) unused = enclose_used(env, used);
  };
  parallel_chunks(is_shared(env.map, parallel) ? parallel : kOneThread, 2, 1, body);
  if (report != nullptr) report->unused_point_count = unused;
}

DSW_INSTANTIATE(read_mesh);
DSW_INSTANTIATE(replace_cells);
DSW_INSTANTIATE(find_invalid);
DSW_INSTANTIATE(finish_mesh);
DSW_INSTANTIATE(prove);
template dsw_environment_desc check_description<2>(dsw_environment_desc);
template dsw_environment_desc check_description<3>(dsw_environment_desc);
DSW_INSTANTIATE(count_parts);
DSW_INSTANTIATE(finish_topology);

}  // namespace dsw
