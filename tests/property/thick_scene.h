// Thick bodies in a scene, and what must be true of them (dartsweep/body.h): every part against every obstacle, by brute
// force and in exact arithmetic.
#pragma once

#include "body_state.h"
#include "names.h"
#include "support.h"
#include "thick_truth.h"

#include <functional>
#include <map>
#include <set>
#include <string>

namespace dsw::oracle {

/// What counts as kept, as a share of the distance to be kept (dartsweep/body.h), and what the tests ask for.
inline const mpq_class kCounts = less_by(31), kKept = less_by(30);

struct ThickBody {
  dsw_body_id id{0, 0};
  dsw_level level = DSW_LEVEL_EDGES;
  bool self = false, rigid = false;
  double radius = 0;
  BodyState state;
  std::map<std::pair<uint32_t, uint32_t>, double> lengths;  // of edges, by id, when the radius was set
};

/// A vertex, edge or face.
struct ThickPart {
  std::vector<uint32_t> vertices;  // the moving one first, if there is one
  Hull hull;
};

class ThickScene {
 public:
  /// `meets`: bodies meet bodies there.
  ThickScene(dsw_scene* scene, bool meets) : scene_(scene), meets_(meets) { read_obstacles(); }

  dsw_scene* handle() const { return scene_; }
  dsw_environment* environment() const { return dsw_scene_get_environment(scene_); }
  size_t obstacle_count() const { return obstacles_.size(); }
  /// The places of the vertices of the environment.
  const std::vector<Vec>& points() const { return points_; }
  std::vector<ThickBody> bodies;
  /// Whether a part of a body has to keep away from an obstacle; none: from all.
  std::function<bool(size_t body, const ThickPart&, const Hull& obstacle)> counts;

  /// Again, after a change of the environment.
  void read_obstacles() {
    obstacles_.clear();
    std::map<Vec, size_t> vertices;  // by their places
    read_points();
    for (size_t v = 0; v < points_.size(); ++v) vertices[points_[v]] = v;
    dsw_trace* trace = nullptr;
    dsw_trace_data data{};
    data.struct_size = sizeof data;
    EXPECT_EQ(dsw_trace_create(nullptr, &trace), DSW_STATUS_OK);
    EXPECT_EQ(dsw_trace_add_impassable(trace, environment(), 1, 0), DSW_STATUS_OK);
    EXPECT_EQ(dsw_trace_get_data(trace, &data), DSW_STATUS_OK);
    std::set<std::vector<uint32_t>> all;  // a wall has two sides
    const auto add = [&](const uint32_t* indices, size_t count, size_t corners) {
      for (size_t i = 0; i < count; ++i) {
        std::vector<uint32_t> simplex(indices + corners * i, indices + corners * (i + 1));
        std::sort(simplex.begin(), simplex.end());
        all.insert(simplex);
      }
    };
    add(data.triangles, data.triangle_count, 3);
    add(data.segments, data.segment_count, 2);
    add(data.vertices, data.vertex_count, 1);
    for (const auto& simplex : all) {
      std::vector<size_t> corners;
      Hull hull;
      for (const size_t p : simplex) {
        hull.push_back({data.points[3 * p], data.points[3 * p + 1], data.points[3 * p + 2]});
        EXPECT_EQ(vertices.count(hull.back()), 1u);
        corners.push_back(vertices[hull.back()]);
      }
      std::sort(corners.begin(), corners.end());
      obstacles_.push_back({corners, hull, HullBox(hull)});
    }
    dsw_trace_destroy(trace);
  }

  /// Puts each obstacle between its places in two scenes, a part of the way from one to the other. Walls come and go where volumes
  /// become invalid or valid: those of both scenes count all the time, as nothing is near such a volume on its way.
  void place_obstacles(const ThickScene& before, const ThickScene& after, double part) {
    obstacles_.clear();
    std::set<std::vector<size_t>> all;
    for (const ThickScene* scene : {&before, &after}) {
      for (const Obstacle& each : scene->obstacles_) all.insert(each.corners);
    }
    for (const std::vector<size_t>& corners : all) {
      Hull hull;
      for (const size_t v : corners) hull.push_back(between(before.points_[v], after.points_[v], part));
      obstacles_.push_back({corners, hull, HullBox(hull)});
    }
  }
  static Vec between(const Vec& from, const Vec& to, double part) {
    Vec at = from;
    for (size_t k = 0; k < 3; ++k) at[k] += part * (to[k] - from[k]);
    return at;
  }

