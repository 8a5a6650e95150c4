#include "corridor/hop.h"

#include "base/compiler.h"
#include "base/dimensions.h"
#include "corridor/facet_pass.h"
#include "corridor/line_sides.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** The corners of a facet, counter-clockwise seen from outside; a triangle repeats the last. */
template <int D>
struct Facet {
  const double* corners[D == 3 ? 4 : 2];
};

/** The words of a record that hold links, a bit each; none of forms that are not asked. */
uint32_t link_words(Form form) noexcept {
  return form == Form::kSimplex ? 0xf0u : form == Form::kPyramid ? 0xf8u : form == Form::kBox ? 0xfcu : 0u;
}

/** The facet of `first` that leads into `second`; that of a marked one leads nowhere. */
bool find_facet(const Environment<3>& env, Cell first, Cell second, Facet<3>& facet) noexcept {
  const uint32_t* const w = env.map.record(first);
  const Form form = form_of(w[0]);
  uint32_t shared = 0;
  for (uint32_t i = 0; i < kUnitWords<3>; ++i) shared |= (w[i] / kUnitWords<3> == second.unit ? 1u : 0u) << i;
  shared &= link_words(form);
  if (shared == 0) return false;
  const uint32_t first_link = kUnitWords<3> - env.map.facets_of(first);
  uint32_t vertices[4];
  standard_corners(w, lowest_bit(shared) - first_link, vertices);
  for (int i = 0; i < 4; ++i) facet.corners[i] = env.point(vertices[i]);
  return true;
}

bool find_facet(const Environment<2>& env, Cell first, Cell second, Facet<2>& side) noexcept {
  const Map<2>& map = env.map;
  const uint32_t count = map.facets_of(first);
  for (uint32_t f = 0; f < count; ++f) {
    const HalfFacet h = map.half_facet(first, f), o = map.opposite(h);
    if (!o.valid() || map.facet_marked(h) || map.cell_of(o) != second) continue;
    side = {{env.point(first, f), env.point(first, f + 1 == count ? 0 : f + 1)}};
    return true;
  }
  return false;
}

/** Whether a line passes all ridges of a facet on the facet's side, on its way out. */
bool passes(const Facet<2>& side, const double* from, const double* to) noexcept {
  LineSides line(from, to);
  return line.pass(side.corners[0], side.corners[1]) && line.passed_all();
}
bool passes(const Facet<3>& facet, const double* from, const double* to) noexcept {
  return kPassesFacet(facet.corners, from, to);
}

}  // namespace

template <int D>
bool passes_between(const Environment<D>& env, Cell first, Cell second, const double* from, const double* to) noexcept {
  Facet<D> facet;
  return env.map.convex(first) && env.map.convex(second) && find_facet(env, first, second, facet) &&
         !is_closed(env, second) && passes(facet, from, to);
}

DSW_INSTANTIATE(passes_between);

}  // namespace dsw
