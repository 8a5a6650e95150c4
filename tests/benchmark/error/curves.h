// The curves of this program, by what is measured together. Each writes its tables to `options.out`.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_CURVES_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_CURVES_H

#include "curve.h"

#include <cstdint>

namespace dsw::curves {

struct Options {
  bool quick = false;
  double scale = 1;  // on all counts; tests make it small
  std::string out;   // a folder that exists
  std::uint64_t seed = 1;

  /** A count for this run, at least 8. */
  std::size_t count(std::size_t quick_count, std::size_t full_count) const {
    const double wanted = scale * static_cast<double>(quick ? quick_count : full_count);
    return wanted < 8 ? 8 : static_cast<std::size_t>(wanted);
  }
  int rounds() const { return quick ? 3 : 7; }
};

/** edge_time, edge_place, edge_normal, move_time: the dichotomic search against the exact one. */
void time_curves(const Options& options);
/** missed_vessel, missed_faces, missed_spikes: levels against the length of edges. */
void level_curves(const Options& options);
/** ccd_vertex_face, ccd_edge_edge, degenerate_vertex_face, degenerate_edge_edge, contact_point, contact_normal: single
 * pairs, beside peers. Leaves the pairs of the first four in pairs_<curve>.csv. */
void pair_curves(const Options& options);
/** cast_time, cast_through: casts through a scene, beside peers. */
void cast_curves(const Options& options);
/** sampling_vessel, sampling_faces: vertices of a catheter. */
void sampling_curves(const Options& options);
/** elimination: edges that are not looked at. */
void elimination_curve(const Options& options);
/** stand_off_gap, stand_off_fallbacks: a distance kept from walls along which a sheet slides. */
void slide_curves(const Options& options);

}  // namespace dsw::curves

#endif
