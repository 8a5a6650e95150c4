#include "topology/edit.h"

#include "base/error.h"
#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/marking.h"
#include "environment/validity.h"
#include "map/integrity.h"
#include "topology/layout.h"

namespace dsw {

template <int D>
Edit<D>::Edit(Environment<D>& env) : env_(env), map_(env.map) {
  make_ready(map_);
  local_points_.swap(env_.local_points);
  room_ = room_of(map_);
  point_doubles_ = env.owned_points.size();
  vertex_mark_words_ = env.vertex_marks.size();
}

template <int D>
Edit<D>::~Edit<D>() {
  if (finished_) return;
  if (applied_) revert();
  while (!made_.empty()) {
    const Made& made = made_.back();
    if (made.cell.valid()) untake_record(map_, made.cell.unit, made.units, room_);
    if (made.shape != kNoCell) untake_shape(map_, made.shape, room_);
    made_.pop_back();
  }
  shrink(map_, room_);
  local_points_.swap(env_.local_points);
  if (made_regions_) env_.regions.clear();
  if (made_tags_) env_.tags.clear();
  if (vertices_.empty()) return;
  for (size_t i = 0; i < vertices_.size(); ++i) {
    std::copy_n(&points_before_[i * D], D, env_.writable_points() + size_t{vertices_[i]} * D);
  }
  if (!env_.owned_points.empty()) env_.owned_points.resize(point_doubles_);
  env_.vertex_marks.resize(vertex_mark_words_);
}

template <int D>
void Edit<D>::remove(Cell c) {
  if (gone_.insert(c.unit) == removed_.size()) removed_.push_back(c);
}

template <int D>
CellDraft* Edit<D>::find_draft(Cell c) {
  CellDraft* found = nullptr;
  for_each_heir(c, [&](size_t i) {
    if (drafts_[i].from == c) found = &drafts_[i];
    return found == nullptr;
  });
  return found;
}

template <int D>
size_t Edit<D>::replace(Cell c) {
  if (const CellDraft* const known = find_draft(c)) return static_cast<size_t>(known - drafts_.data());
  remove(c);
  return add(draft_of(env_, c));
}

template <int D>
size_t Edit<D>::add(CellDraft&& draft) {
  drafts_.push_back(std::move(draft));
  const size_t i = drafts_.size() - 1;
  note_heir(drafts_[i].from, static_cast<uint32_t>(i));
  for (const Cell c : drafts_[i].also) note_heir(c, static_cast<uint32_t>(i));
  return i;
}

template <int D>
void Edit<D>::note_heir(Cell c, uint32_t draft) {
  if (!c.valid()) return;
  const uint32_t cell = ancestors_.insert(c.unit);
  const auto heir = static_cast<uint32_t>(heirs_.size());
  heirs_.push_back({draft, kNoHeir});
  if (cell == heirs_of_.size()) {
    heirs_of_.push_back({heir, heir});
  } else {
    heirs_[heirs_of_[cell].last].next = heir;
    heirs_of_[cell].last = heir;
  }
}

template <int D>
uint32_t Edit<D>::add_vertex(const double* position) {
  const uint32_t v = map_.vertex_slots.upcoming(vertices_.size());
  if (v >= kVertexMask) fail(DSW_STATUS_TOO_LARGE, "there are 2^28 vertices already");
  reserve_more(vertices_, 1);
  if (!env_.vertex_marks.empty()) reserve_more(env_.vertex_marks, 1);
  std::copy_n(position, D, room_for(v));
  if (!env_.vertex_marks.empty()) env_.vertex_marks.resize(std::max(env_.vertex_marks.size(), size_t{v} / 64 + 1), 0);
  vertices_.push_back(v);
  return v;
}

/** Where the position of a new vertex is written; what is there now is kept. */
template <int D>
double* Edit<D>::room_for(uint32_t v) {
  const size_t at = size_t{v} * D;
  reserve_more(points_before_, D);
  if (env_.owned_points.empty()) {
    if (v >= env_.point_room)
      fail(DSW_STATUS_BORROWED, "the points belong to the host and have no room for vertex %u", v);
  } else if (at == env_.owned_points.size()) {
    reserve_more(env_.owned_points, D);
    env_.points = env_.owned_points.data();
    env_.owned_points.resize(at + D);
  }
  double* const point = env_.writable_points() + at;
  points_before_.insert(points_before_.end(), point, point + D);
  return point;
}

template <int D>
uint32_t Edit<D>::add_vertex(uint32_t a, uint32_t b, double share) {
  double point[D];
  point_at<D>(env_.point(a), env_.point(b), share, point);
  const uint32_t v = add_vertex(point);
  if (edge_marked(env_, a, b)) {
    set_mark(a, v, true);
    set_mark(v, b, true);
  }
  return v;
}

template <int D>
void Edit<D>::set_link(HalfFacet h, HalfFacet to, bool marked) {
  links_.push_back({h.word, map_.words[h.word], to.word | (marked ? kMarkBit : 0)});
}

template <int D>
void Edit<D>::set_mark(uint32_t a, uint32_t b, bool marked) {
  marks_.push_back({a, b, marked, false});
}
template <int D>
void Edit<D>::set_mark(uint32_t vertex, bool marked) {
  marks_.push_back({vertex, kNoCell, marked, false});
}

template <int D>
void Edit<D>::set_mark(Cell c, bool marked) {
  if (!is_removed(c)) {
    cell_marks_.push_back({c, marked, false});
    return;
  }
  for_each_heir(c, [&](size_t i) {
    set_draft_mark(i, marked);
    return true;
  });
}

template <int D>
void Edit<D>::set_draft_mark(size_t i, bool marked) noexcept {
  drafts_[i].marked = marked;
  uint32_t& word = map_.record(made_[i].cell)[0];
  word = marked ? word | kMarkBit : word & ~kMarkBit;
}

template <int D>
HalfFacet Edit<D>::half_facet(size_t i, uint32_t facet) const {
  return {word_of(i, facet)};
}

template <int D>
void Edit<D>::prepare(Array<uint32_t>* invalid) {
  dsw::sort(removed_.begin(), removed_.end(), [](Cell a, Cell b) { return a.unit < b.unit; });
  if (!removed_.empty()) {
    lowest_gone_ = removed_.front().unit;
    gone_span_ = removed_.back().unit - lowest_gone_;
  }
  for (const Cell c : removed_) reserve_return(map_, c);
  made_.reserve(drafts_.size());
  for (uint32_t i = 0; i < drafts_.size(); ++i) {
    if (write_record(i)) continue;
    if (invalid == nullptr) {
      const Cell from = drafts_[i].from;
      const char* const what = D == 3 ? "a sphere" : "a loop";
      if (!from.valid()) fail(DSW_STATUS_BAD_CELL, "the faces of new volume %u would not close %s", i, what);
      fail(DSW_STATUS_BAD_CELL, "the faces of a part of volume %u would not close %s", map_.index(from), what);
    }
    invalid->push_back(i);
  }
  if (invalid != nullptr && !invalid->empty()) return;
  choose_indices();
  collect_links();
  connect();
  check_cells(invalid);
  if (invalid != nullptr && !invalid->empty()) return;
  drop_marks();
  count_all();
  reserve();
}

/** False: its facets would not close a sphere, in the plane a loop. */
template <int D>
bool Edit<D>::write_record(size_t i) {
  Layout& layout = layout_;
  if (!lay_out<D>(drafts_[i], layout)) return false;
  const size_t first = words_.size();
  words_.resize(first + layout.facets.size());
  made_.emplace_back();
  Made& made = made_.back();
  made.first_word = first;
  if (layout.form == Form::kGeneral) {
    write_general(layout, made);
  } else {
    const bool is_simplex = layout.form == Form::kSimplex;
    made.units = is_simplex ? 1 : 2;
    made.cell = {take_record(map_, made.units)};
    uint32_t* const w = map_.record(made.cell);
    std::copy(layout.vertices.begin(), layout.vertices.end(), w + (is_simplex ? 0 : kUnitWords<D>));
    if (!is_simplex) w[0] = static_cast<uint32_t>(layout.form) << kFormShift | layout.cuts;
  }
  for (size_t f = 0; f < layout.facets.size(); ++f) {
    words_[first + f] = map_.half_facet(made.cell, layout.facets[f]).word;
  }
  return true;
}

template <int D>
void Edit<D>::write_general(const Layout& layout, Made& made) {
  const auto facets = static_cast<uint32_t>(layout.facets.size());
  const auto count = static_cast<uint32_t>(layout.vertices.size());
  made.shape = take_shape(map_, layout.table);
  made.units = general_units<D>(facets, count);
  made.cell = {take_record(map_, made.units)};
  uint32_t* const w = map_.record(made.cell);
  w[0] = static_cast<uint32_t>(Form::kGeneral) << kFormShift | made.shape;
  write_continuations<D>(w, made.units);
  for (uint32_t k = 0; k < count; ++k) w[item_word<D>(first_vertex_item<D>(facets) + k)] = layout.vertices[k];
}

/** A cell that only changes keeps its index and gets the next generation. */
template <int D>
void Edit<D>::choose_indices() {
  for (size_t i = 0; i < drafts_.size(); ++i) {
    const CellDraft& draft = drafts_[i];
    const bool keeps = draft.from.valid() && draft.keeps_index && map_.cell_slots.can_renew(map_.index(draft.from));
    made_[i].index = keeps ? map_.index(draft.from) : map_.cell_slots.upcoming(fresh_++);
    map_.cell_of_unit[made_[i].cell.unit] = made_[i].index;
    cells_ += 1;
  }
  cells_ -= static_cast<int64_t>(removed_.size());
}

template <int D>
typename Edit<D>::Link* Edit<D>::find_link(uint32_t word) {
  return &*std::lower_bound(links_.begin(), links_.end(), Link{word, 0, 0});
}

/** Every half-facet of a cell that stays whose link has to change. Unless a new facet claims it, it then is on the
 * outside. */
template <int D>
void Edit<D>::collect_links() {
  const auto add = [&](HalfFacet h) {
    const uint32_t before = map_.words[h.word];
    links_.push_back({h.word, before, kNoFacet | (before & kMarkBit)});
  };
  for (const Cell c : removed_) {
    for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) {
      const HalfFacet o = map_.opposite(map_.half_facet(c, f));
      if (o.valid() && !is_removed(map_.cell_of(o))) add(o);
    }
  }
  for (const CellDraft& draft : drafts_) {
    for (const FacetDraft& facet : draft.facets) {
      if (facet.far.valid() && !map_.opposite(facet.far).valid() && !is_removed(map_.cell_of(facet.far)))
        add(facet.far);
    }
  }
  dsw::sort(links_.begin(), links_.end());
}

