#include "lattice.h"

#include <map>

namespace dsw::rigid {

namespace {

scenes::HexGrid make_grid(std::uint64_t seed) {
  scenes::HexGridOptions options;
  options.size = {21, 21, 21};
  options.seed = seed;
  return scenes::make_hex_grid(options);
}

}  // namespace

Lattice::Lattice(std::uint64_t seed) : grid_(make_grid(seed)), world_(grid_.mesh, 1) {
  bench::mark_cells(world_, grid_.obstacle);
  for (std::size_t i = 0; i < grid_.mesh.point_count(); ++i) {
    const double* const p = grid_.mesh.point(i);
    walls_.points.push_back({p[0], p[1], p[2]});
  }
  // Triangles alone: those who ask have no use for their edges.
  for (const scenes::Wall& wall : scenes::hex_grid_walls(grid_)) {
    for (std::uint32_t i = 0; i < wall.triangle_count(); ++i) walls_.faces.push_back({wall.triangle(i), 3});
  }
}

Point Lattice::draw_middle(scenes::Random& random) const {
  while (true) {
    const std::size_t cell = random.index(grid_.obstacle.size());
    if (grid_.obstacle[cell] != 0) continue;
    const std::uint32_t n = grid_.options.size[0], at = static_cast<std::uint32_t>(cell);
    return {at % n + 0.5, at / n % n + 0.5, at / (n * n) + 0.5};
  }
}

bool Lattice::add(const Figure& body, double radius, dsw_body_id& id) {
  std::vector<std::uint32_t> edges, offsets{0}, corners;
  for (const Part& edge : body.edges) edges.insert(edges.end(), edge.at.begin(), edge.at.begin() + 2);
  for (const Part& face : body.faces) {
    corners.insert(corners.end(), face.at.begin(), face.at.end());
    offsets.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  dsw_body_desc d;
  dsw_body_desc_init(&d, sizeof d);
  d.level = body.faces.empty() ? DSW_LEVEL_EDGES_SWEPT : DSW_LEVEL_FACES;
  d.positions = body.points[0].data();
  d.vertex_count = body.points.size();
  d.radius = radius;
  d.edges = body.faces.empty() ? edges.data() : nullptr;
  d.edge_count = body.faces.empty() ? body.edges.size() : 0;
  d.face_offsets = body.faces.empty() ? nullptr : offsets.data();
  d.face_corners = body.faces.empty() ? nullptr : corners.data();
  d.face_count = body.faces.size();
  d.face_corner_count = corners.size();
  const dsw_status status = dsw_body_create(world_.scene(), &d, &id);
  if (status != DSW_STATUS_OK && status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_OUTSIDE &&
      status != DSW_STATUS_IMPASSABLE) {
    bench::check(status);
  }
  return status == DSW_STATUS_OK;
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

}  // namespace dsw::rigid
