#include "cutting/cut.h"

#include "base/search.h"
#include "base/sort.h"
#include "environment/marking.h"
#include "environment/recut.h"
#include "map/dart.h"

namespace dsw {

template <int D>
Cut<D>::Cut(Environment<D>& env, const Blade<D>& blade, const CutSettings& settings, const Crossings<D>& crossings,
            const Inside<D>* inside)
    : env_(env),
      map_(env.map),
      blade_(blade),
      settings_(settings),
      crossings_(crossings),
      inside_(inside),
      record_(env.memory) {
  section_.emplace(env, crossings_, settings.snap);
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    if (!can_split(crossings_.cell(i).cell)) section_->keep_whole(i);
  }
}

template <int D>
bool Cut<D>::can_split(Cell c) const {
  switch (settings_.splits) {
    case Splits::kAll:
      return true;
    case Splits::kNothing:
      return false;
    default:
      return map_.marked(c) == (settings_.splits == Splits::kImpassable);
  }
}

/** Cells that come out invalid stay whole, and all is written anew: each time more of them, so this ends. */
template <int D>
void Cut<D>::prepare(std::optional<Edit<D>>& edit) {
  Array<uint32_t> invalid{env_.memory};
  for (;;) {
    edit.emplace(env_);
    if (!write(*edit)) continue;
    invalid.clear();
    edit->prepare(&invalid);
    if (invalid.empty() && !undo_idle_splits(*edit)) break;
    for (const uint32_t draft : invalid) keep_whole(origins_[draft]);
  }
  write_record(*edit);
}

/** Cells with both parts on one side stay whole; whether there were any. */
template <int D>
bool Cut<D>::undo_idle_splits(const Edit<D>& edit) {
  if (inside_ == nullptr) return false;
  const auto is_inside = [&](size_t draft) {
    double at[D];
    centre(env_, edit.cell(draft), at);
    return inside_->holds(origins_[draft], at);
  };
  bool any = false;
  for (const Split& split : splits_) {
    if (is_inside(split.front) != is_inside(split.back)) continue;
    section_->keep_whole(split.cell);
    any = true;
  }
  return any;
}

/** False: something has to stay whole first. */
template <int D>
bool Cut<D>::write(Edit<D>& edit) {
  drafts_.clear();
  origins_.clear();
  splits_.clear();
  choose_nodes(edit);
  if constexpr (D == 3) choose_lines();
  choose_cells();
  bool all = true;
  for (uint32_t i = 0; i < changed_.size(); ++i) {
    drafts_.push_back(origins_.size());
    if (write_cell(edit, i)) continue;
    keep_whole({static_cast<uint32_t>(changed_[i])});
    all = false;
  }
  if (!all) return false;
  find_old_faces();
  if (settings_.unsew) unsew_old_faces(edit);
  return true;
}

/** Vertices for the nodes of loops. */
template <int D>
void Cut<D>::choose_nodes(Edit<D>& edit) {
  vertices_.assign(section_->node_count(), kNoCell);
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    for (const uint32_t n : section_->loop(i)) {
      if (vertices_[n] != kNoCell) continue;
      const Node& node = section_->node(n);
      vertices_[n] = node.is_old() ? node.a : edit.add_vertex(node.a, node.b, node.share);
    }
  }
}

template <int D>
void Cut<D>::choose_lines() {
  line_numbers_ = KeyTable(env_.memory);
  lines_.clear();
  lines_.reserve(section_->chord_count());
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    if (section_->loop(i).empty()) continue;
    section_->for_each_chord(i, [&](const Chord& chord) {
      const HalfFacet h = map_.half_facet(crossings_.cell(i).cell, chord.facet), o = map_.opposite(h);
      if (line_numbers_.insert(std::min(h.word, o.word)) != lines_.size()) return;
      lines_.emplace_back(env_.scratch.memory());
      lines_.back().facet = h;
      lines_.back().from = vertices_[chord.from];
      lines_.back().to = vertices_[chord.to];
    });
  }
}

/** Cells that are split, and those at new vertices and lines. Where a boundary is pinched an edge has volumes that are
 * not joined with each other there: if one of those changes, all that are joined with it do. */
