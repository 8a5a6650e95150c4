// What a thick body can come to in an environment that has folded. Volumes that are turned over lie over others, so their faces poke into
// volumes that have no passable way to them. A distance is kept from what is seen through passable faces alone (src/proximity/README.md).
// All is decided in rational numbers.
#pragma once

#include "thick_scene.h"

namespace dsw::oracle {

class ThickReach {
 public:
  /// While all volumes are valid.
  ThickReach(dsw_environment* environment, const std::vector<Vec>& points) : environment_(environment) {
    std::map<Vec, size_t> vertices;
    for (size_t v = 0; v < points.size(); ++v) vertices[points[v]] = v;
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
    for (uint32_t i = 0; i < info.volume_count; ++i) {
      Volume& volume = volumes_.emplace_back();
      EXPECT_EQ(dsw_environment_get_volume_id(environment, i, &volume.id), DSW_STATUS_OK);
      numbers_[volume.id.index] = i;
    }
    for (Volume& volume : volumes_) add_triangles(volume, vertices);
    read();
  }

  /// Before a call.
  void start() {
    for (Volume& volume : volumes_) volume.was_valid = volume.is_valid;
  }
  /// After it.
  void read() {
    for (Volume& volume : volumes_) {
      EXPECT_EQ(dsw_environment_is_valid(environment_, volume.id, &volume.is_valid), DSW_STATUS_OK);
    }
  }

  /// Whether a volume is invalid before or after. Else nothing that is hidden is nearer than what hides it.
  bool has_folded() const {
    return std::any_of(volumes_.begin(), volumes_.end(),
                       [](const Volume& each) { return each.was_valid == 0 || each.is_valid == 0; });
  }

  /// Whether a part of a body that goes from one scene to the other sees an obstacle, both as they are when a share of the way is made: the
  /// straight way between their nearest points passes no wall. A volume is passable if it is valid before or after.
  bool sees(const ThickScene& before, const ThickScene& after, double share, size_t body, const ThickPart& part,
            const Hull& obstacle) const {
    const Points points = points_at(before, after, share);
    const std::vector<Point> own = all_exact(part.hull), other = all_exact(obstacle);
    const Nearest<mpq_class> nearest(own, other);
    const std::set<size_t> start = follow(before, after, share, body, part.vertices[0]);
    EXPECT_FALSE(start.empty()) << "a vertex is nowhere";
    const std::set<size_t> at_end =
        reached_on(reached_on(start, own[0], nearest.on_a, points), nearest.on_a, nearest.on_b, points);
    return std::any_of(at_end.begin(), at_end.end(), [&](size_t i) {
      return std::all_of(other.begin(), other.end(), [&](const Point& p) { return volumes_[i].has_corner(points, p); });
    });
  }

 private:
  using Point = Nearest<mpq_class>::Point;
  using Points = std::vector<Point>;  // of the environment
  static constexpr size_t kNothing = SIZE_MAX;
  struct Triangle {
    std::array<size_t, 3> corners;
    size_t behind;  // the volume, if the mark lets pass
  };
  struct Volume {
    bool has_corner(const Points& points, const Point& p) const {
      return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
        return std::any_of(t.corners.begin(), t.corners.end(), [&](size_t v) { return points[v] == p; });
      });
    }

