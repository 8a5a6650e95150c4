#pragma once
// Creation: from the arrays of a mesh to a validated environment, in expected linear time.

#include <vector>

#include "base/compiler.h"
#include "dartsweep/environment.h"
#include "environment/environment.h"
#include "environment/touching.h"

namespace dsw {

/** First offenders of one kind, ascending. */
struct Offenders {
  static constexpr uint32_t kMax = 8;
  uint32_t count = 0;
  uint32_t index[kMax] = {};
  void add(uint32_t i) {
    if (count < kMax && (count == 0 || index[count - 1] != i)) index[count++] = i;
  }
};

template <int D>
struct ReplacedCells;

constexpr size_t kCellsAtOnce = size_t{1} << 14;  // that one thread takes

/** Whether work on the cells of a map is shared out. */
template <int D>
bool is_shared(const Map<D>& map, const Parallel& parallel) {
  return map.cell_count >= 4 * kCellsAtOnce &&
         (parallel.run != nullptr || (DSW_HAS_THREADS && parallel.thread_count > 1));
}

struct BuildReport {
  Offenders offenders;
  uint32_t reoriented_count = 0, unused_point_count = 0, convex_volume_count = 0;
  uint32_t turned_face_count = 0;           // of polyhedra, against the other faces of their cell
  std::vector<uint32_t> with_turned_faces;  // cells, ascending
  uint32_t merged_point_count = 0;          // that count as another one
  Offenders changed;                        // cells that were made to conform
  uint32_t changed_count = 0;
  uint32_t split_count = 0, added_point_count = 0;  // cells that were split; points for it
  Touching touching;
};

/** Whether points that lie at one place, or nearly, count as one. */
inline bool merges_points(const dsw_environment_desc& desc) {
  return (desc.flags & (DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_CONFORM)) != 0;
}

/** A description whose sizes and pointers fit each other, with its defaults in place of zeros. Throws Error. */
template <int D>
dsw_environment_desc check_description(dsw_environment_desc desc);

/** Fills an empty environment from a description that was checked: points, cells, and links of their facets. Throws Error
 * (and leaves the environment useless) on the first kind of defect found, with the first offenders of that kind in the report.
 * Order of checks: sizes, points finite, cells well-formed, facets matched. `parallel` shares the work out. */
template <int D>
void read_mesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report,
               const Parallel& parallel = kOneThread);

/** Replaces cells of a mesh that was read, and links the facets of those that change. Throws as read_mesh. */
template <int D>
void replace_cells(Environment<D>& env, const ReplacedCells<D>& cells, BuildReport& report);

/** The cells of a mesh that was read that are neither valid nor turned inside out, however their facets are cut, in the
 * order of their records. Throws std::bad_alloc. */
template <int D>
Array<Cell> find_invalid(Environment<D>& env);

/** Proves the cells of a mesh that was read valid, and adds what the description asks for. Throws as read_mesh. */
template <int D>
void finish_mesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report,
                 const Parallel& parallel = kOneThread);

/** Reads and finishes. */
template <int D>
void build(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report) {
  read_mesh(env, input, report);
  finish_mesh(env, input, report);
}

/** Proves everything again; throws as build. */
template <int D>
void prove(const Environment<D>& env, BuildReport& report);

/** How many parts there are, connected through facets. Throws std::bad_alloc. */
template <int D>
uint32_t count_parts(const Environment<D>& env);

/** Counts the parts connected through facets and sets the box of used vertices; for build and for loading. */
template <int D>
void finish_topology(Environment<D>& env, BuildReport* report, const Parallel& parallel = kOneThread);

}  // namespace dsw
