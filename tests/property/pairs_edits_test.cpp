// Edges of a body that meets itself are bent, its vertices merged: allowed if and only if nothing is touched on the
// way, by rationals.
#include "pairs_support.h"
#include "proximity/pair_sweep.h"

namespace dsw::oracle {
namespace {

using Numbers = std::vector<uint32_t>;

struct Case {
  const char* name;
  int dimension;
  SweepLevel level;
  int bits;  // coordinates are multiples of 2^-bits, so the middles of edges are numbers, too
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

bool has(const Numbers& part, uint32_t v) { return std::find(part.begin(), part.end(), v) != part.end(); }
bool share_vertex(const Numbers& a, const Numbers& b) {
  return std::any_of(a.begin(), a.end(), [&](uint32_t v) { return has(b, v); });
}

/// A body that meets itself, and all that can be said of its parts.
template <int D>
struct Knit {
  Body<D> body{nullptr};

  explicit Knit(SweepLevel level) {
    body.level = level;
    body.filter.self = true;
    keep_boxes(body);
  }

  std::vector<Numbers> parts() const {
    std::vector<Numbers> all;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) all.push_back({v});
    }
    for (uint32_t e = 0; covers_edges(body.level) && e < body.edges.size(); ++e) {
      if (body.has_edge(e)) all.push_back({body.edges[e].ends[0], body.edges[e].ends[1]});
    }
    for (uint32_t f = 0; covers_faces(body.level) && f < body.faces.size(); ++f) {
      if (body.has_face(f)) all.push_back({body.faces[f].corners, body.faces[f].corners + 3});
    }
    return all;
  }

  /// Whether no two parts without a common vertex touch.
  bool is_apart() const {
    const std::vector<Numbers> all = parts();
    for (const Numbers& a : all) {
      for (const Numbers& b : all) {
        if (a.size() < b.size() || (a.size() == 3 && b.size() == 3) || share_vertex(a, b)) continue;
        if (touch(a, b)) return false;
      }
    }
    return true;
  }
  bool touch(const Numbers& a, const Numbers& b) const {
    const auto at = [&](uint32_t v) { return body.position(v); };
    if constexpr (D == 3) {
      if (a.size() == 3) {
        const double* const triangle[3] = {at(a[0]), at(a[1]), at(a[2])};
        return triangle_touches(triangle, at(b.front()), at(b.back()));
      }
    }
    return segments_touch<D>(at(a.front()), at(a.back()), at(b.front()), at(b.back()));
  }

  /// When the part with vertex v touches one that stays, as v goes to `to`.
  TouchTruth truth(const Numbers& moving, uint32_t v, const double* to, const Numbers& still) const {
    std::vector<const double*> others, fixed, swept = {body.position(v), to};
    for (const uint32_t u : moving) {
      if (u != v) others.push_back(body.position(u));
    }
    for (const uint32_t u : still) fixed.push_back(body.position(u));
    swept.insert(swept.end(), others.begin(), others.end());
    Box<D> box;
    for (const double* each : swept) box.add(each);
    if (!box.overlaps(fixed.data(), static_cast<int>(fixed.size()))) return {};
    return touch_truth<D>(body.position(v), to, others, fixed);
  }

  /// Whether an edge can be bent: split in its middle, and the new vertex goes to `point`.
  bool can_bend(uint32_t edge, const double* point) const {
    Knit split(body.level);
    split.body = body;
    const uint32_t p = body.edges[edge].ends[0], q = body.edges[edge].ends[1];
    double half[D];
    for (int k = 0; k < D; ++k) half[k] = (body.position(p)[k] + body.position(q)[k]) / 2;
    reserve(split.body, 1, 3, 2);
    const uint32_t m = add_vertex(split.body, half, dsw::Cell{8});
    split_edge(split.body, edge, m);
    const auto is_touched = [&](const Numbers& moving) {
      for (const Numbers& still : split.parts()) {
        // If two faces touched, an edge of one of them would touch the other.
        if (share_vertex(moving, still) || moving.size() + still.size() > 5) continue;
        const TouchTruth found = split.truth(moving, m, point, still);
        if (found.touches || found.at_start) return true;
      }
      return false;
    };
    const std::vector<Numbers> all = split.parts();
    for (const Numbers& moving : all) {
      // What nothing stood for before appears where it is: a vertex of points, an edge that cuts a face in two which is
      // not covered.
      const bool appears = !covers_edges(body.level) ||
                           (!covers_faces(body.level) && moving.size() == 2 && !has(moving, p) && !has(moving, q));
      if (has(moving, m) && !appears && is_touched(moving)) return false;
    }
    put_vertex(split.body, m, point, dsw::Cell{8});
    return split.is_apart();
  }

  /// Whether vertex v can go to `into` and become one with it.
  bool can_merge(uint32_t v, uint32_t into) const {
    const std::vector<Numbers> all = parts();
    for (const Numbers& moving : all) {
      if (!has(moving, v) || has(moving, into)) continue;
      for (const Numbers& still : all) {
        if (share_vertex(moving, still) || moving.size() + still.size() > 5) continue;
        const TouchTruth found = truth(moving, v, body.position(into), still);
        if (found.touches && !(has(still, into) && found.time == 1)) return false;
      }
    }
    return true;
  }
};

template <int D>
class Loom {
 public:
  explicit Loom(const Case& c) : case_(c), knit_(c.level) { partners_.all.push_back({&knit_.body, 0, 1}); }

