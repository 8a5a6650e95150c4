// Bodies against bodies and against themselves: every move of a vertex against all parts, over GMP.
#include "pairs_support.h"
#include "plane_support.h"

#include <algorithm>
#include <cstdlib>

namespace dsw::oracle {
namespace {

struct Kind {
  const char* name;
  int exponent;  // coordinates are scaled by 2^exponent
  bool lattice;  // they are multiples of a quarter
  bool self;
  int dimension = 3;
};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

struct Counts {
  int moves = 0, contacts = 0, missed = 0, false_ones = 0, late = 0, not_free = 0, wrong_part = 0, wrong_normal = 0;
  int split = 0, merged = 0;
};

class PairsTest : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    scale_ = std::ldexp(1.0, GetParam().exponent);
    if (plane()) {
      place_.environment = make_squares(4, true, nullptr, scale_);
    } else {
      place_ = place_of(hex_grid(axis(4, scale_), axis(4, scale_), axis(4, scale_)));
      ASSERT_PLACE(place_);
    }
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
  }

  static bool plane() { return GetParam().dimension == 2; }
  static dsw_level highest_level() { return plane() ? DSW_LEVEL_EDGES_SWEPT : DSW_LEVEL_FACES; }

  Vec place() {
    const bool lattice = GetParam().lattice || rng_.below(3) == 0;
    Vec p = {0, 0, 0};
    for (size_t k = 0; k < static_cast<size_t>(GetParam().dimension); ++k)
      p[k] = scale_ * (lattice ? 0.25 * static_cast<double>(1 + rng_.below(15)) : rng_.range(0.01, 3.99));
    return p;
  }
  Vec near(const Vec& p, double reach) {
    Vec q = place();
    for (size_t k = 0; k < static_cast<size_t>(GetParam().dimension); ++k) {
      q[k] = p[k] + std::max(-reach * scale_, std::min(reach * scale_, q[k] - p[k]));
      q[k] = std::max(0.01 * scale_, std::min(3.99 * scale_, q[k]));
    }
    return q;
  }

