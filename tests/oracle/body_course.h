// What bodies of one level go through in one scene, each step compared with exact arithmetic.
#pragma once

#include "body_run.h"
#include "body_scenes.h"

namespace dsw::oracle {

/// Bodies of one level in one scene.
class Course {
 public:
  Course(Arena& arena, Places& places, dsw_environment* environment, dsw_scene* scene, dsw_level level, Rng& rng,
         BodyReport& report)
      : arena_(arena),
        places_(places),
        environment_(environment),
        scene_(scene),
        level_(level),
        rng_(rng),
        report_(report) {}

  /// A body that stops at what it touches, beside others that leave out work, all of the same bits.
  void stopping();
  void responding();
  /// Levels, splits, collapses, parts added and removed, rigid motions: free after each, or refused for a reason.
  void editing();
  /// Elimination by similar motion: nothing may be met where it ends, on the way something may be.
  void eliminating();

 private:
  bool create(BodyChecker& checker, Bodies& source, SweepReport& faults, uint32_t flags, BodyPlan& plan,
              dsw_body_id& body, BodyState& state);
  void compare_made(const BodyState& want, const BodyState& got, SweepReport& faults);
  dsw_move_options options_of(const BodyMove& move);
  dsw_status edit(dsw_body_id body, Bodies& source, const BodyState& state, uint32_t kind, SweepReport& faults);
  bool moved(dsw_body_id body, const BodyMove& move, const dsw_move_options& options, BodyAnswer& answer,
             SweepReport& faults);

  Arena& arena_;
  Places& places_;
  dsw_environment* environment_;
  dsw_scene* scene_;
  dsw_level level_;
  Rng& rng_;
  BodyReport& report_;
};

}  // namespace dsw::oracle
