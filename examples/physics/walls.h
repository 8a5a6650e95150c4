// Walls that give way: the impassable faces inside of an environment as a net of springs, anchored where they are at rest.
#ifndef DARTSWEEP_PHYSICS_WALLS_H
#define DARTSWEEP_PHYSICS_WALLS_H

#include <unordered_map>

#include "contact_response.h"
#include "integrators.h"
#include "library.h"

namespace physics {

struct WallOptions {
  double mass = 1;        // of each vertex
  double stretching = 1;  // stiffness of each edge, force per length
  double anchor = 1;      // stiffness of the spring that ties each vertex to its place at rest
  IntegratorOptions integrator;
  dsw_deform_options deform;

  WallOptions() { dsw_deform_options_init(&deform, sizeof deform); }
};

class Walls {
 public:
  // Makes the walls of the environment of a scene with DSW_FEATURE_DEFORMING. The environment reads its points from
  // here from the first step on: the walls have to be there as long as the environment is. O(volumes). Throws
  // LibraryError.
  Walls(dsw_scene* scene, const WallOptions& options);
  Walls(const Walls&) = delete;
  Walls& operator=(const Walls&) = delete;

  // What bodies did to the wall: the opposite of each impulse, in equal parts to the corners of the face that was met.
  void take_reactions(const std::vector<Touch>& touches);

  // One time step: integrate, then bend the environment as far as the library finds possible. Vertices it held have the velocity of what
  // they made. Positions that are no numbers give DSW_STATUS_NON_FINITE: the walls stay, at rest. (They do not go to the library, which
  // would refuse them near bodies only and call the volumes elsewhere invalid.)
  dsw_status step(double dt, dsw_deform_report* report);

  // Vertices of the wall first, then their anchors, which are held.
  Points points;
  Springs springs;
  Load load;
  // Vertices of the wall, and which vertex of the environment each of them is.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }

 private:
  void find_wall();
  std::size_t point_of(dsw_vertex_id vertex);

  dsw_scene* scene_;
  WallOptions options_;
  std::vector<std::uint32_t> vertices_;
  std::unordered_map<std::uint32_t, std::size_t> point_of_;
  std::vector<double> arrays_[2];  // lent in turn
  int next_array_ = 0;
};

}  // namespace physics

#endif
