#include "locate/nearest_search.h"

#include <algorithm>

#include "base/compiler.h"

namespace dsw {

template <int D>
NearestSearch<D>::NearestSearch(const Distances<D>& distances, const CellTree<D>& tree, const double* point, Cell start,
                                double radius)
    : distances_(distances),
      env_(distances.environment()),
      map_(env_.map),
      tree_(tree),
      point_(point),
      start_(start),
      radius_(radius),
      nearest_(HUGE_VAL),
      sights_(Allocator<Sight>(env_.memory)),
      looked_(env_.memory),
      known_(env_.memory),
      seen_(env_.memory),
      levels_(Allocator<double>(env_.memory)),
      steps_(Allocator<Step>(env_.memory)),
      heap_(env_.memory) {
  slack_ = 0x1p-44 * tree.length();
}

/** Sights up to here count: those of the nearest obstacle, however they are rounded. */
template <int D>
double NearestSearch<D>::reach() const {
  return std::min(radius_, nearest_ + (0x1p-44 * nearest_ + slack_));
}

template <int D>
SearchEnd NearestSearch<D>::run(NearestResult& result) {
  if (!gather()) return SearchEnd::kUnknown;
  result.volumes_visited = looked_.size();
  if (sights_.empty()) return SearchEnd::kNothing;
  if (!set_levels()) return SearchEnd::kUnknown;
  double end = HUGE_VAL;
  for (const Sight& sight : sights_) end = std::min(end, std::max(sight.distance, sight.level));
  if (!(end <= reach())) return SearchEnd::kUnknown;
  const Sight* best = nullptr;
  for (const Sight& sight : sights_) {
    if (sight.level > end || (best != nullptr && sight.distance > best->distance)) continue;
    if (best == nullptr || sight.distance < best->distance || distances_.precedes(sight.feature, best->feature))
      best = &sight;
  }
  distances_.report(best->distance, best->at, result);
  result.feature = best->feature;
  result.volumes_visited += step_count_;
  return SearchEnd::kFound;
}

/** False: too far outside, or too much. */
template <int D>
bool NearestSearch<D>::gather() {
  const auto visit = [&](uint32_t index) {
    const Cell c = map_.cell(index);
    if (c.valid() && sights_.size() <= kMostSights && looked_.find(c.unit) == KeyTable::kNone) look(c);
    return reach();
  };
  env_.obstacles.for_each_beside(tree_, visit);
  if (!tree_.visit_near(point_, reach(), visit)) return false;
  forget_far();
  return sights_.size() <= kMostSights;
}

template <int D>
void NearestSearch<D>::forget_far() {
  const double limit = reach();
  const auto is_far = [&](const Sight& sight) { return sight.distance > limit; };
  sights_.erase(std::remove_if(sights_.begin(), sights_.end(), is_far), sights_.end());
}

template <int D>
void NearestSearch<D>::look(Cell c) {
  looked_.insert(c.unit);
  if (is_closed(env_, c)) return;
  const auto see = [&](double distance, const Vec& at, const FeatureRef& feature) {
    nearest_ = std::min(nearest_, distance);
    if (distance <= reach()) sights_.push_back({distance, HUGE_VAL, at, feature, c});
  };
  const Shape shape = map_.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = map_.half_facet(c, f);
    if (!is_impassable(env_, h)) continue;
    const FeatureRef name = distances_.name(h);
    const Vec at = distances_.to_obstacle(name);
    see(Distances<D>::length(at), at, name);
  }
  distances_.for_each_thin(c, shape, see);
  if (sights_.size() > kMostSights / 2) forget_far();
}

/** Calls visit(cell, key) for passable facets through which the flood may enter a cell, where is_wanted(cell). */
template <int D>
template <class Wanted, class Visit>
void NearestSearch<D>::for_each_way_in(Cell c, Wanted is_wanted, Visit visit) const {
  const uint32_t facets = map_.facets_of(c);
  for (uint32_t f = 0; f < facets; ++f) {
    const HalfFacet o = map_.opposite(map_.half_facet(c, f));
    if (o.valid()) prefetch_line(&map_.words[o.word - o.word % kUnitWords<D>]);
  }
  for (uint32_t f = 0; f < facets; ++f) {
    const HalfFacet h = map_.half_facet(c, f);
    if (is_impassable(env_, h)) continue;
    const HalfFacet o = map_.opposite(h);
    const Cell from = map_.cell_of(o);
    if (is_wanted(from))
      visit(from, Distances<D>::length(distances_.to_facet(from, map_.shape(from), map_.local_of(o, from))));
  }
}

/** False: too much work. */
template <int D>
bool NearestSearch<D>::set_levels() {
  // The nearest first: its way back passes most others.
  std::stable_sort(sights_.begin(), sights_.end(),
                   [](const Sight& a, const Sight& b) { return a.distance < b.distance; });
  for (size_t i = 0; i < sights_.size(); ++i) {
    Sight& sight = sights_[i];
    size_t same = 0;
    while (sights_[same].cell != sight.cell) ++same;
    sight.level = same < i ? sights_[same].level : level_of(sight.cell);
    if (step_count_ > kMostSteps) return false;
  }
  return true;
}

/** The level of a cell, or infinity if it is beyond the reach. Cells from which it can be entered are found in the
 * order of keys, so the largest key when the start is found is the level. */
template <int D>
double NearestSearch<D>::level_of(Cell c) {
  const double limit = reach();
  double level = 0;
  steps_.clear();
  seen_.clear();
  heap_.clear();
  heap_.push({0, c, kNoCell});
  while (!heap_.empty()) {
    const Step step = heap_.pop();
    const auto number = static_cast<uint32_t>(steps_.size());
    if (seen_.insert(step.cell.unit) != number) continue;
    steps_.push_back(step);
    level = std::max(level, step.key);
    const uint32_t known = known_.find(step.cell.unit);
    if (step.cell == start_ || (known != KeyTable::kNone && levels_[known] <= level)) {
      note_way(number);
      return level;
    }
    if (++step_count_ > kMostSteps) break;
    const auto is_new = [&](Cell from) { return seen_.find(from.unit) == KeyTable::kNone; };
    for_each_way_in(step.cell, is_new, [&](Cell from, double key) {
      if (!(key <= limit)) return;
      for (uint32_t i = 0, n = map_.vertices_of(from); i < n; ++i) prefetch_line(env_.point(from, i));
      heap_.push({key, from, number});
    });
  }
  return HUGE_VAL;
}

/** Notes the levels, at most, of the cells on the way from a step to where the search began. */
template <int D>
void NearestSearch<D>::note_way(uint32_t number) {
  const uint32_t first = known_.find(steps_[number].cell.unit);
  double level = first != KeyTable::kNone ? levels_[first] : 0;
  while (number != kNoCell) {
    const uint32_t known = known_.insert(steps_[number].cell.unit);
    if (known == levels_.size()) levels_.push_back(level);
    levels_[known] = std::min(levels_[known], level);
    level = std::max(level, steps_[number].key);
    number = steps_[number].next;
  }
}

template class NearestSearch<2>;
template class NearestSearch<3>;

}  // namespace dsw
