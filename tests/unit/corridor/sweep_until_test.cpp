// Sweeps that end at the first contact, and corridors that are kept until an event, against what is asked at length.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "corridor/first_ridge.h"
#include "corridor/sweep.h"
#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/standard_facets.h"

namespace {

using namespace dsw;
using namespace dsw::test;

using Point = std::array<double, 3>;

enum class Kind { kBoxes, kWarped, kTetrahedra, kUneven };

/** n^3 cubes, or six tetrahedra in each; some vertices are moved. */
std::unique_ptr<Environment<3>> make_ground(Kind kind, int n, Random& random) {
  Mesh3 boxes, mesh;
  add_boxes(boxes, n, n, n);
  const double reach = kind == Kind::kWarped ? 0.2 : kind == Kind::kUneven ? 0.12 : 0;
  for (double& x : boxes.points) x += reach * (2 * random.unit() - 1);
  if (kind == Kind::kBoxes || kind == Kind::kWarped) return boxes.build();
  mesh.points = boxes.points;
  for (size_t c = 0; c < boxes.types.size(); ++c) {
    const int64_t* const v = &boxes.connectivity[8 * c];
    const int64_t ways[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
    for (const auto& way : ways) mesh.cell(kTetra, {v[0], v[way[0]], v[way[1]], v[6]});
  }
  return mesh.build();
}

void mark_some(Environment<3>& env, Random& random) {
  const Map<3>& map = env.map;
  reserve_edge_marks(env, 400);
  const int facets = 2 + random.below(20), cells = 5 + random.below(60);
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    if (random.below(cells) == 0) set_cell_mark(env, c, true);
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      if (random.below(facets) == 0 && map.opposite(map.half_facet(c, f)).valid()) {
        set_facet_mark(env, map.half_facet(c, f), true);
      }
    }
    if (random.below(40) == 0) {
      const Shape shape = map.shape(c);
      const uint32_t d = static_cast<uint32_t>(random.below(static_cast<int>(shape.dart_count())));
      set_edge_mark(env, map.vertex(c, shape.dart_vertex(d)), map.vertex(c, shape.dart_vertex(shape.beta1(d))), true);
    }
  }
}

Point some_point(Random& random, int n, bool lattice) {
  Point p;
  for (double& x : p) x = lattice ? 0.25 * random.below(4 * n + 1) : n * random.unit();
  return p;
}
Point near(const Point& from, Random& random, double reach, bool lattice) {
  Point p = from;
  for (double& x : p) x += lattice ? 0.25 * (random.below(9) - 4) : reach * (2 * random.unit() - 1);
  return p;
}

/** A free edge p q and where p goes. */
struct Try {
  Point p, to, q;
  Cell start;

  EdgeMotion motion() const { return {p.data(), to.data(), q.data()}; }
  bool draw(const Environment<3>& env, Random& random, int n, bool lattice) {
    p = some_point(random, n, lattice);
    q = near(p, random, 1.5, lattice);
    to = near(p, random, random.below(2) == 0 ? 0.3 : 2, lattice);
    start = locate(env, p.data(), Cell{}, nullptr).cell;
    if (!start.valid() || is_closed(env, start)) return false;
    return dsw::cast(env, p.data(), q.data(), start, 0, nullptr).end == CastEnd::kReached;
  }
};

bool same_contact(const SweepContact& a, const SweepContact& b) {
  return same_event(a, b) && a.front == b.front && a.facet.word == b.facet.word && a.simplex == b.simplex &&
         a.dart == b.dart && a.faces_start == b.faces_start;
}

class SweepUntil : public testing::TestWithParam<Kind> {};

