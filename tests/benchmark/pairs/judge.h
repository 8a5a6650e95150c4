// The whole comparison. A library, so that a process that has loaded Tight-Inclusion can run it as well.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_JUDGE_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_JUDGE_H

/**
 * Runs with the arguments of a command line.
 * @param vertex_face address of ticcd::vertexFaceCCD, or null: Tight-Inclusion is left out.
 * @param edge_edge of ticcd::edgeEdgeCCD.
 * @return the exit code: 1 if an answer of the library is not exact.
 */
extern "C" int dartsweep_pairs(int argc, const char* const* argv, void* vertex_face, void* edge_edge);

#endif
