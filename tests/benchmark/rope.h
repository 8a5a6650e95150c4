// A rope that meets itself: a helix whose turns wobble through each other, if nothing stops them.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ROPE_H
#define DARTSWEEP_TESTS_BENCHMARK_ROPE_H

#include "ours.h"

#include "scenes/hex_grid.h"

namespace dsw::bench {

/** The lattice that holds the rope, without obstacles. */
class RopeSpace {
 public:
  RopeSpace();
  dsw_environment* environment() const { return world_.environment(); }

 private:
  scenes::HexGrid grid_;
  World world_;
};

/** The rope's vertices at every step, 3 doubles each. */
std::vector<std::vector<double>> rope_targets(std::size_t edges, std::size_t steps);

/** What our body did in one step. */
struct RopeStep {
  std::vector<double> before, after;
  std::vector<std::uint8_t> stopped;  // by itself, a vertex
  std::size_t contacts = 0;
};

/** A rope in a scene of its own; nothing else is there. */
class Rope {
 public:
  Rope(dsw_environment* environment, const std::vector<double>& at, bool meets_itself);
  ~Rope();
  Rope(const Rope&) = delete;
  Rope& operator=(const Rope&) = delete;

  dsw_scene* scene() const { return scene_; }
  dsw_body_id body() const { return body_; }
  /** @return processor time of the move alone, ns */
  double move(const std::vector<double>& targets, RopeStep& step);

 private:
  std::vector<double> at_;
  dsw_scene* scene_ = nullptr;
  dsw_body_id body_{};
};

}  // namespace dsw::bench

#endif
