// The oracle's own, brute-force answer to "what does an edge meet whose end p moves to p' while its end q stays".
// Every obstacle is looked at, in integers over a common power of two; only boxes that are apart skip one. p, p' and q
// are shifted by one and the same s = (e, e^2, e^3), in units of the coordinates; values linear in s are kept as
// polynomials in e, and times are compared as their ratios.
#pragma once

#include "world.h"

namespace dsw::oracle {

/// c[0] + c[1] e + c[2] e^2 + c[3] e^3.
struct Shifted {
  Big c[4];
  int sign() const;
  void negate();
};

/// A moment in which the swept edge meets an obstacle: its moving end a triangle, or its inside an obstacle's edge.
struct SweepEvent {
  int triangle = -1, side = 0;     // of the moving end; side as in Walk
  int a = -1, b = -1;              // of the inside: the two vertices, a < b
  Shifted numerator, denominator;  // time; the denominator is positive
  double time = 0;                 // its standard part, rounded down
  bool regular = true;             // the standard part needs no shift
};

/// What is true of one sweep, at every level.
struct SweepTruth {
  int start = -1;                       // cell of p; -1: outside, -2: the cells overlap
  bool start_free = false;              // p q meets nothing
  bool path_hit = false;                // p p' does
  bool new_edge_hit = false;            // p' q does
  std::vector<SweepEvent> path, swept;  // the first one, and any that have exactly its time
  bool tie = false;                     // a value that had to be looked at was zero without the shift
};

class SweepWorld {
 public:
  /// Marks must be set; wires are pairs of vertices. `world` must outlive this.
  SweepWorld(World& world, const std::vector<std::array<int, 2>>& wires);
  SweepTruth sweep(const Vec& from, const Vec& to, const Vec& fixed);
  /// Whether segment x y, shifted, goes through an obstacle triangle.
  bool blocked(const Vec& x, const Vec& y);

 private:
  using Point = std::array<Big, 3>;
  struct Box {
    Vec low, high;
  };
  struct Normal {
    int triangle;
    Box box;
    Point n;
  };
  struct Edge {
    int a, b;
    Box box;
  };

  void load(const Vec* points, int count);
  const Point& at(int vertex);
  Shifted shifted(const Big& unshifted, const Point& coefficients) const;
  int sign_with_ties(const Big& unshifted, const Point& coefficients);
  Big line_value(int x, int y, int a, int b);
  Point line_shift(int x, int y, int a, int b);
  int line_sign(int x, int y, int a, int b);
  Shifted line(int x, int y, int a, int b);
  int pierce(int x, int y, const Normal& t);
  bool any_pierced(const Vec* points, int x, int y);
  void add_vertex_events(const Box& box, std::vector<SweepEvent>& events);
  void add_edge_events(const Box& box, std::vector<SweepEvent>& events);
  static void keep_first(std::vector<SweepEvent>& events);

  World& world_;
  std::vector<Normal> normals_;
  std::vector<Edge> edges_;
  std::vector<Point> points_, scaled_;
  std::vector<uint64_t> stamp_;
  uint64_t now_ = 0;
  int need_ = 0;        // points_ = raw * 2^need_
  unsigned delta_ = 0;  // the sweep at hand needs more
  Big unit_;            // how long 1 is in its integers
  Point body_[3];       // p, p', q
  bool tie_ = false;
};

/// Sign of a's time - b's, shift included.
int compare_times(const SweepEvent& a, const SweepEvent& b);

}  // namespace dsw::oracle
