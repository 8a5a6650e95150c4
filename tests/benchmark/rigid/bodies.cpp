#include "bodies.h"

#include <map>
#include <stdexcept>
#include <string>

namespace dsw::rigid {

void check(dsw_status status) {
  if (status == DSW_STATUS_OK) return;
  throw std::runtime_error(std::string(dsw_status_string(status)) + ": " + dsw_last_error_message());
}

bool add_body(dsw_scene* scene, const Figure& figure, double radius, dsw_body_id& id, std::uint32_t flags) {
  std::vector<std::uint32_t> edges, offsets{0}, corners;
  for (const Part& edge : figure.edges) edges.insert(edges.end(), edge.at.begin(), edge.at.begin() + 2);
  for (const Part& face : figure.faces) {
    corners.insert(corners.end(), face.at.begin(), face.at.end());
    offsets.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  dsw_body_desc d;
  dsw_body_desc_init(&d, sizeof d);
  d.level = figure.faces.empty() ? DSW_LEVEL_EDGES_SWEPT : DSW_LEVEL_FACES;
  d.positions = figure.points[0].data();
  d.vertex_count = figure.points.size();
  d.stride_bytes = sizeof(Point);
  if (figure.faces.empty()) {
    d.edges = edges.data();
    d.edge_count = figure.edges.size();
  } else {
    d.face_offsets = offsets.data();
    d.face_corners = corners.data();
    d.face_count = figure.faces.size();
    d.face_corner_count = corners.size();
  }
  d.radius = radius;
  d.flags = flags;
  const dsw_status status = dsw_body_create(scene, &d, &id);
  const bool has_no_room =
      status == DSW_STATUS_OCCUPIED || status == DSW_STATUS_OUTSIDE || status == DSW_STATUS_IMPASSABLE;
  if (!has_no_room) check(status);
  return !has_no_room;
}

Figure make_ball(int k, double radius) {
  std::vector<Point> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < k; ++i) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto found =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(points.size()));
      if (found.second) points.push_back(unit(points[a] + points[b]));
      return found.first->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& f : faces) {
      const std::uint32_t a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = finer;
  }
  Figure ball;
  for (const Point& p : points) ball.points.push_back(radius * p);
  for (const auto& f : faces) ball.add_face(f[0], f[1], f[2]);
  return ball;
}

Figure make_box(const Point& half) {
  Figure box;
  for (int i = 0; i < 8; ++i) {
    box.points.push_back(
        {(i & 1) != 0 ? half[0] : -half[0], (i & 2) != 0 ? half[1] : -half[1], (i & 4) != 0 ? half[2] : -half[2]});
  }
  static constexpr std::uint32_t kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& s : kSides) {
    box.add_face(s[0], s[1], s[2]);
    box.add_face(s[0], s[2], s[3]);
  }
  return box;
}

Figure make_rope(std::uint32_t edges, double length) {
  Figure rope;
  for (std::uint32_t i = 0; i <= edges; ++i)
    rope.points.push_back({length * (i / static_cast<double>(edges) - 0.5), 0, 0});
  for (std::uint32_t i = 0; i < edges; ++i) rope.add_edge(i, i + 1);
  return rope;
}

}  // namespace dsw::rigid