  /// Points, a polyline, a strip of triangles or the surface of a tetrahedron; in the plane also trees and polygons.
  BodyPlan plan() {
    const Vec at = place();
    const uint64_t kind = rng_.below(5);
    BodyPlan plan;
    const size_t count = kind == 3 ? 4 : 3 + rng_.below(4);
    for (size_t i = 0; i < count; ++i) plan.at.push_back(i == 0 ? at : near(plan.at.back(), 0.75));
    if (plane()) {
      const uint32_t edges = kind == 0 ? 2 : static_cast<uint32_t>(count);
      for (uint32_t i = 1; i < edges; ++i) plan.edges.push_back({kind == 3 ? 0 : i - 1, i});
      if (kind == 4) plan.edges.push_back({edges - 1, 0});
    } else if (kind == 3) {
      plan.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    } else if (kind == 0) {
      plan.edges = {{0, 1}};  // and vertices alone
    } else if (kind == 1) {
      for (uint32_t i = 1; i < count; ++i) plan.edges.push_back({i - 1, i});
    } else {
      for (uint32_t i = 2; i < count; ++i)
        plan.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i}
                                        : std::vector<uint32_t>{i - 1, i - 2, i});
    }
    return plan;
  }

  void fill(size_t count) {
    for (int tries = 0; tries < 300 && bodies_.size() < count; ++tries) {
      Meeting body;
      const BodyPlan made = plan();
      body.level = tries % 4 == 0 ? static_cast<dsw_level>(1 + rng_.below(highest_level())) : highest_level();
      body.dimension = GetParam().dimension;
      body.self = GetParam().self;
      const dsw_status status =
          create_body(scene_.get(), made, body.level, body.self ? DSW_BODY_SELF_CONTACTS : 0, {}, &body.id);
      if (status == DSW_STATUS_OCCUPIED) {
        ++refused_;
        continue;
      }
      ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
      bodies_.push_back(body);
      ASSERT_EQ(read_body(scene_.get(), body.id, bodies_.back().state), "");
    }
  }

  /// Moves one vertex and looks what is true of it.
  void move(size_t b, uint32_t v, const Vec& to) {
    Meeting& body = bodies_[b];
    if (body.state.at[v] == to) return;
    const TouchTruth truth = truth_of_move(bodies_, b, v, to);
    std::vector<Vec> targets = body.state.at;
    targets[v] = to;
    dsw_move_options options = defaults(dsw_move_options_init);
    options.order = &v;
    options.order_count = 1;
    BodyAnswer answer;
    ASSERT_EQ(move_body(scene_.get(), body.id, targets, &options, answer), "");
    const dsw_contact_partner* partners = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_contact_partners(scene_.get(), body.id, &partners, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, answer.contacts.size());
    ++counts_.moves;
    counts_.not_free += truth.at_start ? 1 : 0;
    counts_.missed += truth.touches && answer.contacts.empty() ? 1 : 0;
    counts_.false_ones += !truth.touches && !answer.contacts.empty() ? 1 : 0;
    if (truth.touches && !answer.contacts.empty()) {
      ++counts_.contacts;
      const dsw_body_contact& contact = answer.contacts[0];
      counts_.late += is_time(contact.time, truth.time) ? 0 : 1;
      counts_.wrong_part += is_named_part(body, v, to, contact, partners[0]) ? 0 : 1;
      counts_.wrong_normal += !plane() || is_normal(contact, partners[0]) ? 0 : 1;
      const Vec reached = answer.after.at[v];
      if (reached != body.state.at[v]) counts_.not_free += truth_of_move(bodies_, b, v, reached).touches ? 1 : 0;
    } else {
      EXPECT_EQ(answer.after.at[v], to);
    }
    body.state = answer.after;
  }

  /// Splits an edge and merges a vertex, where that can be.
  void edit(Meeting& body) {
    ASSERT_TRUE(are_apart(body, body));
    if (body.state.edges.empty()) return;
    const auto any = [&] { return rng_.below(body.state.edges.size()); };
    const double share = rng_.below(2) == 0 ? 0.5 : rng_.range(0.1, 0.9);
    dsw_status status = dsw_body_split_edge(scene_.get(), body.id, body.state.edge_ids[any()], share, nullptr);
    ASSERT_TRUE(status == DSW_STATUS_OK || status == DSW_STATUS_OCCUPIED) << dsw_last_error_message();
    counts_.split += status == DSW_STATUS_OK ? 1 : 0;
    ASSERT_EQ(read_body(scene_.get(), body.id, body.state), "");
    ASSERT_TRUE(are_apart(body, body));
    const size_t e = any();
    const dsw_body_vertex_id gone = body.state.vertices[body.state.edges[e][rng_.below(2)]];
    status = dsw_body_collapse_edge(scene_.get(), body.id, body.state.edge_ids[e], gone, nullptr);
    ASSERT_TRUE(status == DSW_STATUS_OK || status == DSW_STATUS_OCCUPIED || status == DSW_STATUS_NOT_MANIFOLD)
        << dsw_last_error_message();
    counts_.merged += status == DSW_STATUS_OK ? 1 : 0;
    ASSERT_EQ(read_body(scene_.get(), body.id, body.state), "");
  }

  /// Whether the parts that are named touch at that time.
  bool is_named_part(const Meeting& body, uint32_t v, const Vec& to, const dsw_body_contact& contact,
                     const dsw_contact_partner& partner) {
    const Meeting* const other = find(partner.body);
    if (other == nullptr || contact.vertex.index != v) return false;
    const Part moving = part(body.state, contact.vertex, contact.edge, contact.face);
    const Part still = part(other->state, partner.vertex, partner.edge, partner.face);
    const TouchTruth truth = truth_of_parts(body, moving, v, to, *other, still);
    return truth.touches && is_time(contact.time, truth.time);
  }
  const Meeting* find(dsw_body_id id) const {
    const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const Meeting& each) {
      return each.id.index == id.index && each.id.generation == id.generation;
    });
    return found == bodies_.end() ? nullptr : &*found;
  }
  static Part part(const BodyState& s, dsw_body_vertex_id vertex, dsw_body_edge_id edge, dsw_body_face_id face) {
    for (size_t e = 0; e < s.edges.size(); ++e) {
      if (edge.generation != 0 && s.edge_ids[e].index == edge.index) return Part{{s.edges[e][0], s.edges[e][1]}};
    }
    for (size_t f = 0; f < s.faces.size(); ++f) {
      if (face.generation != 0 && s.face_ids[f].index == face.index) {
        return Part{{s.faces[f][0], s.faces[f][1], s.faces[f][2]}};
      }
    }
    return Part{{vertex.index}};
  }

  /// In the plane: across the edge, moving or not, and against the motion; where that is along the edge, or there is
  /// none, the motion turned round.
  bool is_normal(const dsw_body_contact& contact, const dsw_contact_partner& partner) {
    const auto way = [this](const double* from, const double* to) {
      return std::array<mpq_class, 2>{(mpq_class(to[0]) - from[0]) / scale_, (mpq_class(to[1]) - from[1]) / scale_};
    };
    const BodyState& other = find(partner.body)->state;
    const Part still = part(other, partner.vertex, partner.edge, partner.face);
    const double *const first = other.at[still.vertices.front()].data(), *const last =
                                                                             other.at[still.vertices.back()].data();
    const bool moves = contact.edge.generation != 0;
    const auto move = way(contact.from, contact.to), edge = way(first, moves ? contact.fixed[0] : last);
    const auto start = moves ? way(contact.from, contact.fixed[0]) : edge;  // it turns round one of its ends
    const int into = sgn(mpq_class(start[1] * move[0] - start[0] * move[1]));
    double x = -into * edge[1].get_d(), y = into * edge[0].get_d();
    if (into == 0) x = -move[0].get_d(), y = -move[1].get_d();
    const double length = std::hypot(x, y);
    return std::fabs(contact.contact.normal[0] - x / length) < 1e-14 &&
           std::fabs(contact.contact.normal[1] - y / length) < 1e-14 && contact.contact.normal[2] == 0;
  }

  double scale_ = 1;
  Rng rng_{17};
  Place place_;
  ScenePtr scene_;
  std::vector<Meeting> bodies_;
  Counts counts_;
  int refused_ = 0;
};
INSTANTIATE_TEST_SUITE_P(
    All, PairsTest,
    testing::Values(Kind{"Places", 0, false, false}, Kind{"Lattice", 0, true, false}, Kind{"Huge", 332, false, false},
                    Kind{"Tiny", -332, true, false}, Kind{"Self", 0, false, true}, Kind{"SelfOnLattice", 0, true, true},
                    Kind{"PlanePlaces", 0, false, false, 2}, Kind{"PlaneLattice", 0, true, false, 2},
                    Kind{"PlaneHuge", 1000, false, false, 2}, Kind{"PlaneTiny", -1000, true, false, 2},
                    Kind{"PlaneSelf", 0, false, true, 2}, Kind{"PlaneSelfOnLattice", 0, true, true, 2}),
    [](const auto& i) { return i.param.name; });

