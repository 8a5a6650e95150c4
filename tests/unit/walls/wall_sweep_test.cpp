// What the walls at one vertex sweep, against integers in which the shift is a number: e = 2^-200, far below anything
// that determinants of small coordinates leave.
#include "walls/wall_sweep.h"

#include <gtest/gtest.h>

#include "../../gmp_numbers.h"

#include <array>
#include <random>
#include <type_traits>

#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "map/cell_queue.h"

namespace {

using namespace dsw;
using namespace dsw::test;

template <size_t D>
using Exact = std::array<mpz_class, D>;
/** A body point, and the corners of a simplex or facet. */
template <size_t D>
using Exacts = std::vector<Exact<D>>;

template <size_t D>
Exact<D> fixed(const double* x) {
  Exact<D> p;
  for (size_t k = 0; k < D; ++k) p[k] = mpz_class(x[k]) << 600;
  return p;
}
template <size_t D>
Exact<D> shifted(const double* x) {
  Exact<D> p = fixed<D>(x);
  for (size_t k = 0; k < D; ++k) p[k] += mpz_class(1) << static_cast<unsigned>(400 - 200 * k);
  return p;
}
mpz_class volume(const Exacts<3>& x) {
  mpz_class m[3][3];
  for (size_t k = 0; k < 3; ++k) {
    for (size_t i = 0; i < 3; ++i) m[i][k] = x[i + 1][k] - x[0][k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
mpz_class volume(const Exacts<2>& x) {
  return (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]);
}

template <size_t D>
bool lies_inside(const Exacts<D>& simplex, const Exact<D>& x) {
  const int whole = sgn(volume(simplex));
  bool inside = whole != 0;
  for (size_t i = 0; i <= D && inside; ++i) {
    Exacts<D> part = simplex;
    part[i] = x;
    inside = sgn(volume(part)) == whole;
  }
  return inside;
}
template <size_t D>
bool cross_each_other(const Exact<D>& x, const Exact<D>& y, const Exacts<D>& facet) {
  Exacts<D> with_x = facet, with_y = facet;
  with_x.push_back(x);
  with_y.push_back(y);
  if (sgn(volume(with_x)) * sgn(volume(with_y)) >= 0) return false;
  int turn = 0;
  for (size_t i = 0; i < D; ++i) {
    Exacts<D> round = {x, y};
    for (size_t k = 0; k < D; ++k) {
      if (k != i) round.push_back(facet[k]);
    }
    const int sign = sgn(volume(round)) * (i % 2 == 0 ? 1 : -1);
    if (sign == 0 || sign * turn < 0) return false;
    turn = sign;
  }
  return true;
}
/** Whether `time` is the largest double not above the time at which the volume, linear in it, is 0. */
bool is_time(double time, const mpz_class& at_start, const mpz_class& at_end) {
  if (at_start == at_end) return true;  // the shift decides
  const mpq_class exact = mpq_class(at_start) / mpq_class(at_start - at_end);
  return mpq_class(time) <= exact && (time == 1 || mpq_class(std::nextafter(time, 2)) > exact);
}

void add_boxes(Mesh2& mesh, int n) {
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.point({static_cast<double>(x), static_cast<double>(y)});
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int64_t at = x + y * (n + 1);
      mesh.cell(kQuad, {at, at + 1, at + n + 2, at + n + 1});
    }
  }
}

/** 2 boxes along each axis; what is looked at is the vertex in the middle. */
template <class Dimension>
class WallSweepTest : public testing::Test {
 protected:
  static constexpr int kD = Dimension::value;
  static constexpr size_t kAxes = kD;
  static constexpr uint32_t kMiddle = kD == 3 ? 13 : 4, kCells = 1u << kD;

