// A soft body that folds over the ridge of a roof, is lifted off and unfolds [JCD10] 7.3: responses insert vertices
// where it folds, and the criterion of 7.3.1 removes them (removal.h).
//
// The roof lies along y, heights are z; gravity presses the body on it, then lifts it, then is off. The body is held
// together by its shape alone: there are no springs, and "edges are only used for collision detection and do not
// support mechanical properties".
#ifndef DARTSWEEP_PHYSICS_FOLD_H
#define DARTSWEEP_PHYSICS_FOLD_H

#include <string>

#include "verify.h"
#include "world.h"

namespace physics {

enum class FoldBody {
  kBar,      // edges of a row of cubes, level EDGES_SWEPT
  kSheet,    // a grid of edges, level EDGES_SWEPT
  kSurface,  // the bar with its surface of triangles, level FACES
  kPlane,    // one side of the bar, in the plane; height is y there
};
constexpr FoldBody kFoldBodies[] = {FoldBody::kBar, FoldBody::kSheet, FoldBody::kSurface, FoldBody::kPlane};
const char* name_of(FoldBody body);

struct FoldOptions {
  FoldBody body = FoldBody::kBar;
  double omega = 0.7;        // of inserted vertices, see ShapeMatching
  double negligible = 0.01;  // see SoftBodyOptions
  double match = 0.02;       // see SoftBodyOptions: how soft the body is
  int cells = 5;             // of the body along x; it is 5 m long
  double aside = 0;          // how far its middle is from the ridge, m
  double gravity = 9.81, drag = 1.5;
  double dt = 0.01;
  int press = 200, lift = 50, rest = 300;  // steps of the three phases
  // Responses and search of all moves.
  dsw_move_options move;

  FoldOptions();
};

// What a step did and how things stand after it.
struct FoldStep {
  int step = 0;
  std::string phase;  // press, lift, rest
  std::size_t vertices = 0, edges = 0, inserted = 0, removed = 0, contacts = 0;
  double largest_pull = 0;  // of all vertices, over the radius of the shape
  double bend = 0;          // of original vertices: how far one is from its goal by these alone, over the radius
  double removed_pull =
      0;              // largest pull before the step of a vertex that it removed, or of one next to it, over the radius
  double turned = 0;  // rotation about the ridge of the shape that the original vertices match, degrees
  double unwanted =
      0;  // angle between the rotation of equation 1 and the one that it has without inserted vertices, degrees
  Validation validation;
};

class Fold {
 public:
  explicit Fold(const FoldOptions& options);
  FoldStep step();
  bool is_over() const;
  // Whether the body has the vertices, edges, faces and masses that it began with.
  bool is_as_at_first() const;

  SoftBody& body() { return *body_; }
  // Positions of the vertices in space: x, depth, height.
  Positions in_space() const;
  // Ends of living edges, by index, and corners of living faces.
  std::vector<std::uint32_t> edges() const, faces() const;

 private:
  FoldOptions options_;
  bool plane_;
  Environment environment_;
  World world_;
  SoftBody* body_ = nullptr;
  int steps_ = 0;
  Points first_;
  std::vector<std::uint32_t> first_edges_, first_faces_;
};

// Side view of the roof: its corners along x and z, in m.
Positions roof();

}  // namespace physics

#endif
