#include "cutting/fold.h"

#include "predicates/filtered.h"
#include "topology/draft.h"

namespace dsw {
namespace {

/** How far half-planes round an edge have turned from the first of them on; each step is less than half of the way. */
class Turn {
 public:
  Turn(const double* from, const double* to, const double* first) : points_{from, to, first} {}

  void go_to(const double* next) {
    const int side = orient<3>(points_, next);
    done_ = past_half_ && side == 0;
    over_ = over_ || (past_half_ && side > 0);
    past_half_ = past_half_ || side <= 0;
  }
  /** More than all of the way; or exactly that, after the last step. */
  bool is_over() const { return over_; }
  bool is_done() const { return done_; }

 private:
  const double* points_[3];
  bool past_half_ = false, over_ = false, done_ = false;
};

/** The corner of a facet's triangle at one of its darts that is not on its edge. */
const double* corner_beside(const Environment<3>& env, Dart d) {
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

}  // namespace

bool is_folded(const Environment<3>& env, Dart d) {
  const Map<3>& map = env.map;
  Turn turn(env.point(dart_target(map, d)), env.point(dart_vertex(map, d)), corner_beside(env, d));
  Dart last = d;
  for (Dart e = d; e.cell.valid(); e = beta3(map, last)) {
    if (map.form(e.cell) != Form::kSimplex) {
      double apex[3];
      centre(env, e.cell, apex);
      turn.go_to(apex);
    }
    last = beta2(map, e);
    turn.go_to(corner_beside(env, last));
    if (turn.is_over()) return true;
  }
  return turn.is_done() && !face_each_other(draft_of(env, half_facet(map, d)), draft_of(env, half_facet(map, last)));
}

}  // namespace dsw
