// The moves of a catheter that a hand pushes into a vessel, recorded to be made again: the haptic preset of
// examples/insertion without contact memory, so that every step finds all of its contacts.
#ifndef DARTSWEEP_TESTS_BENCHMARK_CATHETER_MOVES_H
#define DARTSWEEP_TESTS_BENCHMARK_CATHETER_MOVES_H

#include "vessel.h"

namespace dsw::bench {

/** A vessel of examples/insertion. @param mesh of examples/demo/read_mesh.py; empty: the generated one. */
insertion::Options catheter_options(const std::string& mesh);

struct CatheterMoves {
  std::vector<double> start;         // of the vertices, 3 doubles each, once all links are in
  std::vector<std::uint32_t> edges;  // two vertices each
  std::vector<double> targets;       // move by move

  std::size_t count() const { return start.empty() ? 0 : targets.size() / start.size(); }
  const double* move(std::size_t i) const { return targets.data() + i * start.size(); }
};

/** The first moves with all links in: of `most`, those that the preset makes. Throws. */
CatheterMoves record_moves(const insertion::Vessel& vessel, const insertion::Options& options, std::size_t most);

/** False where there is no such file. Throws where it holds something else. */
bool read_moves(const std::string& path, CatheterMoves& moves);
void write_moves(const std::string& path, const CatheterMoves& moves);

/** The catheter in a scene of its own, without physics. */
class CatheterReplay {
 public:
  CatheterReplay(dsw_environment* environment, const CatheterMoves& moves);

  /** Move i, as the preset makes it. */
  void move(std::size_t i);
  dsw_scene* scene() const { return scene_.get(); }
  dsw_body_id body() const { return body_; }

 private:
  const CatheterMoves& moves_;
  dsw_move_options options_{};
  physics::Scene scene_;
  dsw_body_id body_{};
};

}  // namespace dsw::bench

#endif
