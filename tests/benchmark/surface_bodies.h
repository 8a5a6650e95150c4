// Bodies of a scene as the benchmark makes and moves them.
#ifndef DARTSWEEP_TESTS_BENCHMARK_SURFACE_BODIES_H
#define DARTSWEEP_TESTS_BENCHMARK_SURFACE_BODIES_H

#include "ours.h"

namespace dsw::bench {

/** A level and what it leaves out. */
struct Variant {
  std::string name;
  dsw_level level = DSW_LEVEL_EDGES;
  std::uint32_t flags = 0;
};

/** Edges and triangles that each of the bodies has. */
struct BodyShape {
  std::size_t vertices = 0;
  std::vector<std::uint32_t> edges, corners;  // two and three vertices each
};

/** Bodies of one shape in a scene of their own. */
class Flock {
 public:
  /** @param positions those of the bodies one after the other. @param features of the scene. */
  Flock(dsw_environment* environment, const Variant& variant, const BodyShape& shape,
        const std::vector<double>& positions, std::uint32_t features = 0);
  ~Flock();
  Flock(const Flock&) = delete;
  Flock& operator=(const Flock&) = delete;

  const Variant& variant() const { return variant_; }
  dsw_scene* scene() const { return scene_; }
  const std::vector<dsw_body_id>& bodies() const { return bodies_; }
  const dsw_move_report& report(std::size_t body) const { return reports_[body]; }

  /** Moves all vertices. */
  void move(const double* targets, const dsw_move_options* options = nullptr);
  /** Moves all vertices at once. */
  void move_together(const double* targets, dsw_together_stop stop);
  /** Positions and volumes of all vertices, body by body. */
  void places(std::vector<double>& positions, std::vector<dsw_volume_id>& volumes) const;
  /** Sums of a report's members over the bodies. */
  std::size_t swept() const;
  std::size_t skipped() const;
  std::size_t stopped() const;

 private:
  Variant variant_;
  std::size_t vertices_;  // of one body
  dsw_scene* scene_ = nullptr;
  std::vector<dsw_body_id> bodies_;
  std::vector<dsw_move_report> reports_;
};

}  // namespace dsw::bench

#endif
