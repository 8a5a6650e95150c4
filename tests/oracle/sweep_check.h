// Compares what the library answers about a swept edge with the truth, one report at a time.
#pragma once

#include "arena.h"

#include <map>

namespace dsw::oracle {

struct SweepTally {
  uint64_t sweeps = 0, missed = 0, late = 0, early = 0, wrong = 0, not_free_after = 0;
  uint64_t ties = 0, inside_only = 0, contacts = 0, edge_contacts = 0, face_contacts = 0, not_free = 0, stuck = 0;
  uint64_t faults() const { return missed + late + early + wrong + not_free_after; }
};

/// Collects the figures and prints the first faults with all that is needed to see them again.
class SweepReport {
 public:
  explicit SweepReport(int print_most = 20) : print_most_(print_most) {}
  void begin(const std::string& scene, const std::string& reproduce);
  void sweep(const SweepTruth& truth, bool may_start);
  /// A step of a body: one vertex moved.
  void step(const MoveTruth& truth);
  /// A vertex that stayed where it was although the way was free for a good part of the scene.
  void stuck();
  enum Fault { kMissed, kLate, kEarly, kWrong, kNotFreeAfter };
  void fault(Fault fault, const std::string& text);

  SweepTally total;
  std::map<std::string, SweepTally> scenes;

 private:
  SweepTally* scene_ = nullptr;
  std::string reproduce_;
  int printed_ = 0, print_most_;
};

class SweepChecker {
 public:
  SweepChecker(Arena& arena, SweepReport& report) : arena_(arena), report_(report) {}

  /// Whether the edge may start at all.
  bool may_start(const SweepTruth& truth) const;
  /// The contact at a level: the events with the first time, or none.
  static const std::vector<SweepEvent>& first(const SweepTruth& truth, dsw_level level);
  void compare(const Sweep& sweep, dsw_level level, const dsw_sweep& got, const std::string& how);
  /// `whole`: the answer without a limit.
  void compare_limited(const Sweep& sweep, uint32_t max_volumes, const dsw_sweep& whole, const dsw_sweep& got,
                       const std::string& how);
  /// The truth against the oracle of casts, and against itself with the triangle's corners exchanged or its path cut.
  void check_truth(const Sweep& sweep);

 private:
  Arena& arena_;
  SweepReport& report_;
};

}  // namespace dsw::oracle
