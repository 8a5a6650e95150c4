#pragma once
// The obstacles at a passable cell: its impassable facets, its marked edges (in space) and its marked vertices.

#include "environment/marking.h"

namespace dsw {

/** Calls visit(edge dart) for the marked edges of a cell, each once. */
template <class Visit>
void for_each_marked_edge(const Environment<3>& env, Cell c, const Shape& shape, Visit visit) {
  if (env.marked_edges == 0) return;
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    if (shape.dart_beta2(d) < d) continue;
    if (edge_marked(env, env.map.vertex(c, shape.dart_vertex(d)), env.map.vertex(c, shape.dart_vertex(shape.beta1(d)))))
      visit(d);
  }
}

/** Calls visit(local vertex) for the vertices of all obstacles at a cell, some more than once. No call: it is closed,
 * or there are none. */
template <int D, class Visit>
void for_each_obstacle_vertex(const Environment<D>& env, Cell c, Visit visit) {
  if (is_closed(env, c)) return;
  const Shape shape = env.map.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    if (is_impassable(env, env.map.half_facet(c, f))) for_each_facet_vertex<D>(shape, f, visit);
  }
  if constexpr (D == 3) {
    for_each_marked_edge(env, c, shape, [&](uint32_t d) {
      visit(shape.dart_vertex(d));
      visit(shape.dart_vertex(shape.beta1(d)));
    });
  }
  for (uint32_t i = 0; env.marked_vertices != 0 && i < shape.vertex_count(); ++i) {
    if (vertex_marked(env, env.map.vertex(c, i))) visit(i);
  }
}

template <int D>
bool has_obstacle(const Environment<D>& env, Cell c) {
  bool found = false;
  for_each_obstacle_vertex(env, c, [&](uint32_t) { found = true; });
  return found;
}

}  // namespace dsw
