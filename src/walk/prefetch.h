#pragma once
// Batches know which cells come next: asking the memory for them while a packet is filled hides most of what casts in
// random cells wait for.

#include "base/compiler.h"
#include "environment/environment.h"
#include "walk/standard_facets.h"

namespace dsw {

// GCC drops the call of a function that does nothing else, so these are not called.
#define DSW_PREFETCH DSW_HOT

constexpr size_t kRecordAhead = 16;  // casts ahead at which a cell's record is asked for

template <int D>
DSW_PREFETCH void prefetch_record(const Environment<D>& env, Cell c) noexcept {
  prefetch_line(env.map.record(c));
}

/** The record of a polyhedron, as large as most are, of which one link is known. */
template <int D>
DSW_PREFETCH void prefetch_round(const Environment<D>& env, HalfFacet h) noexcept {
  constexpr intptr_t kLine = 64;
  const uintptr_t line =
      reinterpret_cast<uintptr_t>(env.map.words.data() + h.word);  // may lie before or behind the array
  for (const intptr_t lines : {-1, 1, 2}) {
    prefetch_line(reinterpret_cast<const void*>(line + static_cast<uintptr_t>(lines * kLine)));
  }
}

/** A vertex, which may lie in two lines of the cache. */
template <int D>
DSW_PREFETCH void prefetch_point(const Environment<D>& env, uint32_t vertex) noexcept {
  const double* const point = env.point(vertex);
  prefetch_line(point);
  prefetch_line(point + D - 1);
}

/** Vertices of a simplex, whose planes are computed sooner than they come. The record is read. */
template <int D>
DSW_PREFETCH void prefetch_vertices(const Environment<D>& env, Cell c) noexcept {
  const uint32_t* w = env.map.record(c);
  if (form_of(w[0]) != Form::kSimplex) return;
  for (int i = 0; i <= D; ++i) prefetch_point(env, w[i] & kVertexMask);
}

/** What a cast reads of the cell where it starts. The record is read. */
template <int D>
DSW_PREFETCH void prefetch_start(const Environment<D>& env, Cell c) noexcept {
  prefetch_vertices(env, c);
  if (env.has_moved()) env.checked.prefetch(env.map.index(c));
}

/** The tip of a simplex, opposite to the facet that was crossed: the cell before has all others. `crossed`: the facet,
 * seen from the simplex. In the plane all vertices. The record is read. */
template <int D>
DSW_PREFETCH void prefetch_vertex_beyond(const Environment<D>& env, HalfFacet crossed) noexcept {
  const uint32_t* const w = env.map.words.data() + (crossed.word - crossed.word % kUnitWords<D>);
  if (form_of(w[0]) != Form::kSimplex) return;
  if constexpr (D == 3) {
    prefetch_point(env, w[kTetrahedronTips[local_in_tetrahedron(crossed)]] & kVertexMask);
  } else {
    prefetch_vertices(env, env.map.cell_of(crossed));
  }
}

/** What a look at a polyhedron reads, as far as most have it: local points, and of the shape counts and triangles. The
 * record is read. */
template <int D>
DSW_PREFETCH void prefetch_polyhedron(const Environment<D>& env, Cell c) noexcept {
  const uint32_t word = env.map.record(c)[0];
  if (form_of(word) != Form::kGeneral) return;
  constexpr uint32_t kLine = 64, kTriangles = 462;  // where those of a sphere of 16 triangles begin, in bytes
  const auto* const table = reinterpret_cast<const char*>(env.map.general_shape(word).table());
  for (const uint32_t at : {0u, kTriangles, kTriangles + kLine}) prefetch_line(table + at);
  if (env.local_points.empty()) return;
  const auto* const local = reinterpret_cast<const char*>(env.local_points.data() + size_t{c.unit} * kUnitWords<D>);
  for (const uint32_t at : {0u, kLine, 2 * kLine}) prefetch_line(local + at);
}

/** What is known of a cell whose points have moved, and its vertices. The record is read. */
template <int D>
DSW_PREFETCH void prefetch_moving(const Environment<D>& env, Cell c) noexcept {
  env.checked.prefetch(env.map.index(c));
  const uint32_t* const w = env.map.record(c);
  if (D == 3 && form_of(w[0]) == Form::kBox) {
    DSW_UNROLL(8)
    for (uint32_t i = 0; i < 8; ++i) prefetch_line(env.point(w[kUnitWords<3> + i]));
    return;
  }
  for (uint32_t i = 0, count = env.map.vertices_of(c); i < count; ++i) prefetch_line(env.point(c, i));
}

}  // namespace dsw
