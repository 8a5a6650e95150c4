// Calls for thick bodies with random arguments, and what must be true after each.
#pragma once

#include "thick_ground.h"

namespace dsw::oracle {

class ThickChecks {
 public:
  ThickChecks(ThickScene& scene, ThickGround& ground, Rng& rng) : scene_(scene), ground_(ground), rng_(rng) {}

  /// One vertex goes alone, and stops at what it touches.
  void move_one(size_t i);
  /// All vertices go, with any options.
  void move_all(size_t i);
  /// Radii round the largest one for which there is room.
  void try_radii(size_t i);
  /// Creation with such radii. The body is another one then.
  void try_creation(size_t i, const BodyPlan& plan);
  void check_gap(size_t i);

  Vec target(size_t i, uint32_t vertex);
  dsw_move_options any_options();

  uint64_t moves = 0, contacts = 0, arrivals = 0, refused = 0, accepted = 0, named = 0;

 private:
  void check_arrival(size_t i, uint32_t vertex, const Vec& from, const Vec& to, size_t contact_count);
  void check_contact(size_t i, const dsw_body_contact& contact, const dsw_contact_partner& partner);
  void check_obstacle(const dsw_body_contact& contact, const Hull& part, double radius, double slack);
  static void check_normal(const dsw_body_contact& contact, const Apart& nearest, double radius, double slack);
  void check_offending(size_t i, double radius);
  /// -1: too near for a radius, 1: not too near, 0: either may be said, for the sake of rounding.
  int verdict(size_t i, double radius) const;
  std::vector<Hull> hulls_of(const dsw_cell& cell) const;
  double slack() const { return 0x1p-46 * ground_.largest; }

