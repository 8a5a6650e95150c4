#pragma once
// How a drafted cell is written down.

#include "topology/draft.h"

namespace dsw {

/** Can be used for one cell after the other. */
struct Layout {
  Form form = Form::kGeneral;
  uint32_t cuts = 0;         // of a standard form
  Array<uint32_t> vertices;  // in the order of the record
  Array<uint32_t> facets;    // numbers in the record of the draft's
  Array<uint16_t> table;     // of a general form: its shape

  Array<uint32_t> listed;  // scratch: the draft's vertices, its loops, where these begin, its triangles
  Array<uint16_t> loops, first, triangles;

  explicit Layout(const Memory* memory)
      : vertices(memory),
        facets(memory),
        table(memory),
        listed(memory),
        loops(memory),
        first(memory),
        triangles(memory) {}
};

/** False: the facets would not close a sphere, the sides of a polygon no loop. Throws TOO_LARGE, std::bad_alloc. */
template <int D>
bool lay_out(const CellDraft& draft, Layout& out);
template <>
bool lay_out<3>(const CellDraft& draft, Layout& out);
template <>
bool lay_out<2>(const CellDraft& draft, Layout& out);

}  // namespace dsw
