#include "cutting/fold.h"

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "topology/draft.h"

namespace dsw {
namespace {

/** How far half-planes round an edge, in the plane rays from a vertex, have turned from the first of them on; each step
 * is less than half of the way. */
template <int D>
class Turn {
 public:
  /** The simplex of D points has the side to which the first step leads outside of it. */
  explicit Turn(const double* const (&first)[D]) { std::copy_n(first, D, first_); }

  void go_to(const double* next) {
    const int side = orient<D>(first_, next);
    done_ = past_half_ && side == 0;
    over_ = over_ || (past_half_ && side > 0);
    past_half_ = past_half_ || side <= 0;
  }
  /** More than all of the way; or exactly that, after the last step. */
  bool is_over() const { return over_; }
  bool is_done() const { return done_; }

 private:
  const double* first_[D];
  bool past_half_ = false, over_ = false, done_ = false;
};

/** The corner that is not on the ridge: of a facet's triangle at one of its darts, of a side with one end there. */
template <int D>
const double* corner_beside(const Environment<D>& env, Dart d, [[maybe_unused]] uint32_t vertex) {
  if constexpr (D == 2) {
    const uint32_t a = dart_vertex(env.map, d);
    return env.point(a == vertex ? dart_target(env.map, d) : a);
  } else {
    const Shape shape = env.map.shape(d.cell);
    const uint32_t f = shape.dart_facet(d.local), a = shape.dart_vertex(d.local),
                   b = shape.dart_vertex(shape.beta1(d.local));
    for (uint32_t s = shape.simplex_first(f);; ++s) {
      const uint16_t* const corners = shape.simplices() + 3 * s;
      for (int k = 0; k < 3; ++k) {
        if (corners[k] == a && corners[(k + 1) % 3] == b) return env.point(d.cell, corners[(k + 2) % 3]);
      }
    }
  }
}

template <int D>
Turn<D> turn_from(const Environment<D>& env, Dart d) {
  const uint32_t vertex = dart_vertex(env.map, d);
  const double* const beside = corner_beside(env, d, vertex);
  if constexpr (D == 2) {
    return Turn<2>({beside, env.point(vertex)});
  } else {
    return Turn<3>({env.point(dart_target(env.map, d)), env.point(vertex), beside});
  }
}

/** The outer boundary's first dart of a ridge, from where the cells round it follow each other; invalid: they close. */
template <int D>
Dart first_round(const Environment<D>& env, Dart d) {
  if (D == 3) return env.map.opposite(half_facet(env.map, d)).valid() ? Dart{} : d;
  for (Dart e = d;;) {
    const Dart beyond = cross(env.map, e);
    if (!beyond.cell.valid()) return e;
    e = beta1(env.map, beyond);
    if (e == d) return {};
  }
}

}  // namespace

template <int D>
bool is_folded(const Environment<D>& env, Dart of) {
  const Map<D>& map = env.map;
  const Dart d = first_round(env, of);
  if (!d.cell.valid()) return false;
  const uint32_t vertex = dart_vertex(map, d);
  Turn<D> turn = turn_from(env, d);
  Dart last = d;
  for (Dart e = d; e.cell.valid(); e = cross(map, last)) {
    if (map.form(e.cell) != Form::kSimplex) {
      double apex[D];
      centre(env, e.cell, apex);
      turn.go_to(apex);
    }
    last = across_ridge(map, e);
    turn.go_to(corner_beside(env, last, vertex));
    if (turn.is_over()) return true;
  }
  return turn.is_done() && !face_each_other(draft_of(env, half_facet(map, d)), draft_of(env, half_facet(map, last)));
}

DSW_INSTANTIATE(is_folded);

}  // namespace dsw
