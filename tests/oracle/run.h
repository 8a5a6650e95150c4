// The oracle's run: scenes, marks and motions from a seed.
#pragma once

#include "check.h"

namespace dsw::oracle {

struct RunOptions {
  uint64_t casts = 20000;
  uint64_t seed = 1;
  std::string only;            // a scene's name, or empty
  uint64_t casts_a_scene = 0;  // 0: chosen so that every scene and transform has its turn
};

void run(const RunOptions& options, Report& report);
std::string to_json(const Report& report);

/// Body points with a bias to everything that is exactly on something.
class Motions {
 public:
  Motions(const World& world, Rng& rng) : world_(world), rng_(rng) {}
  Vec start();
  Vec site();
  Vec target(const Vec& from);

 private:
  Vec vertex();
  Vec any_target(const Vec& from);
  const World& world_;
  Rng& rng_;
};

}  // namespace dsw::oracle
