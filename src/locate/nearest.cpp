#include "locate/nearest.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "locate/bounded_flood.h"
#include "locate/nearest_search.h"
#include "walk/cast.h"

namespace dsw {
namespace {

template <int D, class From>
class Flood {
 public:
  using Way = typename From::Way;

  Flood(const Distances<D, From>& distances, double radius, FloodNotes& notes, typename From::Result& result)
      : distances_(distances),
        env_(distances.environment()),
        map_(env_.map),
        result_(result),
        notes_(notes),
        best_(radius * distances.scale()) {
    notes_.clear();
  }

  /** Notes a cell that holds part of what is asked from. */
  void begin_in(Cell c) { wait({0, map_.index(c)}); }
  /** Visits at most so many cells. Whether it is done. */
  bool run(uint32_t most) {
    Array<Waiting>& heap = notes_.waiting;
    while (!heap.empty() && heap.front().distance <= limit()) {
      if (most == 0) return false;
      level_ = std::max(level_, heap.front().distance);
      std::pop_heap(heap.begin(), heap.end());
      const Cell c = map_.cell(heap.back().index);
      heap.pop_back();
      if (!notes_.see(c)) continue;
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
  /** How far the flood goes: to the nearest obstacle, and always through all cells of the present level. So the order
   * of cells in a level does not decide. */
  double limit() const { return std::max(best_, level_); }

  void visit(Cell c) {
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map_.half_facet(c, f);
      const bool impassable = is_impassable(env_, h);
      if (!impassable && notes_.is_seen(map_.cell_of(map_.opposite(h)))) continue;
      if (impassable) {
        const FeatureRef name = distances_.name(h);
        const Way at = distances_.to_obstacle(name, best_);
        offer(distances_.length(at), at, name);
        continue;
      }
      const double key = distances_.length(distances_.to_facet(c, shape, f, limit()));
      // A cell can stand in the heap once for each of its facets: a nearer way in must not be lost to a farther one.
      if (key <= limit()) wait({key, map_.index(map_.cell_of(map_.opposite(h)))});
    }
    distances_.for_each_thin(c, shape, [&](double distance, const Way& at, const FeatureRef& feature) {  //
      offer(distance, at, feature);
    });
  }

  void offer(double distance, const Way& at, const FeatureRef& feature) {
    if (!(distance <= best_)) return;
    if (found_ && distance == best_ && !distances_.precedes(feature, result_.feature)) return;
    found_ = true;
    best_ = distance;
    at_ = at;
    result_.feature = feature;
  }

  void wait(const Waiting& next) {
    notes_.waiting.push_back(next);
    std::push_heap(notes_.waiting.begin(), notes_.waiting.end());
  }

  const Distances<D, From>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  typename From::Result& result_;
  FloodNotes& notes_;
  double best_, level_ = 0;  // the largest distance at which a cell was entered
  Way at_{};
  bool found_ = false;
};

// So many cells are visited before the tree of obstacles is asked. Without a radius fewer: in the time that the tree
// takes. With one, the flood mostly ends by itself.
constexpr uint32_t kFewCells = 8, kFewCellsWithin = 64;

}  // namespace

template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result) {
  FloodNotes notes(env.memory);
  return find_nearest_by_flood(env, point, start, radius, notes, result);
}

template <int D>
bool find_nearest_by_flood(const Environment<D>& env, const double* point, Cell start, double radius, FloodNotes& notes,
                           NearestResult& result) {
  result = {};
  const Distances<D> distances(env, point);
  Flood<D, FromPoint<D>> flood(distances, radius, notes, result);
  flood.begin_in(start);
  flood.run(kNoCell);
  return flood.finish();
}

template <int D>
bool find_nearest_far(const Environment<D>& env, const double* point, Cell start, double radius, BoundedNotes& notes,
                      NearestResult& result) {
  result = {};
  const Distances<D> distances(env, point);
  const uint32_t few = std::isfinite(radius) ? kFewCellsWithin : kFewCells;
  notes.starts.assign(1, start);
  BoundedFlood<D, FromPoint<D>> near(distances, radius, notes, result);
  SearchEnd end = near.run(few);
  if (end != SearchEnd::kUnknown) return end == SearchEnd::kFound;
  Flood<D, FromPoint<D>> flood(distances, radius, notes, result);
  flood.begin_in(start);
  if (!near.is_cut_off() && flood.run(few)) return flood.finish();
  if (distances.scale() == 1) {
    const CellTree<D>* tree = env.obstacles.find(env);
    if (tree == nullptr) {
      const bool is_done = flood.run(env.obstacles.patience(env));
      env.obstacles.note_flood(env, result.volumes_visited);
      if (is_done) return flood.finish();
      tree = env.obstacles.find(env);
    }
    NearestResult other;
    if (tree != nullptr) end = NearestSearch<D>(distances, *tree, point, start, radius).run(other);
    if (end != SearchEnd::kUnknown) {
      other.volumes_visited += result.volumes_visited;
      result = other;
      return end == SearchEnd::kFound;
    }
  }
  flood.run(kNoCell);
  return flood.finish();
}

namespace {

/** Answers as find_nearest_far does, without the tree: it visits the cells that are nearer than the answer. */
template <int D>
bool find_nearest_near(const Environment<D>& env, const double* point, Cell start, double radius, BoundedNotes& notes,
                       NearestResult& result, bool by_flood) {
  if (!by_flood) {
    notes.starts.assign(1, start);
    const SearchEnd end = BoundedFlood<D, FromPoint<D>>(Distances<D>(env, point), radius, notes, result).run();
    if (end != SearchEnd::kUnknown) return end == SearchEnd::kFound;
  }
  return find_nearest_by_flood(env, point, start, radius, notes, result);
}

/** The facet that ends a cast, at distance 0. */
template <int D>
void report_crossed(const Distances<D, FromSegment<D>>& distances, const double* from, const double* to,
                    const CastResult& hit, SegmentNearest& result) {
  result.feature = distances.name(hit.facet);
  result.crossed = hit.facet;
  result.parameter = crossing_time(distances.environment(), hit.cell, hit.simplex, from, to);
  point_at<D>(from, to, result.parameter, result.segment_point);
  std::copy_n(result.segment_point, D, result.point);
  result.volumes_visited = hit.volumes_visited;
}

}  // namespace

template <int D>
bool find_nearest_to_segment(const Environment<D>& env, const double* from, const double* to, Cell start, double radius,
                             BoundedNotes& notes, SegmentNearest& result, bool by_flood) {
  result = {};
  if (std::equal(from, from + D, to)) {  // a point
    result.last = start;
    const bool found = find_nearest_near(env, from, start, radius, notes, result, by_flood);
    if (found) std::copy_n(from, D, result.segment_point);
    return found;
  }
  const Distances<D, FromSegment<D>> distances(env, from, to);
  // A cast does not throw.
  struct Entered {
    Array<Cell>* cells;
    bool is_lost;
  } entered{&notes.starts, false};
  notes.starts.assign(1, start);
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  request.crossing_user = &entered;
  request.crossing = [](void* user, Cell, uint32_t, Cell cell) {
    Entered& all = *static_cast<Entered*>(user);
    try {
      all.cells->push_back(cell);
    } catch (const std::bad_alloc&) {
      all.is_lost = true;
    }
  };
  const CastResult path = cast(env, request, nullptr);
  if (entered.is_lost) throw std::bad_alloc();
  result.last = path.cell;
  if (path.end == CastEnd::kHit) {
    report_crossed(distances, from, to, path, result);
    return true;
  }
  if (!by_flood) {
    const SearchEnd end = BoundedFlood<D, FromSegment<D>>(distances, radius, notes, result).run();
    if (end != SearchEnd::kUnknown) return end == SearchEnd::kFound;
  }
  Flood<D, FromSegment<D>> flood(distances, radius, notes, result);
  for (const Cell c : notes.starts) flood.begin_in(c);
  flood.run(kNoCell);
  return flood.finish();
}

void FloodNotes::clear() noexcept {
  waiting.clear();
  seen_count_ = 0;
  if (++round_ != 0) return;
  std::fill(slots_.begin(), slots_.end(), Slot{});
  round_ = 1;
}

void FloodNotes::grow() {
  Array<Slot> old(2 * slots_.size(), Slot{}, slots_.get_allocator());
  old.swap(slots_);
  for (const Slot& each : old) {
    if (each.entry >> 32 == round_) slots_[slot_of(each.entry)] = each;
  }
}

#define DSW_NEAREST(D)                                                                                               \
  template bool find_nearest(const Environment<D>&, const double*, Cell, double, NearestResult&);                    \
  template bool find_nearest_by_flood(const Environment<D>&, const double*, Cell, double, FloodNotes&,               \
                                      NearestResult&);                                                               \
  template bool find_nearest_far(const Environment<D>&, const double*, Cell, double, BoundedNotes&, NearestResult&); \
  template bool find_nearest_to_segment(const Environment<D>&, const double*, const double*, Cell, double,           \
                                        BoundedNotes&, SegmentNearest&, bool)
DSW_NEAREST(2);
DSW_NEAREST(3);
#undef DSW_NEAREST

}  // namespace dsw
