#include "topology/polyhedron.h"

#include <algorithm>

#include "base/search.h"
#include "environment/validity.h"

namespace dsw {
namespace {

constexpr uint8_t kNone = 0xff;

/** Boundary triangles as they come. Dart d is side d % 3 of triangle d / 3. */
struct Surface {
  uint32_t facet_count, vertex_count = 0;
  uint32_t vertices[kMostVertices];
  uint8_t origin[3 * kMostFacets];
  uint8_t opposite[3 * kMostFacets];
  uint8_t degree[kMostVertices] = {};

  static uint32_t next(uint32_t d) { return d % 3 == 2 ? d - 2 : d + 1; }
  uint8_t target(uint32_t d) const { return origin[next(d)]; }
  uint8_t apex(uint32_t d) const { return origin[next(next(d))]; }
};

/** False unless every side of a triangle is one of just one other, turned round, and V = F / 2 + 2. */
bool join(const Environment<3>& env, const uint32_t* facets, uint32_t count, Surface& surface) noexcept {
  surface.facet_count = count;
  const uint32_t expected = count / 2 + 2;
  for (uint32_t f = 0; f < count; ++f) {
    uint32_t corners[3];
    corners_of(env, {facets[f]}, corners);
    for (uint32_t k = 0; k < 3; ++k) {
      uint32_t* const end = surface.vertices + surface.vertex_count;
      uint32_t* const at = dsw::find(surface.vertices, end, corners[k]);
      if (at == end) {
        if (surface.vertex_count == expected) return false;
        surface.vertices[surface.vertex_count++] = corners[k];
      }
      surface.origin[3 * f + k] = static_cast<uint8_t>(at - surface.vertices);
      ++surface.degree[at - surface.vertices];
    }
  }
  if (surface.vertex_count != expected) return false;
  uint8_t dart_between[kMostVertices][kMostVertices];
  std::fill_n(&dart_between[0][0], sizeof dart_between, kNone);
  for (uint32_t d = 0; d < 3 * count; ++d) {
    uint8_t& dart = dart_between[surface.origin[d]][surface.target(d)];
    if (dart != kNone) return false;
    dart = static_cast<uint8_t>(d);
  }
  for (uint32_t d = 0; d < 3 * count; ++d) {
    surface.opposite[d] = dart_between[surface.target(d)][surface.origin[d]];
    if (surface.opposite[d] == kNone) return false;
  }
  return true;
}

/** The numbering that starts at a dart: its triangle first, then, side by side of the triangles met, those beyond. What
 * is new about each triangle after the first is the number of its apex. */
struct DartNumbering {
  uint8_t darts[kMostFacets];   // of each triangle, the side that it was met through
  uint8_t apexes[kMostFacets];  // by number
  uint8_t number[kMostVertices], vertex[kMostVertices];

  /** False if it stays behind `best`, or does not meet all triangles. */
  bool make(const Surface& surface, uint32_t start, const DartNumbering* best) noexcept {
    std::fill_n(number, kMostVertices, kNone);
    uint32_t numbered = 0, met = 0;
    bool seen[kMostFacets] = {}, leads = best == nullptr;
    const auto give = [&](uint8_t v) {
      if (number[v] == kNone) {
        vertex[numbered] = v;
        number[v] = static_cast<uint8_t>(numbered++);
      }
    };
    const auto meet = [&](uint32_t d) {
      seen[d / 3] = true;
      darts[met] = static_cast<uint8_t>(d);
      give(surface.apex(d));
      apexes[met] = number[surface.apex(d)];
      const int lead = leads ? 1 : best->apexes[met] - apexes[met];
      ++met;
      leads = lead > 0;
      return lead >= 0;
    };
    give(surface.origin[start]);
    give(surface.target(start));
    if (!meet(start)) return false;
    for (uint32_t t = 0; t < met; ++t) {
      for (uint32_t k = 0, d = darts[t]; k < 3; ++k, d = Surface::next(d)) {
        const uint32_t beyond = surface.opposite[d];
        if (!seen[beyond / 3] && !meet(beyond)) return false;
      }
    }
    return leads && met == surface.facet_count;
  }
};

/** Starts that are worth trying: what is seen next to the dart. */
uint32_t rank(const Surface& surface, uint32_t d) noexcept {
  const auto degree = [&](uint8_t v) { return uint32_t{surface.degree[v]}; };
  return degree(surface.origin[d]) << 24 | degree(surface.target(d)) << 16 | degree(surface.apex(d)) << 8 |
         degree(surface.apex(surface.opposite[d]));
}

}  // namespace

void corners_of(const Environment<3>& env, HalfFacet h, uint32_t (&out)[3]) noexcept {
  const Cell c = env.map.cell_of(h);
  const Shape shape = standard_shape(Form::kSimplex, 0);
  const uint16_t* const local = shape.simplices() + 3 * env.map.local_of(h, c);
  for (uint32_t k = 0; k < 3; ++k) out[k] = env.map.vertex(c, local[k]);
}

bool make_polyhedron(const Environment<3>& env, const uint32_t* facets, uint32_t count, Polyhedron& out) noexcept {
  Surface surface;
  if (!join(env, facets, count, surface)) return false;
  uint32_t highest = 0;
  for (uint32_t d = 0; d < 3 * count; ++d) highest = std::max(highest, rank(surface, d));
  DartNumbering numberings[2], *best = nullptr, *other = &numberings[0];
  for (uint32_t d = 0; d < 3 * count; ++d) {
    if (rank(surface, d) != highest || !other->make(surface, d, best)) continue;
    best = other;
    other = &numberings[best == &numberings[0] ? 1 : 0];
  }
  if (best == nullptr) return false;  // in several parts

  out.facet_count = count;
  out.vertex_count = surface.vertex_count;
  const double* points[kMostVertices];
  for (uint32_t v = 0; v < surface.vertex_count; ++v) {
    out.vertices[v] = surface.vertices[best->vertex[v]];
    points[v] = env.point(out.vertices[v]);
  }
  for (uint32_t t = 0; t < count; ++t) {
    const uint32_t d = best->darts[t];
    out.facets[t] = facets[d / 3];
    out.triangles[3 * t] = best->number[surface.origin[d]];
    out.triangles[3 * t + 1] = best->number[surface.target(d)];
    out.triangles[3 * t + 2] = best->number[surface.apex(d)];
  }
  return is_valid_star(points, out.vertex_count, out.triangles, count);
}

}  // namespace dsw
