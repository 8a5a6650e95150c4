#include "cutting/section.h"

#include "base/search.h"
#include "environment/recut.h"
#include "map/dart.h"

namespace dsw {

template <int D>
Section<D>::Section(const Environment<D>& env, const Crossings<D>& crossings, double snap)
    : env_(env),
      map_(env.map),
      crossings_(crossings),
      loops_(crossings.cell_count(), NodeLoop(env.scratch.memory()), env.memory),
      barred_(crossings.cell_count(), 0, env.memory),
      crossed_(crossings.cell_count(), 0, env.memory) {
  for (uint32_t i = 0; i < crossings.count(); ++i) {
    const Crossing& at = crossings[i];
    if (!at.once || (at.share > snap && at.share < 1 - snap)) continue;
    const uint32_t vertex = at.share < 0.5 ? at.a : at.b;
    if (places_.insert(pair_key(vertex, vertex)) == nodes_.size())
      nodes_.push_back({vertex, vertex, 0, at.simplex, vertex == at.b ? 1 : -1});
  }
  // A blade that passes through itself can have one vertex on both of its sides.
  const auto see_side = [&](uint32_t node, int side) {
    if (node != KeyTable::kNone && nodes_[node].side != side) nodes_[node].side = 0;
  };
  Array<uint32_t> of_crossings(crossings.count(), KeyTable::kNone, env.memory);
  for (uint32_t i = 0; i < crossings.count(); ++i) {
    const Crossing& at = crossings[i];
    if (!at.once) continue;
    const uint32_t behind = node_at(at.a), before = node_at(at.b);
    see_side(behind, -1);
    see_side(before, 1);
    if (behind != KeyTable::kNone || before != KeyTable::kNone) continue;
    of_crossings[i] = places_.insert(pair_key(at.a, at.b));
    nodes_.push_back({at.a, at.b, at.share, at.simplex, 0});
  }
  CellNodes nodes(env.scratch.memory());
  first_chords_.reserve(crossings.cell_count() + size_t{1});
  first_nodes_on_.reserve(crossings.cell_count());
  for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
    first_chords_.push_back(static_cast<uint32_t>(chords_.size()));
    first_nodes_on_.push_back(static_cast<uint32_t>(nodes_on_.size()));
    const MetCell& met = crossings.cell(i);
    const Shape shape = map_.shape(met.cell);
    barred_[i] = met.holds_rim || met.invalid || !read_nodes(met.cell, shape, of_crossings, nodes);
    crossed_[i] = barred_[i] || is_crossed(nodes);
    if (barred_[i]) continue;
    nodes_on_.insert(nodes_on_.end(), nodes.on.begin(), nodes.on.end());
    find_loop(i, shape, nodes);
  }
  first_chords_.push_back(static_cast<uint32_t>(chords_.size()));
}

/** False: the blade crosses an edge twice. */
template <int D>
bool Section<D>::read_nodes(Cell c, const Shape& shape, const Array<uint32_t>& of_crossings, CellNodes& out) const {
  out.at.clear();
  map_.for_each_vertex(c, [&](uint32_t vertex) { out.at.push_back(node_at(vertex)); });
  out.on.clear();
  const DartEnds<D> darts(map_, c);
  for (uint32_t d = 0; d < darts.count(); ++d) {
    const uint32_t other = shape.dart_beta2(d);
    if (other < d) {
      out.on.push_back(out.on[other]);
      continue;
    }
    const uint32_t crossing = crossings_.find(darts.start(d), darts.end(d));
    if (crossing != KeyTable::kNone && !crossings_[crossing].once) return false;
    out.on.push_back(crossing == KeyTable::kNone ? KeyTable::kNone : of_crossings[crossing]);
  }
  return true;
}

template <int D>
bool Section<D>::is_crossed(const CellNodes& nodes) const {
  const auto is_node = [](uint32_t node) { return node != KeyTable::kNone; };
  if (dsw::any_of(nodes.on.begin(), nodes.on.end(), is_node)) return true;
  return dsw::none_of(nodes.at.begin(), nodes.at.end(), is_node);  // else a fold of the blade enters through one facet
}

