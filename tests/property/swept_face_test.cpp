// Swept faces against brute force over all impassable vertices.

#include "swept_cases.h"

#include <map>

#include "corridor/box_probe.h"
#include "corridor/sweep.h"
#include "locate/locate.h"

namespace dsw::swept {
namespace {

struct Count {
  int sweeps = 0, contacts = 0, lone = 0, ties = 0, later = 0, checked_before = 0;
};

/// What is reported of a vertex beside its number.
void check_report(const Environment<3>& env, const SweepContact& contact) {
  const Map<3>& map = env.map;
  bool at_front = false;
  for (uint32_t v = 0; v < map.vertices_of(contact.front); ++v)
    at_front |= map.vertex(contact.front, v) == contact.vertex;
  ASSERT_TRUE(at_front);
  ASSERT_FALSE(map.marked(contact.front));
  HalfFacet lowest;
  for (uint32_t i = 0; i < map.cell_count && !lowest.valid(); ++i) {
    const Cell c = map.cell(i);
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count() && !lowest.valid(); ++f) {
      if (!is_impassable(map, map.half_facet(c, f))) continue;
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        if (map.vertex(c, shape.dart_vertex(d)) == contact.vertex) lowest = map.half_facet(c, f);
      }
    }
  }
  ASSERT_TRUE(contact.facet.valid() == lowest.valid());
  if (!lowest.valid()) return;
  ASSERT_TRUE(canonical(map, contact.facet) == lowest);
  const HalfFacet behind = map.opposite(contact.facet);
  ASSERT_TRUE(!behind.valid() || !map.marked(map.cell_of(contact.facet)) || map.marked(map.cell_of(behind)));
}

/// One face: its own flood, those of its edges, and the truth.
void check_face(const Environment<3>& env, SweptTruth& truth, SweepFlood<3>& flood, const Vec (&x)[4], bool generic,
                Count& count) {
  const FaceMotion m{x[0].data(), x[1].data(), x[2].data(), x[3].data()};
  const double* const at[4] = {m.p, m.to, m.q, m.r};
  const Cell start = locate(env, m.p, Cell{}, nullptr).cell;
  if (!start.valid() || env.map.marked(start)) return;
  truth.load(at, 4);
  if (!truth.is_free(0, 2, 3)) return;
  ++count.sweeps;
  const SweepResult face = flood.sweep(m, start, 0);
  if (truth.is_flat(0, 1, 2, 3)) {
    ASSERT_EQ(face.end, SweepEnd::kFree);
    return;
  }
  std::vector<std::pair<Moment, uint32_t>> met;
  for (const uint32_t v : truth.vertices) {
    if (truth.inside(v)) met.emplace_back(truth.face_moment(v), v);
  }
  // In ascending order of vertices: the first of the earliest counts.
  const auto first = std::min_element(met.begin(), met.end(),
                                      [](const auto& a, const auto& b) { return compare(a.first, b.first) < 0; });
  const SweepResult q = flood.sweep(EdgeMotion{m.p, m.to, m.q}, start, 0);
  const SweepResult r = flood.sweep(EdgeMotion{m.p, m.to, m.r}, start, 0);
  const SweepContact* edge = q.end == SweepEnd::kContact ? &q.contact : nullptr;
  if (r.end == SweepEnd::kContact && (edge == nullptr || comes_before(env.map, m.p, m.to, r.contact, *edge))) {
    edge = &r.contact;
  }
  if (face.end == SweepEnd::kContact) {
    ++count.contacts;
    check_report(env, face.contact);
    count.lone += face.contact.facet.valid() ? 0 : 1;
    ASSERT_EQ(face.contact.event.kind, EventKind::kFace);
    ASSERT_EQ(face.contact.event.points[2], env.point(face.contact.vertex));
    ASSERT_EQ(kind_of(face.contact), ContactKind::kVertex);
    ASSERT_TRUE(truth.inside(face.contact.vertex));
    ASSERT_EQ(truth.vertices.count(face.contact.vertex), 1u);
    ASSERT_NE(first, met.end());
    ASSERT_GE(compare(truth.face_moment(face.contact.vertex), first->first), 0);
    const Moment moment = truth.face_moment(face.contact.vertex);
    size_t k = 0;
    while (sgn(moment.denominator.c[k]) == 0) ++k;
    ASSERT_EQ(event_time<3>(m.p, m.to, face.contact.event),
              std::min(1.0, oracle::floor_to_double(moment.numerator.c[k], moment.denominator.c[k])));
    for (const auto& [other, vertex] : met) {
      const Big a = other.numerator.c[k] * first->first.denominator.c[k];
      count.ties += vertex != first->second && a == first->first.numerator.c[k] * other.denominator.c[k] ? 1 : 0;
    }
  }
  const SweepContact* earliest = edge;
  if (first != met.end()) {
    const SweepEvent event{{m.q, m.r, env.point(first->second)}, EventKind::kFace};
    if (edge == nullptr || compare_events<3>(m.p, m.to, event, edge->event).sign <= 0) {
      ASSERT_EQ(face.end, SweepEnd::kContact);
      ASSERT_EQ(face.contact.vertex, first->second);
      earliest = &face.contact;
      if (edge != nullptr) {
        ASSERT_TRUE(comes_before(env.map, m.p, m.to, face.contact, *edge));
      }
    } else {
      ++count.later;
    }
  } else {
    ASSERT_EQ(face.end, SweepEnd::kFree);
  }
  // Nothing is met before, nor ever if there is no contact; where rounding p(t) cannot matter.
  if (!generic) return;
  const double end = earliest == nullptr ? 1 : event_time<3>(m.p, m.to, earliest->event);
  for (const double by : {0.3, 0.7, 0.99, 0.9999}) {
    Vec now;
    for (size_t k = 0; k < 3; ++k) now[k] = m.p[k] + by * end * (m.to[k] - m.p[k]);
    const double* const moved[3] = {now.data(), m.q, m.r};
    truth.load(moved, 3);
    ASSERT_TRUE(truth.is_free(0, 1, 2));
  }
  ++count.checked_before;
}