  ThickScene& scene_;
  ThickGround& ground_;
  Rng& rng_;
  std::vector<uint32_t> order_;
};

inline Vec ThickChecks::target(size_t i, uint32_t vertex) {
  const Vec& from = scene_.bodies[i].state.at[vertex];
  Places& places = ground_.places();
  Vec to = from;
  switch (rng_.below(6u)) {
    case 0:
      to = places.target(from);
      break;
    case 1:
      to = places.near(from, std::pow(10, rng_.range(-6, -1)));
      break;
    case 2:
      to = places.near(from, 0.3);
      break;
    case 3:
      to = places.along_axis(from, rng_.chance(0.5) ? 0.02 : 1);
      break;
    default:  // past something that sticks out, or up to it
      to = between(from, places.obstacle(0.5), rng_.chance(0.5) ? rng_.range(0.5, 2) : 1);
  }
  return finite(to) ? to : from;
}

inline dsw_move_options ThickChecks::any_options() {
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_SLIDE : DSW_RESPONSE_STOP;
  options.edge_response = static_cast<dsw_response>(rng_.below(6u));
  if (rng_.chance(0.3)) options.flags = DSW_MOVE_KEEP_WALLS;
  if (rng_.chance(0.2)) options.search = rng_.chance(0.5) ? DSW_SEARCH_BISECTION : DSW_SEARCH_EXHAUSTIVE;
  if (rng_.chance(0.3)) options.passes = rng_.below(4u);
  if (rng_.chance(0.3)) options.stand_off = rng_.chance(0.5) ? -1 : 1e-3 * ground_.cell();
  if (rng_.chance(0.2)) options.noise_share = 0.05;
  if (rng_.chance(0.1)) options.max_volumes = 1 + rng_.below(8u);
  return options;
}

inline void ThickChecks::move_one(size_t i) {
  const BodyState before = scene_.bodies[i].state;
  const uint32_t v = rng_.below(before.at.size());
  if (before.vertices[v].generation == 0) return;
  const Vec from = before.at[v], to = target(i, v);
  std::vector<Vec> targets = before.at;
  targets[v] = to;
  dsw_move_options options = defaults(dsw_move_options_init);
  options.order = &v;
  options.order_count = 1;
  if (rng_.chance(0.3)) options.stand_off = rng_.chance(0.5) ? -1 : 1e-4 * ground_.cell();
  if (rng_.chance(0.1)) options.search = DSW_SEARCH_BISECTION;
  BodyAnswer answer;
  ASSERT_EQ(move_body(scene_.handle(), scene_.bodies[i].id, targets, &options, answer), "");
  const dsw_contact_partner* partners = nullptr;
  size_t count = 0;
  dsw_body_get_contact_partners(scene_.handle(), scene_.bodies[i].id, &partners, &count);
  const Vec end = answer.after.at[v];
  SCOPED_TRACE("radius " + number(scene_.bodies[i].radius) + " level " + std::to_string(scene_.bodies[i].level) +
               " vertex " + std::to_string(v) + " " + hex(from) + " to " + hex(to) + " came to " + hex(end));
  ++moves;
  contacts += answer.contacts.size();
  EXPECT_EQ(scene_.too_near_on_way(i, v, from, end, kKept), "");
  check_arrival(i, v, from, to, answer.contacts.size());
  if (options.search == DSW_SEARCH_EXACT && answer.contacts.size() == 1) {
    check_contact(i, answer.contacts[0], count == 1 ? partners[0] : dsw_contact_partner{});
  }
  scene_.read(i);
  EXPECT_EQ(scene_.too_near(i), "");
}

/// Where there is room on the whole way, nothing stops a vertex.
inline void ThickChecks::check_arrival(size_t i, uint32_t vertex, const Vec& from, const Vec& to,
                                       size_t contact_count) {
  const ThickBody& body = scene_.bodies[i];
  if (body.radius == 0 || body.self) return;
  for (size_t k = 0; k < 3; ++k) {
    if (std::fabs(to[k] - from[k]) > ground_.size) return;  // that leads out of it
  }
  if (!scene_.too_near_on_way(i, vertex, from, to, more_by(40)).empty()) return;
  // Rounding could be seen here.
  if (body.radius < std::max(0x1p-8 * slack(), 0x1p-1000)) return;
  ++arrivals;
  BodyState after;
  ASSERT_EQ(read_body(scene_.handle(), body.id, after), "");
  EXPECT_EQ(after.at[vertex], to) << "the way is free";
  EXPECT_EQ(contact_count, 0u);
}

inline std::vector<Hull> ThickChecks::hulls_of(const dsw_cell& cell) const {
  Hull corners;
  for (const dsw_vertex_id v : vertices_of(scene_.environment(), cell)) {
    Vec at{};
    EXPECT_EQ(dsw_environment_get_vertex_position(scene_.environment(), v, at.data()), DSW_STATUS_OK);
    corners.push_back(at);
  }
  if (corners.size() <= 3) return {corners};
  return scene_.obstacles_among(corners);
}

/// The obstacle that is named is the one that is touched, and the normal points from there.
inline void ThickChecks::check_obstacle(const dsw_body_contact& c, const Hull& part, double radius, double slack) {
  Apart nearest;
  const std::vector<Hull> named_hulls = hulls_of(c.contact.obstacle);
  ASSERT_FALSE(named_hulls.empty());
  std::string named_text = "the obstacle spans";
  for (const Hull& hull : named_hulls) {
    for (const Vec& p : hull) named_text += " " + hex(p);
    const Apart each = apart(part, hull);
    if (each.high < nearest.high) nearest = each;
  }
  SCOPED_TRACE(named_text);
  EXPECT_LE(nearest.low, radius * (1 + 1e-6) + slack) << "the obstacle is too far away";
  EXPECT_GE(nearest.high, radius * (1 - 1e-6) - slack) << "the contact is too late";
  if (c.contact.wall.generation == 0) {
    check_normal(c, nearest, radius, slack);
    EXPECT_NE(c.contact.obstacle.kind, DSW_CELL_FACE);
    EXPECT_TRUE(scene_.is_of_marked(named_hulls[0])) << "neither a wall nor a marked edge or vertex";
    return;
  }
  int impassable = 0;
  EXPECT_EQ(dsw_environment_is_impassable(scene_.environment(), cell_of(c.contact.wall), &impassable), DSW_STATUS_OK);
  EXPECT_EQ(impassable, 1);
  Apart wall;
  for (const Hull& hull : hulls_of(cell_of(c.contact.wall))) {
    const Apart each = apart(part, hull);
    if (each.high < wall.high) wall = each;
  }
  EXPECT_LE(wall.low, radius * (1 + 1e-6) + slack) << "the wall is too far away";
  check_normal(c, wall, radius, slack);
}

/// The normal is the way from the nearest point, as far as doubles know that.
inline void ThickChecks::check_normal(const dsw_body_contact& c, const Apart& nearest, double radius, double slack) {
  if (!(slack < 1e-3 * radius)) return;
  double off = 0;
  for (size_t k = 0; k < 3; ++k) off = std::max(off, std::fabs(c.contact.normal[k] - nearest.way[k]));
  const double doubt = std::sqrt(2 * std::max(0.0, nearest.high - nearest.low) / nearest.high);
  EXPECT_LE(off, 1e-6 + 4 * slack / radius + doubt)
      << "normal " << hex(c.contact.normal) << " for " << hex(nearest.way);
}

/// It is the first touch: there is room on the way to it, and none a little farther.
inline void ThickChecks::check_contact(size_t i, const dsw_body_contact& c, const dsw_contact_partner& partner) {
  const ThickBody& body = scene_.bodies[i];
  const bool at_body = partner.body.generation != 0;
  if (body.radius == 0 && !at_body) return;
  const uint32_t v = c.vertex.index;
  const Vec from = {c.from[0], c.from[1], c.from[2]}, to = {c.to[0], c.to[1], c.to[2]};
  const Vec at = {c.position[0], c.position[1], c.position[2]};
  double length = 0;
  for (const double x : c.contact.normal) length += x * x;
  EXPECT_NEAR(length, 1, 1e-12);
  double other = 0;
  size_t touched = scene_.bodies.size();
  for (size_t j = 0; j < scene_.bodies.size() && at_body; ++j) {
    if (same_id(scene_.bodies[j].id, partner.body)) touched = j, other = scene_.bodies[j].radius;
  }
  const double radius = body.radius + other;
  const double rounding = slack();
  if (radius < 0x1p-1000 || touched == i) return;  // its own parts may be joined, and touch without a radius
  // What touches at the start may be what stops it, at any time.
  const mpq_class touching = mpq_class(1 + 1e-8) + 4 * mpq_class(rounding) / mpq_class(radius);
  if (!scene_.too_near_on_way(i, v, from, from, touching).empty()) return;
  const Vec later = between(from, to, std::min(1.0, c.time + std::max(1e-6, 1e-6 * c.time)));
  if (radius > rounding && finite(later)) {
    const mpq_class share =
        mpq_class(1 + 1e-9) + 4 * mpq_class(rounding) / mpq_class(body.radius > 0 ? body.radius : radius);
    EXPECT_NE(scene_.too_near_on_way(i, v, from, later, share), "") << "nothing is touched at " << c.time;
  }
  // The part that touches, at that time.
  Hull part = {at};
  if (c.edge.generation != 0 || c.face.generation != 0) part.push_back({c.fixed[0][0], c.fixed[0][1], c.fixed[0][2]});
  if (c.face.generation != 0) part.push_back({c.fixed[1][0], c.fixed[1][1], c.fixed[1][2]});
  const double far = std::max({std::fabs(to[0]), std::fabs(to[1]), std::fabs(to[2])});
  if (far > 100 * (ground_.largest + ground_.size)) return;  // the time is rough
  ++named;
  std::string spans = "the part spans";
  for (const Vec& p : part) spans += " " + hex(p);
  SCOPED_TRACE(spans + " at " + number(c.time));
  if (!at_body) return check_obstacle(c, part, radius, rounding);
  ASSERT_LT(touched, scene_.bodies.size());
  const BodyState& s = scene_.bodies[touched].state;
  const auto index = [](const auto& ids, auto id) {
    return static_cast<size_t>(std::find_if(ids.begin(), ids.end(), [&](auto x) { return same_id(x, id); }) -
                               ids.begin());
  };
  Hull still;
  if (partner.face.generation != 0) {
    for (const uint32_t u : s.faces[index(s.face_ids, partner.face)]) still.push_back(s.at[u]);
  } else if (partner.edge.generation != 0) {
    for (const uint32_t u : s.edges[index(s.edge_ids, partner.edge)]) still.push_back(s.at[u]);
  } else {
    still.push_back(s.at[partner.vertex.index]);
  }
  const Apart nearest = apart(part, still);
  std::string still_spans = "the other body's part spans";
  for (const Vec& p : still) still_spans += " " + hex(p);
  SCOPED_TRACE(still_spans);
  EXPECT_LE(nearest.low, radius * (1 + 1e-6) + rounding) << "the other body is too far away";
  EXPECT_GE(nearest.high, radius * (1 - 1e-6) - rounding) << "the contact is too late";
  if (rounding < 1e-3 * radius) {
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(c.contact.normal[k], nearest.way[k], 1e-6 + 4 * rounding / radius) << "normal";
    }
  }
}

