// The oracle's picture of an environment and its own, brute-force answer to "where is this point" and "what does
// this segment cross". Exact: integers over a common power of two; a floating-point filter only skips signs that are
// certain. Body points are shifted by (e, e^2, e^3), environment points are not; nothing else is assumed, in
// particular no centres, no stars and no convexity: a cell is what its boundary triangles enclose.
#pragma once

#include "mesh.h"
#include "numbers.h"

#include <string>
#include <vector>

namespace dsw::oracle {

struct Triangle {
  int v[3];
  int cell[2];  // counter-clockwise seen from outside of cell[0]; cell[1] < 0: outer boundary
  int face;
  double n[3], p[3];  // normal and the sums of magnitudes behind it
  int64_t ln[3];
  Big bn[3];
};

struct Face {
  int cell[2] = {-1, -1};  // ascending; the second < 0: outer boundary
  int local[2] = {-1, -1};
  std::vector<int> loop;  // seen from outside of cell[0]
  bool marked = false;
  std::vector<int> triangles;
};

/// A body point and what the tests need of it.
struct BodyPoint {
  Vec raw;
  double norm[3];
  bool filter = false, lattice = false;
  int64_t at[3];
  int need = 0;  // exponent that makes it an integer
};

/// One entry into a cell; time is the exact ratio rounded down.
struct Step {
  int cell, face;
  double time;
};

struct Walk {
  enum Outcome { kReached, kContact, kOutside, kImpassable, kBroken };
  Outcome outcome = kBroken;
  std::vector<Step> steps;
  int cell = -1;      // where it ends
  int face = -1;      // contact
  int triangle = -1;  // contact
  int side = 0;       // +1: left cell[0] of the triangle, -1: cell[1]
  double time = 1;
  bool tie = false;   // an unshifted zero among the triangles of the cells walked
  std::string fault;  // kBroken: why the environment is no partition
};

class World {
 public:
  /// An environment whose topology has changed: cell i of the mesh is volumes[i], and the cell's face f lies on the
  /// outer boundary if outer[i][f] says so, also where another face has the same vertices.
  struct Changed {
    std::vector<dsw_volume_id> volumes;
    std::vector<std::vector<char>> outer;
  };
  /// Reads the triangles of every volume from the library and checks them against the mesh. Empty `fault` if sound.
  World(const Mesh& m, const dsw_environment* environment) : World(m, environment, Changed{}) {}
  World(const Mesh& m, const dsw_environment* environment, const Changed& changed);

  const std::string& fault() const { return fault_; }
  BodyPoint body(const double* xyz) const;
  /// The cell that contains the shifted point, or -1; -2 if there are several.
  int locate(const BodyPoint& p);
  bool contains(int cell, const BodyPoint& p);
  /// Follows p -> q from cell `start`, or from where p lies if start is -1.
  Walk cast(const BodyPoint& p, const BodyPoint& q, int start = -1);
  bool impassable(int face) const;
  /// Whether an edge of the outer boundary goes through another of its triangles. Then the cells are no partition.
  bool outer_boundary_crosses() const;
  /// Unit normal of a triangle seen from cell[0], and a bound on how far a good double computation may be off.
  Vec unit_normal(int triangle, double* tolerance) const;
  /// Twice the exact area-weighted flux: six times the enclosed volume of a cell's triangles, over a common power.
  Big volume6(int cell) const;
  Big outer_volume6() const;
  /// Limits a cast to these triangles; empty means all. For large meshes.
  void restrict_to(const std::vector<int>& subset) { subset_ = subset; }
  /// Triangles whose box meets the (enlarged) box of a segment's part inside the scene, or of a point.
  std::vector<int> near_segment(const double* p, const double* q, double margin) const;

  Mesh mesh;
  std::vector<Triangle> triangles;
  std::vector<Face> faces;
  std::vector<std::vector<int>> cell_triangles, cell_faces;
  std::vector<dsw_volume_id> ids;
  std::vector<char> cell_marked;
  bool lattice = false;
  Vec lower, upper;
  double size = 0;

 private:
  struct Query {
    const BodyPoint *p, *q;
    bool lattice, big_ready = false;
    int delta = 0;
    double u[3];
    int64_t lu[3];
    Big bp[3], bq[3], bu[3];
  };
  struct Hit {
    int triangle, side;
    Big numerator, denominator, shift[3];
  };

  void read_topology(const dsw_environment* environment, const Changed& changed);
  void prepare_numbers();
  Query query(const BodyPoint& p, const BodyPoint& q) const;
  void need_big(Query& s) const;
  int plane_sign(Query& s, bool end, int t, bool* tie) const;
  int line_sign(Query& s, int a, int b, bool* tie) const;
  /// +1 when p -> q leaves cell[0] of the triangle, -1 when it enters it, 0 when it misses.
  int pierce(Query& s, int t, bool* tie) const;
  Hit make_hit(Query& s, int t, int side) const;
  static bool earlier(const Hit& a, const Hit& b);

  std::string fault_;
  std::vector<Vec> norm_;
  std::vector<std::array<int64_t, 3>> at_;
  std::vector<std::array<Big, 3>> big_;
  std::vector<char> used_, tie_;
  std::vector<int> subset_, all_, winding_;
  int exponent_ = 0;  // norm = raw * 2^exponent
  int need_ = 0;      // raw * 2^need is an integer for all used points
  int fine_ = 0;      // lattice: raw * 2^fine - origin is a small integer
  Vec origin_;
  std::vector<BodyPoint> far_;
};

}  // namespace dsw::oracle
