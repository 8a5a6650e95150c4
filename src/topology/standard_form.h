#pragma once
// Which polyhedra are tetrahedra, pyramids, prisms or hexahedra, whatever order their facets have.

#include "map/map.h"

namespace dsw {

/** How a shape turns into a standard form. */
struct StandardMatch {
  Form form = Form::kGeneral;  // kGeneral: into none
  uint16_t vertex[8] = {};     // of the form -> local vertex of the shape
  uint16_t facet[6] = {};      // likewise
  uint32_t cuts = 0;
};

/** The first match in the order of the shape's darts. */
StandardMatch match_standard_form(const Shape& shape);

}  // namespace dsw
