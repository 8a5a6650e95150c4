#include "locate/bounded_flood.h"

#include <algorithm>

#include "base/compiler.h"
#include "base/search.h"
#include "base/sort.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr uint32_t kLanes = 8;  // of bounds

template <int D>
double largest_near(const Environment<D>& env, const FromSegment<D>& segment) {
  return largest_coordinate<D>(env.lower, env.upper, segment.from, segment.to);
}
template <int D>
double largest_near(const Environment<D>& env, const FromPoint<D>& from) {
  return largest_coordinate<D>(env.lower, env.upper, from.point);
}

template <int D>
SegmentFrame<D> frame_of(const FromSegment<D>& segment, double largest) {
  return {segment.from, segment.line.along, largest};
}
template <int D>
SegmentFrame<D> frame_of(const FromPoint<D>& from, double largest) {
  return {from.point, Vec::Zero(), largest};
}

}  // namespace

template <int D, class From>
BoundedFlood<D, From>::BoundedFlood(const Distances<D, From>& distances, double radius, BoundedNotes& notes,
                                    typename From::Result& result)
    : distances_(distances),
      env_(distances.environment()),
      map_(env_.map),
      kernel_(bounds_kernel<D>()),
      notes_(notes),
      sights_(notes.template sights<Way>()),
      result_(result),
      has_thin_(env_.marked_edges != 0 || env_.marked_vertices != 0),
      radius_(radius),
      largest_(largest_near(env_, distances.from())),
      frame_(frame_of(distances.from(), largest_)) {
  set_limit(radius);
  notes_.clear();
  notes_.later.clear();
  notes_.steps.clear();
  sights_.clear();
  notes_.views.clear();
}

template <int D, class From>
void BoundedFlood<D, From>::set_limit(double limit) {
  limit_ = limit;
  bound_ = static_cast<float>(std::min(limit * frame_.scale, 0x1p100) * (1 + 0x1p-22));
}

template <int D, class From>
SearchEnd BoundedFlood<D, From>::run(uint32_t most) {
  if (distances_.scale() != 1) return SearchEnd::kUnknown;
  for (const Cell c : notes_.starts) enter({c, {}, 0, Notes::kNone, 0});
  visit_tetrahedra();
  while (go_on()) {
    look_ahead();
    for (const Entry& each : notes_.now) {
      if (!(each.lower <= bound_)) continue;
      const HalfFacet h{each.facet & ~kMarkBit};
      if (h.word != each.facet) {
        measure(h, each.from);
      } else {
        enter({map_.cell_of(h), h, each.upper, each.from, 0});
      }
    }
    visit_tetrahedra();
    is_cut_off_ = notes_.steps.size() > most;
    if (is_cut_off_) break;
  }
  result_.volumes_visited = static_cast<uint32_t>(notes_.steps.size());
  return is_cut_off_ ? SearchEnd::kUnknown : decide();
}

/** Moves the nearer part of what waits to `now`. Returns whether anything waits. An exact order would cost more than it
 * saves, because an obstacle's upper bound sets the limit as soon as it is seen. No branch depends on a bound: it could
 * not be foreseen. */
template <int D, class From>
bool BoundedFlood<D, From>::go_on() {
  Array<Entry>&now = notes_.now, &later = notes_.later;
  float sum = 0, least = HUGE_VALF;
  size_t left = 0;
  for (const Entry each : later) {
    const bool counts = each.lower <= bound_;
    later[left] = each;
    sum += counts ? each.lower : 0;
    least = counts ? std::min(least, each.lower) : least;
    left += counts;
  }
  if (left == 0) return false;
  const float soon = std::max(least, 1.5f * sum / static_cast<float>(left));
  now.resize(left);
  size_t first = 0, kept = 0;
  for (size_t i = 0; i < left; ++i) {
    const Entry each = later[i];
    const bool is_soon = each.lower <= soon;
    now[first] = each;
    later[kept] = each;
    first += is_soon;
    kept += !is_soon;
  }
  now.resize(first);
  later.resize(kept);
  return true;
}

/** Looks which of the next entries lead into impassable cells, and asks the memory for vertices of the others. */
template <int D, class From>
void BoundedFlood<D, From>::look_ahead() {
  for (Entry& each : notes_.now) {
    if ((each.facet & kMarkBit) != 0) continue;
    const HalfFacet h{each.facet};
    const Cell to = map_.cell_of(h);
    if (is_closed(env_, to)) {
      set_limit(std::min(limit_, each.upper / frame_.scale));
      each.facet = map_.opposite(h).word | kMarkBit;
    } else if (D == 3 && map_.form(to) == Form::kSimplex) {
      prefetch_line(env_.point(map_.record(to)[kTetrahedronTips[local_in_tetrahedron(h)]] & kVertexMask));
    }
  }
}

template <int D, class From>
void BoundedFlood<D, From>::enter(const Step& step) {
  const auto number = static_cast<uint32_t>(notes_.steps.size());
  if (!notes_.see(step.cell, number)) return;
  notes_.steps.push_back(step);
  const uint32_t* const w = map_.record(step.cell);
  if (D == 2 || form_of(w[0]) != Form::kSimplex) {
    visit_any(number);
  } else {
    for (uint32_t i = 0; i < 4; ++i) waiting_vertices_[4 * waiting_ + i] = env_.point(w[i] & kVertexMask);
    waiting_steps_[waiting_] = number;
    if (++waiting_ == kMostTogether) visit_tetrahedra();
  }
  if (!has_thin_) return;
  distances_.for_each_thin(
      step.cell, map_.shape(step.cell),
      [&](double distance, const Way& at, const FeatureRef& feature) { note_sight(distance, at, feature, number); });
}