  void build(std::mt19937& random) {
    std::uniform_int_distribution<int> noise(-2, 2);
    TestMesh<kD> mesh;
    if constexpr (kD == 3) {
      dsw::test::add_boxes(mesh, 2, 2, 2);
    } else {
      add_boxes(mesh, 2);
    }
    env_ = mesh.build();
    points_.clear();
    for (uint32_t v = 0; v < env_->map.vertex_count; ++v) {
      for (int k = 0; k < kD; ++k) points_.push_back(8 * env_->point(v)[k] + noise(random));
    }
    env_->points = points_.data();
    reserve_edge_marks(*env_, 16);
    reserve_vertex_marks(*env_);
    star_.clear();
    for (uint32_t i = 0; i < kCells; ++i) star_.push_back(env_->map.cell(i));
  }
  void mark(std::mt19937& random) {
    const Map<kD>& map = env_->map;
    const int kind = static_cast<int>(random() % 4);
    for (uint32_t i = 0; i < kCells; ++i) {
      if (kind == 0 && random() % 4 == 0) set_cell_mark(*env_, map.cell(i), true);
      for (uint32_t f = 0; f < map.facets_of(map.cell(i)) && kind == 1; ++f) {
        const HalfFacet h = map.half_facet(map.cell(i), f);
        if (random() % 4 == 0 && map.opposite(h).valid()) set_facet_mark(*env_, h, true);
      }
    }
    if (kD == 3 && kind == 2) {
      for (const uint32_t q : {4u, 10u, 12u, 14u, 16u, 22u}) set_edge_mark(*env_, kMiddle, q, random() % 2 == 0);
    }
    if (kind == 3) set_vertex_mark(*env_, kMiddle, true);
  }

  /** The other vertices of simplices of walls at the middle, from every cell; and of what of them edges meet. */
  void find_walls() {
    simplices_.clear();
    ridges_.clear();
    const Map<kD>& map = env_->map;
    for (const Cell c : star_) {
      if (map.marked(c)) continue;  // between two that are impassable is nothing to be met
      const Shape shape = map.shape(c);
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        if (!is_impassable(map, map.half_facet(c, f))) continue;
        for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
          std::vector<uint32_t> others;
          for (uint32_t k = 0; k < kD; ++k) {
            const uint32_t v = map.vertex(c, shape.simplices()[kD * s + k]);
            if (v != kMiddle) others.push_back(v);
          }
          if (others.size() == kD) continue;
          simplices_.push_back(others);
          if (kD == 2) ridges_.push_back({});
          for (size_t k = 0; k < others.size() && kD == 3; ++k) ridges_.push_back({others[k]});
        }
      }
    }
    if (kD == 2 && vertex_marked(*env_, kMiddle)) ridges_.push_back({});
    for (uint32_t q = 0; q < env_->map.vertex_count; ++q) {
      if (edge_marked(*env_, kMiddle, q)) ridges_.push_back({q});
    }
  }
  /** With the way of the middle. */
  Exacts<kAxes> swept(const Exact<kAxes>& from, const Exact<kAxes>& to, const std::vector<uint32_t>& others) const {
    Exacts<kAxes> all = {from, to};
    for (const uint32_t v : others) all.push_back(fixed<kAxes>(env_->point(v)));
    return all;
  }
  /** Whether that is when the wall that is hit is in one hyperplane with what it touches. */
  bool is_time_of(const WallHit& hit, const Exact<kAxes>& from, const Exact<kAxes>& to,
                  const Exacts<kAxes>& touched) const {
    Exacts<kAxes> at_start = {from}, at_end = {to};
    for (Exacts<kAxes>* each : {&at_start, &at_end}) {
      for (int k = 0; k < 2 && hit.wall.vertices[k + 1] != kNone; ++k) {
        each->push_back(fixed<kAxes>(env_->point(hit.wall.vertices[k + 1])));
      }
      each->insert(each->end(), touched.begin(), touched.end());
      if (each->size() != kAxes + 1) return false;
    }
    return is_time(hit.time, volume(at_start), volume(at_end));
  }

  std::unique_ptr<Environment<kD>> env_;
  std::vector<double> points_;
  Array<Cell> star_;
  std::vector<std::vector<uint32_t>> simplices_, ridges_;
};