inline void ThickChecks::move_all(size_t i) {
  const BodyState before = scene_.bodies[i].state;
  std::vector<Vec> targets = before.at;
  const bool together = rng_.chance(0.6);
  const uint32_t leader = rng_.below(before.at.size());
  const Vec to = target(i, leader);
  for (uint32_t v = 0; v < targets.size(); ++v) {
    for (size_t k = 0; k < 3 && together; ++k) targets[v][k] += to[k] - before.at[leader][k];
    if (!together && before.vertices[v].generation != 0) targets[v] = target(i, v);
    if (!finite(targets[v])) targets[v] = before.at[v];
  }
  dsw_move_options options = any_options();
  order_.clear();
  for (uint32_t v = 0; v < targets.size(); ++v) {
    if (before.vertices[v].generation != 0) order_.push_back(v);
  }
  for (size_t k = order_.size(); k > 1; --k) std::swap(order_[k - 1], order_[rng_.below(k)]);
  if (rng_.chance(0.5)) options.order = order_.data(), options.order_count = order_.size();
  BodyAnswer answer;
  ASSERT_EQ(move_body(scene_.handle(), scene_.bodies[i].id, targets, &options, answer), "");
  moves += order_.size();
  contacts += answer.contacts.size();
  scene_.follow_edits(i);
  scene_.read(i);
  EXPECT_EQ(scene_.too_near(i), "") << "responses " << options.vertex_response << " " << options.edge_response
                                    << " search " << options.search << " flags " << options.flags << " passes "
                                    << options.passes << " stand-off " << options.stand_off;
}