TEST_P(PairsTest, EveryMoveEndsAsAllPartsAgainstAllPartsSay) {
  fill(12);
  ASSERT_GT(bodies_.size(), 4u);
  EXPECT_GT(refused_, 0);
  const int moves = std::max(5, effort_of(plane() ? 400 : 80));  // rationals are slow
  for (int i = 0; i < moves && !HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    const size_t b = rng_.below(bodies_.size());
    const auto v = static_cast<uint32_t>(rng_.below(bodies_[b].state.at.size()));
    move(b, v, near(bodies_[b].state.at[v], plane() ? 0.75 : 1.5));
  }
  EXPECT_GT(counts_.contacts, moves / 10);
  EXPECT_GT(counts_.moves - counts_.contacts, moves / 10);
  EXPECT_EQ(counts_.missed, 0);
  EXPECT_EQ(counts_.false_ones, 0);
  EXPECT_EQ(counts_.late, 0);
  EXPECT_EQ(counts_.not_free, 0);
  EXPECT_EQ(counts_.wrong_part, 0);
  EXPECT_EQ(counts_.wrong_normal, 0);
}

TEST_P(PairsTest, BodiesStayApartWhateverTheResponse) {
  fill(12);
  ASSERT_GT(bodies_.size(), 4u);
  size_t contacts = 0, edits = 0;
  for (int round = 0; round < at_least(10); ++round) {
    SCOPED_TRACE(round);
    dsw_move_options options = defaults(dsw_move_options_init);
    options.vertex_response = round % 2 == 0 ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
    options.edge_response = static_cast<dsw_response>(round % 6);
    options.search = static_cast<dsw_search>(round / 2 % 3);
    options.min_length = 0.125 * scale_;  // else parts get ever smaller
    options.noise_share = round % 4 == 3 ? 0.05 : 0;
    std::vector<dsw_body_id> ids;
    std::vector<double> targets;
    for (Meeting& body : bodies_) {
      ids.push_back(body.id);
      for (const Vec& p : body.state.at) {
        const Vec to = near(p, 0.5);
        targets.insert(targets.end(), to.begin(), to.end());
      }
    }
    std::vector<dsw_move_report> reports(ids.size());
    ASSERT_EQ(dsw_scene_move_bodies(scene_.get(), ids.data(), ids.size(), targets.data(), targets.size() / 3,
                                    sizeof(Vec), &options, reports.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    for (size_t i = 0; i < bodies_.size(); ++i) {
      ASSERT_EQ(read_body(scene_.get(), ids[i], bodies_[i].state), "");
      contacts += reports[i].contact_count;
      edits += reports[i].edit_count;
    }
    for (size_t i = 0; i < bodies_.size(); ++i) {
      if (GetParam().self) {
        edit(bodies_[i]);
        ASSERT_TRUE(are_apart(bodies_[i], bodies_[i])) << i;
      }
      for (size_t j = 0; j < i && round % 5 == 4; ++j) ASSERT_TRUE(are_apart(bodies_[i], bodies_[j])) << i << " " << j;
    }
  }
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(edits, 10u);
  if (!GetParam().self) return;
  EXPECT_GT(counts_.split, 20);
  EXPECT_GT(counts_.merged, 10);
}

}  // namespace
}  // namespace dsw::oracle
