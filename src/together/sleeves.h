#pragma once
// Edges of which both ends move, inside of convex cells that they are known to cross.

#include "flood/sequence.h"
#include "together/traveller.h"

namespace dsw {

/** One for each thread. */
template <int D>
class Sleeves {
 public:
  explicit Sleeves(const Environment<D>& env) : env_(env), writer_(env.memory) {}

  /** Whether an edge keeps to the cells that it crosses, or to one cell more or less at either end. Then it meets
   * nothing on its way. False also where that is not known, and for bodies that keep no sequences. The sequence becomes
   * that of the end. Throws std::bad_alloc. */
  bool keeps(const Traveller<D>& of, uint32_t edge);

  CastCounters* counters = nullptr;

 private:
  /** An end, and the facet through which it leaves its cell, if it does. */
  struct End {
    const double *start, *end;
    Cell from, to;
    HalfFacet crossed;
    bool is_known;  // whether it passes one facet at most
  };
  End end_of(const Traveller<D>& of, uint32_t v) const;
  bool is_of(const EdgeSequence<D>& sequence, const End& a, const End& b) const;
  bool note(EdgeSequence<D>& sequence, const End& a, const End& b);
  bool extend(EdgeSequence<D>& sequence, const End& end, bool first);
  bool keeps_to(EdgeSequence<D>& sequence, const End& a, const End& b);
  bool passes_all(EdgeSequence<D>& sequence, const End& a, const End& b) const;

  const Environment<D>& env_;
  SequenceWriter<D> writer_;
};

}  // namespace dsw