inline int ThickChecks::verdict(size_t i, double radius) const {
  ThickScene& scene = scene_;
  const double before = std::exchange(scene.bodies[i].radius, radius);
  int said = 1;
  for (const ThickPart& part : scene.parts_of(scene.bodies[i])) {
    for (const bool all_own : {false, true}) {
      scene.for_each_foe(i, part, 1, all_own, [&](const mpq_class& keep, const Hull& foe, int) {
        if (said < 0) return;
        if (!all_own && is_nearer(part.hull, foe, Limit(keep, kCounts))) {
          said = -1;
        } else if (is_nearer(part.hull, foe, Limit(keep + mpq_class(slack())))) {
          said = 0;
        }
      });
    }
  }
  scene.bodies[i].radius = before;
  return said;
}

/// Edges are named if they are too near, or belong to a face that is.
inline void ThickChecks::check_offending(size_t i, double radius) {
  const uint32_t* pairs = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_offending_edges(scene_.handle(), &pairs, &count), DSW_STATUS_OK);
  EXPECT_GT(count, 0u);
  std::set<std::vector<uint32_t>> named_ones, certain, possible;
  for (size_t k = 0; k < count; ++k) {
    std::vector<uint32_t> ends = {std::min(pairs[2 * k], pairs[2 * k + 1]), std::max(pairs[2 * k], pairs[2 * k + 1])};
    if (ends[0] == ends[1]) ends.pop_back();
    named_ones.insert(ends);
  }
  ThickBody& body = scene_.bodies[i];
  const double before = std::exchange(body.radius, radius);
  bool at_wall = false;
  for (const bool only_walls : {true, false}) {
    for (ThickPart part : scene_.parts_of(body)) {
      bool is_certain = false, is_possible = false;
      scene_.for_each_foe(i, part, 1, true, [&](const mpq_class& keep, const Hull& foe, int other) {
        if (only_walls != (other < 0) || is_certain) return;
        is_certain = other != static_cast<int>(i) && is_nearer(part.hull, foe, Limit(keep, kCounts));
        is_possible = is_possible || is_certain || is_nearer(part.hull, foe, Limit(keep + mpq_class(slack())));
      });
      std::sort(part.vertices.begin(), part.vertices.end());
      // What is too near to a wall may be all that is looked at.
      if (is_certain && part.vertices.size() == 2 && (only_walls || !at_wall)) certain.insert(part.vertices);
      at_wall = at_wall || (only_walls && is_certain);
      if (!is_possible) continue;
      possible.insert(part.vertices);
      for (size_t k = 0; k < part.vertices.size(); ++k) {
        possible.insert({part.vertices[k]});
        std::vector<uint32_t> side = part.vertices;
        if (side.size() == 3) side.erase(side.begin() + static_cast<std::ptrdiff_t>(k)), possible.insert(side);
      }
    }
  }
  body.radius = before;
  // A face that is too near may be named by one of its edges.
  const auto is_named = [&](const std::vector<uint32_t>& edge) {
    if (named_ones.count(edge) != 0) return true;
    const auto& faces = body.state.faces;
    return body.level == DSW_LEVEL_FACES && std::any_of(faces.begin(), faces.end(), [&](std::array<uint32_t, 3> f) {
             std::sort(f.begin(), f.end());
             return std::includes(f.begin(), f.end(), edge.begin(), edge.end()) &&
                    std::any_of(named_ones.begin(), named_ones.end(), [&](const auto& other) {
                      return std::includes(f.begin(), f.end(), other.begin(), other.end());
                    });
           });
  };
  for (const auto& each : certain) {
    EXPECT_TRUE(is_named(each)) << "edge " << each[0] << "-" << each.back() << " is too near";
  }
  for (const auto& each : named_ones) {
    const bool is_edge_at_vertex = body.level == DSW_LEVEL_POINTS && each.size() == 2 &&
                                   (possible.count({each[0]}) != 0 || possible.count({each[1]}) != 0);
    EXPECT_TRUE(possible.count(each) != 0 || is_edge_at_vertex)
        << "edge " << each[0] << "-" << each.back() << " is not too near";
  }
}