TEST(SweptFaceTest, TheFirstVertexIsFound) {
  Count total;
  std::map<std::string, int> contacts;
  for_each_ground({{0, 0, 0, 0}, {0, 0, 0, 0.2}, {0, 0, 0.03, 0}, {0, 0.03, 0, 0}, {0.1, 0.02, 0.02, 0.05}},
                  [&](Ground& ground) {
                    const int before = total.contacts;
                    SweepFlood<3> flood(ground.env);
                    ground.draw(3000, [&](const Vec(&x)[4], bool generic) {
                      check_face(ground.env, ground.truth, flood, x, generic, total);
                    });
                    contacts[ground.kind] += total.contacts - before;
                  });
  for (const SceneKind& kind : oracle::sweep_scenes()) EXPECT_GT(contacts[kind.name], effort_of(15)) << kind.name;
  EXPECT_GT(total.contacts, effort_of(2000));
  EXPECT_GT(total.lone, effort_of(500));
  EXPECT_GT(total.ties, 0) << "vertices met at once, but for the shift";
  EXPECT_GT(total.later, effort_of(500)) << "an edge meets something earlier";
  EXPECT_GT(total.checked_before, effort_of(5000));
}

/// Body points on the half-way points of a lattice of marked vertices, edges and faces.
TEST(SweptFaceTest, TiesOnALattice) {
  static const Shares shares[] = {{0, 0, 0, 0.2}, {0, 0, 0.1, 0.1}, {0, 0.05, 0.05, 0.05}};
  Count count;
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(at_least(3)); ++seed) {
    Rng rng(seed);
    const auto env = environment_of(oracle::hex_grid(oracle::axis(5, 1), oracle::axis(5, 1), oracle::axis(5, 1)));
    ASSERT_NE(env, nullptr);
    mark(*env, rng, shares[seed - 1]);
    SweptTruth truth(*env);
    SweepFlood<3> flood(*env);
    for (int i = 0; i < effort_of(20000); ++i) {
      Vec x[4];
      for (double& c : x[0]) c = 0.5 * rng.between(0, 10);
      for (int j = 1; j < 4; ++j) {
        for (size_t k = 0; k < 3; ++k) x[j][k] = x[0][k] + 0.5 * rng.between(-4, 4);
      }
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(i));
      check_face(*env, truth, flood, x, false, count);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(count.contacts, effort_of(500));
  EXPECT_GT(count.ties, effort_of(60));
}

/// What is swept in a box that is free, from any of the cells that the probe has entered.
TEST(SweptFaceTest, NothingIsMetInAFreeBox) {
  int free = 0, of_many_cells = 0, from_elsewhere = 0;
  for_each_ground({{0.1, 0, 0, 0}, {0, 0.05, 0, 0}, {0, 0, 0.01, 0}, {0, 0, 0, 0.01}}, [&](Ground& ground) {
    SweepFlood<3> flood(ground.env);
    BoxProbe<3> probe(ground.env);
    ground.draw(3000, [&](const Vec(&x)[4], bool) {
      Cell cells[4];
      for (int k = 0; k < 4; ++k) cells[k] = locate(ground.env, x[k].data(), Cell{}, nullptr).cell;
      const Bounds<3> box = bounds<3>(x[0].data(), x[1].data(), x[2].data(), x[3].data());
      if (!cells[0].valid() || is_closed(ground.env, cells[0]) || !probe.is_free(box, cells[0])) return;
      ++free;
      for (int k = 0; k < 4; ++k) {
        if (!probe.has_entered(cells[k])) continue;
        from_elsewhere += cells[k] != cells[0] ? 1 : 0;
        const FaceMotion face{x[k].data(), x[(k + 1) % 4].data(), x[(k + 2) % 4].data(), x[(k + 3) % 4].data()};
        const SweepResult of_edge = flood.sweep(EdgeMotion{face.p, face.to, face.q}, cells[k], 0);
        ASSERT_EQ(of_edge.end, SweepEnd::kFree);
        of_many_cells += of_edge.volumes_visited > 1 ? 1 : 0;
        ASSERT_EQ(flood.sweep(face, cells[k], 0).end, SweepEnd::kFree);
        for (size_t c = 0; c < flood.cells().size(); ++c) ASSERT_TRUE(probe.has_entered(flood.cells()[c]));
      }
    });
  });
  EXPECT_GT(free, effort_of(1000));
  EXPECT_GT(of_many_cells, effort_of(1000));
  EXPECT_GT(from_elsewhere, effort_of(500));
}

}  // namespace
}  // namespace dsw::swept
