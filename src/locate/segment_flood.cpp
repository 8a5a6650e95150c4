#include "locate/segment_flood.h"

#include <algorithm>

#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr uint32_t kMostTogether = 8;  // cells that are visited together
constexpr uint32_t kLanes = 8;         // of bounds

template <int D>
double largest_coordinate(const Environment<D>& env, const FromSegment<D>& segment) {
  double most = 0;
  for (const double* p : {env.lower, env.upper, segment.from, segment.to}) {
    for (int k = 0; k < D; ++k) most = std::max(most, std::fabs(p[k]));
  }
  return most;
}

}  // namespace

template <int D>
SegmentFlood<D>::SegmentFlood(const Distances<D, FromSegment<D>>& distances, double radius, SegmentNotes& notes,
                              SegmentNearest& result)
    : distances_(distances),
      env_(distances.environment()),
      map_(env_.map),
      kernel_(bounds_kernel<D>()),
      notes_(notes),
      result_(result),
      radius_(radius),
      largest_(largest_coordinate(env_, distances.from())),
      frame_(distances.from().from, distances.from().line.along, largest_) {
  set_limit(radius);
  notes_.clear();
  notes_.now.clear();
  notes_.later.clear();
  notes_.steps.clear();
  notes_.sights.clear();
  notes_.views.clear();
}

template <int D>
void SegmentFlood<D>::set_limit(double limit) {
  limit_ = limit;
  bound_ = static_cast<float>(std::min(limit * frame_.scale, 0x1p100) * (1 + 0x1p-22));
}

template <int D>
SearchEnd SegmentFlood<D>::run() {
  if (distances_.scale() != 1) return SearchEnd::kUnknown;
  for (const Cell c : notes_.starts) enter({c, {}, 0, Notes::kNone, 0});
  visit_from(0);
  do {
    for (size_t next = 0, seen = 0; next < notes_.now.size();) {
      const auto first = static_cast<uint32_t>(notes_.steps.size());
      look_ahead(seen, next);
      while (next < seen && notes_.steps.size() < first + kMostTogether) {
        const Entry each = notes_.now[next++];
        if (!(each.lower <= bound_)) continue;
        const HalfFacet h{each.facet & ~kMarkBit};
        if (h.word != each.facet) {
          measure(h, each.from);
        } else {
          enter({map_.cell_of(h), h, each.upper, each.from, 0});
        }
      }
      look_ahead(seen, next);
      visit_from(first);
    }
    notes_.now.clear();
  } while (go_on());
  return decide();
}

/** Looks which of the next entries lead into impassable cells, and asks the memory for vertices of the others. */
template <int D>
void SegmentFlood<D>::look_ahead(size_t& seen, size_t next) {
  for (; seen < notes_.now.size() && seen < next + kMostTogether; ++seen) {
    Entry& each = notes_.now[seen];
    if ((each.facet & kMarkBit) != 0) continue;
    const HalfFacet h{each.facet};
    const Cell to = map_.cell_of(h);
    if (is_closed(env_, to)) {
      set_limit(std::min(limit_, each.upper / frame_.scale));
      each.facet = map_.opposite(h).word | kMarkBit;
    } else if (D == 3 && map_.form(to) == Form::kSimplex) {
      __builtin_prefetch(env_.point(map_.record(to)[kTetrahedronTips[local_in_tetrahedron(h)]] & kVertexMask));
    }
  }
}

template <int D>
void SegmentFlood<D>::enter(const Step& step) {
  if (notes_.see(step.cell, static_cast<uint32_t>(notes_.steps.size()))) notes_.steps.push_back(step);
}

/** Visits the cells that were entered from a step on. The bounds of tetrahedra are found together. */
template <int D>
void SegmentFlood<D>::visit_from(uint32_t first) {
  const auto last = static_cast<uint32_t>(notes_.steps.size());
  result_.volumes_visited += last - first;
  const double* vertices[4 * kMostTogether];
  uint32_t steps[kMostTogether], count = 0;
  FacetBounds bounds[kMostTogether / 2];
  const auto visit_tetrahedra = [&] {
    if constexpr (D == 3) {
      if (count % 2 != 0) std::copy_n(vertices + 4 * (count - 1), 4, vertices + 4 * count);
      for (uint32_t i = 0; i < count; i += 2) kernel_.of_tetrahedra(frame_, vertices + 4 * i, bounds[i / 2]);
    }
    for (uint32_t i = 0; i < count; ++i) visit_tetrahedron(steps[i], bounds[i / 2], i % 2 * 4);
    count = 0;
  };
  for (uint32_t step = first; step < last; ++step) {
    const Cell c = notes_.steps[step].cell;
    if (D == 2 || map_.form(c) != Form::kSimplex) {
      visit_any(step);
      continue;
    }
    const uint32_t* w = map_.record(c);
    for (uint32_t i = 0; i < 4; ++i) {
      vertices[4 * count + i] = env_.point(w[i] & kVertexMask);
    }
    steps[count] = step;
    if (++count == kMostTogether) visit_tetrahedra();
  }
  if (count != 0) visit_tetrahedra();
  if (env_.marked_edges == 0 && env_.marked_vertices == 0) return;
  for (uint32_t step = first; step < last; ++step) look_for_thin(step);
}

