// What [JCD10] states in its text and no figure shows, measured: a line each.
#ifndef DARTSWEEP_PAPER_STATEMENTS_H
#define DARTSWEEP_PAPER_STATEMENTS_H

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "library.h"

namespace paper {

using Point = std::array<double, 3>;

struct Statement {
  std::string section, quantity;
  double ours;
  std::string paper;
  double most = HUGE_VAL;  // more is a fault of the program
};
using Statements = std::vector<Statement>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  Point near(const Point& at, double size) {
    return {at[0] + between(-size, size), at[1] + between(-size, size), at[2] + between(-size, size)};
  }

 private:
  std::mt19937_64 engine_;
};

// Cubes of side 1, each of six tetrahedra, with inner vertices off the grid.
struct Tetrahedra {
  Tetrahedra(std::uint32_t side, Random* random);
  physics::Environment environment;
  std::vector<double> points;
  std::vector<std::int64_t> cells;
  std::uint32_t side;
};

physics::Scene make_scene(dsw_environment* environment, std::uint32_t features);
// A body of one edge.
dsw_status add_edge(dsw_scene* scene, const Point* ends, dsw_level level, std::uint32_t flags, dsw_body_id* body);

double dot(const Point& a, const Point& b);
Point minus(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
Point to_point(const double* x);
double quantile(std::vector<double> numbers, double part);

// 5.1: orientation tests of a vertex or particle whose cell has not changed.
void deformations(Statements* out);
// 5.1: where walls push a rigid edge, and how often they bend one that is not.
void walls_that_push(Statements* out);
// 3.3: orientation tests that the cell aimed at saves a particle.
void forecasts(Statements* out);
// 5.2: particles that a change of the topology looks at, of many.
void local_changes(Statements* out);
// 4.2: the normal at a vertex of the last dart, beside the exact one; on the wall of a vessel and on one of blocks.
void normals(dsw_environment* vessel, int trials, Statements* out);
// 4.3: how deep a spike comes through a face at EDGES, beside the text's bound.
void depths(int trials, Statements* out);
// 4.4: edges that share a cell, beside those whose boxes meet.
void registration(Statements* out);

}  // namespace paper

#endif
