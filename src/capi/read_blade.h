#pragma once
// The points of a blade as a host gives them.

#include "capi/convert.h"
#include "dartsweep/surgery.h"

namespace dsw::capi {

/** In the plane the chain is one point. */
template <int D>
PointArray read_blade(const dsw_cut_desc& d) {
  if (d.rows < 2 || (D == 3 ? d.columns < 2 : d.columns != 1)) {
    const char* const columns = D == 3 ? "at least 2" : "1 in the plane";
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->rows is %u and desc->columns is %u, must be at least 2 and %s", d.rows,
         d.columns, columns);
  }
  if (uint64_t{d.rows} * d.columns > kVertexMask) {
    fail(DSW_STATUS_TOO_LARGE, "desc->rows is %u and desc->columns is %u, together must be below 2^28 points", d.rows,
         d.columns);
  }
  return to_finite_points(D, d.points, size_t{d.rows} * d.columns, d.point_stride_bytes, "desc->points");
}

}  // namespace dsw::capi
