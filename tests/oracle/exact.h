// The oracle's own, brute-force answer to "what is met when a vertex p of a body moves to p' while the other ends of
// its edges and faces stay", in either dimension. Every obstacle is looked at, in integers over a common power of two;
// only boxes that are apart skip one. All points of the body are shifted by one and the same s = (e, e^2, e^3), in
// units of the coordinates; values linear in s are kept as polynomials in e, and times are compared as their ratios.
#pragma once

#include "mesh.h"
#include "numbers.h"

#include <initializer_list>
#include <string>

namespace dsw::oracle {

/// c[0] + c[1] e + c[2] e^2 + c[3] e^3.
struct Shifted {
  Big c[4];
  int sign() const;
  void negate();
};

/// A moment in which what moves meets an obstacle: the moving vertex a triangle or, in the plane, a side; the inside of
/// an edge an obstacle's edge or, in the plane, its vertex; or the inside of a face an obstacle's vertex.
struct SweepEvent {
  int triangle = -1, side = 0;    // of the moving vertex: a triangle or a side, by number; side: +1: out of its cell[0]
  int edge = -1, a = -1, b = -1;  // of edge number `edge`: the two vertices, a < b
  int face = -1, vertex = -1;     // of face number `face`, or of the edge
  Shifted numerator, denominator;  // time; the denominator is positive
  double time = 0;                 // its standard part, rounded down
  size_t order = 0;                // of the coefficients whose ratio the standard part is; 0: it needs no shift
};

/// Sign of a's time - b's, shift included.
int compare_times(const SweepEvent& a, const SweepEvent& b);
bool same_feature(const SweepEvent& x, const SweepEvent& y);
/// What meets what.
std::string name(const SweepEvent& e);

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

/// Exact sweeps in space or in the plane, in which the third coordinate is 0.
class ExactSweeps {
 public:
  virtual ~ExactSweeps() = default;
  /// The cell that holds a body point; -1: none, -2: several.
  virtual int locate(const Vec& p) = 0;
  SweepTruth sweep(const Vec& from, const Vec& to, const Vec& fixed);
  MoveTruth move(const VertexMove& move, dsw_level level);
  /// Whether segment x y, shifted, meets an obstacle.
  bool blocked(const Vec& x, const Vec& y);
  /// Whether an obstacle's edge goes through triangle x y z, shifted.
  virtual bool blocked(const Vec&, const Vec&, const Vec&) { return false; }

 protected:
  using Point = std::array<Big, 3>;
  struct Box {
    Vec low, high;
  };
  struct Vertex {
    int vertex;
    Box box;
  };
  static constexpr size_t kP = 0, kTo = 1, kQ = 2;

  /// Points that obstacles have, by index.
  void take_points(const std::vector<Vec>& all, const std::vector<int>& used);
  static Box box_of(const std::vector<Vec>& all, std::initializer_list<int> vertices);
  void load(const std::vector<Vec>& points);
  Box body_box(std::initializer_list<size_t> points) const;
  /// Strictly: then no shift makes them meet.
  static bool apart(const Box& x, const Box& y);
  const Point& at(int vertex);
  Shifted shifted(const Big& unshifted, const Point& coefficients) const;
  int sign_with_ties(const Big& unshifted, const Point& coefficients);
  /// Adds an event: the time is the ratio, with both signs turned if the denominator is negative.
  static void add(SweepEvent e, std::vector<SweepEvent>& events);

  virtual bool any_pierced(size_t x, size_t y) = 0;
  virtual void add_path_events(std::vector<SweepEvent>& events) = 0;
  virtual void add_edge_events(size_t edge, std::vector<SweepEvent>& events) = 0;
  virtual void add_face_events(size_t, const std::array<size_t, 2>&, std::vector<SweepEvent>&) {}

  std::vector<Vertex> vertices_;  // those that were taken
  std::vector<Point> points_;
  std::vector<Point> body_;  // p, p', then the fixed ends
  bool tie_ = false;

 private:
  static bool keep_first(std::vector<SweepEvent>& events);

  std::vector<Point> scaled_;
  std::vector<uint64_t> stamp_;
  uint64_t now_ = 0;
  int need_ = 0;        // points_ = raw * 2^need_
  unsigned delta_ = 0;  // the move at hand needs more
  Big unit_;            // how long 1 is in its integers
  std::vector<Vec> raw_;
};

}  // namespace dsw::oracle