template <int D>
void Cut<D>::choose_cells() {
  changed_ = KeyTable(env_.memory);
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    if (!section_->loop(i).empty()) changed_.insert(crossings_.cell(i).cell.unit);
  }
  for (const Line& line : lines_) {
    const HalfFacet o = map_.opposite(line.facet);
    if (o.valid()) changed_.insert(map_.cell_of(o).unit);
  }
  on_edges_.clear();
  first_on_edges_.clear();
  ShortArray<uint32_t, 64> looked_up(env_.scratch.memory());
  for (uint32_t i = 0; i < changed_.size(); ++i) {
    const Cell c{static_cast<uint32_t>(changed_[i])};
    const Shape shape = map_.shape(c);
    const uint32_t count = shape.dart_count(), met = crossings_.number(c);
    const size_t first = on_edges_.size();
    first_on_edges_.push_back(static_cast<uint32_t>(first));
    const uint32_t* on = met == KeyTable::kNone ? nullptr : section_->nodes_on(met);
    if (on == nullptr) {
      look_up_nodes(c, shape, looked_up);
      on = looked_up.data();
    }
    const uint16_t *const facets = shape.dart_vertices() + count, *const beta2 = facets + count;
    for (uint32_t d = 0; d < count; ++d) {
      if (on[d] == KeyTable::kNone || vertices_[on[d]] == kNoCell) continue;
      if (beta2[d] >= d) on_edges_.push_back({on[d], d});
      const HalfFacet o = map_.opposite(map_.half_facet(c, facets[d]));
      if (o.valid()) changed_.insert(map_.cell_of(o).unit);
    }
    dsw::sort(on_edges_.begin() + static_cast<ptrdiff_t>(first), on_edges_.end(),
              [](const OnEdge& a, const OnEdge& b) { return a.node < b.node; });
  }
  first_on_edges_.push_back(static_cast<uint32_t>(on_edges_.size()));
}

/** Finds for any cell what Section::nodes_on() gives for a met cell. */
template <int D>
void Cut<D>::look_up_nodes(Cell c, const Shape& shape, ShortArray<uint32_t, 64>& out) const {
  const DartEnds<D> darts(map_, c);
  out.clear();
  for (uint32_t d = 0; d < darts.count(); ++d) {
    const uint32_t other = shape.dart_beta2(d);
    out.push_back(other < d ? out[other] : section_->node_on(darts.start(d), darts.end(d)));
  }
}

/** False: it can't be written. */
template <int D>
bool Cut<D>::write_cell(Edit<D>& edit, uint32_t number) {
  const Cell c{static_cast<uint32_t>(changed_[number])};
  CellDraft draft = draft_of(env_, c);
  edit.remove(c);
  insert_vertices(draft, number);
  if constexpr (D == 3) {
    if (!write_lines(draft)) return false;
  }
  const uint32_t cell = crossings_.number(c);
  if (cell != KeyTable::kNone && !section_->loop(cell).empty()) return split_cell(edit, cell, draft);
  edit.add(std::move(draft));
  origins_.push_back(c);
  return true;
}

/** Puts the parts of facets in their places. False: they can't be drawn. */
template <int D>
bool Cut<D>::write_lines(CellDraft& draft) {
  for (uint32_t f = 0, facets = map_.facets_of(draft.from); f < facets; ++f) {
    const HalfFacet h = map_.half_facet(draft.from, f), o = map_.opposite(h);
    const uint32_t number = line_numbers_.find(std::min(h.word, o.word));
    if (number == KeyTable::kNone) continue;
    Line& line = lines_[number];
    if (!line.drawn && !draw_line(draft.facets[f], line)) return false;
    // The first of the two cells that is written sees the parts as they were drawn.
    const bool first = line.parts[0].near == h;
    draft.facets[f] = first ? line.parts[0] : turned(line.parts[0]);
    draft.facets.push_back(first ? line.parts[1] : turned(line.parts[1]));
  }
  return true;
}

/** In the order of nodes, so that facets are cut alike on both sides. */
template <int D>
void Cut<D>::insert_vertices(CellDraft& draft, uint32_t number) const {
  const Shape shape = map_.shape(draft.from);
  for (uint32_t k = first_on_edges_[number]; k < first_on_edges_[number + 1]; ++k) {
    const Node& node = section_->node(on_edges_[k].node);
    const uint32_t middle = vertices_[on_edges_[k].node];
    if constexpr (D == 3) {
      insert_vertex(draft, shape, on_edges_[k].dart, node.a, node.b, middle);
    } else {
      insert_vertex(draft, node.a, node.b, middle);
    }
  }
}

