// Who answers queries: the library, and peers on the same doubles.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_METHODS_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_METHODS_H

#include "queries.h"

#include <memory>

namespace dsw::pairs {

struct Answer {
  bool touches;
  double time;  // of the first touch
};

class Method {
 public:
  virtual ~Method() = default;
  /** Brings a query into the method's own types: not timed. */
  virtual void prepare(const Query& query) { query_ = &query; }
  /** Answers the query that was prepared: timed. */
  virtual Answer ask() = 0;

 protected:
  const Query* query_ = nullptr;
};

/** Answers nothing: what the clock takes. */
std::unique_ptr<Method> make_nothing();
/** dsw_sweep_pairs, one call for each query. */
std::unique_ptr<Method> make_ours();
/** FCL's tests of moving vertices and edges: Newton's method, FCL's default, or the closed form of the cubic.
 * @param scaled by the power of two that brings the largest coordinate to 1024 .. 2048. Its tolerances are lengths. */
std::unique_ptr<Method> make_fcl(bool newton, bool scaled);

/** The addresses of ticcd::vertexFaceCCD and ticcd::edgeEdgeCCD in a library that was compiled for this machine. */
struct TightInclusionLibrary {
  void* vertex_face = nullptr;
  void* edge_edge = nullptr;
};
/** Tight-Inclusion as its own program for the sample queries has it. */
std::unique_ptr<Method> make_tight_inclusion(const TightInclusionLibrary& library);

}  // namespace dsw::pairs

#endif
