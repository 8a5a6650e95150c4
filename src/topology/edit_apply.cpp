// An edit that is prepared: applied, taken back, finished. Nothing here fails or allocates.

#include "base/position.h"
#include "base/search.h"
#include "environment/marking.h"
#include "topology/edit.h"

namespace dsw {

template <int D>
void Edit<D>::set_marks(bool back) noexcept {
  const auto set = [&](MarkChange& mark, bool marked) {
    return mark.b == kNoCell ? set_vertex_mark(env_, mark.a, marked) : set_edge_mark(env_, mark.a, mark.b, marked);
  };
  if (!back) {
    for (MarkChange& mark : marks_) mark.done = set(mark, mark.marked);
    for (CellMark& mark : cell_marks_) mark.done = set_cell_mark(env_, mark.cell, mark.marked);
    return;
  }
  for (size_t i = marks_.size(); i-- != 0;) {
    if (marks_[i].done) set(marks_[i], !marks_[i].marked);
  }
  for (const CellMark& mark : cell_marks_) {
    if (mark.done) set_cell_mark(env_, mark.cell, !mark.marked);
  }
}

template <int D>
void Edit<D>::apply() noexcept {
  version_ = env_.obstacle_version;
  env_.renew_version();
  for (const Link& link : links_) map_.words[link.word] = link.after;
  set_marks(false);
  forget_cells();
  applied_ = true;
}

template <int D>
void Edit<D>::revert() noexcept {
  for (const Link& link : links_) map_.words[link.word] = link.before;
  set_marks(true);
  forget_cells();
  env_.give_back_version(version_);
  applied_ = false;
}

/** What is known of cells may be so no more. */
template <int D>
void Edit<D>::forget_cells() noexcept {
  if (!env_.checked.active()) return;
  for (const Made& made : made_) env_.checked.open(made.index);
}

/** Ids from before, then those from after: slots are released last, so that no index is given out twice. */
template <int D>
void Edit<D>::log_changes() noexcept {
  const auto id = [&](Cell c) { return SlotPool::Slot{map_.index(c), map_.generation(c)}; };
  for (const CellDraft& draft : drafts_) {
    changes_.push_back({draft.from.valid() ? id(draft.from) : SlotPool::Slot{0, 0}, {0, 0}});
    for (const Cell c : draft.also) changes_.push_back({id(c), {0, 0}});
  }
  for (const Cell c : removed_) {
    if (ancestors_.find(c.unit) == KeyTable::kNone) changes_.push_back({id(c), {0, 0}});
  }
}

template <int D>
void Edit<D>::move_uses() noexcept {
  double* const points = env_.writable_points();
  for (const uint32_t v : vertices_) {
    map_.vertex_slots.acquire();
    if (v == map_.vertex_uses.size()) map_.vertex_uses.push_back(0);
  }
  map_.vertex_count = static_cast<uint32_t>(map_.vertex_slots.slot_count());
  const bool move = env_.checked.active();  // else all vertices that are in use are in the box
  for (const Made& made : made_) {
    map_.for_each_vertex(made.cell, [&](uint32_t v) {
      if (map_.vertex_uses[v]++ != 0 && !move) return;
      for (int axis = 0; axis < D; ++axis) {
        env_.lower[axis] = std::min(env_.lower[axis], env_.point(v)[axis]);
        env_.upper[axis] = std::max(env_.upper[axis], env_.point(v)[axis]);
      }
    });
  }
  for (const Cell c : removed_) {
    map_.for_each_vertex(c, [&](uint32_t v) {
      if (--map_.vertex_uses[v] != 0 || points == nullptr) return;
      set_vertex_mark(env_, v, false);
      map_.vertex_slots.release(v);
      std::fill_n(points + size_t{v} * D, D, 0.0);
    });
  }
}

/** Exits of cells that go, and those that are sewn to something, are no more. */
template <int D>
void Edit<D>::move_exits() noexcept {
  if (env_.exits.empty()) return;
  const auto has_exit = [&](Cell c) { return env_.exits.has_cell(map_.index(c)); };
  const bool any =
      !exits_.empty() || dsw::any_of(removed_.begin(), removed_.end(), has_exit) ||
      dsw::any_of(links_.begin(), links_.end(), [&](const Link& link) { return has_exit(map_.cell_of({link.word})); });
  if (!any) return;
  env_.exits.remove_if([&](const Exit& exit) {
    const Cell c = map_.cell(exit.cell);
    return is_removed(c) || map_.opposite(map_.half_facet(c, exit.local)).valid();
  });
  env_.exits.set(exits_.data(), exits_.size());
}

template <int D>
void Edit<D>::finish() noexcept {
  log_changes();
  move_exits();
  for (const Cell c : removed_) env_.marked_cells -= map_.marked(c) ? 1u : 0u;
  move_uses();
  size_t at = 0;
  for (uint32_t k = 0; k < fresh_; ++k) {
    const uint32_t index = map_.cell_slots.acquire().index;
    if (index < map_.unit_of_cell.size()) continue;
    map_.unit_of_cell.push_back(kNoCell);
    if (!env_.regions.empty()) env_.regions.push_back(0);
    if (!env_.parents.empty()) env_.parents.push_back(kNoCell);
    if (!env_.tags.empty()) env_.tags.push_back(0);
  }
  for (const Cell c : removed_) map_.unit_of_cell[map_.index(c)] = kNoCell;
  for (size_t i = 0; i < made_.size(); ++i) {
    const CellDraft& draft = drafts_[i];
    const uint32_t index = made_[i].index;
    map_.unit_of_cell[index] = made_[i].cell.unit;
    env_.index.add(index);
    if (draft.from.valid() && map_.index(draft.from) == index) map_.cell_slots.renew(index);
    if (!env_.regions.empty()) env_.regions[index] = draft.region;
    if (!env_.parents.empty()) env_.parents[index] = draft.parent;
    if (!env_.tags.empty()) env_.tags[index] = draft.tag;
    env_.marked_cells += draft.marked ? 1u : 0u;
    const SlotPool::Slot after{index, map_.cell_slots.generation(index)};
    changes_[at++].after = after;
    for (size_t k = 0; k < draft.also.size(); ++k) changes_[at++].after = after;
  }
  if (env_.obstacles.exists()) {
    for (const Made& made : made_) env_.obstacles.note_cell(made.index);
    for (const Link& link : links_) env_.obstacles.note_cell(map_.index(map_.cell_of({link.word})));
  }
  for (const Cell c : removed_) {
    if (map_.unit_of_cell[map_.index(c)] == kNoCell) map_.cell_slots.release(map_.index(c));
    give_back(map_, c);
  }
  map_.cell_count = static_cast<uint32_t>(map_.cell_count + cells_);
  map_.facet_count = static_cast<uint32_t>(map_.facet_count + (sides_ + boundary_) / 2);
  map_.boundary_facet_count = static_cast<uint32_t>(map_.boundary_facet_count + boundary_);
  env_.marked_facets = static_cast<uint64_t>(static_cast<int64_t>(env_.marked_facets) + marked_ / 2);
  map_.is_as_created = false;
  finished_ = true;
}

template void Edit<2>::apply() noexcept;
template void Edit<3>::apply() noexcept;
template void Edit<2>::revert() noexcept;
template void Edit<3>::revert() noexcept;
template void Edit<2>::finish() noexcept;
template void Edit<3>::finish() noexcept;

}  // namespace dsw
