// What the walls at one vertex sweep, against integers in which the shift is a number: e = 2^-200, far below anything that
// determinants of small coordinates leave.
#include "walls/wall_sweep.h"

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <array>
#include <random>

#include "environment/marking.h"
#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

using Exact = std::array<mpz_class, 3>;

Exact fixed(const double* x) {
  Exact p;
  for (size_t k = 0; k < 3; ++k) p[k] = mpz_class(x[k]) << 600;
  return p;
}
Exact shifted(const double* x) {
  Exact p = fixed(x);
  for (size_t k = 0; k < 3; ++k) p[k] += mpz_class(1) << static_cast<unsigned>(400 - 200 * k);
  return p;
}
mpz_class volume(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {
  mpz_class m[3][3];
  for (size_t k = 0; k < 3; ++k) {
    m[0][k] = b[k] - a[k];
    m[1][k] = c[k] - a[k];
    m[2][k] = d[k] - a[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool lies_inside(const Exact& a, const Exact& b, const Exact& c, const Exact& d, const Exact& x) {
  const int whole = sgn(volume(a, b, c, d));
  return whole != 0 && sgn(volume(x, b, c, d)) == whole && sgn(volume(a, x, c, d)) == whole &&
         sgn(volume(a, b, x, d)) == whole && sgn(volume(a, b, c, x)) == whole;
}
bool cross_each_other(const Exact& x, const Exact& y, const Exact& a, const Exact& b, const Exact& c) {
  if (sgn(volume(a, b, c, x)) * sgn(volume(a, b, c, y)) >= 0) return false;
  const int turn = sgn(volume(x, y, a, b));
  return turn != 0 && sgn(volume(x, y, b, c)) == turn && sgn(volume(x, y, c, a)) == turn;
}
/** Whether `time` is the largest double not above the time at which the volume, linear in it, is 0. */
bool is_time(double time, const mpz_class& at_start, const mpz_class& at_end) {
  if (at_start == at_end) return true;  // the shift decides
  const mpq_class exact = mpq_class(at_start) / mpq_class(at_start - at_end);
  return mpq_class(time) <= exact && (time == 1 || mpq_class(std::nextafter(time, 2)) > exact);
}

/** 2 x 2 x 2 boxes; what is looked at is the vertex in the middle. */
class WallSweepTest : public testing::Test {
 protected:
  static constexpr uint32_t kMiddle = 13;

  void build(std::mt19937& random) {
    std::uniform_int_distribution<int> noise(-2, 2);
    Mesh3 mesh;
    add_boxes(mesh, 2, 2, 2);
    env_ = mesh.build();
    points_.clear();
    for (uint32_t v = 0; v < env_->map.vertex_count; ++v) {
      for (int k = 0; k < 3; ++k) points_.push_back(8 * env_->point(v)[k] + noise(random));
    }
    env_->points = points_.data();
    reserve_edge_marks(*env_, 16);
    reserve_vertex_marks(*env_);
    star_.clear();
    for (uint32_t i = 0; i < 8; ++i) star_.push_back(env_->map.cell(i));
  }
  void mark(std::mt19937& random) {
    const Map<3>& map = env_->map;
    const int kind = static_cast<int>(random() % 4);
    for (uint32_t i = 0; i < 8; ++i) {
      if (kind == 0 && random() % 4 == 0) set_cell_mark(*env_, map.cell(i), true);
      for (uint32_t f = 0; f < 6 && kind == 1; ++f) {
        const HalfFacet h = map.half_facet(map.cell(i), f);
        if (random() % 4 == 0 && map.opposite(h).valid()) set_facet_mark(*env_, h, true);
      }
    }
    if (kind == 2) {
      for (const uint32_t q : {4u, 10u, 12u, 14u, 16u, 22u}) set_edge_mark(*env_, kMiddle, q, random() % 2 == 0);
    }
    if (kind == 3) set_vertex_mark(*env_, kMiddle, true);
  }

  /** Triangles and edges of walls at the middle, from every cell. */
  void find_walls() {
    triangles_.clear();
    edges_.clear();
    const Map<3>& map = env_->map;
    for (const Cell c : star_) {
      if (map.marked(c)) continue;  // between two that are impassable is nothing to be met
      const Shape shape = map.shape(c);
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        if (!is_impassable(map, map.half_facet(c, f))) continue;
        for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
          uint32_t others[2], count = 0;
          for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t v = map.vertex(c, shape.simplices()[3 * s + k]);
            if (v != kMiddle && count < 2) others[count++] = v;
          }
          bool has_middle = false;
          for (uint32_t k = 0; k < 3; ++k) has_middle |= map.vertex(c, shape.simplices()[3 * s + k]) == kMiddle;
          if (!has_middle) continue;
          triangles_.push_back({others[0], others[1]});
          edges_.push_back(others[0]);
          edges_.push_back(others[1]);
        }
      }
    }
    wires_.clear();
    for (uint32_t q = 0; q < env_->map.vertex_count; ++q) {
      if (edge_marked(*env_, kMiddle, q)) wires_.push_back(q);
    }
  }

  std::unique_ptr<Environment<3>> env_;
  std::vector<double> points_;
  Array<Cell> star_;
  std::vector<std::array<uint32_t, 2>> triangles_;
  std::vector<uint32_t> edges_, wires_;
};

TEST_F(WallSweepTest, FindsWhatIsTouched) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(2, 14);
  int met[3] = {}, free = 0, with_ties = 0;
  for (int scene = 0; scene < 100; ++scene) {
    build(random);
    mark(random);
    find_walls();
    Occupants<3> all(nullptr);
    Body<3> body(nullptr);
    MoveRecord record(nullptr);
    body.level = SweepLevel::kFaces;
    reserve(body, 3, 3, 1);
    const double origin[3] = {0, 0, 0};
    for (int v = 0; v < 3; ++v) add_vertex(body, origin, Cell{0});
    add_face(body, 0, 1, 2);
    all.bodies.push_back({&body, &record, {0, 1}});
    WallSweep<3> walls(*env_);
    walls.start(kMiddle, star_);
    ASSERT_EQ(walls.has_walls(), !triangles_.empty() || !wires_.empty() || vertex_marked(*env_, kMiddle));
    for (int move = 0; move < 60; ++move) {
      double from[3], to[3];
      for (int k = 0; k < 3; ++k) {
        from[k] = points_[3 * kMiddle + static_cast<size_t>(k)];
        to[k] = random() % 4 == 0 ? from[k] : place(random);
        for (BodyVertex<3>& v : body.vertices) v.position[k] = place(random);
      }
      if (random() % 3 == 0) std::copy_n(env_->point(4), 3, body.vertices[0].position);
      const Exact a = fixed(from), b = fixed(to);
      Exact x[3], plain[3];
      for (size_t v = 0; v < 3; ++v) {
        x[v] = shifted(body.vertices[v].position);
        plain[v] = fixed(body.vertices[v].position);
      }
      const auto at = [&](uint32_t v) { return fixed(env_->point(v)); };

      bool touched = false;
      for (const auto& [q, r] : triangles_) touched |= lies_inside(a, b, at(q), at(r), x[0]);
      WallHit hit;
      ASSERT_EQ(walls.meets(all, {Feature::kVertex, 0, 0}, from, to, &hit), touched);
      if (touched) {
        const Exact q = at(hit.q), r = at(hit.r);
        ASSERT_TRUE(is_time(hit.time, volume(a, q, r, plain[0]), volume(b, q, r, plain[0])));
        with_ties += volume(a, q, r, plain[0]) == 0 ? 1 : 0;
      }
      met[0] += touched;

      const uint32_t edge = find_edge(body, 0, 1);
      touched = false;
      for (const uint32_t q : edges_) touched |= cross_each_other(x[0], x[1], a, b, at(q));
      for (const uint32_t q : wires_) touched |= cross_each_other(x[0], x[1], a, b, at(q));
      ASSERT_EQ(walls.meets(all, {Feature::kEdge, 0, edge}, from, to, &hit), touched);
      if (touched) {
        const Exact q = at(hit.q);
        ASSERT_TRUE(is_time(hit.time, volume(a, q, plain[0], plain[1]), volume(b, q, plain[0], plain[1])));
      }
      met[1] += touched;

      touched = walls.has_walls() && cross_each_other(a, b, x[0], x[1], x[2]);
      ASSERT_EQ(walls.meets(all, {Feature::kFace, 0, 0}, from, to, &hit), touched);
      if (touched) {
        ASSERT_TRUE(
            is_time(hit.time, volume(plain[0], plain[1], plain[2], a), volume(plain[0], plain[1], plain[2], b)));
      }
      met[2] += touched;
      free += touched ? 0 : 1;
    }
  }
  EXPECT_GT(met[0], 25);
  EXPECT_GT(met[1], 120);
  EXPECT_GT(met[2], 120);
  EXPECT_GT(free, 1200);
  EXPECT_GT(with_ties, 1);
}

