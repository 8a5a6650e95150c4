// Small environments of every kind, made from a seed.
#pragma once

#include "mesh.h"
#include "rng.h"

#include <string>
#include <vector>

namespace dsw::oracle {

/// What is done to all points after a scene was made.
enum class Transform { kNone, kFar, kLarge, kSmall, kPower, kDenormal, kCoarse, kVast, kTiny };
const char* transform_name(Transform t);
double transformed(double x, Transform t);

struct SceneKind {
  const char* name;
  Mesh (*make)(Rng& rng);
  bool integer;            // integer coordinates, and cells that bear their centre rounded to integers
  bool may_cross = false;  // the outer boundary may pass through itself, so creation is asked to look
};

const std::vector<SceneKind>& scene_kinds();
/// Kinds that the library made of parts that lie on each other.
const std::vector<SceneKind>& conformed_kinds();
/// Both, one after the other.
const std::vector<SceneKind>& all_kinds();
/// The cells that DSW_ENVIRONMENT_CONFORM makes of a mesh; none if it is refused.
Mesh conformed(const Mesh& loose);
/// An integer linear map with positive determinant: flat faces, ties, no axis.
void shear(Mesh& mesh, Rng& rng);
void apply_transform(Mesh& mesh, Transform t);

/// Rectilinear hexahedra over three ascending coordinate lists.
Mesh hex_grid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z);
/// Axis 0, s, 2 s, ... with n intervals.
std::vector<double> axis(int n, double s);
/// Delaunay tetrahedra of random integer points in 0 .. size.
Mesh delaunay(Rng& rng, int points, int size);
/// Voronoi cells of random points; `share`: how far their vertices are drawn away from where they belong, which leaves
/// no face flat.
Mesh voronoi(Rng& rng, double share, int points = 28);
/// Whether some face has no triangulation that keeps the stars of its volumes positive: then creation may refuse the
/// mesh.
bool may_be_refused(const Mesh& mesh);
/// Puts the cells of a mesh into another order.
void shuffle_cells(Mesh& mesh, Rng& rng);

}  // namespace dsw::oracle
