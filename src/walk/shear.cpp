#include "walk/shear.h"

#include "base/compiler.h"
#include "base/processor.h"

namespace dsw {

uint64_t missed_triangles(Shear& shear, const FacetSpan<3>& triangles) noexcept {
  uint64_t missed = 0;
  for (size_t n = 0; n < triangles.size(); ++n) {
    Shear::Point at[3];
    for (int i = 0; i < 3; ++i) {
      const double x[3] = {triangles.row(i, 0)[n], triangles.row(i, 1)[n], triangles.row(i, 2)[n]};
      at[i] = shear(x);
    }
    if (Shear::side(at[0], at[1]) > 0 && Shear::side(at[1], at[2]) > 0 && Shear::side(at[2], at[0]) > 0) {
      for (int i = 0; i < 3; ++i) shear.pass(at[i], at[(i + 1) % 3]);
    } else {
      missed |= uint64_t{1} << n;
    }
  }
  return missed;
}

bool passes_triangles(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept {
  Shear line(from, to);
  for (size_t n = 0; n < triangles.size(); n += kMostMissed) {
    if (missed_triangles(line, triangles.part(n, std::min(kMostMissed, triangles.size() - n))) != 0) return false;
  }
  return line.passed_all();
}

const MissedTriangles kMissedTriangles = DSW_WITH_AVX512(missed_triangles);
const PassesTriangles kPassesTriangles = DSW_WITH_AVX512(passes_triangles);

}  // namespace dsw
