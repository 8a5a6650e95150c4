#pragma once
// The two convex features of a contact, ready for a test of how deep one lies in the other: seen from the contact
// point, of unit size, the body's one pushed in against the normal.

#include "environment/environment.h"

namespace dsw {

/** What is asked about, in the engine's terms. */
enum class TouchKind : uint32_t {
  kPoint,     // the moving vertex on a face
  kDiagonal,  // an edge of the body on a diagonal of a face
  kEdge,      // an edge of the body on an edge of the obstacle
  kCorner     // a face of the body on a vertex of the obstacle
};

struct ReportedTouch {
  TouchKind kind = TouchKind::kPoint;
  const double *position, *fixed;  // the moving vertex; one (edge) or two (face) others
  const double *point, *normal;
  HalfFacet wall;       // seen from the passable side; not used by kEdge
  Dart edge;            // kEdge: one dart of the obstacle's
  uint32_t vertex = 0;  // kCorner: the obstacle's
};

enum class NoFeatures : uint32_t { kFound, kParallel, kOutsideCone, kDegenerate };

/** The hull of points. */
struct Hull {
  explicit Hull(const Memory* memory) : points(memory) {}
  size_t count() const { return points.size() / 3; }
  Array<double> points;  // 3 each
};

struct Features {
  explicit Features(const Memory* memory) : body(memory), obstacle(memory) {}
  Hull body, obstacle;
  double unit = 0;  // length of 1, scene units
};

/** Both features; the body's is where it touches, not yet pushed in. Throws std::bad_alloc. O(cells round the edge). */
NoFeatures find_features(const Environment<3>& env, const ReportedTouch& touch, Features& features);

/** The point of a hull that lies farthest in a direction. */
const double* farthest(const Hull& hull, const double* direction) noexcept;

/** How far the body has to go along a unit vector until it is out of the obstacle. */
double way_out(const Hull& body, const Hull& obstacle, const double* along) noexcept;

/** Moves the body's feature against the normal. */
void push_in(Hull& body, const double* normal, double depth) noexcept;

}  // namespace dsw
