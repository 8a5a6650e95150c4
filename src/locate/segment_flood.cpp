#include "locate/segment_flood.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "walk/standard_facets.h"

namespace dsw {

template <int D>
SegmentFlood<D>::SegmentFlood(const Distances<D, FromSegment<D>>& distances, double radius, SegmentNotes& notes,
                              SegmentNearest& result)
    : distances_(distances),
      env_(distances.environment()),
      map_(env_.map),
      kernel_(bounds_kernel<D>()),
      notes_(notes),
      result_(result),
      frame_(distances.from().first, distances.from().line.along, distances.scale()),
      radius_(radius * distances.scale()),
      limit_(radius_) {
  for (int k = 0; k < D; ++k) {
    for (const double* p : {env_.lower, env_.upper, distances.from().from, distances.from().to})
      largest_ = std::max(largest_, std::fabs(p[k] * distances.scale()));
  }
  notes_.clear();
  notes_.queue.clear();
  notes_.steps.clear();
  notes_.sights.clear();
  notes_.views.clear();
}

template <int D>
SearchEnd SegmentFlood<D>::run() {
  if (!(largest_ >= kLeastBounded && largest_ <= kMostBounded)) return SearchEnd::kUnknown;
  for (const Cell c : notes_.starts) push({0, 0, {}, Notes::kNone, c});
  Array<uint64_t>& queue = notes_.queue;
  while (!queue.empty() && queue.front() >> 32 <= key(limit_) >> 32) {
    const auto number = static_cast<uint32_t>(queue.front());
    std::pop_heap(queue.begin(), queue.end(), std::greater<uint64_t>());
    queue.pop_back();
    const Cell c = notes_.steps[number].cell;
    if (!c.valid()) {
      measure(notes_.steps[number]);
    } else if (notes_.see(c, number)) {
      ++result_.volumes_visited;
      visit(number);
    }
  }
  return decide();
}

template <int D>
void SegmentFlood<D>::visit(uint32_t step) {
  const Cell c = notes_.steps[step].cell;
  if (D == 3 && map_.form(c) == Form::kSimplex && !env_.checked.active()) {
    visit_tetrahedron(step);
  } else {
    visit_any(step);
  }
  if (env_.marked_edges == 0 && env_.marked_vertices == 0) return;
  distances_.for_each_thin(c, map_.shape(c), [&](double distance, const SegmentWay& at, const FeatureRef& feature) {
    note_sight(distance, at, feature, step);
  });
}

/** The cell that is entered through a facet of an entered cell; invalid if it is impassable. */
template <int D>
Cell SegmentFlood<D>::beyond(HalfFacet h) const {
  return is_impassable(env_, h) ? Cell{} : map_.cell_of(map_.opposite(h));
}

template <int D>
void SegmentFlood<D>::visit_tetrahedron(uint32_t step) {
  if constexpr (D == 3) {
    const Cell c = notes_.steps[step].cell;
    const uint32_t* w = map_.record(c);
    const uint32_t first = c.unit * kUnitWords<D> + 4;
    Cell next[4];
    uint32_t wanted = 0;
    for (uint32_t f = 0; f < 4; ++f) {
      const uint32_t o = w[4 + f];
      if (o < kNoFacet) {
        const Cell to = map_.cell_of(HalfFacet{o});
        if (!map_.marked(to)) {
          if (notes_.is_seen(to)) continue;
          next[f] = to;
        }
      }
      wanted |= 1u << f;
    }
    if (wanted == 0) return;
    const double* points[4];
    for (uint32_t i = 0; i < 4; ++i) points[i] = env_.point(w[i] & kVertexMask);
    FacetBounds bounds;
    kernel_.of_tetrahedron(frame_, points, bounds);
    for (uint32_t f = 0; f < 4; ++f) {
      if ((wanted >> f & 1u) != 0) take(step, HalfFacet{first + f}, next[f], bounds.lower[f], bounds.upper[f]);
    }
  }
}

template <int D>
void SegmentFlood<D>::visit_any(uint32_t step) {
  const Cell c = notes_.steps[step].cell;
  const Shape shape = map_.shape(c);
  const double* corners[4 * D];
  uint32_t facets[4], count = 0, current = 0;
  double lower = HUGE_VAL, upper = HUGE_VAL;  // of the current facet
  const auto end_facet = [&] {
    if (lower == HUGE_VAL) return;
    const HalfFacet h = map_.half_facet(c, current);
    take(step, h, beyond(h), lower, upper);
    lower = upper = HUGE_VAL;
  };
  const auto bound = [&] {
    for (uint32_t i = count; i < 4; ++i) {
      for (uint32_t k = 0; k < uint32_t{D}; ++k) corners[4 * k + i] = corners[4 * k];
    }
    FacetBounds bounds;
    kernel_.of_triangles(frame_, corners, bounds);
    for (uint32_t i = 0; i < count; ++i) {
      if (facets[i] != current) end_facet();
      current = facets[i];
      lower = std::min(lower, bounds.lower[i]);
      upper = std::min(upper, bounds.upper[i]);
    }
    count = 0;
  };
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const Cell next = beyond(map_.half_facet(c, f));
    if (next.valid() && notes_.is_seen(next)) continue;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const uint16_t* local = shape.simplices() + uint32_t{D} * s;
      for (uint32_t k = 0; k < uint32_t{D}; ++k) corners[4 * k + count] = env_.point(c, local[k]);
      facets[count] = f;
      if (++count == 4) bound();
    }
  }
  if (count != 0) bound();
  end_facet();
}

