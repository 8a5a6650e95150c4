// On which side a line through two points passes a ridge is affine in each of the points. So if the lines through all
// choices of start or end of both ends pass all facets of a sequence, the edge's line passes them at all times. It then
// crosses the cells between these facets one after the other, each from facet to facet. The ends are in cells of the
// sequence at all times, so the edge is, too.
//
// An end that goes to the next cell of the sequence leaves it shorter. One that goes elsewhere makes it longer. What is
// asked about is the longer one. If the edge does not keep to it, what it may touch is found by `ridge_rings.h`.

#include "together/sleeves.h"

namespace dsw {

template <int D>
typename Sleeves<D>::End Sleeves<D>::end_of(const Traveller<D>& of, uint32_t edge, uint32_t k) const {
  const uint32_t v = of.body->edges[edge].ends[k];
  return {of.start(v), of.end(v), of.body->vertices[v].cell, of.arrivals[v], paths_[k]};
}

/** Whether it is known which facets a vertex passes up to a place, and maybe after that. */
template <int D>
bool Sleeves<D>::find_path(const Traveller<D>& of, uint32_t v, const double* place, bool is_end,
                           Array<uint32_t>& path) {
  const Cell from = of.body->vertices[v].cell, to = of.arrivals[v];
  const auto suits = [&](Cell c) { return c.valid() && env_.map.convex(c) && !is_closed(env_, c); };
  path.clear();
  if (!suits(from)) return false;
  if (from == to) return true;
  if (is_end && !suits(to)) return false;
  const PathFacets& crossed = of.crossed[v];
  for (uint32_t i = 0; i < crossed.count; ++i) path.push_back(crossed.facets[i].word);
  if (crossed.count != 0) return true;
  if (!passes(of.start(v), place, from, is_end ? to : Cell{}) || writer_.passed() == nullptr) return false;
  path = *writer_.passed();
  return true;
}

/** Casts a segment, and notes the facets that it passes. Whether it is free, and ends in a cell, if that is valid. */
template <int D>
bool Sleeves<D>::passes(const double* from, const double* to, Cell start, Cell end) {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  request.end = end;
  writer_.attach(env_, request);
  const CastResult result = cast(env_, request, counters);
  return result.end == CastEnd::kReached && (!end.valid() || result.cell == end);
}

/** Whether a sequence leads from the cell of one end to that of the other. */
template <int D>
bool Sleeves<D>::is_of(const EdgeSequence<D>& sequence, const End& a, const End& b) const {
  if (!sequence.known()) return false;
  if (sequence.facets.empty()) return a.from == b.from;
  return sequence.passage.version == env_.obstacle_version && sequence.passage.front == a.from &&
         sequence.passage.back == b.from;
}

/** Notes the sequence of the edge where it starts. */
template <int D>
bool Sleeves<D>::note(EdgeSequence<D>& sequence, const End& a, const End& b) {
  if (!passes(a.start, b.start, a.from, b.from)) return false;
  writer_.finish(sequence);
  return sequence.known();
}

template <int D>
typename Sleeves<D>::Answer Sleeves<D>::ask(const Traveller<D>& of, uint32_t edge, const double* const (&places)[2],
                                            bool are_ends) {
  const Body<D>& body = *of.body;
  if (!body.keeps_sequences()) return Answer::kUnknown;
  for (uint32_t k = 0; k < 2; ++k) {
    if (!find_path(of, body.edges[edge].ends[k], places[k], are_ends, paths_[k])) return Answer::kUnknown;
  }
  const End a = end_of(of, edge, 0), b = end_of(of, edge, 1);
  // What is found does not depend on what was noted before.
  EdgeSequence<D>& sequence = body.sequences[edge];
  const bool may_be_known = is_of(sequence, a, b);
  const bool keeps_cells = are_ends && a.path.empty() && b.path.empty() && !sequence.facets.empty();
  if (may_be_known && keeps_cells && passes_all(sequence, a, b)) return Answer::kNothing;
  const bool is_known = may_be_known && follows(env_, sequence, a.start, b.start, a.from, b.from);
  if (!is_known && !note(sequence, a, b)) return Answer::kUnknown;
  if (are_ends && stays(sequence, a, b)) return Answer::kNothing;
  if (!rings_.find(sequence, {a.start, places[0], b.start, places[1], &a.path, &b.path})) return Answer::kUnknown;
  if (!rings_.walls().empty()) return Answer::kWalls;
  if (are_ends) go_on(of, edge);
  return Answer::kNothing;
}

/** Whether the edge keeps to its sequence, or to one more facet at either end. */
template <int D>
bool Sleeves<D>::stays(EdgeSequence<D>& sequence, const End& a, const End& b) {
  if (a.path.size() > 1 || b.path.size() > 1) return false;
  const bool longer_at_a = extend(sequence, a, true), longer_at_b = extend(sequence, b, false);
  const bool stays = !sequence.facets.empty() && passes_all(sequence, a, b);
  // What it passes at the end; or at the start, if it is not known to keep to that.
  if (stays ? !a.path.empty() && !longer_at_a : longer_at_a) sequence.remove(env_, true);
  if (stays ? !b.path.empty() && !longer_at_b : longer_at_b) sequence.remove(env_, false);
  return stays;
}

/** Lets a sequence hold the cells that an end is in. Whether it got one more; else it may lose one. */
template <int D>
bool Sleeves<D>::extend(EdgeSequence<D>& sequence, const End& end, bool first) {
  if (end.path.empty()) return false;
  const HalfFacet passed{end.path[0]}, beyond = env_.map.opposite(passed);
  const HalfFacet left = first ? passed : beyond, met = first ? beyond : passed;
  const Array<uint32_t>& facets = sequence.facets;
  if (!facets.empty() && (first ? facets.front() : facets.back()) == left.word) return false;
  sequence.add(env_, met, first);
  return true;
}

template <int D>
bool Sleeves<D>::passes_all(EdgeSequence<D>& sequence, const End& a, const End& b) const {
  const Cell front = sequence.passage.front, back = sequence.passage.back;
  const EdgeWay way{a.start, a.end, b.start, b.end, true, true};
  if (sequence.passage.is_only()) return keeps_to_passage(env_, sequence.passage, way);
  if (D == 3 && !sequence.in_rows) return keeps_to_facets(env_, sequence, way);
  const auto passes = [&](const double* from, const double* to) {
    return follows(env_, sequence, from, to, front, back);
  };
  return passes(a.start, b.start) && passes(a.end, b.start) && passes(a.start, b.end) && passes(a.end, b.end);
}

template <int D>
void Sleeves<D>::go_on(const Traveller<D>& of, uint32_t edge) {
  const End a = end_of(of, edge, 0), b = end_of(of, edge, 1);
  EdgeSequence<D>& sequence = of.body->sequences[edge];
  go_with(sequence, a, true);
  go_with(sequence, b, false);
  constexpr int kMostTurns = 16;
  Pivot<D> pivot;
  for (int k = 0; k < kMostTurns && !follows(env_, sequence, a.end, b.end, a.to, b.to); ++k) {
    if (!turn(env_, sequence, a.end, b.end, pivot)) return;
  }
}

/** Lets a sequence begin or end where the path of an end does. */
template <int D>
void Sleeves<D>::go_with(EdgeSequence<D>& sequence, const End& end, bool first) {
  for (const uint32_t passed : end.path) {
    const HalfFacet beyond = env_.map.opposite({passed});
    const uint32_t left = first ? passed : beyond.word;
    if (!sequence.facets.empty() && (first ? sequence.facets.front() : sequence.facets.back()) == left) {
      sequence.remove(env_, first);
    } else {
      sequence.add(env_, first ? beyond : HalfFacet{passed}, first);
    }
  }
}

template class Sleeves<2>;
template class Sleeves<3>;

}  // namespace dsw