/** What a facet comes from: the half-facet's address, or of a pair its number from the end of the same range; kNoFacet:
 * from nothing. */
template <int D>
uint32_t Edit<D>::origin_of(const FacetDraft& facet) {
  return facet.pair != kNoPair ? kNoPair - 1 - facet.pair : facet.near.word;
}

template <int D>
void Edit<D>::connect() {
  Origins origins(env_.memory);
  origins.keys.reserve(words_.size());
  origins.first.reserve(words_.size());
  origins.list.reserve(words_.size());
  for (auto i = static_cast<uint32_t>(drafts_.size()); i-- != 0;) {
    for (auto f = static_cast<uint32_t>(drafts_[i].facets.size()); f-- != 0;) {
      const uint32_t key = origin_of(drafts_[i].facets[f]);
      if (key == kNoFacet) continue;
      const uint32_t number = origins.keys.insert(key);
      if (number == origins.first.size()) origins.first.push_back(kNoOrigin);
      origins.list.push_back({i, f, origins.first[number]});
      origins.first[number] = static_cast<uint32_t>(origins.list.size() - 1);
    }
  }
  for (size_t i = 0; i < drafts_.size(); ++i) {
    for (uint32_t f = 0; f < drafts_[i].facets.size(); ++f) connect(i, f, origins);
  }
}