template <int D>
void SegmentFlood<D>::take(uint32_t step, HalfFacet h, Cell beyond, double lower, double upper) {
  if (!(lower <= limit_)) return;
  if (!beyond.valid()) limit_ = std::min(limit_, upper);
  push({std::max(lower, 0.0), upper, h, step, beyond});
}

/** Keys of numbers that are not negative are in their order. Their lower halves are left out. */
template <int D>
uint64_t SegmentFlood<D>::key(double lower) noexcept {
  uint64_t bits = 0;
  std::memcpy(&bits, &lower, sizeof bits);
  return bits & 0xffffffff00000000u;
}

template <int D>
void SegmentFlood<D>::push(const Step& next) {
  notes_.queue.push_back(key(next.lower) | notes_.steps.size());
  std::push_heap(notes_.queue.begin(), notes_.queue.end(), std::greater<uint64_t>());
  notes_.steps.push_back(next);
}

/** An obstacle, unless another cell has seen it. */
template <int D>
void SegmentFlood<D>::measure(const Step& step) {
  const FeatureRef name = distances_.name(step.facet);
  for (Sight& sight : notes_.sights) {
    if (sight.feature.dimension != D - 1 || sight.feature.cell != name.cell || sight.feature.local != name.local)
      continue;
    notes_.views.push_back({step.from, sight.view});
    sight.view = static_cast<uint32_t>(notes_.views.size() - 1);
    return;
  }
  const SegmentWay at = distances_.to_facet(name.cell, map_.shape(name.cell), name.local, limit_);
  note_sight(distances_.length(at), at, name, step.from);
}

template <int D>
void SegmentFlood<D>::note_sight(double distance, const SegmentWay& at, const FeatureRef& feature, uint32_t step) {
  if (!(distance <= limit_)) return;
  // What is as near up to rounding is wanted, too.
  limit_ = std::min(limit_, distance + 0x1p-48 * largest_);
  const auto is_same = [&](const Sight& sight) {
    return !distances_.precedes(sight.feature, feature) && !distances_.precedes(feature, sight.feature);
  };
  const auto known = std::find_if(notes_.sights.begin(), notes_.sights.end(), is_same);
  const auto view = static_cast<uint32_t>(notes_.views.size());
  notes_.views.push_back({step, known == notes_.sights.end() ? Notes::kNone : known->view});
  if (known == notes_.sights.end()) {
    notes_.sights.push_back({distance, at, feature, view});
  } else {
    known->view = view;
  }
}

template <int D>
SearchEnd SegmentFlood<D>::decide() {
  Array<Sight>& sights = notes_.sights;
  if (sights.empty()) return limit_ == radius_ ? SearchEnd::kNothing : SearchEnd::kUnknown;
  std::sort(sights.begin(), sights.end(), [&](const Sight& a, const Sight& b) {
    return a.distance != b.distance ? a.distance < b.distance : distances_.precedes(a.feature, b.feature);
  });
  for (auto first = sights.begin(); first != sights.end() && first->distance <= limit_;) {
    const double end = first->distance;
    const auto last = std::find_if(first, sights.end(), [&](const Sight& sight) { return sight.distance != end; });
    const auto is_here = [&](const Sight& sight) { return is_reached(sight, end); };
    const auto found = std::find_if(sights.begin(), last, is_here);
    if (found < first && std::find_if(found + 1, first, is_here) != first) return SearchEnd::kUnknown;
    if (found != last) {
      distances_.report(found->distance, found->at, result_);
      result_.feature = found->feature;
      return SearchEnd::kFound;
    }
    first = last;
  }
  return SearchEnd::kUnknown;
}

/** Whether facets with keys up to a limit lead to a cell that sees an obstacle. */
template <int D>
bool SegmentFlood<D>::is_reached(const Sight& sight, double limit) {
  for (uint32_t view = sight.view; view != Notes::kNone; view = notes_.views[view].before) {
    if (is_reached(notes_.views[view].step, limit)) return true;
  }
  return false;
}

template <int D>
bool SegmentFlood<D>::is_reached(uint32_t step, double limit) {
  for (uint32_t s = step; notes_.steps[s].from != Notes::kNone; s = notes_.steps[s].from) {
    const Step& each = notes_.steps[s];
    if (!(each.upper <= limit || (each.lower <= limit && is_within(each.facet, limit))))
      return is_reached_otherwise(step, limit);
  }
  return true;
}

/** By other facets than those by which cells were entered. */
template <int D>
bool SegmentFlood<D>::is_reached_otherwise(uint32_t step, double limit) {
  ++search_;
  notes_.steps[step].search = search_;
  notes_.back.assign(1, step);
  while (!notes_.back.empty()) {
    const Step& here = notes_.steps[notes_.back.back()];
    notes_.back.pop_back();
    if (here.from == Notes::kNone) return true;
    for (uint32_t f = 0, count = map_.facets_of(here.cell); f < count; ++f) {
      const HalfFacet h = map_.half_facet(here.cell, f), o = map_.opposite(h);
      if (is_impassable(env_, h) || !notes_.is_seen(map_.cell_of(o))) continue;
      const uint32_t other = notes_.number_of(map_.cell_of(o));
      if (notes_.steps[other].search == search_ || !is_within(o, limit)) continue;
      notes_.steps[other].search = search_;
      notes_.back.push_back(other);
    }
  }
  return false;
}

/** Whether the key of a facet, as its cell sees it, is within a limit. */
template <int D>
bool SegmentFlood<D>::is_within(HalfFacet h, double limit) const {
  const Cell c = map_.cell_of(h);
  return distances_.length(distances_.to_facet(c, map_.shape(c), map_.local_of(h, c), limit)) <= limit;
}

template class SegmentFlood<2>;
template class SegmentFlood<3>;

}  // namespace dsw
