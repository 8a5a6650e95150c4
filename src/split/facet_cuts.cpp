#include "split/facet_cuts.h"

#include <cmath>

#include "predicates/turn.h"
#include "split/ears.h"

namespace dsw {
namespace {

Array<uint32_t> loop_of(const Environment<3>& env, HalfFacet h) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  Array<uint32_t> loop(env.memory);
  for_each_facet_vertex<3>(shape, env.map.local_of(h, c),
                           [&](uint32_t local) { loop.push_back(env.map.vertex(c, local)); });
  return loop;
}

template <class Visit>
void for_each_own_triangle(const Environment<3>& env, HalfFacet h, const Visit& visit) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  const uint32_t f = env.map.local_of(h, c);
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    visit(env.map.vertex(c, local[0]), env.map.vertex(c, local[1]), env.map.vertex(c, local[2]));
  }
}

/** Turns of corners, seen along the axis along which a loop is largest; positive as the loop turns. */
class View {
 public:
  View(const Environment<3>& env, const Array<uint32_t>& loop) : env_(env) {
    const double* const origin = env.point(loop[0]);
    double scale = 0, area[3] = {};
    for (const uint32_t v : loop) {
      for (int k = 0; k < 3; ++k) scale = std::max(scale, std::fabs(env.point(v)[k] / 2 - origin[k] / 2));
    }
    for (size_t n = 0; n < loop.size() && scale > 0; ++n) {
      const double *const p = env.point(loop[n]), *const q = env.point(loop[n + 1 == loop.size() ? 0 : n + 1]);
      double a[3], b[3];
      for (int k = 0; k < 3; ++k) {
        a[k] = (p[k] / 2 - origin[k] / 2) / scale;
        b[k] = (q[k] / 2 - origin[k] / 2) / scale;
      }
      for (int k = 0; k < 3; ++k) area[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    for (int k = 0; k < 3; ++k) axis_ = std::fabs(area[k]) > std::fabs(area[axis_]) ? k : axis_;
    sense_ = area[axis_] < 0 ? -1 : 1;
  }
  int operator()(uint32_t a, uint32_t b, uint32_t c) const {
    return turn_sign<3>(env_.point(a), env_.point(b), env_.point(c), axis_) * sense_;
  }

 private:
  const Environment<3>& env_;
  int axis_ = 0, sense_ = 1;
};

}  // namespace

FacetCuts::FacetCuts(const Environment<3>& env, const Array<Cell>& cells)
    : env_(env), numbers_(env.memory), first_(env.memory), triangles_(env.memory), is_broken_(env.memory) {
  for (const Cell c : cells) {
    for (uint32_t f = 0; f < env.map.facets_of(c); ++f) add(cells, canonical(env.map, env.map.half_facet(c, f)));
  }
  first_.push_back(static_cast<uint32_t>(triangles_.size()));
  is_broken_.assign(numbers_.size(), 0);
}

/** Whether a cell of a facet stays as it is: then the facet has to, too. */
bool FacetCuts::keeps_triangles(const Array<Cell>& cells, HalfFacet h) const {
  const auto stays = [&](HalfFacet side) {
    return side.valid() && !std::binary_search(cells.begin(), cells.end(), env_.map.cell_of(side),
                                               [](Cell a, Cell b) { return a.unit < b.unit; });
  };
  return stays(h) || stays(env_.map.opposite(h));
}

void FacetCuts::add(const Array<Cell>& cells, HalfFacet h) {
  if (numbers_.insert(h.word) != first_.size()) return;
  const size_t before = triangles_.size();
  first_.push_back(static_cast<uint32_t>(before));
  const Array<uint32_t> loop = loop_of(env_, h);
  const View turn(env_, loop);
  bool is_turned_alike = true;
  for_each_own_triangle(env_, h, [&](uint32_t a, uint32_t b, uint32_t c) {
    is_turned_alike = is_turned_alike && turn(a, b, c) > 0;
    triangles_.push_back(make_simplex(a, b, c));
  });
  if (is_turned_alike || loop.size() == 3 || keeps_triangles(cells, h)) return;
  Array<uint32_t> ears(env_.memory);
  triangles_.resize(before);
  if (!clip_ears(loop, turn, ears)) return;
  for (size_t k = 0; k < ears.size(); k += 3) triangles_.push_back(make_simplex(ears[k], ears[k + 1], ears[k + 2]));
}

}  // namespace dsw