  void run(int rounds) {
    for (int i = 0; i < rounds; ++i) {
      SCOPED_TRACE(i);
      if (i % 4 == 0) fill();
      for (int k = 0; k < 3; ++k) bend();
      merge();
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(bent_, rounds / 4);
    EXPECT_GT(merged_, rounds / 10);
    EXPECT_GT(not_bent_, rounds / 4);
    EXPECT_GE(not_merged_, rounds / 40);
  }

 private:
  void place(double* at) {
    for (int k = 0; k < D; ++k) at[k] = std::ldexp(static_cast<double>(rng_.below(1u << case_.bits)), -case_.bits);
  }

  /// Polylines, what branches, rings, strips and closed surfaces, as many as fit.
  void fill() {
    Body<D>& body = knit_.body;
    body = Knit<D>(case_.level).body;
    for (int tries = 0; tries < 400 && body.vertices.size() < 14; ++tries) {
      const Body<D> before = body;
      const uint32_t first = static_cast<uint32_t>(body.vertices.size()), kind = rng_.below(6);
      const uint32_t count = kind == 5 ? 4 : 3 + rng_.below(3);
      reserve(body, count, 12, 6);
      for (uint32_t i = 0; i < count; ++i) {
        double at[D];
        place(at);
        add_vertex(body, at, dsw::Cell{8});
      }
      const auto edge = [&](uint32_t a, uint32_t b) { add_edge(body, first + a, first + b); };
      const uint32_t joined = kind == 1 ? count - 1 : count;  // a vertex alone beside a polyline
      for (uint32_t i = 1; i < joined && kind < 3; ++i) edge(kind == 0 ? 0 : i - 1, i);
      if (kind == 2) edge(count - 1, 0);
      if constexpr (D == 3) {
        const auto face = [&](uint32_t a, uint32_t b, uint32_t c) { add_face(body, first + a, first + b, first + c); };
        for (uint32_t i = 2; i < count && (kind == 3 || kind == 4); ++i)
          face(i - (i % 2 == 0 ? 2 : 1), i - (i % 2 == 0 ? 1 : 2), i);
        if (kind == 5) face(0, 2, 1), face(0, 1, 3), face(0, 3, 2), face(1, 2, 3);
      } else if (kind >= 3) {
        edge(0, 1);  // and vertices alone
      }
      if (!knit_.is_apart()) body = before;
    }
    ASSERT_GT(body.vertices.size(), 5u);
  }

  uint32_t any_edge() {
    for (;;) {
      const uint32_t e = rng_.below(knit_.body.edges.size());
      if (knit_.body.has_edge(e)) return e;
    }
  }

  void bend() {
    Body<D>& body = knit_.body;
    const uint32_t e = any_edge(), kind = rng_.below(7);
    const double *p = body.position(body.edges[e].ends[0]), *q = body.position(body.edges[e].ends[1]);
    double point[D], other[D];
    place(other);
    // In the middle, beside it, anywhere; in line with the edge; at or near a vertex.
    const double share = kind == 3 ? 0.25 : kind == 4 ? (rng_.below(2) == 0 ? 1 : 1.25) : 0.5;
    const double beside = kind == 0 || kind == 3 || kind == 4 ? 0 : kind == 1 ? 0x1p-4 : kind == 2 ? 0x1p-20 : 1;
    for (int k = 0; k < D; ++k) {
      const double on = (1 - share) * p[k] + share * q[k];
      point[k] = on + beside * (other[k] - on);
    }
    if (kind == 6) std::copy_n(body.position(body.edges[any_edge()].ends[0]), D, point);
    const bool can = is_bend_apart(partners_, body, e, point);
    ASSERT_EQ(can, knit_.can_bend(e, point)) << e;
    ++(can ? bent_ : not_bent_);
    if (!can || rng_.below(3) != 0) return;
    reserve(body, 1, 3, 2);
    split_edge(body, e, add_vertex(body, point, dsw::Cell{8}));
    ASSERT_TRUE(knit_.is_apart());
  }

  void merge() {
    Body<D>& body = knit_.body;
    const uint32_t e = any_edge(), v = body.edges[e].ends[rng_.below(2)], into = body.edges[e].other(v);
    if (!can_collapse(body, e, v)) return;
    const bool can = is_merge_apart(partners_, body, v, into);
    ASSERT_EQ(can, knit_.can_merge(v, into)) << v << " " << into;
    ++(can ? merged_ : not_merged_);
    if (!can) return;
    collapse_edge(body, e, v);
    ASSERT_TRUE(knit_.is_apart());
  }

  Case case_;
  Rng rng_{23};
  Knit<D> knit_;
  Partners<D> partners_{nullptr};
  int bent_ = 0, not_bent_ = 0, merged_ = 0, not_merged_ = 0;
};

class PairEditsTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    All, PairEditsTest,
    testing::Values(Case{"Points", 3, SweepLevel::kPoints, 2}, Case{"Edges", 3, SweepLevel::kEdgesSwept, 20},
                    Case{"EdgesOnLattice", 3, SweepLevel::kEdges, 2}, Case{"Faces", 3, SweepLevel::kFaces, 20},
                    Case{"FacesOnLattice", 3, SweepLevel::kFaces, 2}, Case{"Plane", 2, SweepLevel::kEdgesSwept, 20},
                    Case{"PlaneOnLattice", 2, SweepLevel::kEdges, 3}),
    [](const auto& i) { return i.param.name; });

TEST_P(PairEditsTest, AnEdgeIsBentAndAVertexMergedIfNothingIsTouched) {
  const int rounds = std::max(8, effort_of(120));  // rationals are slow
  if (GetParam().dimension == 2) {
    Loom<2>(GetParam()).run(rounds);
  } else {
    Loom<3>(GetParam()).run(rounds);
  }
}

}  // namespace
}  // namespace dsw::oracle
