// One vertex from which the whole rim is seen makes an edge collapse of the cells round a vertex, a flip of those round
// an edge, and cuts a large cell into tetrahedra. All of these are one thing here.

#include "topology/patch.h"

#include <cmath>

#include "base/position.h"
#include "base/search.h"
#include "environment/validity.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

constexpr size_t kMostPlaces = 255;  // of vertices, in a byte

const double* point(const double* points, uint32_t vertex) { return points + size_t{vertex} * 3; }

/** Calls visit(points) for each of the positions until it returns false; whether none did. */
template <class Visit>
bool for_all_positions(const Geometry& geometry, Visit visit) {
  return visit(geometry.now) && (geometry.next == nullptr || visit(geometry.next));
}

/** Six times the volume of a tetrahedron over the cube of its longest edge, rounded. */
double shape_of(const double* const* corners) {
  double edges[3][3], longest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) edges[i][k] = corners[i][k] - corners[3][k];
  }
  const auto note = [&](const double* a, const double* b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    longest = std::max(longest, sum);
  };
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) note(corners[i], corners[j]);
  }
  const double(&u)[3] = edges[0], (&v)[3] = edges[1], (&w)[3] = edges[2];
  const double volume =
      u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  return std::fabs(volume) / (longest * std::sqrt(longest));
}

}  // namespace

RimSurface::RimSurface(const Environment<3>& env)
    : env_(env), first_(loops_.get_allocator()), table_(loops_.get_allocator()) {}

bool RimSurface::read(const Rim& rim, uint32_t most_facets) {
  vertices_.clear();
  triangles_.clear();
  loops_.clear();
  first_.clear();
  first_.push_back(0);
  if (rim.size() > most_facets) return false;
  for (const HalfFacet h : rim) {
    const Cell c = env_.map.cell_of(h);
    const Shape shape = env_.map.shape(c);
    const uint32_t f = env_.map.local_of(h, c);
    const auto place_of = [&](uint32_t local) { return vertices_.insert(env_.map.vertex(c, local)); };
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      loops_.push_back(static_cast<uint16_t>(place_of(shape.dart_vertex(d))));
      if (vertices_.size() > kMostPlaces) return false;
    }
    first_.push_back(static_cast<uint16_t>(loops_.size()));
    const uint16_t* const local = shape.simplices();
    for (uint32_t k = 3 * shape.simplex_first(f); k < 3 * shape.simplex_first(f + 1); ++k) {
      triangles_.push_back(static_cast<uint8_t>(place_of(local[k])));
    }
  }
  return true;
}

uint32_t RimSurface::count_wrong(const Geometry& geometry) {
  uint32_t wrong = 0;
  for_all_positions(geometry, [&](const double* points) {
    double apex[3];
    mean_point<3>(
        vertices_.size(), [&](uint32_t i) { return point(points, vertex(i)); }, apex);
    for (size_t t = 0; t < triangles_.size(); t += 3) {
      const double* corners[3];
      for (size_t k = 0; k < 3; ++k) corners[k] = point(points, vertex(triangles_[t + k]));
      wrong += orient<3>(corners, apex) < 0 ? 0u : 1u;
    }
    return true;
  });
  return wrong;
}

bool RimSurface::is_triangulated() const {
  return triangles_.size() == 3 * (first_.size() - 1) && loops_.size() == triangles_.size();
}

uint32_t RimSurface::count_wrong_from_vertex(const Geometry& geometry, uint32_t most) {
  if (!is_triangulated()) return most;
  const auto count = static_cast<uint32_t>(triangles_.size() / 3);
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    uint32_t wrong = 0;
    for_all_positions(geometry, [&](const double* points) {
      for (uint32_t t = 0; t < count && wrong < most; ++t) {
        if (has(t, v)) continue;
        const double* corners[3];
        for (uint32_t k = 0; k < 3; ++k) corners[k] = point(points, vertex(triangles_[size_t{3} * t + k]));
        wrong += orient<3>(corners, point(points, vertex(v))) < 0 ? 0u : 1u;
      }
      return wrong < most;
    });
    most = std::min(most, wrong);
  }
  return most;
}

bool RimSurface::is_sphere() {
  table_.clear();
  const FacetLoops faces{loops_.data(), first_.data(), static_cast<uint32_t>(first_.size() - 1), vertices_.size()};
  return append_polyhedron(faces, nullptr, table_) == ShapeDefect::kNone;
}

