// Meshes in the plane: triangles, quads that need not be convex, polygons of many kinds, slivers; and their
// environments.
#pragma once

#include "environments.h"
#include "plane_mesh.h"
#include "rng.h"
#include "scenes.h"

namespace dsw::oracle::plane {

struct Kind {
  const char* name;
  void (*make)(Rng& rng, World& world);
  bool integer;    // coordinates are
  bool triangles;  // all cells are
  bool fine;       // what 1e8 would swallow
};
const std::vector<Kind>& kinds();

/// A kind in one of its sizes.
struct Turn {
  const Kind* kind;
  Transform transform;
  std::string name() const { return std::string(kind->name) + transform_name(transform); }
  /// Doubles are as coarse as the cells: the centre of what is no triangle may be rounded out of its cell.
  bool coarse() const { return transform == Transform::kDenormal || transform == Transform::kCoarse; }
  bool may_be_refused() const { return coarse() && !kind->triangles; }
};
/// All that have their turn in a round; `only` names a kind, or is empty.
std::vector<Turn> turns(const std::string& only);

World make_world(const Turn& turn, Rng& rng);
/// With everything that is left open chosen at random; null if the library refuses it.
EnvironmentPtr make_environment(const Turn& turn, const World& world, Rng& rng, dsw_context* context = nullptr);

/// The shares of cells, sides and vertices that become impassable.
struct Shares {
  double cells, sides, vertices;
};
/// Marks in both, and says which vertices. What failed, or empty.
std::string mark(World& world, dsw_environment* environment, const Shares& shares, Rng& rng,
                 std::vector<int>& vertices);

}  // namespace dsw::oracle::plane