  /// The obstacles that have all their corners among these points.
  std::vector<Hull> obstacles_among(const Hull& points) const {
    std::vector<Hull> found;
    for (const Obstacle& each : obstacles_) {
      const auto is_among = [&](const Vec& p) { return std::find(points.begin(), points.end(), p) != points.end(); };
      if (std::all_of(each.hull.begin(), each.hull.end(), is_among)) found.push_back(each.hull);
    }
    return found;
  }

  /// Whether these points are corners of a marked edge or vertex, in the plane also of a wall.
  bool is_of_marked(const Hull& points) const {
    return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& each) {
      return each.hull.size() <= 2 && std::all_of(points.begin(), points.end(), [&](const Vec& p) {
               return std::find(each.hull.begin(), each.hull.end(), p) != each.hull.end();
             });
    });
  }

  /// Creates a body and follows it. @return what the library answers.
  dsw_status create(const BodyPlan& plan, dsw_level level, double radius, uint32_t flags = 0) {
    ThickBody body;
    body.level = level;
    body.self = (flags & DSW_BODY_SELF_CONTACTS) != 0;
    body.rigid = (flags & DSW_BODY_RIGID) != 0;
    body.radius = radius;
    const dsw_status status = create_body(scene_, plan, level, flags, {}, &body.id, radius);
    if (status != DSW_STATUS_OK) return status;
    bodies.push_back(body);
    read(bodies.size() - 1);
    measure(bodies.back());
    return status;
  }
  /// Follows a body that is there already.
  void adopt(dsw_body_id id) {
    ThickBody body;
    body.id = id;
    EXPECT_EQ(dsw_body_get_level(scene_, id, &body.level), DSW_STATUS_OK);
    EXPECT_EQ(dsw_body_get_radius(scene_, id, &body.radius), DSW_STATUS_OK);
    bodies.push_back(body);
    read(bodies.size() - 1);
    measure(bodies.back());
  }
  /// Sets a radius, and measures the edges if that is allowed.
  dsw_status set_radius(size_t i, double radius) {
    const dsw_status status = dsw_body_set_radius(scene_, bodies[i].id, radius);
    if (status != DSW_STATUS_OK) return status;
    bodies[i].radius = radius;
    measure(bodies[i]);
    return status;
  }
  void destroy(size_t i) {
    EXPECT_EQ(dsw_body_destroy(scene_, bodies[i].id), DSW_STATUS_OK);
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
  }
  /// Reads a body after a call.
  void read(size_t i) {
    ThickBody& body = bodies[i];
    EXPECT_EQ(read_body(scene_, body.id, body.state), "");
    double radius = -1;
    EXPECT_EQ(dsw_body_get_radius(scene_, body.id, &radius), DSW_STATUS_OK);
    EXPECT_EQ(radius, body.radius);
  }
  /// Parts of an edge that was split have their shares of its length. Of a merge nothing is said: ways over it may count
  /// as short.
  void follow(size_t i, const dsw_body_edit& edit) {
    auto& lengths = bodies[i].lengths;
    const auto length = lengths.find(key(edit.edge));
    if (length == lengths.end()) return;
    if (edit.inserted == 0) {
      lengths.clear();
      return;
    }
    lengths[key(edit.rest)] = (1 - edit.edge_parameter) * length->second;
    length->second *= edit.edge_parameter;
  }
  void follow_edits(size_t i) {
    const dsw_body_edit* edits = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_edits(scene_, bodies[i].id, &edits, &count), DSW_STATUS_OK);
    for (size_t k = 0; k < count; ++k) follow(i, edits[k]);
  }
  void read_all() {
    for (size_t i = 0; i < bodies.size(); ++i) read(i);
  }

  /// What is nearer to a body than it may be, as it is now. Empty: nothing.
  std::string too_near(size_t i) const {
    for (const ThickPart& part : parts_of(bodies[i])) {
      const std::string found = nearer_than(i, part, kKept);
      if (!found.empty()) return found;
    }
    return "";
  }
  std::string too_near() const {
    for (size_t i = 0; i < bodies.size(); ++i) {
      const std::string found = too_near(i);
      if (!found.empty()) return "body " + name(bodies[i].id) + ": " + found;
    }
    return "";
  }
  /// Whether anything is so near to a body that rounding decides whether it may be there.
  bool is_tight(size_t i) const {
    const std::vector<ThickPart> parts = parts_of(bodies[i]);
    return std::any_of(parts.begin(), parts.end(),
                       [&](const ThickPart& part) { return !nearer_than(i, part, more_by(30)).empty(); });
  }
  /// What comes nearer than `share` of what is to be kept to any part of a vertex, while it alone moves.
  std::string too_near_on_way(size_t i, uint32_t vertex, const Vec& from, const Vec& to, const mpq_class& share) const {
    for (ThickPart part : parts_at(bodies[i], vertex)) {
      part.hull[0] = from;
      if (to != from) part.hull.push_back(to);
      const std::string found = nearer_than(i, part, share);
      if (!found.empty()) return found;
    }
    return "";
  }

  /// Calls visit(distance to keep, hull, body) for all that a part must keep away from and that is not farther than
  /// `reach` times that, in a rough sense. The body is -1 for an obstacle. Of the same body, parts of larger parts that
  /// the level covers only count if `all_own`: a larger part may be joined to what its corner alone is not joined to.
  template <class Visit>
  void for_each_foe(size_t i, const ThickPart& part, double reach, bool all_own, Visit visit) const {
    const HullBox box(part.hull);
    const ThickBody& body = bodies[i];
    if (body.radius > 0) {
      const mpq_class keep(body.radius);
      for (const Obstacle& each : obstacles_) {
        if (!each.box.is_beyond(box, reach * body.radius)) visit(keep, each.hull, -1);
      }
    }
    for (size_t j = 0; j < bodies.size(); ++j) {
      const ThickBody& other = bodies[j];
      if (!meets_ || (i == j && !body.self) || body.radius + other.radius == 0) continue;
      const mpq_class keep = mpq_class(body.radius) + mpq_class(other.radius);
      for (const ThickPart& still : parts_of(other)) {
        if (HullBox(still.hull).is_beyond(box, reach * (body.radius + other.radius))) continue;
        if (i == j &&
            (are_joined(body, part, still) || !(all_own || (is_whole(body, part) && is_whole(body, still))))) {
          continue;
        }
        visit(keep, still.hull, static_cast<int>(j));
      }
    }
  }

  /// Whether no larger part that the level covers has this one.
  static bool is_whole(const ThickBody& body, const ThickPart& part) {
    const auto covers = [&](const auto& larger) {
      return larger.size() > part.vertices.size() &&
             std::all_of(part.vertices.begin(), part.vertices.end(),
                         [&](uint32_t v) { return std::find(larger.begin(), larger.end(), v) != larger.end(); });
    };
    const BodyState& s = body.state;
    if (body.level >= DSW_LEVEL_EDGES && std::any_of(s.edges.begin(), s.edges.end(), covers)) return false;
    return body.level != DSW_LEVEL_FACES || std::none_of(s.faces.begin(), s.faces.end(), covers);
  }

  std::vector<ThickPart> parts_of(const ThickBody& body) const {
    std::vector<ThickPart> parts;
    const BodyState& s = body.state;
    const auto add = [&](std::initializer_list<uint32_t> vertices) {
      ThickPart part{vertices, {}};
      for (const uint32_t v : vertices) part.hull.push_back(s.at[v]);
      parts.push_back(part);
    };
    for (uint32_t v = 0; v < s.at.size(); ++v) {
      if (s.vertices[v].generation != 0) add({v});
    }
    for (const auto& e : s.edges) {
      if (body.level >= DSW_LEVEL_EDGES) add({e[0], e[1]});
    }
    for (const auto& f : s.faces) {
      if (body.level == DSW_LEVEL_FACES) add({f[0], f[1], f[2]});
    }
    return parts;
  }
  std::vector<ThickPart> parts_at(const ThickBody& body, uint32_t vertex) const {
    std::vector<ThickPart> parts;
    for (ThickPart part : parts_of(body)) {
      const auto at = std::find(part.vertices.begin(), part.vertices.end(), vertex) - part.vertices.begin();
      if (at == static_cast<std::ptrdiff_t>(part.vertices.size())) continue;
      std::swap(part.vertices[0], part.vertices[static_cast<size_t>(at)]);
      std::swap(part.hull[0], part.hull[static_cast<size_t>(at)]);
      parts.push_back(part);
    }
    return parts;
  }

  /// The least gap of a body, exactly but for the last of 256 bits. What is farther than `reach` lengths to be kept is
  /// not looked at; false: there is nothing.
  bool find_gap(size_t i, double reach, mpf_class& gap) const {
    struct Pair {
      mpq_class keep;
      Hull a, b;
      double low;
    };
    std::vector<Pair> pairs;
    double least = HUGE_VAL;
    for (const ThickPart& part : parts_of(bodies[i])) {
      for_each_foe(i, part, reach, false, [&](const mpq_class& keep, const Hull& foe, int) {
        const Apart about = apart(part.hull, foe);
        const double length = keep.get_d(), slack = 0x1p-50 * (about.high + length);
        pairs.push_back({keep, part.hull, foe, about.low - length - slack});
        least = std::min(least, about.high - length + slack);
      });
    }
    bool is_found = false;
    for (const Pair& pair : pairs) {
      if (pair.low > least) continue;
      const mpf_class each = root(square_of_distance(pair.a, pair.b)) - mpf_class(pair.keep, 256);
      if (!is_found || each < gap) gap = each;
      is_found = true;
    }
    return is_found;
  }

  /// The largest share of a distance that is missing between a body and anything, exactly but for the last of 256 bits.
  double missing(size_t i) const {
    double most = 0;
    for (const ThickPart& part : parts_of(bodies[i])) {
      for_each_foe(i, part, 1, false, [&](const mpq_class& keep, const Hull& foe, int) {
        if (apart(part.hull, foe).low >= keep) return;
        const mpf_class share = root(square_of_distance(part.hull, foe)) / mpf_class(keep, 256);
        most = std::max(most, mpf_class(1 - share).get_d());
      });
    }
    return most;
  }

  /// A radius for which there is room round a body that has none, up to `most` and to rounding. `lost`: how much less
  /// there is, as a share of the size of two parts; then distances are exact but for the last of 256 bits.
  double room(size_t i, double most, double lost = 0) const {
    double least = most;
    const auto room_between = [&](const Hull& a, const Hull& b) {
      if (lost == 0) return apart(a, b).low;
      const mpf_class less = mpf_class(lost, 256) * size_of(a, b);
      return mpf_class(root(square_of_distance(a, b)) - less).get_d();
    };
    const ThickBody& body = bodies[i];
    for (const ThickPart& part : parts_of(body)) {
      const HullBox box(part.hull);
      for (const Obstacle& each : obstacles_) {
        if (lost > 0 || !each.box.is_beyond(box, least)) least = std::min(least, room_between(part.hull, each.hull));
      }
      for (size_t j = 0; meets_ && j < bodies.size(); ++j) {
        if (i == j && !body.self) continue;
        const double other = i == j ? 0 : bodies[j].radius;
        for (const ThickPart& still : parts_of(bodies[j])) {
          if (i == j && are_joined(body, part, still)) continue;
          least = std::min(least, (room_between(part.hull, still.hull) - other) / (i == j ? 2 : 1));
        }
      }
    }
    return least;
  }

  /// Whether two parts of one body need not keep apart: a way along its edges joins them that is at most four radii
  /// long, up to rounding. An edge of unknown length has none.
  bool are_joined(const ThickBody& body, const ThickPart& a, const ThickPart& b) const {
    const double limit = 4 * body.radius * (1 + 1e-9);
    std::map<uint32_t, double> reached;
    for (const uint32_t v : a.vertices) reached[v] = 0;
    for (size_t round = 0; round < body.state.at.size(); ++round) {
      bool changed = false;
      for (size_t e = 0; e < body.state.edges.size(); ++e) {
        for (size_t k = 0; k < 2; ++k) {
          const uint32_t from = body.state.edges[e][k], to = body.state.edges[e][1 - k];
          if (reached.count(from) == 0) continue;
          const auto known = body.lengths.find(key(body.state.edge_ids[e]));
          const double length = reached[from] + (known == body.lengths.end() ? 0 : known->second);
          if (length > limit || (reached.count(to) != 0 && reached[to] <= length)) continue;
          reached[to] = length;
          changed = true;
        }
      }
      if (!changed) break;
    }
    return std::any_of(b.vertices.begin(), b.vertices.end(), [&](uint32_t v) { return reached.count(v) != 0; });
  }
  static void measure(ThickBody& body) {
    body.lengths.clear();
    const BodyState& s = body.state;
    for (size_t e = 0; e < s.edges.size(); ++e) {
      const Vec &p = s.at[s.edges[e][0]], &q = s.at[s.edges[e][1]];
      body.lengths[key(s.edge_ids[e])] = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }
  }

 private:
  struct Obstacle {
    std::vector<size_t> corners;  // the numbers of its vertices
    Hull hull;
    HullBox box;
  };

  void read_points() {
    const double* points = nullptr;
    size_t count = 0;
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    ASSERT_EQ(dsw_environment_get_info(environment(), &info), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_get_points(environment(), &points, &count), DSW_STATUS_OK);
    points_.assign(count, Vec{});
    for (size_t v = 0; v < count; ++v) std::copy_n(points + info.dimension * v, info.dimension, points_[v].begin());
  }

  /// The largest difference of coordinates.
  static double size_of(const Hull& a, const Hull& b) {
    double size = 0;
    for (const Hull* each : {&a, &b}) {
      for (const Vec& p : *each) {
        for (size_t k = 0; k < 3; ++k) size = std::max(size, std::fabs(p[k] - b[0][k]));
      }
    }
    return size;
  }
  static std::pair<uint32_t, uint32_t> key(dsw_body_edge_id id) { return {id.index, id.generation}; }

  std::string nearer_than(size_t i, const ThickPart& part, const mpq_class& share) const {
    std::string text;
    mpq_class kept;
    std::unique_ptr<Limit> limit;
    const double reach = std::max(1.0, 1.001 * share.get_d());  // boxes leave out nothing that a share above 1 lets in
    for_each_foe(i, part, reach, false, [&](const mpq_class& keep, const Hull& foe, int other) {
      if (!text.empty()) return;
      if (limit == nullptr || kept != keep) {
        limit = std::make_unique<Limit>(keep, share);
        kept = keep;
      }
      if (!is_nearer(part.hull, foe, *limit)) return;
      if (other < 0 && counts && !counts(i, part, foe)) return;
      const double share_missing =
          mpf_class(1 - root(square_of_distance(part.hull, foe)) / mpf_class(keep, 256)).get_d();
      text = "a part of " + std::to_string(part.vertices.size()) + " vertices with " +
             std::to_string(part.vertices[0]) + " is too near by " + number(share_missing) + " of " +
             number(keep.get_d()) + " to " +
             (other < 0 ? "an obstacle" : "body " + name(bodies[static_cast<size_t>(other)].id)) + " of";
      for (const Vec& p : foe) text += " " + hex(p);
      text += "; it spans";
      for (const Vec& p : part.hull) text += " " + hex(p);
    });
    return text;
  }

  dsw_scene* scene_;
  bool meets_;
  std::vector<Obstacle> obstacles_;
  std::vector<Vec> points_;
};

}  // namespace dsw::oracle
