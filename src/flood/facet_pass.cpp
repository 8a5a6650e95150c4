#include "flood/facet_pass.h"

#include "base/processor.h"

namespace dsw {

bool passes_facet(const double* const* corners, const double* from, const double* to) noexcept {
  const filter::Vec<3> way = filter::difference<3>(to, from);
  for (int k = 0; k < 4; ++k) {
    const double *const x = corners[k], *const y = corners[k == 3 ? 0 : k + 1];
    if (x != y && !passes_ridge(x, y, from, way)) return false;
  }
  return true;
}

namespace {

PassesFacet choose_passes_facet() noexcept {
#if defined(__x86_64__)
  if (has_avx2()) return passes_facet_avx2;
#endif
  return passes_facet;
}

}  // namespace

const PassesFacet kPassesFacet = choose_passes_facet();

}  // namespace dsw
