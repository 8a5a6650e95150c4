#include "topology/standard_form.h"

#include <algorithm>
#include <array>

namespace dsw {
namespace {

constexpr uint32_t kMostDarts = 24;

Form candidate(const Shape& shape) {
  const uint32_t v = shape.vertex_count(), f = shape.facet_count(), d = shape.dart_count();
  if (v == 4 && f == 4 && d == 12) return Form::kSimplex;
  if (v == 5 && f == 5 && d == 16) return Form::kPyramid;
  if (v == 6 && f == 5 && d == 18) return Form::kPrism;
  if (v == 8 && f == 6 && d == 24) return Form::kBox;
  return Form::kGeneral;
}

/** Whether dart 0 of the form can be dart `first` of the shape. image: dart of the form -> dart of the shape. Both are
 * connected and have as many darts, so following beta1 and beta2 from one pair decides all others. */
bool match_from(const Shape& shape, const Shape& form, uint32_t first, uint32_t* image) {
  constexpr uint32_t kUnknown = kMostDarts;
  std::fill(image, image + kMostDarts, kUnknown);
  uint32_t stack[kMostDarts], height = 0;
  const auto set = [&](uint32_t d, uint32_t to) {
    if (image[d] != kUnknown) return image[d] == to;
    if (form.facet_size(form.dart_facet(d)) != shape.facet_size(shape.dart_facet(to))) return false;
    image[d] = to;
    stack[height++] = d;
    return true;
  };
  if (!set(0, first)) return false;
  while (height != 0) {
    const uint32_t d = stack[--height];
    if (!set(form.beta1(d), shape.beta1(image[d])) || !set(form.dart_beta2(d), shape.dart_beta2(image[d])))
      return false;
  }
  std::array<bool, kMostDarts> taken{};
  for (uint32_t d = 0; d < form.dart_count(); ++d) {
    if (image[d] == kUnknown || taken[image[d]]) return false;
    taken[image[d]] = true;
  }
  return true;
}

/** How the quads of the form are cut: bit k is set where the diagonal of quad k does not start at its first vertex. */
uint32_t cuts_of(const Shape& shape, const Shape& form, const StandardMatch& match) {
  uint32_t cuts = 0, quad = 0;
  for (uint32_t f = 0; f < form.facet_count(); ++f) {
    if (form.facet_size(f) != 4) continue;
    const uint32_t first = match.vertex[form.dart_vertex(form.facet_first(f))];
    const uint16_t* const triangles = shape.simplices() + 3 * shape.simplex_first(match.facet[f]);
    const bool on_diagonal = std::count(triangles, triangles + 6, first) == 2;
    cuts |= (on_diagonal ? 0u : 1u) << quad++;
  }
  return cuts;
}

}  // namespace

StandardMatch match_standard_form(const Shape& shape) {
  StandardMatch match;
  const Form wanted = candidate(shape);
  if (wanted == Form::kGeneral) return match;
  const Shape form = standard_shape(wanted, 0);
  for (uint32_t first = 0; first < shape.dart_count(); ++first) {
    uint32_t image[kMostDarts];
    if (!match_from(shape, form, first, image)) continue;
    match.form = wanted;
    for (uint32_t d = 0; d < form.dart_count(); ++d) {
      match.vertex[form.dart_vertex(d)] = static_cast<uint16_t>(shape.dart_vertex(image[d]));
      match.facet[form.dart_facet(d)] = static_cast<uint16_t>(shape.dart_facet(image[d]));
    }
    match.cuts = cuts_of(shape, form, match);
    break;
  }
  return match;
}

}  // namespace dsw
