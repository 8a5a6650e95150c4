#pragma once
// First half of creation: the host's arrays become records, every index and count checked before it is used.

#include <cstring>

#include "environment/builder.h"

namespace dsw {

/** Signed integers of 4 or 8 bytes, as VTK keeps them. */
class Integers {
 public:
  Integers(const void* data, uint32_t bytes) : data_(static_cast<const unsigned char*>(data)), bytes_(bytes) {}
  int64_t operator[](size_t i) const {
    if (bytes_ == 4) {
      int32_t value;
      std::memcpy(&value, data_ + 4 * i, 4);
      return value;
    }
    int64_t value;
    std::memcpy(&value, data_ + 8 * i, 8);
    return value;
  }

 private:
  const unsigned char* data_;
  uint32_t bytes_;
};

struct CellType {
  Form form;
  uint32_t vertex_count;  // 0: as many as its entry has
  bool known;
};

/** Gives the cell type that a VTK number stands for. */
template <int D>
CellType cell_type(uint32_t vtk);
/** The VTK number of a form that the dimension has. */
dsw_cell_type number_of(Form form, int dimension);

/** Copies or borrows the points. Throws NON_FINITE, with the first such points in the report. */
template <int D>
void read_points(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report);

/** Writes a record for every cell, links empty. Throws WRONG_SIZE, BAD_CELL_TYPE, INDEX_OUT_OF_RANGE, BAD_CELL, TOO_LARGE. */
template <int D>
void read_cells(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report, const Parallel& parallel);

/** Turns a cell inside out by renumbering its vertices; before its facets are matched. */
template <int D>
void mirror_cell(Environment<D>& env, Cell c);

}  // namespace dsw
