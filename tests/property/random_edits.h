// Random changes of an environment's topology with particles and bodies inside, and what has to hold after each.
#pragma once

#include "support.h"

#include "capi/handle.h"
#include "run.h"

namespace dsw::oracle {

enum class Operation {
  kSew,
  kUnsew,
  kRemove,
  kMergeVolumes,
  kSplitVolume,
  kMergeFaces,
  kSplitFace,
  kSplitEdge,
  kMergeEdges,
  kCollapse,
  kCount
};
const char* name_of(Operation operation);

/// How often an operation was tried, done, and refused because of what was in the way.
struct EditTally {
  size_t tried = 0, done = 0, occupied = 0;
};

class RandomEdits {
 public:
  RandomEdits(const std::string& scene, uint64_t seed);

  /// One call with random arguments, then all checks that do not need exact integers. What is wrong; empty: nothing.
  std::string step();
  /// Particles, bodies and volumes against brute force in exact integers.
  std::string check_exactly();

  const dsw_environment* environment() const { return place_.get(); }
  size_t volume_count() const { return env().map.cell_count; }
  size_t exact_checks = 0;  // of a partition; others look at volumes and particles only
  EditTally tallies[static_cast<size_t>(Operation::kCount)];

 private:
  const Environment<3>& env() const { return place_.get()->engine; }
  const Scene<3>& scene() const { return scene_->engine; }

  void mark_some();
  void add_particles();
  void add_bodies();
  Operation choose();
  dsw_status call(Operation operation);
  dsw_status sew();
  dsw_status split_volume();
  dsw_status split_face();
  dsw::Cell some_cell();
  dsw_face_id some_face();
  dsw_edge_id some_edge();
  dsw_vertex_id vertex_of(dsw_edge_id edge);
  std::string state() const;
  std::string check() const;
  std::string check_counts() const;
  double volume() const;

  Place place_;
  ScenePtr scene_;
  Rng rng_;
  size_t first_count_ = 0;
  std::vector<std::array<dsw_face_id, 2>> unsewn_;
  double volume_ = 0;
  bool may_change_ = false;  // the last call: the space that all volumes fill
};

}  // namespace dsw::oracle