/** False: there are no triangles for one of the parts. */
template <int D>
bool Cut<D>::draw_line(const FacetDraft& whole, Line& line) const {
  line.parts[0] = part_of(whole, line.from, line.to);
  line.parts[1] = part_of(whole, line.to, line.from);
  line.drawn = true;
  if (share_triangles(whole, line.parts[0], line.parts[1])) return true;
  double apex[3], beyond[3];
  centre(env_, map_.cell_of(whole.near), apex);
  if (whole.far.valid()) centre(env_, map_.cell_of(whole.far), beyond);
  for (FacetDraft& part : line.parts) {
    part.triangles.clear();
    if (part.loop.size() > kMostTriangulated) return false;
    if (!cut_anew(env_, part, part.loop, apex, whole.far.valid() ? beyond : nullptr)) return false;
  }
  return true;
}

template <int D>
bool Cut<D>::split_cell(Edit<D>& edit, uint32_t cell, CellDraft& whole) {
  const NodeLoop& nodes = section_->loop(cell);
  FacetDraft face(env_.scratch.memory());
  for (const uint32_t n : nodes) face.loop.push_back(vertices_[n]);
  CellDraft left(env_.scratch.memory());
  left.from = whole.from;
  left.marked = whole.marked;
  left.region = whole.region;
  left.tag = whole.tag;
  CellDraft right = left;
  if (!part_along(whole, face.loop, left, right)) return false;
  FacetDraft of_left = turned(face);
  if constexpr (D == 2) {
    std::swap(of_left, face);  // left of the way from node to node; in space of the loop as it is seen from outside
  } else {
    double left_apex[D], right_apex[D];
    centre(env_, left, left_apex);
    centre(env_, right, right_apex);
    if (!cut_anew(env_, of_left, of_left.loop, left_apex, right_apex)) return false;
    cut_like(face, of_left);
  }
  if (!settings_.unsew) face.pair = of_left.pair = static_cast<uint32_t>(splits_.size());
  left.facets.push_back(std::move(of_left));
  right.facets.push_back(std::move(face));
  const bool left_first = is_before_blade(left, nodes);
  CellDraft &front = left_first ? left : right, &back = left_first ? right : left;
  back.keeps_index = false;
  Split split{cell, 0, 0, static_cast<uint32_t>(front.facets.size() - 1),
              static_cast<uint32_t>(back.facets.size() - 1)};
  split.front = edit.add(std::move(front));
  split.back = edit.add(std::move(back));
  origins_.push_back(edit.draft(split.front).from);
  origins_.push_back(edit.draft(split.front).from);
  splits_.push_back(split);
  return true;
}

/** Tells whether one part of a cell that was split lies before the blade. */
template <int D>
bool Cut<D>::is_before_blade(const CellDraft& part, const NodeLoop& nodes) const {
  const auto has = [&](uint32_t vertex) {
    return dsw::any_of(part.facets.begin(), part.facets.end(), [&](const FacetDraft& f) { return f.has(vertex); });
  };
  for (const uint32_t n : nodes) {
    if (!section_->node(n).is_old()) return has(section_->node(n).b);
  }
  int side = 0;
  for_each_edge_both_ways(map_, part.from, [&](uint32_t on, uint32_t off) {
    const bool leads_off = section_->node_at(on) != KeyTable::kNone && section_->node_at(off) == KeyTable::kNone;
    if (side == 0 && leads_off && has(off)) side = side_of(on, off);
  });
  return side >= 0;
}

/** Facets with nothing but old vertices on the blade are on the cut if the cells beside them are on its two sides. The
 * blade need not meet both. A cut that closes takes those, too, of which that is not to be told. */
template <int D>
void Cut<D>::find_old_faces() {
  old_faces_.clear();
  const auto stays_whole = [&](uint32_t cell) { return !section_->is_barred(cell) && section_->loop(cell).empty(); };
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    const Cell c = crossings_.cell(i).cell;
    if (!stays_whole(i)) continue;
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map_.half_facet(c, f), o = map_.opposite(h);
      if (!o.valid() || !is_on_blade(c, shape, f)) continue;
      const Cell beyond = map_.cell_of(o);
      const uint32_t other = crossings_.number(beyond);
      if (other == KeyTable::kNone ? !admits(env_, beyond) : o.word < h.word || !stays_whole(other)) continue;
      const int side = side_of(c), other_side = side_of(beyond);
      if (settings_.closes ? side * other_side > 0 || is_impassable(env_, h) : side * other_side >= 0) continue;
      old_faces_.push_back(side > 0 || other_side < 0 ? CutFace{h, o} : CutFace{o, h});
    }
  }
}