struct DimensionNames {
  template <class Dimension>
  static std::string GetName(int) {
    return Dimension::value == 3 ? "Space" : "Plane";
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 2>>;
TYPED_TEST_SUITE(WallSweepTest, Dimensions, DimensionNames);

TYPED_TEST(WallSweepTest, FindsWhatIsTouched) {
  constexpr int D = TypeParam::value;
  std::mt19937 random(static_cast<uint32_t>(seed_of(1)));
  std::uniform_int_distribution<int> place(2, 14);
  int met[3] = {}, free = 0, with_ties = 0, all_passable = 0;
  for (int scene = 0; scene < at_least(100); ++scene) {
    this->build(random);
    this->mark(random);
    this->find_walls();
    Occupants<D> all(nullptr);
    Body<D> body(nullptr);
    MoveRecord record(nullptr);
    body.level = D == 3 ? SweepLevel::kFaces : SweepLevel::kEdgesSwept;
    reserve(body, 3, 3, 1);
    const double origin[3] = {0, 0, 0};
    for (int v = 0; v < 3; ++v) add_vertex(body, origin, Cell{0});
    if constexpr (D == 3) add_face(body, 0, 1, 2);
    if (D == 2) add_edge(body, 0, 1);
    all.bodies.push_back({&body, &record, {0, 1}});
    WallSweep<D> walls(*this->env_);
    CellQueue around(nullptr);
    around.insert(this->star_[0]);
    const bool passable = for_each_cell_at_vertex(this->env_->map, this->kMiddle, around, [](Cell) {});
    ASSERT_EQ(around.size(), this->star_.size());
    ASSERT_TRUE(!passable || this->simplices_.empty());
    all_passable += passable ? 1 : 0;
    walls.start(this->kMiddle, this->star_, passable);
    ASSERT_EQ(walls.has_walls(), !this->ridges_.empty() || vertex_marked(*this->env_, this->kMiddle));
    for (int move = 0; move < at_least(60); ++move) {
      double from[D], to[D];
      for (int k = 0; k < D; ++k) {
        from[k] = this->env_->point(this->kMiddle)[k];
        to[k] = random() % 4 == 0 ? from[k] : place(random);
        for (BodyVertex<D>& v : body.vertices) v.position[k] = place(random);
      }
      if (random() % 3 == 0) std::copy_n(this->env_->point(D == 3 ? 4 : 1), D, body.vertices[0].position);
      const Exact<D> a = fixed<D>(from), b = fixed<D>(to);
      Exacts<D> x, plain;
      for (const BodyVertex<D>& v : body.vertices) {
        x.push_back(shifted<D>(v.position));
        plain.push_back(fixed<D>(v.position));
      }

      bool touched = false;
      for (const auto& others : this->simplices_) touched |= lies_inside<D>(this->swept(a, b, others), x[0]);
      WallHit hit;
      ASSERT_EQ(walls.meets(all, {Feature::kVertex, 0, 0}, from, to, &hit), touched);
      if (touched) {
        ASSERT_TRUE(this->is_time_of(hit, a, b, {plain[0]}));
        Exacts<D> at_start = this->swept(a, plain[0], {hit.wall.vertices + 1, hit.wall.vertices + D});
        with_ties += volume(at_start) == 0 ? 1 : 0;
      }
      met[0] += touched;

      const uint32_t edge = find_edge(body, 0, 1);
      touched = false;
      for (const auto& others : this->ridges_) touched |= cross_each_other<D>(x[0], x[1], this->swept(a, b, others));
      ASSERT_EQ(walls.meets(all, {Feature::kEdge, 0, edge}, from, to, &hit), touched);
      ASSERT_TRUE(!touched || this->is_time_of(hit, a, b, {plain[0], plain[1]}));
      met[1] += touched;

      if constexpr (D == 3) {
        touched = walls.has_walls() && cross_each_other<3>(a, b, x);
        ASSERT_EQ(walls.meets(all, {Feature::kFace, 0, 0}, from, to, &hit), touched);
        ASSERT_TRUE(!touched || this->is_time_of(hit, a, b, plain));
        met[2] += touched;
      }
      free += touched ? 0 : 1;
    }
  }
  EXPECT_GT(met[0], 25);
  EXPECT_GT(met[1], 120);
  EXPECT_GT(met[2], D == 3 ? 120 : -1);
  EXPECT_GT(free, 1200);
  EXPECT_GT(with_ties, 1);
  EXPECT_GT(all_passable, 1);
}

TYPED_TEST(WallSweepTest, MeetsWhatStandsAloneFromEdgesSweptOn) {
  constexpr int D = TypeParam::value;
  std::mt19937 random(static_cast<uint32_t>(seed_of(2)));
  this->build(random);
  if (D == 3) set_edge_mark(*this->env_, this->kMiddle, 14, true);
  if (D == 2) set_vertex_mark(*this->env_, this->kMiddle, true);
  Occupants<D> all(nullptr);
  Body<D> body(nullptr);
  MoveRecord record(nullptr);
  reserve(body, 2, 1, 0);
  const double p[3] = {12, D == 3 ? 4. : 12., 9.5}, q[3] = {D == 3 ? 12. : 4., 12, 9.5};
  add_vertex(body, p, Cell{0});
  add_vertex(body, q, Cell{0});
  add_edge(body, 0, 1);
  all.bodies.push_back({&body, &record, {0, 1}});
  WallSweep<D> walls(*this->env_);
  walls.start(this->kMiddle, this->star_, false);
  const double from[3] = {8, 8, 6}, to[3] = {8, D == 3 ? 8. : 18., 18};
  WallHit hit;
  body.level = SweepLevel::kEdgesSwept;
  EXPECT_TRUE(walls.meets(all, {Feature::kEdge, 0, 0}, from, to, &hit));
  EXPECT_FALSE(hit.wall.facet.valid());
  EXPECT_EQ(hit.wall.vertices[1], D == 3 ? 14u : kNone);
  body.level = SweepLevel::kEdges;
  EXPECT_FALSE(walls.meets(all, {Feature::kEdge, 0, 0}, from, to, &hit));
}

TYPED_TEST(WallSweepTest, DescribesTheTouch) {
  constexpr int D = TypeParam::value;
  constexpr int kUp = D - 1;
  std::mt19937 random(static_cast<uint32_t>(seed_of(3)));
  this->build(random);
  const uint32_t lower = this->kCells / 2;
  for (uint32_t i = 0; i < lower; ++i) set_cell_mark(*this->env_, this->env_->map.cell(i), true);
  Occupants<D> all(nullptr);
  Body<D> body(nullptr);
  MoveRecord record(nullptr);
  reserve(body, 2, 1, 0);
  ParticleState<D> particle{};
  particle.cell = this->env_->map.cell(this->kCells - 1);
  double from[D], to[D], ends[2][D];
  for (int k = 0; k < D; ++k) {
    particle.position[k] = k == kUp ? 11 : 8;
    from[k] = 8;
    to[k] = k == kUp ? 14 : 8;
    ends[0][k] = k == kUp ? 10 : 4;
    ends[1][k] = k == kUp ? 10 : 12;
  }
  all.particles = &particle;
  all.particle_count = 1;
  for (const auto& end : ends) add_vertex(body, end, particle.cell);
  add_edge(body, 0, 1);
  all.bodies.push_back({&body, &record, {0, 1}});
  WallSweep<D> walls(*this->env_);
  walls.start(this->kMiddle, this->star_, false);
  WallHit hit;
  ASSERT_TRUE(walls.meets(all, {Feature::kParticle, 0, 0}, from, to, &hit));
  EXPECT_GT(hit.time, 0.3);
  EXPECT_LT(hit.time, 0.8);
  measure(*this->env_, all, from, to, hit);
  EXPECT_GT(hit.other.normal[kUp], 0.3);
  EXPECT_EQ(hit.point[kUp], 11);
  if (D == 3) return;
  ASSERT_TRUE(walls.meets(all, {Feature::kEdge, 0, 0}, from, to, &hit));
  EXPECT_EQ(hit.time, 2. / 6);
  measure(*this->env_, all, from, to, hit);
  EXPECT_EQ(hit.along, 0.5);
  EXPECT_EQ(hit.point[0], 8);
  EXPECT_EQ(hit.point[1], 10);
  EXPECT_EQ(hit.other.normal[0], 0);
  EXPECT_EQ(hit.other.normal[1], 1);
}

}  // namespace