/** Writes the link of a new facet, and that which leads back if it belongs to a cell that stays. */
template <int D>
void Edit<D>::connect(size_t i, uint32_t f, const Origins& origins) {
  const FacetDraft& facet = drafts_[i].facets[f];
  const uint32_t mark = facet.marked ? kMarkBit : 0;
  uint32_t& word = map_.words[word_of(i, f)];
  word = kNoFacet | mark;
  if (facet.pair == kNoPair && !facet.far.valid()) return;
  if (facet.pair == kNoPair && !is_removed(map_.cell_of(facet.far))) {
    word = facet.far.word | mark;
    find_link(facet.far.word)->after = word_of(i, f) | mark;
    return;
  }
  const uint32_t number = origins.keys.find(facet.pair != kNoPair ? origin_of(facet) : facet.far.word);
  for (uint32_t k = number == KeyTable::kNone ? kNoOrigin : origins.first[number]; k != kNoOrigin;
       k = origins.list[k].next) {
    const Origin& at = origins.list[k];
    const FacetDraft& other = drafts_[at.draft].facets[at.facet];
    if (&other == &facet || !face_each_other(facet, other)) continue;
    if (at.draft == i) fail(DSW_STATUS_BAD_TOPOLOGY, "a volume would lie on both sides of one of its faces");
    DSW_ASSERT(cut_alike(facet, other) && facet.marked == other.marked);
    word = word_of(at.draft, at.facet) | mark;
    return;
  }
}