TEST_P(SweepUntil, FindsTheContactOfASweepThatComesBeforeTheEnd) {
  constexpr int kSize = 4;
  int contacts = 0, shorter = 0;
  uint64_t all_cells = 0, cells = 0;
  for (int round = 0; round < at_least(40); ++round) {
    Random random(static_cast<uint64_t>(100 * round + 7));
    const auto env = make_ground(GetParam(), kSize, random);
    mark_some(*env, random);
    SweepFlood<3> flood(*env);
    for (int i = 0; i < 400; ++i) {
      Try t;
      if (!t.draw(*env, random, kSize, random.below(2) == 0)) continue;
      const EdgeMotion m = t.motion();
      const SweepResult whole = flood.sweep(m, t.start, 0);
      const double some = random.unit();
      if (whole.end != SweepEnd::kContact) {
        for (const double end : {0.0, some, 1.0}) {
          ASSERT_EQ(flood.sweep_until(m, t.start, end).end, SweepEnd::kFree) << round << "/" << i;
        }
        continue;
      }
      ++contacts;
      const double time = event_time<3>(m.p, m.to, whole.contact.event);
      const double after = time_after<3>(m.p, m.to, whole.contact.event);
      for (const double end : {0.0, std::nextafter(time, 0), time, after, std::nextafter(after, 0), some, 1.0}) {
        if (!(0 <= end && end <= 1)) continue;
        const SweepResult until = flood.sweep_until(m, t.start, end);
        if (end > time || end == 1) {
          ASSERT_EQ(until.end, SweepEnd::kContact) << round << "/" << i << " end " << end << " of " << time;
          ASSERT_TRUE(same_contact(until.contact, whole.contact)) << round << "/" << i << " end " << end;
        } else if (until.end == SweepEnd::kContact) {
          ASSERT_FALSE(comes_before(env->map, m.p, m.to, until.contact, whole.contact)) << round << "/" << i;
        }
        if (end == 1) {
          all_cells += whole.volumes_visited;
          cells += until.volumes_visited;
          shorter += until.volumes_visited < whole.volumes_visited ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_GT(shorter, 100);
  EXPECT_LT(cells, all_cells);
}
INSTANTIATE_TEST_SUITE_P(Kinds, SweepUntil,
                         testing::Values(Kind::kBoxes, Kind::kWarped, Kind::kTetrahedra, Kind::kUneven));

/** 4 x 4 boxes round an edge in their middle; one of the inner ones is cut off from the others. */
class Pinched : public testing::Test {
 protected:
  /** By marked faces, or by a copy of the edge: then the faces are of the outer boundary. */
  void build(bool copy, int corner) {
    Mesh3 mesh;
    add_boxes(mesh, 4, 4, 1);
    const int x = 1 + (corner & 1), y = 1 + (corner >> 1);
    cut_off_ = static_cast<uint32_t>(x + 4 * y);
    if (copy) {
      int64_t* const v = &mesh.connectivity[8 * cut_off_];
      for (int i = 0; i < 8; ++i) {
        const double* const at = &mesh.points[3 * static_cast<size_t>(v[i])];
        const double z = at[2];
        if (at[0] == 2 && at[1] == 2) v[i] = mesh.point({2, 2, z});
      }
    }
    env_ = mesh.build();
    const Map<3>& map = env_->map;
    const Cell c = map.cell(cut_off_);
    for (uint32_t f = 0; f < 6 && !copy; ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      if (!o.valid()) continue;
      const uint32_t n = map.index(map.cell_of(o));
      const bool inner = (n % 4 == 1 || n % 4 == 2) && (n / 4 == 1 || n / 4 == 2);
      if (inner) set_facet_mark(*env_, h, true);
    }
  }

  std::unique_ptr<Environment<3>> env_;
  uint32_t cut_off_ = 0;
};

TEST_F(Pinched, TheWallsCountThatAreLinkedWithWhereTheEdgeComesFrom) {
  int behind = 0;
  for (int i = 0; i < 32; ++i) {
    const bool copy = (i & 1) != 0, swap = (i & 2) != 0, long_way = (i & 4) != 0;
    const int corner = i >> 3;
    build(copy, corner);
    SCOPED_TRACE(i);
    // Seen from the middle the cut-off box is in direction (u, v): the edge comes from the other side.
    const double u = (corner & 1) != 0 ? 1 : -1, v = (corner >> 1) != 0 ? 1 : -1;
    const Point a{2 - 1.5 * u, 2 + 0.9 * v, 0.5}, b{2 + 1.4 * u, 2 - 1.7 * v, 0.4};
    const Point p = swap ? b : a, q = swap ? a : b;
    const double far = long_way ? 1 : 0.5;
    // Its other end goes round the box, so that the triangle meets all that lies there.
    const Point to = swap ? Point{2 + 1.9 * far * u, 2 + 1.9 * v, 0.6} : Point{2 + 1.9 * u, 2 + 1.9 * far * v, 0.6};
    const EdgeMotion m{p.data(), to.data(), q.data()};
    const Cell start = locate(*env_, p.data(), Cell{}, nullptr).cell;
    ASSERT_EQ(dsw::cast(*env_, m.p, m.q, start, 0, nullptr).end, CastEnd::kReached);
    SweepFlood<3> flood(*env_);
    const SweepResult whole = flood.sweep(m, start, 0);
    ASSERT_EQ(whole.end, SweepEnd::kContact);
    EXPECT_EQ(whole.contact.event.points[1][0], 2);
    EXPECT_EQ(whole.contact.event.points[1][1], 2);
    // Behind marked faces the box is still linked round the edge: then the lowest name counts.
    const bool is_behind = env_->map.index(whole.contact.front) == cut_off_;
    EXPECT_FALSE(copy && is_behind);
    behind += is_behind ? 1 : 0;
    for (const double end : {1.0, time_after<3>(m.p, m.to, whole.contact.event)}) {
      const SweepResult until = flood.sweep_until(m, start, end);
      ASSERT_EQ(until.end, SweepEnd::kContact);
      EXPECT_TRUE(same_contact(until.contact, whole.contact)) << "end " << end;
    }
    flood.sweep(m, start, 0, true);
    EXPECT_FALSE(flood.all().empty());
  }
  EXPECT_GT(behind, 0);
}

/** Whether a ridge is that of an event of the edge itself. */
bool is_ridge_of(const SweepEvent& event, const EdgeMotion& m, const double* a, const double* b) {
  if (event.kind != EventKind::kEdge || event.points[0] != m.q) return false;
  return (event.points[1] == a && event.points[2] == b) || (event.points[1] == b && event.points[2] == a);
}

/** Every ridge of every facet, one by one. */
bool passes_all(const Environment<3>& env, const Array<uint32_t>& facets, const EdgeMotion& m, bool p_first,
                const SweepEvent& event) {
  const double *const from = p_first ? m.to : m.q, *const to = p_first ? m.q : m.to;
  for (const uint32_t word : facets) {
    const HalfFacet h{word};
    const Cell c = env.map.cell_of(h);
    const Shape shape = env.map.shape(c);
    const uint32_t f = env.map.local_of(h, c);
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      const double *const a = env.point(c, shape.dart_vertex(d)), *const b =
                                                                      env.point(c, shape.dart_vertex(shape.beta1(d)));
      const double* const ridge[2] = {a, b};
      if (line_side<3>(from, to, ridge, NoTally{}).sign == 1 || is_ridge_of(event, m, a, b)) continue;
      if (compare_events<3>(m.p, m.to, {{m.q, a, b}, EventKind::kEdge}, event).sign <= 0) return false;
    }
  }
  return true;
}

/** Which ridge is met first, one by one: those of facets from `low` to before `high`, of which all that are met count.
 * False: two are met at one time. */
bool find_first_of_all(const Environment<3>& env, const Array<uint32_t>& facets, size_t low, size_t high,
                       const EdgeMotion& m, bool p_first, SweepEvent* first) {
  const double *const from = p_first ? m.to : m.q, *const to = p_first ? m.q : m.to;
  for (size_t i = low; i < high; ++i) {
    const Cell c = env.map.cell_of({facets[i]});
    const Shape shape = env.map.shape(c);
    const uint32_t f = env.map.local_of({facets[i]}, c);
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      const double *const a = env.point(c, shape.dart_vertex(d)), *const b =
                                                                      env.point(c, shape.dart_vertex(shape.beta1(d)));
      const double* const ridge[2] = {a, b};
      if (line_side<3>(from, to, ridge, NoTally{}).sign == 1) continue;
      const SweepEvent met{{m.q, a, b}, EventKind::kEdge};
      const bool any = first->points[0] != nullptr;
      if (any && is_ridge_of(*first, m, a, b)) continue;
      const int order = any ? compare_events<3>(m.p, m.to, met, *first).sign : -1;
      if (order == 0) return false;
      if (order < 0) *first = met;
    }
  }
  return true;
}

/// What an edge passes where it starts.
void note_start(const Environment<3>& env, const EdgeMotion& m, Cell start, bool p_first, Corridor<3>& corridor) {
  CorridorWriter<3> writer(nullptr);
  CastRequest request;
  request.from = p_first ? m.p : m.q;
  request.to = p_first ? m.q : m.p;
  request.start = p_first ? start : locate(env, m.q, Cell{}, nullptr).cell;
  writer.attach(env, request);
  ASSERT_EQ(dsw::cast(env, request, nullptr).end, CastEnd::kReached);
  writer.finish(corridor);
}

TEST(FirstRidge, IsThatOfAll) {
  constexpr int kSize = 4;
  int met = 0, none = 0, added_counts = 0, left_before = 0;
  for (int round = 0; round < at_least(240); ++round) {
    Random random(static_cast<uint64_t>(round + 77));
    const auto env = make_ground(round % 2 == 0 ? Kind::kTetrahedra : Kind::kUneven, kSize, random);
    const Map<3>& map = env->map;
    for (int i = 0; i < 600; ++i) {
      Try t;
      if (!t.draw(*env, random, kSize, random.below(2) == 0)) continue;
      const EdgeMotion m = t.motion();
      const bool p_first = random.below(2) == 0;
      Corridor<3> corridor{Array<uint32_t>::allocator_type(nullptr)};
      ASSERT_NO_FATAL_FAILURE(note_start(*env, m, t.start, p_first, corridor));
      const CastResult path = dsw::cast(*env, m.p, m.to, t.start, 0, nullptr);
      const PathFacets crossed = path_facets(map, t.start, path);
      if (!corridor.known() || !corridor.in_rows || path.end != CastEnd::kReached) continue;
      if (crossed.count > 1 || (crossed.count == 0 && path.cell != t.start)) continue;
      // A facet that the path passes is the end of the corridor, or one more.
      size_t added = 0;
      if (crossed.count == 1) {
        const HalfFacet beyond = map.opposite(crossed.facets[0]);
        const HalfFacet left = p_first ? crossed.facets[0] : beyond, more = p_first ? beyond : crossed.facets[0];
        const bool leaves =
            !corridor.facets.empty() && (p_first ? corridor.facets.front() : corridor.facets.back()) == left.word;
        if (leaves) corridor.remove(*env, p_first);
        if (!leaves) corridor.add(*env, more, p_first);
        added = leaves ? 0 : 1;
        corridor.portal.version = env->obstacle_version;
      }
      const size_t count = corridor.facets.size(), low = p_first ? added : 0;
      SweepEvent expected;
      bool is_known = find_first_of_all(*env, corridor.facets, low, low + count - added, m, p_first, &expected);
      if (is_known && added == 1) {
        const size_t at = p_first ? 0 : count - 1;
        const Cell c = map.cell_of({corridor.facets[at]});
        const double* corners[3];
        boundary_points(*env, c, map.local_of({corridor.facets[at]}, c), corners);
        const SweepEvent passed{{corners[0], corners[1], corners[2]}, EventKind::kVertex};
        const int order = expected.points[0] != nullptr ? compare_events<3>(m.p, m.to, expected, passed).sign : 1;
        if (order == 0) continue;
        left_before += order < 0 ? 1 : 0;
        const SweepEvent of_others = expected;
        if (order > 0) is_known = find_first_of_all(*env, corridor.facets, at, at + 1, m, p_first, &expected);
        added_counts += std::equal(expected.points, expected.points + 3, of_others.points) ? 0 : 1;
      }
      FirstRidge first;
      ASSERT_EQ(find_first_ridge(*env, corridor, m, p_first, added, &first), is_known) << round << "/" << i;
      if (!is_known) continue;
      ASSERT_EQ(first.facet.valid(), expected.points[0] != nullptr) << round << "/" << i;
      ++(first.facet.valid() ? met : none);
      if (!first.facet.valid()) continue;
      EXPECT_TRUE(is_ridge_of(expected, m, first.event.points[1], first.event.points[2]));
      EXPECT_NE(std::find(corridor.facets.begin(), corridor.facets.end(), first.facet.word), corridor.facets.end());
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(none, 300);
  EXPECT_GT(added_counts, 0);
  EXPECT_GT(left_before, 10);
}

/// What a cast passes; unknown if it does not arrive.
Corridor<3> passed_by(const Environment<3>& env, const double* from, const double* to) {
  Corridor<3> corridor{Array<uint32_t>::allocator_type(nullptr)};
  corridor.forget();
  const Cell start = locate(env, from, Cell{}, nullptr).cell;
  if (dsw::cast(env, from, to, start, 0, nullptr).end == CastEnd::kReached) {
    note_start(env, {from, to, to}, start, true, corridor);
  }
  return corridor;
}

TEST(KeepsToRows, WhereCastsPassTheSameFacetsBeforeBetweenAndAfter) {
  constexpr int kSize = 4;
  int kept = 0, before = 0, between = 0, after = 0;
  for (int round = 0; round < at_least(40); ++round) {
    Random random(static_cast<uint64_t>(round + 13));
    const auto env = make_ground(Kind::kUneven, kSize, random);
    for (int i = 0; i < 600; ++i) {
      const Point p = some_point(random, kSize, false), q = near(p, random, 2, false),
                  p_to = near(p, random, 0.2, false), q_to = near(q, random, 0.2, false);
      const auto cell = [&](const Point& x) { return locate(*env, x.data(), Cell{}, nullptr).cell; };
      if (!cell(p).valid() || !cell(q).valid() || cell(p) != cell(p_to) || cell(q) != cell(q_to)) continue;
      const bool from_first = random.below(2) == 0, stays = random.below(8) == 0;
      const double *const first = p.data(), *const first_to = p_to.data(), *const other = q.data(),
                          *const other_to = stays ? other : q_to.data();
      const auto passed = [&](const double* x, const double* y) {
        return from_first ? passed_by(*env, x, y) : passed_by(*env, y, x);
      };
      // What one of the three lines passes, and the others mostly do.
      const int noted = random.below(3);
      const double *const a = noted == 0 ? first : first_to, *const b = noted == 2 ? other_to : other;
      Corridor<3> corridor = passed(a, b);
      if (!corridor.known() || !corridor.in_rows || corridor.facets.size() < 2) continue;
      const bool is_before = passed(first, other).facets == corridor.facets,
                 is_between = passed(first_to, other).facets == corridor.facets,
                 is_after = passed(first_to, other_to).facets == corridor.facets;
      const EdgeWay way{first, first_to, other, other_to, from_first};
      Corridor<3> again = corridor;
      ASSERT_EQ(keeps_to_rows(corridor, way, true), is_before && is_between && is_after) << round << "/" << i;
      ASSERT_EQ(keeps_to_rows(again, way, false), is_between && is_after) << round << "/" << i;
      kept += is_before && is_between && is_after ? 1 : 0;
      before += !is_before && is_between && is_after ? 1 : 0;
      between += is_before && !is_between && is_after ? 1 : 0;
      after += is_before && is_between && !is_after ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 1000);
  EXPECT_GT(std::min({before, between, after}), 20);
}

class PassesBefore : public testing::TestWithParam<Kind> {};

TEST_P(PassesBefore, AsEveryRidgeSays) {
  constexpr int kSize = 4;
  int asked = 0, passed = 0, passed_by_time = 0;
  for (int round = 0; round < at_least(20); ++round) {
    Random random(static_cast<uint64_t>(round + 31));
    const auto env = make_ground(GetParam(), kSize, random);
    const Map<3>& map = env->map;
    for (int i = 0; i < 600; ++i) {
      Try t;
      const bool lattice = random.below(2) == 0;
      if (!t.draw(*env, random, kSize, lattice)) continue;
      const EdgeMotion m = t.motion();
      const bool p_first = random.below(2) == 0;
      Corridor<3> corridor{Array<uint32_t>::allocator_type(nullptr)};
      ASSERT_NO_FATAL_FAILURE(note_start(*env, m, t.start, p_first, corridor));
      if (!corridor.known() || corridor.facets.empty()) continue;
      for (int events = 0; events < 6; ++events) {
        // One of its own ridges, any line, one of another edge, or a plane.
        const Point other = near(t.p, random, 1.5, lattice);
        const HalfFacet h{corridor.facets[static_cast<size_t>(random.below(static_cast<int>(corridor.facets.size())))]};
        const Cell c = random.below(3) == 0
                           ? map.cell(static_cast<uint32_t>(random.below(static_cast<int>(map.cell_count))))
                           : map.cell_of(h);
        const Shape shape = map.shape(c);
        const uint32_t s = static_cast<uint32_t>(random.below(static_cast<int>(shape.simplex_count())));
        const double* at[3];
        for (uint32_t k = 0; k < 3; ++k) at[k] = env->point(c, shape.simplices()[3 * s + k]);
        SweepEvent event;
        if (random.below(4) == 0) {
          event = {{at[0], at[1], at[2]}, EventKind::kVertex};
          if (plane_side<3>(at, m.p, NoTally{}).sign == plane_side<3>(at, m.to, NoTally{}).sign) continue;
        } else {
          event = {{random.below(3) == 0 ? other.data() : m.q, at[0], at[1]}, EventKind::kEdge};
          const double* const q = event.points[0];
          if (line_side<3>(m.p, q, at, NoTally{}).sign == line_side<3>(m.to, q, at, NoTally{}).sign) continue;
        }
        const bool passes = passes_before<3>(*env, corridor, m, p_first, event);
        ASSERT_EQ(passes, passes_all(*env, corridor.facets, m, p_first, event)) << round << "/" << i;
        ++asked;
        passed += passes ? 1 : 0;
        Corridor<3> again{Array<uint32_t>::allocator_type(nullptr)};
        again.assign(*env, corridor.facets);
        passed_by_time +=
            passes && !follows(*env, again, p_first ? m.to : m.q, p_first ? m.q : m.to,
                               map.cell_of({again.facets.front()}), map.cell_of(map.opposite({again.facets.back()})))
                ? 1
                : 0;
      }
    }
  }
  EXPECT_GT(asked, 3000);
  EXPECT_GT(passed, 300);
  EXPECT_LT(passed, asked - 300);
  EXPECT_GT(passed_by_time, 100);
}
INSTANTIATE_TEST_SUITE_P(Kinds, PassesBefore, testing::Values(Kind::kBoxes, Kind::kTetrahedra, Kind::kUneven));

}  // namespace