/** Visits the tetrahedra that wait, two at a time. */
template <int D, class From>
void BoundedFlood<D, From>::visit_tetrahedra() {
  if constexpr (D == 3) {
    if (waiting_ % 2 != 0) std::copy_n(waiting_vertices_ + 4 * (waiting_ - 1), 4, waiting_vertices_ + 4 * waiting_);
    for (uint32_t i = 0; i < waiting_; i += 2) {
      FacetBounds bounds;
      kernel_.of_tetrahedra(frame_, waiting_vertices_ + 4 * i, bounds);
      uint32_t within = 0;
      for (uint32_t lane = 0; lane < kLanes; ++lane) within |= uint32_t{bounds.lower[lane] <= bound_} << lane;
      if (waiting_ == i + 1) within &= 0xf;
      for (; within != 0; within &= within - 1) {
        const auto lane = lowest_bit(within);
        const uint32_t step = waiting_steps_[i + lane / 4];
        const HalfFacet h{notes_.steps[step].cell.unit * kUnitWords<D> + 4 + lane % 4};
        if (h != notes_.steps[step].facet) take(step, h, bounds.lower[lane], bounds.upper[lane]);
      }
    }
  }
  waiting_ = 0;
}

template <int D, class From>
void BoundedFlood<D, From>::visit_any(uint32_t step) {
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
template <int D, class From>
void BoundedFlood<D, From>::take(uint32_t step, HalfFacet h, float lower, float upper) {
  Entry next{lower, upper, h.word | kMarkBit, step};
  const uint32_t other = map_.words[h.word];  // no mark, or it is no facet
  if (other < kNoFacet) {
    next.facet = other;
    prefetch_line(&map_.words[other]);
  } else {
    set_limit(std::min(limit_, upper / frame_.scale));
  }
  notes_.later.push_back(next);
}

/** An obstacle that a cell sees, unless another one has seen it. */
template <int D, class From>
void BoundedFlood<D, From>::measure(HalfFacet h, uint32_t step) {
  const FeatureRef name = distances_.name(h);
  for (Sight& sight : sights_) {
    if (sight.feature.dimension != D - 1 || sight.feature.cell != name.cell || sight.feature.local != name.local)
      continue;
    notes_.views.push_back({step, sight.view});
    sight.view = static_cast<uint32_t>(notes_.views.size() - 1);
    return;
  }
  const Way at = distances_.to_obstacle(name, limit_);
  note_sight(distances_.length(at), at, name, step);
}

template <int D, class From>
void BoundedFlood<D, From>::note_sight(double distance, const Way& at, const FeatureRef& feature, uint32_t step) {
  if (!(distance <= limit_)) return;
  // What is as near up to rounding is wanted, too.
  set_limit(std::min(limit_, distance + 0x1p-48 * largest_));
  const auto is_same = [&](const Sight& sight) {
    return !distances_.precedes(sight.feature, feature) && !distances_.precedes(feature, sight.feature);
  };
  const auto known = dsw::find_if(sights_.begin(), sights_.end(), is_same);
  const auto view = static_cast<uint32_t>(notes_.views.size());
  notes_.views.push_back({step, known == sights_.end() ? Notes::kNone : known->view});
  if (known == sights_.end()) {
    sights_.push_back({distance, at, feature, view});
  } else {
    known->view = view;
  }
}

template <int D, class From>
SearchEnd BoundedFlood<D, From>::decide() {
  if (sights_.empty()) return limit_ == radius_ ? SearchEnd::kNothing : SearchEnd::kUnknown;
  dsw::sort(sights_.begin(), sights_.end(), [&](const Sight& a, const Sight& b) {
    return a.distance != b.distance ? a.distance < b.distance : distances_.precedes(a.feature, b.feature);
  });
  for (auto first = sights_.begin(); first != sights_.end() && first->distance <= limit_;) {
    const double end = first->distance;
    const auto last = dsw::find_if(first, sights_.end(), [&](const Sight& sight) { return sight.distance != end; });
    const auto is_here = [&](const Sight& sight) { return is_reached(sight, end); };
    const auto found = dsw::find_if(sights_.begin(), last, is_here);
    if (found < first && dsw::find_if(found + 1, first, is_here) != first) return SearchEnd::kUnknown;
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
template <int D, class From>
bool BoundedFlood<D, From>::is_reached(const Sight& sight, double limit) {
  for (uint32_t view = sight.view; view != Notes::kNone; view = notes_.views[view].before) {
    if (is_reached(notes_.views[view].step, limit)) return true;
  }
  return false;
}

template <int D, class From>
bool BoundedFlood<D, From>::is_reached(uint32_t step, double limit) {
  for (uint32_t s = step; notes_.steps[s].from != Notes::kNone; s = notes_.steps[s].from) {
    const Step& each = notes_.steps[s];
    if (!(each.upper / frame_.scale <= limit) && !is_within(map_.opposite(each.facet), limit))
      return is_reached_otherwise(step, limit);
  }
  return true;
}

/** By other facets than those by which cells were entered. */
template <int D, class From>
bool BoundedFlood<D, From>::is_reached_otherwise(uint32_t step, double limit) {
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
template <int D, class From>
bool BoundedFlood<D, From>::is_within(HalfFacet h, double limit) const {
  const Cell c = map_.cell_of(h);
  return distances_.length(distances_.to_facet(c, map_.shape(c), map_.local_of(h, c), limit)) <= limit;
}

template class BoundedFlood<2, FromPoint<2>>;
template class BoundedFlood<3, FromPoint<3>>;
template class BoundedFlood<2, FromSegment<2>>;
template class BoundedFlood<3, FromSegment<3>>;

}  // namespace dsw