template <int D>
void Edit<D>::check_cells(Array<uint32_t>* invalid) {
  for (uint32_t i = 0; i < made_.size(); ++i) {
    const Cell c = made_[i].cell;
    const CellState state = check_cell(env_, c);
    const CellDraft& draft = drafts_[i];
    if (state != CellState::kValid && state != CellState::kValidConvex) {
      if (invalid != nullptr) {
        invalid->push_back(i);
        continue;
      }
      const bool inverted = state == CellState::kInverted;
      const char* const what = inverted ? "turned inside out" : "flat, folded, or cover a part of itself twice";
      if (!draft.from.valid()) fail(DSW_STATUS_INVALID_CELL, "new volume %u would be %s", i, what);
      fail(DSW_STATUS_INVALID_CELL, "a part of volume %u would be %s", map_.index(draft.from), what);
    }
    uint32_t& word0 = map_.record(c)[0];
    if (map_.form(c) != Form::kSimplex && state == CellState::kValidConvex) word0 |= map_.convex_bit;
    if (draft.marked) word0 |= kMarkBit;
  }
}

/** Whether an edge of a cell that goes is still that of a new cell, or of one that stays and is joined to it. `drafted`
 * has the marked edges of new cells. */
template <int D>
bool Edit<D>::is_edge_left(Dart d, const KeyTable& drafted) const {
  if (drafted.find(pair_key(dart_vertex(map_, d), dart_target(map_, d))) != KeyTable::kNone) return true;
  bool left = false;
  for_each_volume_round_edge(map_, d, [&](Dart e) {
    left = !is_removed(e.cell);
    return !left;
  });
  return left;
}

