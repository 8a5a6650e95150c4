#include "environment/builder.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "base/error.h"
#include "environment/facet_matcher.h"
#include "environment/mesh_reader.h"
#include "environment/recut.h"
#include "environment/validity.h"

namespace dsw {
namespace {

template <int D>
void reorient(Environment<D>& env, BuildReport& report) {
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    if (check_cell(env, c) != CellState::kInverted) continue;
    mirror_cell(env, c);
    ++report.reoriented_count;
  }
}

/** Two cells on one side of a face are mostly one inverted cell: that is said first, since it is the cause. */
template <int D>
[[noreturn]] void fail_match(const Environment<D>& env, MatchDefect defect, const Offenders& offenders,
                             BuildReport& report) {
  if (defect == MatchDefect::kSameSide) {
    for (uint32_t i = 0; i < env.map.cell_count; ++i) {
      if (check_cell(env, env.map.cell(i)) == CellState::kInverted) report.offenders.add(i);
    }
    if (report.offenders.count != 0)
      fail(DSW_STATUS_INVERTED_CELL, "cell %u is turned inside out", report.offenders.index[0]);
  }
  report.offenders = offenders;
  std::sort(report.offenders.index, report.offenders.index + report.offenders.count);
  const uint32_t a = offenders.index[0], b = offenders.index[1];
  if (defect == MatchDefect::kSameSide)
    fail(DSW_STATUS_DUPLICATE_CELL, "cells %u and %u lie on the same side of a face", a, b);
  fail(DSW_STATUS_SHARED_FACE, "cells %u and %u share a face with a third cell", a, b);
}

/** Validates all cells and notes which are convex. A cell that fails gets its facets cut anew, which can spoil a cell
 * seen before: those are looked at again. */
template <int D>
void validate(Environment<D>& env, BuildReport& report) {
  Map<D>& map = env.map;
  Array<Cell> changed{env.memory};
  Offenders inverted, invalid;
  const auto settle = [&](Cell c, CellState state) {
    const uint32_t i = map.index(c);
    if (state == CellState::kInverted) inverted.add(i);
    if (state == CellState::kInvalid) invalid.add(i);
    uint32_t& word0 = map.record(c)[0];
    if (map.form(c) != Form::kSimplex) {
      word0 = state == CellState::kValidConvex ? word0 | kConvexBit : word0 & ~kConvexBit;
    }
  };
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    CellState state = check_cell(env, c);
    if (state == CellState::kInvalid) {
      recut_cell(env, c, changed);
      state = check_cell(env, c);
    }
    settle(c, state);
    if (state == CellState::kValidConvex) ++report.convex_volume_count;
  }
  for (const Cell c : changed) {
    const bool was_convex = map.convex(c);
    const CellState state = check_cell(env, c);
    if (was_convex != (state == CellState::kValidConvex)) report.convex_volume_count += was_convex ? ~0u : 1u;
    settle(c, state);
  }
  const auto raise = [&](Offenders& offenders, dsw_status status, const char* what) {
    if (offenders.count == 0) return;
    std::sort(offenders.index, offenders.index + offenders.count);
    offenders.count =
        static_cast<uint32_t>(std::unique(offenders.index, offenders.index + offenders.count) - offenders.index);
    report.offenders = offenders;
    fail(status, "cell %u %s", offenders.index[0], what);
  };
  raise(inverted, DSW_STATUS_INVERTED_CELL, "is turned inside out");
  raise(invalid, DSW_STATUS_INVALID_CELL, "is flat, folded, or not seen whole from the mean of its vertices");
}

}  // namespace

template <int D>
void build(Environment<D>& env, const MeshInput& input, BuildReport& report) {
  read_points(env, input, report);
  read_cells(env, input, report);
  if (input.reorient) reorient(env, report);
  Offenders offenders;
  const MatchDefect defect = match_facets(env, offenders);
  if (defect != MatchDefect::kNone) fail_match(env, defect, offenders, report);
  validate(env, report);
  if (input.regions != nullptr) env.regions.assign(input.regions, input.regions + input.cell_count);
  if (input.tags != nullptr) env.tags.assign(input.tags, input.tags + input.cell_count);
  finish_topology(env, &report);
}

template <int D>
uint32_t count_parts(const Environment<D>& env) {
  const Map<D>& map = env.map;
  DisjointSets parts(map.index_count(), env.memory);
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

template <int D>
void finish_topology(Environment<D>& env, BuildReport* report) {
  const Map<D>& map = env.map;
  env.part_count = count_parts(env);
  Array<uint64_t> used((size_t{map.vertex_count} + 63) / 64, 0, env.memory);
  for_each_cell(map, [&](Cell c) {
    for (uint32_t k = 0, n = map.vertices_of(c); k < n; ++k) {
      const uint32_t v = map.vertex(c, k);
      used[v / 64] |= uint64_t{1} << (v % 64);
    }
  });
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
  if (report != nullptr) report->unused_point_count = unused;
}

DSW_INSTANTIATE(build);
DSW_INSTANTIATE(count_parts);
DSW_INSTANTIATE(finish_topology);

}  // namespace dsw