template <int D>
void SegmentFlood<D>::visit_tetrahedron(uint32_t step, const FacetBounds& bounds, uint32_t lane) {
  const Step& here = notes_.steps[step];
  const uint32_t first = here.cell.unit * kUnitWords<D> + 4, entry = here.facet.word - first;
  for (uint32_t f = 0; f < 4; ++f) {
    const float lower = bounds.lower[lane + f];
    if (lower <= bound_ && f != entry) take(step, {first + f}, lower, bounds.upper[lane + f]);
  }
}

template <int D>
void SegmentFlood<D>::visit_any(uint32_t step) {
  const Cell c = notes_.steps[step].cell;
  const HalfFacet entry = notes_.steps[step].facet;
  const Shape shape = map_.shape(c);
  const double* corners[kLanes * D];
  uint32_t facets[kLanes], count = 0, current = 0;
  float lower = HUGE_VALF, upper = HUGE_VALF;  // of the current facet
  const auto end_facet = [&] {
    if (lower <= bound_) take(step, map_.half_facet(c, current), lower, upper);
    lower = upper = HUGE_VALF;
  };
  const auto bound = [&] {
    for (uint32_t i = count; i < kLanes; ++i) {
      for (uint32_t k = 0; k < uint32_t{D}; ++k) corners[kLanes * k + i] = corners[kLanes * k];
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
    if (map_.half_facet(c, f) == entry) continue;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const uint16_t* local = shape.simplices() + uint32_t{D} * s;
      for (uint32_t k = 0; k < uint32_t{D}; ++k) corners[kLanes * k + count] = env_.point(c, local[k]);
      facets[count] = f;
      if (++count == kLanes) bound();
    }
  }
  if (count != 0) bound();
  end_facet();
}

/** Notes a facet within the limit of a cell that was entered. */
template <int D>
void SegmentFlood<D>::take(uint32_t step, HalfFacet h, float lower, float upper) {
  Entry next{lower, upper, h.word | kMarkBit, step};
  const uint32_t other = map_.words[h.word];  // no mark, or it is no facet
  if (other < kNoFacet) {
    next.facet = other;
    __builtin_prefetch(&map_.words[other]);
  } else {
    set_limit(std::min(limit_, upper / frame_.scale));
  }
  (next.lower <= soon_ ? notes_.now : notes_.later).push_back(next);
}

template <int D>
void SegmentFlood<D>::look_for_thin(uint32_t step) {
  const Cell c = notes_.steps[step].cell;
  distances_.for_each_thin(c, map_.shape(c), [&](double distance, const SegmentWay& at, const FeatureRef& feature) {
    note_sight(distance, at, feature, step);
  });
}

/** Chooses what comes next among what was left for later: the lower part. An exact order would take more time than it
 * saves, because an obstacle's upper bound sets the limit as soon as it is seen. Whether there is anything. */
template <int D>
bool SegmentFlood<D>::go_on() {
  float least = HUGE_VALF, sum = 0;
  size_t left = 0;
  for (const Entry& each : notes_.later) {
    if (!(each.lower <= bound_)) continue;
    least = std::min(least, each.lower);
    sum += each.lower;
    notes_.later[left++] = each;
  }
  notes_.later.resize(left);
  if (left == 0) return false;
  soon_ = least + std::max(0.0f, sum / static_cast<float>(left) - least) / 2;
  left = 0;
  for (const Entry& each : notes_.later) {
    if (each.lower <= soon_) {
      notes_.now.push_back(each);
    } else {
      notes_.later[left++] = each;
    }
  }
  notes_.later.resize(left);
  return true;
}

/** An obstacle that a cell sees, unless another one has seen it. */
template <int D>
void SegmentFlood<D>::measure(HalfFacet h, uint32_t step) {
  const FeatureRef name = distances_.name(h);
  for (Sight& sight : notes_.sights) {
    if (sight.feature.dimension != D - 1 || sight.feature.cell != name.cell || sight.feature.local != name.local)
      continue;
    notes_.views.push_back({step, sight.view});
    sight.view = static_cast<uint32_t>(notes_.views.size() - 1);
    return;
  }
  const SegmentWay at = distances_.to_facet(name.cell, map_.shape(name.cell), name.local, limit_);
  note_sight(distances_.length(at), at, name, step);
}

template <int D>
void SegmentFlood<D>::note_sight(double distance, const SegmentWay& at, const FeatureRef& feature, uint32_t step) {
  if (!(distance <= limit_)) return;
  // What is as near up to rounding is wanted, too.
  set_limit(std::min(limit_, distance + 0x1p-48 * largest_));
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
    if (!(each.upper / frame_.scale <= limit) && !is_within(map_.opposite(each.facet), limit))
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
