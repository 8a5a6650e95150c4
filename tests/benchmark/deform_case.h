// The lattice of [JCD10] 7.4 while every vertex of it moves every step, and its bodies with it: a step of ours, timed,
// and what other engines need to repeat it.
#ifndef DARTSWEEP_TESTS_BENCHMARK_DEFORM_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_DEFORM_CASE_H

#include "hex_case.h"

namespace dsw::bench {

/** A wave that runs through a lattice: 0.05 cells high along each axis, some ten cells long, a period of 16 steps. */
class TravellingWave {
 public:
  explicit TravellingWave(const std::array<std::uint32_t, 3>& size);

  /** Places of all vertices of the lattice. */
  void write(std::size_t step, std::vector<double>& points) const;
  /** The place of any point of the lattice. */
  void move(std::size_t step, const double* lattice, double* space) const;

 private:
  std::array<std::uint32_t, 3> size_;
  std::array<std::vector<std::array<double, 2>>, 9> turns_;  // by component and axis: cosine and sine at each layer
};

/** What an engine needs to repeat a step, and what ours answered. */
struct DeformStep {
  std::size_t wave = 0;  // its step
  Segments segments;     // one batch
  std::vector<Answer> answers;
};

class DeformCase {
 public:
  explicit DeformCase(std::size_t cells);

  struct Times {
    double update, queries;  // ns
    std::uint32_t alone;     // vertices that moved one at a time
  };
  /** Takes the environment to the next step of the wave; particles lie at all vertices of the bodies and are cast. */
  Times advance(dsw_deform_method method, DeformStep& step);

  /** Puts the points of the walls to where they are in a step. */
  void place_walls(std::size_t wave_step);

  const WallMesh& walls() const { return hex_.walls; }
  /** Moves of particles that walls made, and deformations that did not go all the way. */
  std::size_t pushed() const { return pushed_; }
  std::size_t shortened() const { return shortened_; }

 private:
  std::vector<double> in_space(const std::vector<double>& lattice) const;
  bool place_particle(std::size_t i, const double* lattice_point);
  void move_particles();

  HexCase hex_;
  TravellingWave wave_;
  Ours names_;
  std::size_t step_ = 0;
  std::array<std::vector<double>, 2> points_;  // lent
  std::vector<double> wall_points_;
  std::vector<dsw_particle_id> particles_, sources_;  // of a vertex, of a cast
  std::vector<std::array<std::size_t, 2>> ends_;      // of a cast: vertices
  std::vector<double> to_;
  std::vector<dsw_flight> flights_;
  std::size_t pushed_ = 0, shortened_ = 0;
};

}  // namespace dsw::bench

#endif