bool RimSurface::is_valid_cell(const Geometry& geometry) {
  return for_all_positions(geometry, [&](const double* points) {
    at_.clear();
    for (uint32_t v = 0; v < vertices_.size(); ++v) at_.push_back(point(points, vertex(v)));
    return is_valid_star(at_.data(), static_cast<uint32_t>(at_.size()), triangles_.data(),
                         static_cast<uint32_t>(triangles_.size() / 3));
  });
}

bool RimSurface::has(uint32_t triangle, uint32_t place) const {
  const uint8_t* const corners = &triangles_[size_t{3} * triangle];
  return corners[0] == place || corners[1] == place || corners[2] == place;
}

/** The worst of the tetrahedra that join a vertex with all triangles; `worst` or less: it is not better than that. */
double RimSurface::quality(const double* points, uint32_t apex, double worst) const {
  double least = HUGE_VAL;
  for (uint32_t t = 0; t < triangles_.size() / 3 && least > worst; ++t) {
    if (has(t, apex)) continue;
    const double* corners[4];
    for (uint32_t k = 0; k < 3; ++k) corners[k] = point(points, vertex(triangles_[size_t{3} * t + k]));
    corners[3] = point(points, vertex(apex));
    if (orient<3>(corners, corners[3]) >= 0) return 0;
    least = std::min(least, shape_of(corners));
  }
  return least;
}

uint32_t RimSurface::find_apex(const Geometry& geometry, size_t most_tetrahedra) {
  if (!is_triangulated()) return kNoVertex;
  const auto count = static_cast<uint32_t>(triangles_.size() / 3);
  double best = 0;
  uint32_t found = kNoVertex;
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    uint32_t beyond = 0;
    for (uint32_t t = 0; t < count; ++t) beyond += has(t, v) ? 0u : 1u;
    if (beyond == 0 || beyond > most_tetrahedra) continue;
    double least = HUGE_VAL;
    for_all_positions(geometry, [&](const double* points) {
      least = std::min(least, quality(points, v, best));
      return least > best;
    });
    if (!(least > best)) continue;
    best = least;
    found = v;
  }
  return found == kNoVertex ? kNoVertex : vertex(found);
}

namespace {

CellDraft like(const Environment<3>& env, Cell c) {
  CellDraft draft(env.scratch.memory());
  draft.from = c;
  draft.marked = env.map.marked(c);
  draft.region = env.region(c);
  draft.tag = env.tag(c);
  return draft;
}

uint32_t fill_with_one_cell(Edit<3>& edit, const Patch& patch) {
  const Environment<3>& env = edit.environment();
  CellDraft draft = like(env, patch.cells[0]);
  for (const HalfFacet h : patch.rim) draft.facets.push_back(draft_of(env, h));
  draft.also.assign(patch.cells.begin() + 1, patch.cells.end());
  edit.add(std::move(draft));
  return 1;
}

/** One for each triangle of the rim without the apex. Between two of them there is a new triangle, unless that is one
 * of the rim. */
uint32_t fill_with_tetrahedra(Edit<3>& edit, const Patch& patch, uint32_t& pairs) {
  const Environment<3>& env = edit.environment();
  Array<FacetDraft> rim{env.memory};
  for (const HalfFacet h : patch.rim) rim.push_back(draft_of(env, h));
  KeyTable edges(env.memory);
  uint32_t used = 0;
  for (const FacetDraft& base : rim) {
    if (base.has(patch.apex)) continue;
    CellDraft draft = like(env, patch.cells[used++]);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = base.loop[k], b = base.after(k);
      const auto beyond = dsw::find_if(rim.begin(), rim.end(), [&](const FacetDraft& facet) {
        const uint32_t at = facet.place_of(b);
        return at != facet.loop.size() && facet.after(at) == a;
      });
      if (beyond->has(patch.apex)) {
        draft.facets.push_back(*beyond);
        continue;
      }
      FacetDraft side(env.scratch.memory());
      side.loop.assign({b, a, patch.apex});
      side.triangles = side.loop;
      side.pair = pairs + edges.insert(pair_key(a, b));
      draft.facets.push_back(std::move(side));
    }
    draft.facets.push_back(base);
    edit.add(std::move(draft));
  }
  pairs += edges.size();
  return used;
}

}  // namespace

uint32_t fill(Edit<3>& edit, const Patch& patch, uint32_t& pairs) {
  for (const Cell c : patch.cells) edit.remove(c);
  return patch.filling == Patch::Filling::kOneCell ? fill_with_one_cell(edit, patch)
                                                   : fill_with_tetrahedra(edit, patch, pairs);
}

}  // namespace dsw
