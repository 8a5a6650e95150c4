// Bodies for the oracle, and where their vertices are sent.
#pragma once

#include "body_check.h"
#include "places.h"

namespace dsw::oracle {

/// Bodies and moves with a bias to what is exactly on something, and to what meets an obstacle with the inside of an
/// edge or a face only.
class Bodies {
 public:
  Bodies(Arena& arena, Places& places, Rng& rng, dsw_level level)
      : arena_(arena), places_(places), rng_(rng), level_(level) {}
  /// Free as a rule.
  BodyPlan next();
  BodyMove move(const BodyState& state);
  Vec target(const BodyState& state, size_t vertex);

 private:
  void shape(BodyPlan& plan);
  Vec place(const BodyPlan& plan, size_t vertex, double scale);
  Vec on_lattice(Vec p);
  Vec round_obstacle(const BodyState& state, size_t vertex);

  Arena& arena_;
  Places& places_;
  Rng& rng_;
  dsw_level level_;
  bool has_focus_ = false;
  Vec focus_ = {0, 0, 0};  // of the body at hand
};

}  // namespace dsw::oracle
