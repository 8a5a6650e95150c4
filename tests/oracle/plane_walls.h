// What moving walls of the plane meet, exactly: the sweeps of exact.h turned round. What moves there is a wall's
// vertex, the obstacle is a part of a body; all of it is mirrored, since the shift of the one is minus that of the
// other.
#pragma once

#include "deform_ground.h"
#include "plane_sweeps.h"

#include <optional>

namespace dsw::oracle {

/// A point of a body, or an edge by its two ends, that stays where it is.
class Obstacle {
 public:
  explicit Obstacle(const std::vector<Vec>& at);

  /// When a vertex on its way meets the edge.
  std::optional<double> met_by_vertex(const Vec& from, const Vec& to);
  /// When a wall's side from a vertex on its way to `other` meets the point.
  std::optional<double> met_by_side(const Vec& from, const Vec& to, const Vec& other);
  /// How often, in the sense of its turn, a side passes the point while its ends go from one place to the next:
  /// whatever their order, that is the same.
  int passed_by_side(const std::array<Vec, 2>& from, const std::array<Vec, 2>& to);

 private:
  std::optional<double> first(const VertexMove& move, dsw_level level);

  plane::World world_;
  std::unique_ptr<PlaneSweeps> sweeps_;
};

/// A deformation of a world.
class WallValidator {
 public:
  WallValidator(const plane::World& world, const std::vector<int>& marked_vertices, const Deformed& deformed);

  /// Whether it is known where all walls went, and the part was at rest. Only if all of the environment was valid
  /// before and after: walls far away, which nobody looks at, may pass over anything while it is not.
  bool knows(const Part& part) const;
  /// What passed it; empty if nothing did.
  std::string passed(const Part& part) const;
  /// What is wrong with a contact; `part` is what it names, as it was before, or null if that is not known.
  std::string wrong_contact(const dsw_wall_contact& contact, const Part* part) const;

 private:
  Vec on_way(int vertex, double fraction) const;
  std::vector<Vec> places(int vertex, double way, uint32_t steps) const;
  bool is_impassable(int vertex, dsw_level level) const;
  std::string wrong_wall(const dsw_wall_contact& contact) const;

  const plane::World& world_;
  const std::vector<int>& marked_vertices_;
  const Deformed& d_;
};

}  // namespace dsw::oracle
