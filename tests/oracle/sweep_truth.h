// The oracle's own, brute-force answer to "what is met when a vertex p of a body moves to p' while the other ends of its
// edges and faces stay". Every obstacle is looked at, in integers over a common power of two; only boxes that are apart
// skip one. All points of the body are shifted by one and the same s = (e, e^2, e^3), in units of the coordinates; values
// linear in s are kept as polynomials in e, and times are compared as their ratios.
#pragma once

#include "world.h"

namespace dsw::oracle {

/// c[0] + c[1] e + c[2] e^2 + c[3] e^3.
struct Shifted {
  Big c[4];
  int sign() const;
  void negate();
};

/// A moment in which what moves meets an obstacle: the moving vertex a triangle, the inside of an edge an obstacle's
/// edge, or the inside of a face an obstacle's vertex.
struct SweepEvent {
  int triangle = -1, side = 0;     // of the moving vertex; side as in Walk
  int edge = -1, a = -1, b = -1;   // of edge number `edge`: the two vertices, a < b
  int face = -1, vertex = -1;      // of face number `face`
  Shifted numerator, denominator;  // time; the denominator is positive
  double time = 0;                 // its standard part, rounded down
  size_t order = 0;                // of the coefficients whose ratio the standard part is; 0: it needs no shift
};

/// A vertex of a body on its way, and what hangs on it.
struct VertexMove {
  Vec from, to;
  std::vector<Vec> fixed;                    // the other ends of its edges
  std::vector<std::array<size_t, 2>> faces;  // its triangles, as pairs of these
};

/// What is true of it at one level.
struct MoveTruth {
  bool path_hit = false;           // p p' meets something
  std::vector<char> new_edge_hit;  // p' q does, by edge
  std::vector<SweepEvent> events;  // the first one, and any that have exactly its time
  bool tie = false;                // a value that had to be looked at was zero without the shift
  bool inside_only() const;        // neither the path nor a new edge meets anything, what is between them does
};

/// What is true of one edge, at every level.
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
  /// Marks must be set; wires are pairs of vertices, `marked` are vertices. `world` must outlive this.
  SweepWorld(World& world, const std::vector<std::array<int, 2>>& wires, const std::vector<int>& marked = {});
  SweepTruth sweep(const Vec& from, const Vec& to, const Vec& fixed);
  MoveTruth move(const VertexMove& move, dsw_level level);
  /// Whether segment x y, shifted, goes through an obstacle triangle.
  bool blocked(const Vec& x, const Vec& y);
  /// Whether an obstacle's edge goes through triangle x y z, shifted.
  bool blocked(const Vec& x, const Vec& y, const Vec& z);

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

  struct Vertex {
    int vertex;
    Box box;
  };

  void load(const std::vector<Vec>& points);
  Box body_box(std::initializer_list<size_t> points) const;
  const Point& at(int vertex);
  Shifted shifted(const Big& unshifted, const Point& coefficients) const;
  int sign_with_ties(const Big& unshifted, const Point& coefficients);
  Big line_value(size_t x, size_t y, int a, int b);
  Point line_shift(size_t x, size_t y, int a, int b);
  int line_sign(size_t x, size_t y, int a, int b);
  Shifted line(size_t x, size_t y, int a, int b);
  Point normal(size_t x, size_t y, size_t z) const;
  Shifted plane(const Point& normal, size_t on, int vertex);
  int plane_sign(const Point& normal, size_t on, int vertex);
  int pierce(size_t x, size_t y, const Normal& t);
  bool any_pierced(size_t x, size_t y);
  int goes_through(const Edge& edge, size_t x, size_t y, size_t z, const Point& normal);
  void add_path_events(std::vector<SweepEvent>& events);
  void add_edge_events(size_t edge, std::vector<SweepEvent>& events);
  void add_face_events(size_t face, const std::array<size_t, 2>& ends, std::vector<SweepEvent>& events);
  static bool keep_first(std::vector<SweepEvent>& events);

  World& world_;
  std::vector<Normal> normals_;
  std::vector<Edge> edges_;
  std::vector<Vertex> vertices_;
  std::vector<Point> points_, scaled_;
  std::vector<uint64_t> stamp_;
  uint64_t now_ = 0;
  int need_ = 0;        // points_ = raw * 2^need_
  unsigned delta_ = 0;  // the move at hand needs more
  Big unit_;            // how long 1 is in its integers
  std::vector<Vec> raw_;
  std::vector<Point> body_;  // p, p', then the fixed ends
  bool tie_ = false;
};

/// Sign of a's time - b's, shift included.
int compare_times(const SweepEvent& a, const SweepEvent& b);

}  // namespace dsw::oracle