TEST_F(WallSweepTest, MeetsWiresFromEdgesSweptOn) {
  std::mt19937 random(2);
  build(random);
  set_edge_mark(*env_, kMiddle, 14, true);
  Occupants<3> all(nullptr);
  Body<3> body(nullptr);
  MoveRecord record(nullptr);
  reserve(body, 2, 1, 0);
  const double p[3] = {12, 4, 9.5}, q[3] = {12, 12, 9.5};
  add_vertex(body, p, Cell{0});
  add_vertex(body, q, Cell{0});
  add_edge(body, 0, 1);
  all.bodies.push_back({&body, &record, {0, 1}});
  WallSweep<3> walls(*env_);
  walls.start(kMiddle, star_);
  const double from[3] = {8, 8, 6}, to[3] = {8, 8, 18};
  WallHit hit;
  body.level = SweepLevel::kEdgesSwept;
  EXPECT_TRUE(walls.meets(all, {Feature::kEdge, 0, 0}, from, to, &hit));
  EXPECT_FALSE(hit.wall.valid());
  EXPECT_EQ(hit.q, 14u);
  body.level = SweepLevel::kEdges;
  EXPECT_FALSE(walls.meets(all, {Feature::kEdge, 0, 0}, from, to, &hit));
}

TEST_F(WallSweepTest, DescribesTheTouch) {
  std::mt19937 random(3);
  build(random);
  for (uint32_t i = 0; i < 4; ++i) set_cell_mark(*env_, env_->map.cell(i), true);  // the lower half
  Occupants<3> all(nullptr);
  ParticleState<3> particle{{8, 8, 11}, env_->map.cell(7)};
  all.particles = &particle;
  all.particle_count = 1;
  WallSweep<3> walls(*env_);
  walls.start(kMiddle, star_);
  const double from[3] = {8, 8, 8}, to[3] = {8, 8, 14};
  WallHit hit;
  ASSERT_TRUE(walls.meets(all, {Feature::kParticle, 0, 0}, from, to, &hit));
  EXPECT_GT(hit.time, 0.3);
  EXPECT_LT(hit.time, 0.8);
  const WallTouch touch = describe_touch(*env_, all, hit, from, to);
  EXPECT_GT(touch.normal[2], 0.3);
  EXPECT_EQ(touch.point[2], 11);
}

}  // namespace
