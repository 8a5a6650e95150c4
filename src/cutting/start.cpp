#include "cutting/start.h"

#include "base/dimensions.h"
#include "locate/locate.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Cells in the order of their centres' distance from the blade. */
template <int D>
class Search {
 public:
  Search(const Environment<D>& env, const Blade<D>& blade, const BladeTree<D>& tree)
      : env_(env), tree_(tree), crossings_(env, blade) {}

  Cell run(Cell from, uint32_t* visited) {
    const size_t patience = env_.index.is_ready(env_) ? kFew : std::max<size_t>(kFew, env_.map.cell_count / kFew);
    uint32_t in_vain = 0;
    push(from);
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell c{static_cast<uint32_t>(seen_[heap_.back().number])};
      heap_.pop_back();
      if (is_met(c)) {
        *visited += in_vain;
        return c;
      }
      if (++in_vain == patience && misses_all()) break;
      for (uint32_t f = 0, facets = env_.map.facets_of(c); f < facets; ++f) {
        const HalfFacet o = env_.map.opposite(env_.map.half_facet(c, f));
        if (o.valid()) push(env_.map.cell_of(o));
      }
    }
    return {};
  }

 private:
  static constexpr size_t kFew =
      64;  // cells; without a tree of cells one look at all of them takes as long as a search
           // through this part of them

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
    heap_.push_back({tree_.distance(from, &nearest_), number});
    std::push_heap(heap_.begin(), heap_.end());
  }
  bool is_met(Cell c) {
    bool met = false;
    tree_.for_each_in({env_, c}, [&](uint32_t simplex) { met = met || crossings_.is_met(c, simplex); });
    return met;
  }
  /** Whether the blade meets no cell, wherever that is. */
  bool misses_all() {
    return for_each_near(env_, tree_, [&](Cell c, uint32_t simplex) { return !crossings_.is_met(c, simplex); });
  }

  const Environment<D>& env_;
  const BladeTree<D>& tree_;
  Crossings<D> crossings_;
  KeyTable seen_{env_.memory};
  Array<Entry> heap_{env_.memory};
  uint32_t nearest_ = 0;  // simplex to the cell that was pushed last
};

/** What locate_blade() finds, where there will be no tree of cells: in one scan for all points. */
template <int D>
Cell locate_by_scan(const Environment<D>& env, const Blade<D>& blade, const BladeTree<D>& tree) {
  uint32_t first = blade.point_count();
  Cell found;
  for (uint32_t i = 0; i < env.map.index_count() && first != 0; ++i) {
    const Cell c = env.map.cell(i);
    if (!c.valid() || !admits(env, c)) continue;
    const typename BladeTree<D>::Box box(env, c);
    tree.for_each_in(box, [&](uint32_t simplex) {
      for (int k = 0; k < D; ++k) {
        const uint32_t point = blade.corner(simplex, k);
        if (point >= first || !box.holds(blade.point(point)) || !contains(env, c, blade.point(point))) continue;
        first = point;
        found = c;
      }
    });
  }
  return found;
}

/** The cell of the first point of the blade that is in any. */
template <int D>
Cell locate_blade(const Environment<D>& env, const Blade<D>& blade, const BladeTree<D>& tree) {
  if (env.index.use() == TreeUse::kLeftOut) return locate_by_scan(env, blade, tree);
  for (uint32_t i = 0; i < blade.point_count(); ++i) {
    const Cell found = locate(env, blade.point(i), {}, nullptr).cell;
    if (found.valid()) return found;
  }
  return {};
}

}  // namespace

template <int D>
Cell find_start(const Environment<D>& env, const Blade<D>& blade, const BladeTree<D>& tree, Cell hint,
                uint32_t* visited) {
  if (hint.valid()) return Search<D>(env, blade, tree).run(hint, visited);
  const Cell found = locate_blade(env, blade, tree);
  if (found.valid()) return found;
  // A blade that is larger than the environment is looked for from anywhere.
  for (uint32_t i = 0; i < env.map.index_count(); ++i) {
    const Cell any = env.map.cell(i);
    if (any.valid() && admits(env, any)) return Search<D>(env, blade, tree).run(any, visited);
  }
  return {};
}

DSW_INSTANTIATE(find_start);

}  // namespace dsw
