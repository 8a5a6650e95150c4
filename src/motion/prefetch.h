#pragma once
// Batches know which cells come next: asking the memory for them while earlier casts run hides most of what a cast in a
// random cell waits for (measured: 100 to 52 ns a cast in 200,000 tetrahedra in random order).

#include "environment/environment.h"

namespace dsw {

constexpr size_t kRecordAhead = 10;   // casts ahead at which a cell's record is asked for
constexpr size_t kVerticesAhead = 5;  // and, once that has come, its vertices

template <int D>
inline void prefetch_record(const Environment<D>& env, Cell c) noexcept {
  __builtin_prefetch(env.map.record(c));
}

/** Vertices of simplices and boxes, where a cell is small against the wait. */
template <int D>
inline void prefetch_vertices(const Environment<D>& env, Cell c) noexcept {
  const uint32_t* w = env.map.record(c);
  const Form form = form_of(w[0]);
  const uint32_t n = form == Form::kSimplex ? static_cast<uint32_t>(D) + 1u : form == Form::kBox ? 1u << D : 0u;
  if (form == Form::kBox) w += kUnitWords;
  for (uint32_t i = 0; i < n; ++i) __builtin_prefetch(env.point(w[i] & kVertexMask));
}

/** Before cast i of a batch of `end`: cell_of(k) is where cast k starts. */
template <int D, class CellOf>
inline void prefetch_ahead(const Environment<D>& env, size_t i, size_t end, CellOf cell_of) noexcept {
  if (i + kRecordAhead < end) prefetch_record(env, cell_of(i + kRecordAhead));
  if (i + kVerticesAhead < end) prefetch_vertices(env, cell_of(i + kVerticesAhead));
}

}  // namespace dsw
