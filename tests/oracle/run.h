// The oracle's run: scenes, marks and motions from a seed.
#pragma once

#include "check.h"
#include "places.h"

namespace dsw::oracle {

struct RunOptions {
  uint64_t casts = 20000;
  uint64_t seed = 1;
  std::string only;            // a scene's name, or empty
  uint64_t casts_a_scene = 0;  // 0: chosen so that every scene and transform has its turn
};

void run(const RunOptions& options, Report& report);
std::string to_json(const Report& report);

/// In a mesh in space.
class Motions : public Places {
 public:
  Motions(const World& world, Rng& rng) : Places(3, world.size, rng), world_(world) {}
  Vec start() override;
  Vec site() override;

 protected:
  Vec vertex() override;
  std::array<Vec, 2> ends() override;

  const World& world_;
};

}  // namespace dsw::oracle
