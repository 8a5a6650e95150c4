// What a swept triangle or tetrahedron meets, by brute force over everything impassable: polynomials in the
// infinitesimal with GMP coefficients. It reads the engine's map for what stands where, and asks it for nothing else.
#pragma once

#include "environment/environment.h"
#include "numbers.h"
#include "predicates/sweep_events.h"

#include <array>
#include <set>
#include <vector>

namespace dsw::swept {

using oracle::Big;

/// Coefficients of 1, e, e^2, ...: of a time or side up to e^3, of a product of two up to e^6.
struct Poly {
  std::array<Big, 7> c;
  int sign() const;
};
Poly operator-(const Poly& a, const Poly& b);
Poly operator*(const Poly& a, const Poly& b);

/// N / D with D > 0.
struct Moment {
  Poly numerator, denominator;
};
int compare(const Moment& a, const Moment& b);

using Line = std::array<uint32_t, 2>;

class SweptTruth {
 public:
  explicit SweptTruth(const Environment<3>& env);

  /// Takes body points at[0] .. at[count - 1]; the functions below name them by number.
  void load(const double* const* at, int count);

  /// Side of an environment vertex of the plane through three body points.
  int side(int x, int y, int z, uint32_t vertex) const;
  /// Whether the triangle of three body points meets a line (vertices of the environment).
  bool line_pierces(int x, int y, int z, const Line& line) const;
  bool segment_pierces(int x, int y, const std::array<uint32_t, 3>& triangle) const;
  /// Whether triangle x y z meets nothing impassable.
  bool is_free(int x, int y, int z) const;
  bool is_flat(int x, int y, int z, int w) const;

  /// Body points p, to, q, r: whether vertex v lies inside, and when the face meets it.
  bool inside(uint32_t v) const;
  Moment face_moment(uint32_t v) const;
  Moment edge_moment(const Line& line) const;

  std::set<uint32_t> vertices;                     // impassable ones
  std::vector<std::array<uint32_t, 3>> triangles;  // impassable ones, each once
  std::set<Line> lines;                            // their sides, and marked edges

 private:
  using Point = std::array<Big, 3>;
  struct Box {
    double low[3], high[3];
  };
  Point at(uint32_t vertex) const;
  Poly line_value(int x, int y, const Line& line) const;
  bool apart(std::initializer_list<int> body, const uint32_t* vertices_of, int count) const;

  const Environment<3>& env_;
  int need_ = 0;
  std::vector<Point> fixed_;
  std::vector<Point> body_;
  std::vector<const double*> raw_;
  int shift_ = 0;  // body_ and at() are coordinates times 2^shift_
  Big unit_;       // how long 1 is in them
};

}  // namespace dsw::swept
