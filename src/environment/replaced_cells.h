#pragma once
// Cells of a mesh that was read, replaced by others at the same places: new records and shapes, and links that stay.

#include "environment/builder.h"
#include "environment/outer_facets.h"

namespace dsw {

/** What becomes of a mesh. Cells keep their indices. */
template <int D>
struct ReplacedCells {
  Array<uint32_t>
      cells;  // indices of cells that are written anew, ascending: all of general form, and those that change
  Array<uint32_t> first_loop;  // of each of them in `loops`, and where the last one ends
  Loops loops;                 // their facets; in the plane of each cell its corners
  Array<uint64_t> changed;     // bits, by cell: it has other facets than it had
  Array<uint64_t> poor_fans;  // bits: vertices from which facets with five and more are not cut if another one is there

  explicit ReplacedCells(const Memory* memory)
      : cells(memory), first_loop(memory), loops(memory), changed(memory), poor_fans(memory) {
    first_loop.push_back(0);
  }
  bool has_changed(uint32_t i) const { return (changed[i / 64] >> i % 64 & 1) != 0; }
};

/** Writes the records. Links between cells that do not change stay. Returns how many sides have none. Throws TOO_LARGE,
 * BAD_CELL with the first of these cells, std::bad_alloc. */
template <int D>
size_t rewrite_records(Environment<D>& env, const ReplacedCells<D>& cells, BuildReport& report);

}  // namespace dsw
