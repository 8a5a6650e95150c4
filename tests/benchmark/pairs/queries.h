// Queries of continuous collision detection with their answers: public sets, which are read where they are.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_QUERIES_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_QUERIES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dsw::pairs {

struct Query {
  std::uint8_t kind;  // dsw_pair_kind
  bool set_truth;     // what the set says, if it has answers: whether the pair touches
  std::array<std::array<double, 3>, 4> start, end;
};

/** Queries of one collection. */
struct QuerySet {
  std::string name;
  bool has_truth;
  std::vector<Query> list;
  std::size_t files = 0;
  std::size_t inexact = 0;  // queries with a coordinate that is no double; they are left out
};

/**
 * Reads all sets below a folder as collections, which are named after the two layouts:
 *
 * - "sample queries": SCENE/edge-edge/NAME.csv and SCENE/vertex-face/NAME.csv, truth in the last column;
 * - "scalable CCD": SCENE/queries/NAMEee.csv and NAMEvf.csv, truth in SCENE/mma_bool/NAMEee_mma_bool.json.
 *
 * The queries of a collection are shuffled, the same way every time, so that the first ones are a fair sample.
 * Throws std::runtime_error, which names the file and the line.
 */
std::vector<QuerySet> read_sets(const std::string& folder);

}  // namespace dsw::pairs

#endif
