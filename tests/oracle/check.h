// Compares what the library answers with the oracle's answer, one flight at a time.
#pragma once

#include "defaults.h"
#include "environments.h"
#include "names.h"
#include "rng.h"
#include "scenes.h"
#include "world.h"

#include <cstdint>
#include <map>
#include <string>

namespace dsw::oracle {

struct Tally {
  uint64_t casts = 0, mismatches = 0, lost = 0, ties = 0, contacts = 0, stuck = 0;
};

/// Collects the figures and prints the first mismatches with all that is needed to see them again.
class Report {
 public:
  explicit Report(int print_most = 20) : print_most_(print_most) {}
  void begin(const std::string& scene, const std::string& reproduce);
  void flight(const Walk& walk);
  /// A stopped particle that stayed where it was although the way was free for a good part of the scene.
  void stuck(const std::string& text);
  void mismatch(const std::string& text);
  void lost(const std::string& text);

  Tally total;
  std::map<std::string, Tally> scenes;
  bool show_stuck = false;
  uint64_t refused = 0;  // scenes whose jitter left no valid triangulation, or an outer boundary that crosses itself

 private:
  Tally* scene_ = nullptr;
  std::string reproduce_;
  int printed_ = 0, print_most_;
};

/// Checks single calls against a World.
class Checker {
 public:
  Checker(World& world, dsw_environment* environment, Report& report)
      : world_(world), environment_(environment), report_(report) {}

  enum Way { kCast, kPath, kBatch, kNoDetail, kWays };
  /// A free cast; `hint` is handed over as start, `known` says that it is right. max_volumes 0: no limit. `start` is
  /// the cell that the oracle takes as start, or -1 to have it located.
  void free_cast(const Vec& p, const Vec& q, Way way, dsw_volume_id hint, bool known, uint32_t max_volumes,
                 int start = -1);
  void locate(const Vec& p, dsw_volume_id hint);
  /// Moves a particle and checks the report, the reached place and the recorded volume.
  void move(dsw_scene* scene, dsw_particle_id particle, const Vec& target, uint32_t max_volumes, bool crossings);

 private:
  bool compare_hit(const Walk& walk, const dsw_flight& flight, const std::string& what);
  void compare_crossings(const Walk& walk, const dsw_crossing* crossings, size_t count, uint32_t max_volumes,
                         const std::string& what);
  bool same_volume(dsw_volume_id id, int cell) const;
  bool same_face(dsw_face_id id, int face) const;
  bool limited(const Walk& walk, uint32_t max_volumes) const {
    return max_volumes != 0 && walk.steps.size() > max_volumes;
  }

  World& world_;
  dsw_environment* environment_;
  Report& report_;
};

}  // namespace dsw::oracle