template <int D>
bool Cut<D>::is_on_blade(Cell c, const Shape& shape, uint32_t facet) const {
  bool all = true;
  for_each_facet_vertex<D>(
      shape, facet, [&](uint32_t local) { all = all && section_->node_at(map_.vertex(c, local)) != KeyTable::kNone; });
  return all;
}

/** On which side of the blade a vertex is that is not on it, seen along an edge from one that is. */
template <int D>
int Cut<D>::side_of(uint32_t on, uint32_t off) const {
  const uint32_t crossing = crossings_.find(on, off);
  if (crossing != KeyTable::kNone) return crossings_[crossing].b == off ? 1 : -1;
  return section_->node(section_->node_at(on)).side;
}

/** On which side a cell is that touches the cut and is not split; 0: that is not to be told. One with nothing but
 * vertices on the blade is where these were if the blade did not meet it, else it counts as before it: its faces are
 * then on the cut where the blade is behind them. */
template <int D>
int Cut<D>::side_of(Cell c) const {
  int side = 0;
  bool told = true;
  const auto see = [&](int here) {
    told = told && here != 0 && here != -side;
    side = here;
  };
  for_each_edge_both_ways(map_, c, [&](uint32_t on, uint32_t off) {
    if (section_->node_at(on) != KeyTable::kNone && section_->node_at(off) == KeyTable::kNone) see(side_of(on, off));
  });
  if (told && side == 0) {
    if (crossings_.number(c) != KeyTable::kNone) return 1;
    for (uint32_t k = 0; k < map_.vertices_of(c); ++k) see(section_->node(section_->node_at(map_.vertex(c, k))).side);
  }
  return told ? side : 0;
}

template <int D>
void Cut<D>::unsew_old_faces(Edit<D>& edit) const {
  for (const CutFace& face : old_faces_) {
    for (const HalfFacet h : {face.front, face.back}) {
      const Cell c = map_.cell_of(h);
      const size_t draft = draft_of_cell(c);
      if (draft == kNoDraft) {
        // What leads to a cell that goes is on the outer boundary unless something new takes it.
        const HalfFacet o = h == face.front ? face.back : face.front;
        if (draft_of_cell(map_.cell_of(o)) == kNoDraft) edit.set_link(h, {}, map_.facet_marked(h));
        continue;
      }
      edit.draft(draft).facets[map_.local_of(h, c)].far = {};
    }
  }
}

/** A cell that is split is not; round one that is not, those that it shares new vertices or lines with are not. */
template <int D>
void Cut<D>::keep_whole(Cell c) {
  const uint32_t cell = crossings_.number(c);
  if (cell != KeyTable::kNone && !section_->loop(cell).empty()) {
    section_->keep_whole(cell);
    return;
  }
  if (first_at_node_.empty()) list_cells_at_nodes();
  keep_whole_round(c);
}

/** Keeps whole the cells that share a new vertex, or both ends of a line, with a cell. */
template <int D>
void Cut<D>::keep_whole_round(Cell c) {
  KeyTable near(env_.memory);  // nodes of the cell
  Array<uint8_t> weights{env_.memory};
  const auto add = [&](uint32_t node, uint8_t weight) {
    if (node != KeyTable::kNone && near.insert(node) == weights.size()) weights.push_back(weight);
  };
  const DartEnds<D> darts(map_, c);
  for (uint32_t d = 0; d < darts.count(); ++d) {
    add(section_->node_on(darts.start(d), darts.end(d)), 2);
    add(section_->node_at(darts.start(d)), 1);
  }
  for (uint32_t k = 0; k < near.size(); ++k) {
    const auto node = static_cast<uint32_t>(near[k]);
    for (uint32_t at = first_at_node_[node]; at < first_at_node_[node + 1]; ++at) {
      const uint32_t cell = cells_at_nodes_[at];
      uint32_t shared = 0;
      for (const uint32_t n : section_->loop(cell)) {
        const uint32_t place = near.find(n);
        shared += place == KeyTable::kNone ? 0 : weights[place];
      }
      if (shared >= 2) section_->keep_whole(cell);
    }
  }
}

template <int D>
void Cut<D>::list_cells_at_nodes() {
  first_at_node_.assign(section_->node_count() + 1, 0);
  const auto for_each = [&](auto visit) {
    for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
      for (const uint32_t n : section_->loop(i)) visit(i, n);
    }
  };
  for_each([&](uint32_t, uint32_t node) { ++first_at_node_[node]; });
  uint32_t sum = 0;
  for (uint32_t& first : first_at_node_) first = sum += first;  // the ends, from where each list is filled backwards
  cells_at_nodes_.resize(sum);
  for_each([&](uint32_t cell, uint32_t node) { cells_at_nodes_[--first_at_node_[node]] = cell; });
}

