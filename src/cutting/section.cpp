#include "cutting/section.h"

#include "environment/recut.h"
#include "map/dart.h"

namespace dsw {

template <int D>
Section<D>::Section(const Environment<D>& env, const Crossings<D>& crossings, double snap)
    : env_(env),
      map_(env.map),
      crossings_(crossings),
      loops_(crossings.cell_count(), Array<uint32_t>(env.scratch.memory()), env.memory),
      barred_(crossings.cell_count(), 0, env.memory) {
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
  for (uint32_t i = 0; i < crossings.count(); ++i) {
    const Crossing& at = crossings[i];
    if (!at.once) continue;
    const uint32_t behind = node_at(at.a), before = node_at(at.b);
    see_side(behind, -1);
    see_side(before, 1);
    if (behind != KeyTable::kNone || before != KeyTable::kNone) continue;
    places_.insert(pair_key(at.a, at.b));
    nodes_.push_back({at.a, at.b, at.share, at.simplex, 0});
  }
  for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
    const MetCell& met = crossings.cell(i);
    barred_[i] = met.holds_rim || met.invalid || has_double_crossing(met.cell);
    if (!barred_[i]) find_loop(i);
  }
}

template <int D>
bool Section<D>::has_double_crossing(Cell c) const {
  const DartEnds<D> darts(map_, c);
  for (uint32_t d = 0; d < darts.count(); ++d) {
    const uint32_t i = crossings_.find(darts.start(d), darts.end(d));
    if (i != KeyTable::kNone && !crossings_[i].once) return true;
  }
  return false;
}

template <int D>
bool Section<D>::is_crossed(uint32_t cell) const {
  if (is_barred(cell)) return true;
  const DartEnds<D> darts(map_, crossings_.cell(cell).cell);
  bool touches = false;
  for (uint32_t d = 0; d < darts.count(); ++d) {
    if (node_on(darts.start(d), darts.end(d)) != KeyTable::kNone) return true;
    touches = touches || node_at(darts.start(d)) != KeyTable::kNone;
  }
  return !touches;  // else a fold of the blade enters through one facet
}

/** Whether a facet, in the plane the cell, has two nodes that no edge of it joins. */
template <int D>
bool Section<D>::find_chord(const DartEnds<D>& darts, const Shape& shape, uint32_t facet, Chord& chord) const {
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
    const uint32_t vertex = darts.start(first + k), next = darts.end(first + k);
    add(node_at(vertex), 2 * k);
    add(node_on(vertex, next), 2 * k + 1);
  }
  if (count != 2) return false;
  const uint32_t apart = place[1] - place[0];  // neighbours are two apart, or all round but two
  if (place[0] % 2 == 0 && place[1] % 2 == 0 && (apart == 2 || apart == 2 * size - 2)) return false;
  chord = {facet, found[0], found[1]};
  return true;
}

template <int D>
void Section<D>::list_chords(uint32_t cell, Array<Chord>& out) const {
  out.clear();
  const Cell c = crossings_.cell(cell).cell;
  const Shape shape = map_.shape(c);
  const DartEnds<D> darts(map_, c);
  const Array<uint32_t>& loop = loops_[cell];
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    Chord chord;
    if (!find_chord(darts, shape, f, chord)) continue;
    const auto at = static_cast<size_t>(std::find(loop.begin(), loop.end(), chord.from) - loop.begin());
    if (at == loop.size()) continue;
    const bool taken =
        loop[(at + 1) % loop.size()] == chord.to || loop[(at + loop.size() - 1) % loop.size()] == chord.to;
    if (taken) out.push_back(chord);
  }
}

/** Drops edges that lead nowhere, and says whether the rest is worth a look. */
template <int D>
bool Section<D>::prune(Array<Arc>& arcs) const {
  for (bool changed = true; changed;) {
    changed = false;
    const auto degree = [&](uint32_t node) {
      return std::count_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.from == node || a.to == node; });
    };
    for (size_t i = arcs.size(); i-- != 0;) {
      if (degree(arcs[i].from) > 1 && degree(arcs[i].to) > 1) continue;
      if (arcs[i].chord) return false;
      arcs.erase(arcs.begin() + static_cast<ptrdiff_t>(i));
      changed = true;
    }
  }
  return arcs.size() >= 3;
}

template <int D>
void Section<D>::find_loop(uint32_t cell) {
  const Cell c = crossings_.cell(cell).cell;
  const Shape shape = map_.shape(c);
  const DartEnds<D> darts(map_, c);
  if constexpr (D == 2) {
    Chord chord;
    if (find_chord(darts, shape, 0, chord)) loops_[cell] = {{chord.from, chord.to}, env_.scratch.memory()};
  } else {
    Array<Arc> arcs{env_.scratch.memory()};
    arcs.reserve(shape.facet_count());
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      Chord chord;
      if (find_chord(darts, shape, f, chord)) arcs.push_back({chord.from, chord.to, true});
    }
    for (uint32_t d = 0; d < darts.count(); ++d) {
      if (shape.dart_beta2(d) < d) continue;
      const uint32_t from = node_at(darts.start(d)), to = node_at(darts.end(d));
      if (from != KeyTable::kNone && to != KeyTable::kNone) arcs.push_back({from, to, false});
    }
    if (arcs.size() > kMostTriangulated || !prune(arcs)) return;
    Array<uint32_t> loop{env_.scratch.memory()};
    uint32_t at = arcs[0].from;
    while (!arcs.empty()) {
      const auto next =
          std::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.from == at || a.to == at; });
      if (next == arcs.end() || std::find(loop.begin(), loop.end(), at) != loop.end()) return;
      loop.push_back(at);
      at = next->from == at ? next->to : next->from;
      arcs.erase(next);
    }
    if (at == loop[0] && !is_facet(c, shape, loop)) loops_[cell] = std::move(loop);
  }
}

template <int D>
bool Section<D>::is_facet(Cell c, const Shape& shape, const Array<uint32_t>& loop) const {
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    bool same = shape.facet_size(f) == loop.size();
    for (uint32_t d = shape.facet_first(f); same && d < shape.facet_first(f + 1); ++d) {
      same = std::find(loop.begin(), loop.end(), node_at(dart_vertex(map_, {c, d}))) != loop.end();
    }
    if (same) return true;
  }
  return false;
}

template Section<2>::Section(const Environment<2>& env, const Crossings<2>& crossings, double snap);
template Section<3>::Section(const Environment<3>& env, const Crossings<3>& crossings, double snap);
template bool Section<2>::is_crossed(uint32_t cell) const;
template bool Section<3>::is_crossed(uint32_t cell) const;
template void Section<3>::list_chords(uint32_t cell, Array<Chord>& out) const;

}  // namespace dsw
