#include "motion/hop.h"

#include "motion/standard_facets.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

/** The corners of a facet, counter-clockwise seen from outside; a triangle repeats the last. */
struct Facet {
  const double* corners[4];
};

/** The words of a record that hold links, a bit each; none of forms that are not asked. */
uint32_t link_words(Form form) noexcept {
  return form == Form::kSimplex ? 0xf0u : form == Form::kPyramid ? 0xf8u : form == Form::kBox ? 0xfcu : 0u;
}

/** The facet of `first` that leads into `second`; that of a marked one leads nowhere. */
template <int D>
bool find_facet(const Environment<D>& env, Cell first, Cell second, Facet& facet) noexcept {
  const uint32_t* const w = env.map.record(first);
  const Form form = form_of(w[0]);
  uint32_t shared = 0;
  for (uint32_t i = 0; i < kUnitWords; ++i) shared |= (w[i] / kUnitWords == second.unit ? 1u : 0u) << i;
  shared &= link_words(form);
  if (shared == 0) return false;
  const uint32_t slot = static_cast<uint32_t>(__builtin_ctz(shared));
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t vertex = form == Form::kSimplex   ? w[kTetrahedronFacets[slot - 4][i < 3 ? i : 2]] & kVertexMask
                            : form == Form::kPyramid ? w[kUnitWords + kPyramidFacets[slot - 3][i]]
                                                     : w[kUnitWords + kBoxFacets[slot - 2][i]];
    facet.corners[i] = env.point(vertex);
  }
  return true;
}

/** Whether a line passes all ridges of a facet on the facet's side, on its way out. */
template <int D>
bool passes(const Facet& facet, const double* from, const double* to) noexcept {
  const filter::Vec<D> way = filter::difference<D>(to, from);
  for (int k = 0; k < 4; ++k) {
    const double *const x = facet.corners[k], *const y = facet.corners[(k + 1) % 4];
    if (x == y) continue;
    const filter::Vec<D> a = filter::difference<D>(x, from), b = filter::difference<D>(y, from);
    const double det = filter::dot(filter::cross(a, b), way);
    if (!(det > 0 && filter::certain(det, filter::extent(way, a, b)))) return false;
  }
  return true;
}

}  // namespace

template <int D>
bool passes_between(const Environment<D>& env, Cell first, Cell second, const double* from, const double* to) noexcept {
  Facet facet;
  return env.map.convex(first) && env.map.convex(second) && find_facet(env, first, second, facet) &&
         !is_closed(env, second) && passes<D>(facet, from, to);
}

#define DSW_HOP(D)                                                                                     \
  template bool passes_between(const Environment<D>& env, Cell first, Cell second, const double* from, \
                               const double* to) noexcept
DSW_HOP(3);
#undef DSW_HOP

}  // namespace dsw