template <int D>
size_t Cut<D>::draft_of_cell(Cell c) const {
  const uint32_t number = changed_.find(c.unit);
  return number == KeyTable::kNone ? kNoDraft : drafts_[number];
}

template <int D>
void Cut<D>::write_record(Edit<D>& edit) {
  record_.met = crossings_.cell_count();
  record_.split = static_cast<uint32_t>(splits_.size());
  record_.changed = static_cast<uint32_t>(changed_.size());
  for (uint32_t n = 0; n < section_->node_count(); ++n) {
    const Node& node = section_->node(n);
    if (!node.is_old() && vertices_[n] != kNoCell)
      record_.vertices.push_back({vertices_[n], node.a, node.b, node.share});
  }
  for (const Split& split : splits_) {
    record_.faces.push_back(
        {edit.half_facet(split.front, split.front_facet), edit.half_facet(split.back, split.back_facet)});
  }
  const auto is_to_be = [&](HalfFacet h) {
    const Cell c = map_.cell_of(h);
    const size_t draft = draft_of_cell(c);
    return draft == kNoDraft ? h : edit.half_facet(draft, map_.local_of(h, c));
  };
  for (const CutFace& face : old_faces_) record_.faces.push_back({is_to_be(face.front), is_to_be(face.back)});
  for (uint32_t i = 0; i < crossings_.cell_count(); ++i) {
    const Cell c = crossings_.cell(i).cell;
    // Where a vertex stands for all crossings, only the cell's sides tell that the cut would have to pass through it.
    if (!section_->loop(i).empty() || (!section_->is_crossed(i) && side_of(c) != 0)) continue;
    if (settings_.closes) {
      if (map_.marked(c)) continue;
      edit.set_mark(c, true);
    }
    const size_t draft = draft_of_cell(c);
    record_.whole.push_back(draft == kNoDraft ? c : edit.cell(draft));
  }
  measure(edit);
}

/** Distances of the cut's vertices from the blade, and of its points from the faces in the cells that hold them. */
template <int D>
void Cut<D>::measure(Edit<D>& edit) {
  const auto add = [&](double distance) { record_.distance = std::max(record_.distance, distance); };
  const auto add_vertex = [&](uint32_t node, uint32_t vertex) {
    const double* corners[D];
    blade_.corners(section_->node(node).simplex, corners);
    add(distance_to_simplex<D>(env_.point(vertex), corners));
  };
  for (uint32_t n = 0; n < section_->node_count(); ++n) {
    if (vertices_[n] != kNoCell) add_vertex(n, vertices_[n]);
  }
  for (const CutFace& face : old_faces_) {
    const FacetDraft facet = draft_of(env_, face.front);
    for (const uint32_t v : facet.loop) add_vertex(section_->node_at(v), v);
  }
  Array<uint32_t> split_of(crossings_.cell_count(), kNoCell, env_.memory);
  for (uint32_t i = 0; i < splits_.size(); ++i) split_of[splits_[i].cell] = i;
  for (const BladePoint<D>& point : crossings_.points()) {
    if (split_of[point.cell] == kNoCell) continue;
    const Split& split = splits_[split_of[point.cell]];
    const FacetDraft& face = edit.draft(split.front).facets[split.front_facet];
    const Vertices& simplices = D == 3 ? face.triangles : face.loop;
    double at[D], least = HUGE_VAL;
    crossings_.place(point, at);
    for (size_t s = 0; s < simplices.size() && least > record_.distance; s += D) {  // else no more to be learnt
      const double* corners[D];
      for (size_t k = 0; k < D; ++k) corners[k] = env_.point(simplices[s + k]);
      least = std::min(least, distance_to_simplex<D>(at, corners));
    }
    add(least);
  }
}

template Cut<2>::Cut(Environment<2>& env, const Blade<2>& blade, const CutSettings& settings,
                     const Crossings<2>& crossings, const Inside<2>* inside);
template Cut<3>::Cut(Environment<3>& env, const Blade<3>& blade, const CutSettings& settings,
                     const Crossings<3>& crossings, const Inside<3>* inside);
template void Cut<2>::prepare(std::optional<Edit<2>>& edit);
template void Cut<3>::prepare(std::optional<Edit<3>>& edit);

}  // namespace dsw
