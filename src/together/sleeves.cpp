// On which side a line through two points passes a ridge is affine in each of the points. So if the lines through all
// choices of start or end of both ends pass all facets of a sequence, the edge's line passes them at all times. It then
// crosses the cells between these facets one after the other, each from facet to facet. The ends are in cells of the
// sequence at all times, so the edge is, too.
//
// An end that goes to the next cell of the sequence leaves it shorter. One that goes elsewhere makes it longer. What is
// asked about is the longer one.

#include "together/sleeves.h"

namespace dsw {

template <int D>
typename Sleeves<D>::End Sleeves<D>::end_of(const Traveller<D>& of, uint32_t v) const {
  const Cell from = of.body->vertices[v].cell, to = of.arrivals[v];
  const PathFacets& passed = of.crossed[v];
  End end{of.start(v), of.end(v), from, to, {}, from == to || passed.count == 1};
  if (from != to && end.is_known) end.crossed = passed.facets[0];
  return end;
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
  CastRequest request;
  request.from = a.start;
  request.to = b.start;
  request.start = a.from;
  request.end = b.from;
  writer_.attach(env_, request);
  const CastResult result = cast(env_, request, counters);
  if (result.end != CastEnd::kReached || result.cell != b.from) return false;
  writer_.finish(sequence);
  return sequence.known();
}

/** Lets a sequence hold the cells that an end is in. Whether it got one more; else it may lose one. */
template <int D>
bool Sleeves<D>::extend(EdgeSequence<D>& sequence, const End& end, bool first) {
  if (!end.crossed.valid()) return false;
  const HalfFacet beyond = env_.map.opposite(end.crossed);
  const HalfFacet left = first ? end.crossed : beyond, met = first ? beyond : end.crossed;
  const Array<uint32_t>& facets = sequence.facets;
  if (!facets.empty() && (first ? facets.front() : facets.back()) == left.word) return false;
  sequence.add(env_, met, first);
  return true;
}

template <int D>
bool Sleeves<D>::passes_all(EdgeSequence<D>& sequence, const End& a, const End& b) const {
  const Cell front = sequence.passage.front, back = sequence.passage.back;
  const auto passes = [&](const double* from, const double* to) {
    return follows(env_, sequence, from, to, front, back);
  };
  return passes(a.start, b.start) && passes(a.end, b.start) && passes(a.start, b.end) && passes(a.end, b.end);
}

template <int D>
bool Sleeves<D>::keeps(const Traveller<D>& of, uint32_t edge) {
  const Body<D>& body = *of.body;
  if (!body.keeps_sequences()) return false;
  const End a = end_of(of, body.edges[edge].ends[0]), b = end_of(of, body.edges[edge].ends[1]);
  if (!a.is_known || !b.is_known) return false;
  for (const Cell c : {a.from, a.to, b.from, b.to}) {
    if (!c.valid() || !env_.map.convex(c) || is_closed(env_, c)) return false;
  }
  EdgeSequence<D>& sequence = body.sequences[edge];
  // What is found does not depend on what was noted before.
  return (is_of(sequence, a, b) && keeps_to(sequence, a, b)) || (note(sequence, a, b) && keeps_to(sequence, a, b));
}

/** Whether the edge keeps to its sequence, or to one more facet at either end. */
template <int D>
bool Sleeves<D>::keeps_to(EdgeSequence<D>& sequence, const End& a, const End& b) {
  const bool longer_at_a = extend(sequence, a, true), longer_at_b = extend(sequence, b, false);
  const bool keeps = !sequence.facets.empty() && passes_all(sequence, a, b);
  // What it passes at the end; or at the start, if it is not known to keep to that.
  if (keeps ? a.crossed.valid() && !longer_at_a : longer_at_a) sequence.remove(env_, true);
  if (keeps ? b.crossed.valid() && !longer_at_b : longer_at_b) sequence.remove(env_, false);
  return keeps;
}

template class Sleeves<2>;
template class Sleeves<3>;

}  // namespace dsw