/** Marks of edges that are no more. */
template <int D>
void Edit<D>::drop_marks() {
  if (env_.edge_marks.size() == 0) return;
  KeyTable drafted(env_.memory);
  for (const CellDraft& draft : drafts_) {
    for (const FacetDraft& facet : draft.facets) {
      for (uint32_t k = 0; k < facet.loop.size(); ++k) {
        const uint32_t a = facet.loop[k], b = facet.after(k);
        if (edge_marked(env_, a, b)) drafted.insert(pair_key(a, b));
      }
    }
  }
  for (const Cell c : removed_) {
    const Shape shape = map_.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      const uint32_t a = map_.vertex(c, shape.dart_vertex(d)), b = dart_target(map_, {c, d});
      if (a < b && edge_marked(env_, a, b) && !is_edge_left({c, d}, drafted)) set_mark(a, b, false);
    }
  }
}

template <int D>
void Edit<D>::count(uint32_t link, int sign) noexcept {
  const bool outer = (link & ~kMarkBit) == kNoFacet;
  sides_ += sign;
  boundary_ += outer ? sign : 0;
  if ((link & kMarkBit) != 0) marked_ += outer ? 2 * sign : sign;
}

template <int D>
void Edit<D>::count_all() noexcept {
  for (const Cell c : removed_) {
    for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) count(map_.words[map_.half_facet(c, f).word], -1);
  }
  for (const uint32_t word : words_) count(map_.words[word], 1);
  for (const Link& link : links_) {
    count(link.before, -1);
    count(link.after, 1);
  }
}

template <int D>
void Edit<D>::reserve() {
  map_.cell_slots.reserve(fresh_, removed_.size());
  reserve_more(map_.unit_of_cell, fresh_);
  env_.checked.make_room(map_.index_count() + fresh_);
  env_.index.make_room(made_.size());
  reserve_labels();
  size_t corners = 0;
  for (const Cell c : removed_) corners += map_.vertices_of(c);
  map_.vertex_slots.reserve(vertices_.size(), corners);
  reserve_more(map_.vertex_uses, vertices_.size());
  size_t edges = 0;
  for (const MarkChange& mark : marks_) edges += mark.marked && mark.b != kNoCell ? 1u : 0u;
  reserve_edge_marks(env_, edges);
  collect_exits();
  changes_.reserve(most_changes());
}

/** Exits among the facets of new cells. */
template <int D>
void Edit<D>::collect_exits() {
  if (env_.exits.empty()) return;
  for (uint32_t i = 0; i < drafts_.size(); ++i) {
    const Array<FacetDraft>& facets = drafts_[i].facets;
    for (uint32_t f = 0; f < facets.size(); ++f) {
      const HalfFacet h = half_facet(i, f);
      if (facets[f].exit_patch == 0 || map_.opposite(h).valid()) continue;
      exits_.push_back({made_[i].index, map_.local_of(h, made_[i].cell), facets[f].exit_patch});
    }
  }
  env_.exits.reserve(exits_.size());
}

/** New volumes can be the first with labels. */
template <int D>
void Edit<D>::reserve_labels() {
  const auto reserve = [&](auto& labels, auto label_of, bool& made) {
    if (labels.empty()) {
      if (dsw::all_of(drafts_.begin(), drafts_.end(), [&](const CellDraft& draft) { return label_of(draft) == 0; }))
        return;
      labels.reserve(map_.index_count() + fresh_);
      labels.assign(map_.index_count(), 0);
      made = true;
    }
    reserve_more(labels, fresh_);
  };
  reserve(
      env_.regions, [](const CellDraft& draft) { return draft.region; }, made_regions_);
  reserve(
      env_.tags, [](const CellDraft& draft) { return draft.tag; }, made_tags_);
  for (CellDraft& draft : drafts_) draft.parent = draft.from.valid() ? env_.parent(draft.from) : kNoCell;
  if (!env_.parents.empty()) reserve_more(env_.parents, fresh_);
}

template class Edit<2>;
template class Edit<3>;

}  // namespace dsw
