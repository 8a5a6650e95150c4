#include "locate/nearest.h"

#include <algorithm>

#include "locate/nearest_search.h"

namespace dsw {
namespace {

template <int D>
class Flood {
 public:
  Flood(const Distances<D>& distances, Cell start, double radius, NearestResult& result)
      : distances_(distances),
        env_(distances.environment()),
        map_(env_.map),
        result_(result),
        heap_(Allocator<Waiting>(env_.memory)),
        seen_(64, kNoCell, Allocator<uint32_t>(env_.memory)),
        best_(radius * distances.scale()) {
    heap_.push_back({0, map_.index(start)});
  }

  /** Visits at most so many cells. Whether it is done. */
  bool run(uint32_t most) {
    while (!heap_.empty() && heap_.front().distance <= best_) {
      if (most == 0) return false;
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell c = map_.cell(heap_.back().index);
      heap_.pop_back();
      if (!see(c)) continue;
      --most;
      ++result_.volumes_visited;
      visit(c);
    }
    return true;
  }
  /** Once it is done: whether there is anything. */
  bool finish() {
    if (found_) distances_.report(best_, at_, result_);
    return found_;
  }

 private:
  void visit(Cell c) {
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map_.half_facet(c, f);
      const bool impassable = is_impassable(env_, h);
      if (!impassable && is_seen(map_.cell_of(map_.opposite(h)))) continue;
      const Vec at = distances_.to_facet(c, shape, f);
      const double distance = Distances<D>::length(at);
      if (!(distance <= best_)) continue;
      if (impassable) {
        offer(distance, at, distances_.name(h));
      } else {
        // A cell can stand in the heap once for each of its facets: a nearer way in must not be lost to a farther one.
        heap_.push_back({distance, map_.index(map_.cell_of(map_.opposite(h)))});
        std::push_heap(heap_.begin(), heap_.end());
      }
    }
    distances_.for_each_thin(c, shape, [&](double distance, const Vec& at, const FeatureRef& feature) {  //
      offer(distance, at, feature);
    });
  }

  void offer(double distance, const Vec& at, const FeatureRef& feature) {
    if (!(distance <= best_)) return;
    if (found_ && distance == best_ && !distances_.precedes(feature, result_.feature)) return;
    found_ = true;
    best_ = distance;
    at_ = at;
    result_.feature = feature;
  }

  /** Enters a cell into the set of seen ones; whether it is new. Open addressing, at most half full. */
  bool see(Cell c) {
    if (2 * (seen_count_ + 1) > seen_.size()) {
      Array<uint32_t> old(2 * seen_.size(), kNoCell, seen_.get_allocator());
      old.swap(seen_);
      for (const uint32_t unit : old) {
        if (unit != kNoCell) seen_[slot_of(unit)] = unit;
      }
    }
    uint32_t& slot = seen_[slot_of(c.unit)];
    if (slot == c.unit) return false;
    slot = c.unit;
    ++seen_count_;
    return true;
  }
  bool is_seen(Cell c) const { return seen_[slot_of(c.unit)] == c.unit; }
  size_t slot_of(uint32_t unit) const {
    const size_t mask = seen_.size() - 1;
    size_t slot = (unit * 0x9e3779b1u) & mask;
    while (seen_[slot] != kNoCell && seen_[slot] != unit) slot = (slot + 1) & mask;
    return slot;
  }

  const Distances<D>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  NearestResult& result_;
  Array<Waiting> heap_;
  Array<uint32_t> seen_;
  size_t seen_count_ = 0;
  double best_;
  Vec at_{};
  bool found_ = false;
};

constexpr uint32_t kFewCells = 8;  // are visited in the time that the tree of obstacles takes

}  // namespace

template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result) {
  result = {};
  const Distances<D> distances(env, point);
  Flood<D> flood(distances, start, radius, result);
  flood.run(kNoCell);
  return flood.finish();
}

template <int D>
bool find_nearest_far(const Environment<D>& env, const double* point, Cell start, double radius,
                      NearestResult& result) {
  result = {};
  const Distances<D> distances(env, point);
  Flood<D> flood(distances, start, radius, result);
  if (flood.run(kFewCells)) return flood.finish();
  if (distances.scale() == 1) {
    const CellTree<D>* tree = env.obstacles.find(env);
    if (tree == nullptr) {
      const bool is_done = flood.run(env.obstacles.patience(env));
      env.obstacles.note_flood(env, result.volumes_visited);
      if (is_done) return flood.finish();
      tree = env.obstacles.find(env);
    }
    NearestResult other;
    const SearchEnd end =
        tree == nullptr ? SearchEnd::kUnknown : NearestSearch<D>(distances, *tree, point, start, radius).run(other);
    if (end != SearchEnd::kUnknown) {
      other.volumes_visited += result.volumes_visited;
      result = other;
      return end == SearchEnd::kFound;
    }
  }
  flood.run(kNoCell);
  return flood.finish();
}

#define DSW_NEAREST(D)                                                                            \
  template bool find_nearest(const Environment<D>&, const double*, Cell, double, NearestResult&); \
  template bool find_nearest_far(const Environment<D>&, const double*, Cell, double, NearestResult&)
DSW_NEAREST(2);
DSW_NEAREST(3);
#undef DSW_NEAREST

}  // namespace dsw
