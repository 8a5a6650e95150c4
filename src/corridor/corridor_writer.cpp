// What a cast tells of the facets that it passes.

#include "base/dimensions.h"
#include "corridor/corridor.h"

namespace dsw {

template <int D>
PathFacets path_facets(const Map<D>& map, Cell start, const CastResult& path) noexcept {
  PathFacets passed;
  if (path.end == CastEnd::kWorkLimit || path.volumes_visited > 3) return passed;
  passed.is_known = true;
  if (path.volumes_visited < 2) return passed;
  passed.facets[0] = map.half_facet(start, path.first_facet);
  passed.count = 1;
  if (path.volumes_visited == 2) return passed;
  // Two tetrahedra have one facet in common; other cells may have several.
  if (D == 3 && (map.form(path.previous) != Form::kSimplex || map.form(path.cell) != Form::kSimplex)) return {};
  for (uint32_t f = 0, facets = map.facets_of(path.previous); f < facets; ++f) {
    const HalfFacet h = map.half_facet(path.previous, f), o = map.opposite(h);
    if (!o.valid() || map.cell_of(o) != path.cell) continue;
    if (passed.count == 2) return {};
    passed.facets[1] = h;
    passed.count = 2;
  }
  return passed;
}

template <int D>
bool CorridorWriter<D>::cast_segment(const Environment<D>& env, const double* from, const double* to, Cell start,
                                     Cell end, CastCounters* counters) {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  request.end = end;
  attach(env, request);
  const CastResult result = cast(env, request, counters);
  return result.end == CastEnd::kReached && (!end.valid() || result.cell == end);
}

template <int D>
void CorridorWriter<D>::finish(Corridor<D>& corridor) {
  if (had_room()) {
    corridor.assign(*env_, facets_);
    corridor.portal.version = env_->obstacle_version;
    return;
  }
  corridor.facets.reserve(1);
  corridor.forget();
}

template <int D>
void CorridorWriter<D>::write(void* user, Cell from, uint32_t simplex, Cell) noexcept {
  CorridorWriter<D>& w = *static_cast<CorridorWriter<D>*>(user);
  ++w.passed_;
  if (w.facets_.size() == w.facets_.capacity()) return;
  const Map<D>& map = w.env_->map;
  const uint32_t facet = map.form(from) == Form::kSimplex ? simplex : map.shape(from).simplex_facets(D)[simplex];
  w.facets_.push_back(map.half_facet(from, facet).word);
}

template class CorridorWriter<2>;
template class CorridorWriter<3>;
DSW_INSTANTIATE(path_facets);

}  // namespace dsw
