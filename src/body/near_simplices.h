#pragma once
// The simplices of a body that are near a place.

#include "body/simplices.h"

namespace dsw {

/** Calls visit(simplex) for those of for_each_outer that overlap a box. Each kind ends where it returns false.
 * @param body keeps boxes, which are fresh. */
template <int D, class Visit>
void for_each_outer_near(const Body<D>& body, const Box<D>& box, Visit visit) {
  const BodyBoxes<D>& boxes = body.boxes[0];
  const auto visit_outer = [&](Simplex::Kind kind) {
    return [&, kind](uint32_t i) { return is_covered(body, Simplex{kind, i}) || visit(Simplex{kind, i}); };
  };
  (covers_edges(body.level) ? boxes.loners : boxes.vertices).visit(box, visit_outer(Simplex::kVertex));
  if (covers_edges(body.level)) boxes.edges.visit(box, visit_outer(Simplex::kEdge));
  if (D == 3 && covers_faces(body.level)) boxes.faces.visit(box, visit_outer(Simplex::kFace));
}

}  // namespace dsw
