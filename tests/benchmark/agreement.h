// Compares engines cast by cast. Where a peer differs from ours, exact arithmetic says who is right, and by how little
// the peer is wrong.
#ifndef DARTSWEEP_TESTS_BENCHMARK_AGREEMENT_H
#define DARTSWEEP_TESTS_BENCHMARK_AGREEMENT_H

#include "exact.h"
#include "report.h"

#include <map>

namespace dsw::bench {

/** How far, in scene units, a peer may be off before a difference counts as unexplained. */
struct Tolerance {
  double absolute = 0.0;  // rounding of its coordinates
  double relative = 0.0;  // of a wall's edges: what its triangle test lets in on purpose
};

/** Gives the tolerance of a peer, by the first word of its name. */
Tolerance tolerance_of(const std::string& peer, const WallMesh& walls);

class Agreement {
 public:
  /** Answers every prepared cast with all engines and compares; the first engine is ours. `sample` casts of ours are
   * also checked exactly, whether or not anybody differs. */
  void compare(const Segments& segments, const std::vector<Engine*>& engines, const WallMesh& walls,
               std::size_t sample);

  /** agree.<peer>.compared, .different, .explained, .unexplained, .largest_slack; agree.exact.checked, .wrong. */
  void write(Report& report) const;

  std::size_t hits() const { return hits_; }
  std::size_t casts() const { return casts_; }

 private:
  struct Peer {
    std::size_t compared = 0, different = 0, explained = 0, unexplained = 0;
    double largest_slack = 0.0;
  };

  bool ours_is_right(const Exact& exact, const Segments& segments, std::size_t cast, const Answer& ours) const;
  void judge(const Exact& exact, const WallMesh& walls, const Segments& segments, std::size_t cast, const Answer& ours,
             const Answer& theirs, const std::string& name);

  std::map<std::string, Peer> peers_;
  std::size_t casts_ = 0, hits_ = 0, checked_ = 0, wrong_ = 0;
};

}  // namespace dsw::bench

#endif
