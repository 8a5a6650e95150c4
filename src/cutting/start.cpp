#include "cutting/start.h"

#include "base/dimensions.h"
#include "locate/locate.h"

namespace dsw {
namespace {

/** Cells in the order of their centres' distance from the blade. */
template <int D>
class Search {
 public:
  Search(const Environment<D>& env, const Blade<D>& blade) : env_(env), blade_(blade), crossings_(env, blade) {}

  Cell run(Cell from, uint32_t* visited) {
    push(from);
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell c{static_cast<uint32_t>(seen_[heap_.back().number])};
      heap_.pop_back();
      if (crossings_.is_met(c)) return c;
      ++*visited;
      for (uint32_t f = 0, facets = env_.map.facets_of(c); f < facets; ++f) {
        const HalfFacet o = env_.map.opposite(env_.map.half_facet(c, f));
        if (o.valid()) push(env_.map.cell_of(o));
      }
    }
    return {};
  }

 private:
  struct Entry {
    double distance;
    uint32_t number;  // among the cells seen
    bool operator<(const Entry& o) const { return distance != o.distance ? distance > o.distance : number > o.number; }
  };

  void push(Cell c) {
    const uint32_t number = seen_.size();
    if (!admits(env_, c) || seen_.insert(c.unit) != number) return;
    double from[D];
    centre(env_, c, from);
    double least = HUGE_VAL;
    for (uint32_t s = 0; s < blade_.simplex_count(); ++s) {
      const double* corners[D];
      blade_.corners(s, corners);
      least = std::min(least, distance_to_simplex<D>(from, corners));
    }
    heap_.push_back({least, number});
    std::push_heap(heap_.begin(), heap_.end());
  }

  const Environment<D>& env_;
  const Blade<D>& blade_;
  Crossings<D> crossings_;
  KeyTable seen_{env_.memory};
  Array<Entry> heap_{env_.memory};
};

}  // namespace

template <int D>
Cell find_start(const Environment<D>& env, const Blade<D>& blade, Cell hint, uint32_t* visited) {
  if (hint.valid()) return Search<D>(env, blade).run(hint, visited);
  for (uint32_t i = 0; i < blade.point_count(); ++i) {
    const Cell found = locate(env, blade.point(i), {}, nullptr).cell;
    if (found.valid()) return found;
  }
  // A blade that is larger than the environment is looked for from anywhere.
  for (uint32_t i = 0; i < env.map.index_count(); ++i) {
    const Cell any = env.map.cell(i);
    if (any.valid() && admits(env, any)) return Search<D>(env, blade).run(any, visited);
  }
  return {};
}

DSW_INSTANTIATE(find_start);

}  // namespace dsw