inline void ThickChecks::try_radii(size_t i) {
  const double before = scene_.bodies[i].radius;
  ASSERT_EQ(scene_.set_radius(i, 0), DSW_STATUS_OK);
  const double room = scene_.room(i, 1e3 * ground_.size);
  const std::vector<Vec> at = scene_.bodies[i].state.at;
  for (int k = 0; k < 6; ++k) {
    const double off = rng_.chance(0.5) ? std::ldexp(rng_.range(-8, 8), -33) : rng_.range(-0.5, 0.5);
    const double radius = room * (1 + off);
    if (!(radius > 0) || !std::isfinite(radius)) continue;
    const int said = verdict(i, radius);
    const double kept = scene_.bodies[i].radius;
    const dsw_status status = scene_.set_radius(i, radius);
    SCOPED_TRACE("radius " + number(radius) + " of " + number(room) + " level " +
                 std::to_string(scene_.bodies[i].level));
    if (said != 0 && radius >= 0x1p-1000) {
      EXPECT_EQ(status, said < 0 ? DSW_STATUS_OCCUPIED : DSW_STATUS_OK) << scene_.too_near(i);
    }
    double now = -1;
    EXPECT_EQ(dsw_body_get_radius(scene_.handle(), scene_.bodies[i].id, &now), DSW_STATUS_OK);
    if (status == DSW_STATUS_OK) {
      ++accepted;
      EXPECT_EQ(now, radius);
      check_gap(i);
    } else {
      ++refused;
      EXPECT_EQ(now, kept);
      if (said < 0) check_offending(i, radius);
    }
    scene_.read(i);
    EXPECT_EQ(scene_.bodies[i].state.at, at);
  }
  if (scene_.set_radius(i, before) != DSW_STATUS_OK) {
    EXPECT_LE(verdict(i, before), 0) << "it has had this radius " << number(before);
  }
}

inline void ThickChecks::try_creation(size_t i, const BodyPlan& plan) {
  const ThickBody body = scene_.bodies[i];
  ASSERT_EQ(scene_.set_radius(i, 0), DSW_STATUS_OK);
  const double room = scene_.room(i, 1e3 * ground_.size);
  const double radius = room * (1 + std::ldexp(rng_.range(-8, 8), -33));
  if (!(radius > 0) || !std::isfinite(radius)) return;
  const int said = verdict(i, radius);
  scene_.destroy(i);
  const uint32_t flags = body.self ? DSW_BODY_SELF_CONTACTS : 0;
  const dsw_status status = scene_.create(plan, body.level, radius, flags);
  if (said != 0) {
    EXPECT_EQ(status, said < 0 ? DSW_STATUS_OCCUPIED : DSW_STATUS_OK);
  }
  if (status != DSW_STATUS_OK) {
    ASSERT_EQ(scene_.create(plan, body.level, 0.9 * room, flags), DSW_STATUS_OK);
  }
  (status == DSW_STATUS_OK ? accepted : refused) += 1;
}

/// The bound holds, and is close to what is exact.
inline void ThickChecks::check_gap(size_t i) {
  const ThickBody& body = scene_.bodies[i];
  if (body.radius == 0) return;
  const double limit = rng_.chance(0.2) ? 0 : body.radius * std::pow(10, rng_.range(-3, 1));
  double gap = HUGE_VAL;
  ASSERT_EQ(dsw_body_find_least_gap(scene_.handle(), body.id, limit, &gap), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_LE(gap, limit);
  mpf_class exact(0, 256);
  const bool is_near = scene_.find_gap(i, 2 + limit / body.radius, exact) && exact < limit;
  const mpf_class expected = is_near ? exact : mpf_class(limit, 256);
  const double tolerance = 1e-9 * body.radius + 1e-12 * std::max(ground_.size, ground_.largest);
  EXPECT_LE(gap, expected) << "of radius " << number(body.radius);
  if (body.self) return;  // own parts that need not keep apart may count as well
  EXPECT_GE(gap, expected - tolerance) << "of radius " << number(body.radius);
}

}  // namespace dsw::oracle