    dsw_volume_id id{0, 0};
    std::vector<Triangle> triangles;  // of its surface
    int was_valid = 0, is_valid = 0;
  };

  static Point exact(const Vec& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }
  static std::vector<Point> all_exact(const Hull& hull) {
    std::vector<Point> points;
    for (const Vec& p : hull) points.push_back(exact(p));
    return points;
  }

  void add_triangles(Volume& volume, const std::map<Vec, size_t>& vertices) {
    uint32_t faces = 0;
    EXPECT_EQ(dsw_environment_get_volume_counts(environment_, volume.id, nullptr, nullptr, nullptr, &faces),
              DSW_STATUS_OK);
    dsw_trace* trace = nullptr;
    dsw_trace_data data{};
    data.struct_size = sizeof data;
    EXPECT_EQ(dsw_trace_create(nullptr, &trace), DSW_STATUS_OK);
    EXPECT_EQ(dsw_trace_add_volumes(trace, environment_, &volume.id, 1, 0), DSW_STATUS_OK);
    EXPECT_EQ(dsw_trace_get_data(trace, &data), DSW_STATUS_OK);
    for (size_t i = 0; i < data.triangle_count; ++i) {
      Triangle& t = volume.triangles.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        const double* const p = data.points + 3 * data.triangles[3 * i + k];
        t.corners[k] = vertices.at({p[0], p[1], p[2]});
      }
      t.behind = kNothing;
      for (uint32_t local = 0; local < faces; ++local) {
        if (!is_of_face(volume.id, local, t)) continue;
        dsw_volume_id neighbour{};
        int is_wall = 0;
        EXPECT_EQ(dsw_environment_get_neighbour(environment_, volume.id, local, &neighbour, &is_wall), DSW_STATUS_OK);
        if (is_wall == 0) t.behind = numbers_.at(neighbour.index);
      }
    }
    dsw_trace_destroy(trace);
  }
  bool is_of_face(dsw_volume_id volume, uint32_t local, const Triangle& t) const {
    const std::vector<dsw_vertex_id> corners =
        vertices_of(environment_, {DSW_CELL_FACE, volume.index, volume.generation, local});
    return std::all_of(t.corners.begin(), t.corners.end(), [&](size_t v) {
      return std::any_of(corners.begin(), corners.end(), [&](dsw_vertex_id each) { return each.index == v; });
    });
  }
  bool leads_on(const Triangle& t) const {
    return t.behind != kNothing && (volumes_[t.behind].was_valid != 0 || volumes_[t.behind].is_valid != 0);
  }

  static Points points_at(const ThickScene& before, const ThickScene& after, double share) {
    Points points;
    for (size_t v = 0; v < before.points().size(); ++v) {
      points.push_back(exact(ThickScene::between(before.points()[v], after.points()[v], share)));
    }
    return points;
  }

  /// All volumes that can be reached from these through passable triangles that may lead on.
  template <class MayLead>
  std::set<size_t> reached_from(const std::set<size_t>& start, MayLead may_lead) const {
    std::set<size_t> reached = start;
    std::vector<size_t> open(start.begin(), start.end());
    while (!open.empty()) {
      const Volume& volume = volumes_[open.back()];
      open.pop_back();
      for (const Triangle& t : volume.triangles) {
        const bool is_passable =
            t.behind != kNothing && (volumes_[t.behind].was_valid != 0 || volumes_[t.behind].is_valid != 0);
        if (is_passable && reached.count(t.behind) == 0 && may_lead(t)) {
          reached.insert(t.behind);
          open.push_back(t.behind);
        }
      }
    }
    return reached;
  }
  std::set<size_t> reached_on(const std::set<size_t>& start, const Point& p, const Point& q,
                              const Points& points) const {
    return reached_from(start, [&](const Triangle& t) { return meets(p, q, t, points); });
  }

  /// The volumes that a vertex is in when a share of its way is made: it is followed from its first one in short steps.
  std::set<size_t> follow(const ThickScene& before, const ThickScene& after, double share, size_t body,
                          uint32_t v) const {
    constexpr int kSteps = 32;
    const BodyState &from = before.bodies[body].state, &to = after.bodies[body].state;
    std::set<size_t> found = {numbers_.at(from.volumes[v].index)};
    Point at = exact(from.at[v]);
    Points points = points_at(before, after, 0);
    for (int step = 1; step <= kSteps; ++step) {
      const double part = share * step / kSteps;
      const Point next = exact(ThickScene::between(from.at[v], to.at[v], part));
      const Points next_points = points_at(before, after, part);
      const std::set<size_t> reached = reached_from(found, [&](const Triangle& t) {
        return !keeps_side({&at, &next}, {&points, &next_points}, t);
      });
      found.clear();
      for (const size_t i : reached) {
        if (contains(volumes_[i], next_points, next)) found.insert(i);
      }
      at = next;
      points = next_points;
    }
    return found;
  }
  /// Whether a point certainly stays on one side of the plane of a triangle while all go steadily: the determinant is affine in each.
  static bool keeps_side(std::array<const Point*, 2> way, std::array<const Points*, 2> points, const Triangle& t) {
    int most = -2, least = 2;
    for (size_t choice = 0; choice < 16; ++choice) {
      const auto corner = [&](size_t k) -> const Point& { return (*points[choice >> k & 1])[t.corners[k]]; };
      const int each = side(corner(0), corner(1), corner(2), *way[choice >> 3]);
      most = std::max(most, each);
      least = std::min(least, each);
    }
    return most * least > 0;
  }

  /// The side of d from which a, b and c are counter-clockwise.
  static int side(const Point& a, const Point& b, const Point& c, const Point& d) {
    std::array<Point, 3> w;
    for (size_t k = 0; k < 3; ++k) w[0][k] = a[k] - d[k], w[1][k] = b[k] - d[k], w[2][k] = c[k] - d[k];
    const mpq_class volume = w[0][0] * (w[1][1] * w[2][2] - w[1][2] * w[2][1]) -
                             w[0][1] * (w[1][0] * w[2][2] - w[1][2] * w[2][0]) +
                             w[0][2] * (w[1][0] * w[2][1] - w[1][1] * w[2][0]);
    return sgn(volume);
  }
  static bool meets(const Point& p, const Point& q, const Triangle& t, const Points& points) {
    const std::vector<Point> way = {p, q}, corners = {points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]};
    return Nearest<mpq_class>(way, corners).square == 0;
  }
  /// Also on its surface. A way to a place far outside passes the surface an odd number of times, if it meets no side of a triangle.
  static bool contains(const Volume& volume, const Points& points, const Point& p) {
    for (int tries = 1; tries < 100; ++tries) {
      const Point far = {p[0] + 1000, p[1] + mpq_class(1000 * tries, 137), p[2] + mpq_class(1000, 7 * tries)};
      bool is_clear = true;
      int passed = 0;
      for (const Triangle& t : volume.triangles) {
        if (meets(p, p, t, points)) return true;
        int most = -2, least = 2;
        for (size_t k = 0; k < 3; ++k) {
          const int each = side(p, far, points[t.corners[k]], points[t.corners[(k + 1) % 3]]);
          most = std::max(most, each);
          least = std::min(least, each);
        }
        if (most > 0 && least < 0) continue;
        is_clear = is_clear && most * least > 0;
        passed += meets(p, far, t, points) ? 1 : 0;
      }
      if (is_clear) return passed % 2 == 1;
    }
    ADD_FAILURE() << "every way meets a side";
    return true;
  }

  dsw_environment* environment_;
  std::vector<Volume> volumes_;
  std::map<uint32_t, size_t> numbers_;  // by index
};

}  // namespace dsw::oracle
