// The fold as a picture: side views of the body at some steps, and what happened over all of them.
#ifndef DARTSWEEP_PHYSICS_FOLD_PICTURE_H
#define DARTSWEEP_PHYSICS_FOLD_PICTURE_H

#include <ostream>

#include "fold.h"

namespace physics {

// The body after a step.
struct FoldView {
  std::string title;
  Positions position;
  std::vector<std::uint32_t> edges;  // two indices each
  std::vector<char> inserted;        // by vertex
};

FoldView view_of(Fold& fold, const std::string& title);

// SVG: the views side by side, inserted vertices as dots; below them the number of vertices and the largest pull by
// step.
void draw_fold(const std::vector<FoldView>& views, const std::vector<FoldStep>& steps, const FoldOptions& options,
               std::ostream& out);

}  // namespace physics

#endif