/** Whether a facet, in the plane the cell, has two nodes that no edge of it joins. */
template <int D>
bool Section<D>::find_chord(const CellNodes& nodes, const Shape& shape, uint32_t facet, Chord& chord) const {
  uint32_t count = 0, place[2] = {}, found[2] = {};
  const auto add = [&](uint32_t node, uint32_t at) {
    if (node == KeyTable::kNone) return;
    if (count < 2) {
      found[count] = node;
      place[count] = at;
    }
    ++count;
  };
  const uint32_t first = D == 3 ? shape.facet_first(facet) : 0,
                 size = D == 3 ? shape.facet_size(facet) : shape.dart_count();
  for (uint32_t k = 0; k < size; ++k) {
    add(nodes.at[shape.dart_vertex(first + k)], 2 * k);
    add(nodes.on[first + k], 2 * k + 1);
  }
  if (count != 2) return false;
  const uint32_t apart = place[1] - place[0];  // neighbours are two apart, or all round but two
  if (place[0] % 2 == 0 && place[1] % 2 == 0 && (apart == 2 || apart == 2 * size - 2)) return false;
  chord = {facet, found[0], found[1]};
  return true;
}

/** Drops edges that lead nowhere, and says whether the rest is worth a look. */
template <int D>
bool Section<D>::prune(Arcs& arcs) const {
  for (bool changed = true; changed;) {
    changed = false;
    const auto degree = [&](uint32_t node) {
      return std::count_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.from == node || a.to == node; });
    };
    for (size_t i = arcs.size(); i-- != 0;) {
      if (degree(arcs[i].from) > 1 && degree(arcs[i].to) > 1) continue;
      if (arcs[i].chord) return false;
      arcs.erase(arcs.begin() + i);
      changed = true;
    }
  }
  return arcs.size() >= 3;
}

/** All arcs are taken by the loop, or there is none. */
template <int D>
void Section<D>::find_loop(uint32_t cell, const Shape& shape, const CellNodes& nodes) {
  if constexpr (D == 2) {
    Chord chord;
    if (find_chord(nodes, shape, 0, chord)) loops_[cell].assign({chord.from, chord.to});
  } else {
    Arcs arcs(env_.scratch.memory());
    const size_t known = chords_.size();
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      Chord chord;
      if (!find_chord(nodes, shape, f, chord)) continue;
      arcs.push_back({chord.from, chord.to, true});
      chords_.push_back(chord);
    }
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (shape.dart_beta2(d) < d) continue;
      const uint32_t from = nodes.at[shape.dart_vertex(d)], to = nodes.at[shape.dart_vertex(shape.beta1(d))];
      if (from != KeyTable::kNone && to != KeyTable::kNone) arcs.push_back({from, to, false});
    }
    NodeLoop loop(env_.scratch.memory());
    if (!take_arcs(arcs, loop) || is_facet(nodes, shape, loop)) {
      chords_.resize(known);
    } else {
      loops_[cell] = std::move(loop);
    }
  }
}

/** Whether arcs are one closed loop, but for edges that lead nowhere. */
template <int D>
bool Section<D>::take_arcs(Arcs& arcs, NodeLoop& loop) const {
  if (arcs.size() > kMostTriangulated || !prune(arcs)) return false;
  const uint32_t first = arcs[0].from;
  uint32_t at = first;
  while (!arcs.empty()) {
    const auto next = dsw::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.from == at || a.to == at; });
    if (next == arcs.end() || dsw::find(loop.begin(), loop.end(), at) != loop.end()) return false;
    loop.push_back(at);
    at = next->from == at ? next->to : next->from;
    arcs.erase(next);
  }
  return at == first;
}

template <int D>
bool Section<D>::is_facet(const CellNodes& nodes, const Shape& shape, const NodeLoop& loop) const {
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    bool same = shape.facet_size(f) == loop.size();
    for (uint32_t d = shape.facet_first(f); same && d < shape.facet_first(f + 1); ++d) {
      same = dsw::find(loop.begin(), loop.end(), nodes.at[shape.dart_vertex(d)]) != loop.end();
    }
    if (same) return true;
  }
  return false;
}

template Section<2>::Section(const Environment<2>& env, const Crossings<2>& crossings, double snap);
template Section<3>::Section(const Environment<3>& env, const Crossings<3>& crossings, double snap);

}  // namespace dsw
