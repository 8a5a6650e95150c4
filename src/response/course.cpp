#include "response/course.h"

#include <algorithm>

namespace dsw {

template <int D>
void Course<D>::start(Body<D>& moved, PointArray to, MoveOrder wanted) {
  motion.start(moved, to, moved.keeps_corridors());
  const Body<D>* const body = motion.body;
  order.clear();
  all_clear = false;
  turn_words = nullptr;
  clear_edges.clear();
  clear_faces.clear();
  vertices.assign(body->vertices.size(), Vertex{});
  keeps.assign(covers_faces(body->level) ? body->edges.size() : 0, true);
  const size_t count = wanted.vertices != nullptr ? wanted.count : body->vertices.size();
  order.resize(count);
  uint32_t told = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t v = wanted.vertices != nullptr ? wanted.vertices[i] : static_cast<uint32_t>(i);
    const BodyVertex<D>& vertex = body->vertices[v];
    if (!vertex.cell.valid()) continue;
    // One that is told to stay is done: nothing moves.
    if (!std::equal(to[v], to[v] + D, vertex.position)) vertices[v].rank = told;
    order[told++] = v;
  }
  order.resize(told);
}

template struct Course<2>;
template struct Course<3>;

}  // namespace dsw
