// A scene with everything that moves in it, one step after the other.
#ifndef DARTSWEEP_PHYSICS_WORLD_H
#define DARTSWEEP_PHYSICS_WORLD_H

#include <memory>

#include "soft_body.h"
#include "walls.h"

namespace physics {

class World {
 public:
  // `features` are those of dsw_scene_desc. The environment has to outlive the world.
  explicit World(dsw_environment* environment, std::uint32_t features = 0);

  SoftBody* add(std::unique_ptr<SoftBody> body);
  // Needs DSW_FEATURE_DEFORMING. The environment reads points from the walls until it is destroyed: take them back with `release_walls`
  // if it lives longer than the world.
  Walls* add_walls(const WallOptions& options);
  Walls* walls() const { return walls_.get(); }
  std::unique_ptr<Walls> release_walls() { return std::move(walls_); }

  // Bodies move in the order in which they were added, then the walls, which answer what bodies did to them and push them.
  // Returns how many were put to rest because their physics handed over something that is no number.
  std::size_t step(double dt);

  dsw_scene* scene() const { return scene_.get(); }
  const std::vector<std::unique_ptr<SoftBody>>& bodies() const { return bodies_; }
  // The reports of the last step.
  const StepReport& report(std::size_t body) const { return reports_[body]; }
  const dsw_deform_report& wall_report() const { return wall_report_; }

 private:
  Scene scene_;
  std::unique_ptr<Walls> walls_;
  std::vector<std::unique_ptr<SoftBody>> bodies_;
  std::vector<StepReport> reports_;
  dsw_deform_report wall_report_ = {};
};

}  // namespace physics

#endif
