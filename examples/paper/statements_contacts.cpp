// 4.2 and 4.3 of [JCD10].
#include <algorithm>
#include <cmath>

#include "statements.h"

namespace paper {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}
double angle(const Point& a, const Point& b) {
  return kDegrees * std::acos(std::clamp(dot(unit(a), unit(b)), -1.0, 1.0));
}

// The contact of an edge whose first end moves; false if the edge does not touch.
bool touch(dsw_scene* scene, const Point* ends, const Point& target, dsw_search search, dsw_body_contact* contact) {
  dsw_body_id body;
  if (add_edge(scene, ends, DSW_LEVEL_EDGES, 0, &body) != DSW_STATUS_OK) {
    return false;
  }
  const Point targets[2] = {target, ends[1]};
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.search = search;
  physics::check(dsw_body_move(scene, body, targets[0].data(), 2, 0, &options, nullptr), "moving an edge");
  const dsw_body_contact* contacts = nullptr;
  std::size_t count = 0;
  physics::check(dsw_body_get_contacts(scene, body, &contacts, &count), "reading contacts");
  const bool touches = count > 0 && contacts[0].edge.generation != 0;
  if (touches) {
    *contact = contacts[0];
  }
  physics::check(dsw_body_destroy(scene, body), "removing an edge");
  return touches;
}

void normals_at(const char* name, dsw_environment* environment, double size, int trials, Statements* out) {
  const physics::Scene scene = make_scene(environment, 0);
  dsw_environment_info info = {};
  info.struct_size = sizeof info;
  physics::check(dsw_environment_get_info(environment, &info), "reading the environment");
  Random random(17);
  std::vector<double> of_vertex, of_triangle;
  for (int trial = 0; trial < trials; ++trial) {
    Point ends[2];
    physics::check(dsw_environment_get_centre(environment, {random.below(info.volume_index_count), 1}, ends[0].data()),
                   "reading a centre");
    ends[1] = random.near(ends[0], size);
    const Point target = random.near(ends[0], size);
    dsw_body_contact exact, halved, paper;
    if (!touch(scene.get(), ends, target, DSW_SEARCH_EXACT, &exact) ||
        !touch(scene.get(), ends, target, DSW_SEARCH_BISECTION, &halved) ||
        !touch(scene.get(), ends, target, DSW_SEARCH_BISECTION_VERTEX, &paper)) {
      continue;
    }
    const Point truth = to_point(exact.contact.normal);
    of_triangle.push_back(angle(truth, to_point(halved.contact.normal)));
    of_vertex.push_back(angle(truth, to_point(paper.contact.normal)));
  }
  const std::string where = name;
  out->push_back({"4.2", where + ": contacts of edges", static_cast<double>(of_vertex.size()), ""});
  for (const double part : {0.5, 0.9}) {
    const std::string rest = part == 0.5 ? ", median" : ", 90 of 100";
    out->push_back({"4.2", where + ": normal at a vertex, degrees off" + rest, quantile(of_vertex, part), ""});
    out->push_back(
        {"4.2", where + ": normal of the triangle (ours), degrees off" + rest, quantile(of_triangle, part), ""});
  }
}

}  // namespace

void normals(dsw_environment* vessel, int trials, Statements* out) {
  normals_at("vessel", vessel, 3, trials, out);
  Random random(2);
  const Tetrahedra mesh(6, &random);
  for (std::uint32_t v = 0; v < mesh.cells.size() / 4; ++v) {
    const dsw_volume_id volume = {v, 1};
    if (random.between(0, 1) < 0.1) {
      physics::check(dsw_environment_mark_volumes(mesh.environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                     "marking");
    }
  }
  normals_at("sharp blocks", mesh.environment.get(), 1, trials / 4, out);
}

namespace {

struct Spike {
  Point corners[4];
};

bool pierces(const Point& a, const Point& b, const Point* triangle) {
  const Point edge = minus(b, a), u = minus(triangle[1], triangle[0]), v = minus(triangle[2], triangle[0]);
  const Point p = cross(edge, v), from = minus(a, triangle[0]), q = cross(from, u);
  const double area = dot(u, p);
  if (area == 0) {
    return false;
  }
  const double s = dot(from, p) / area, t = dot(edge, q) / area, along = dot(v, q) / area;
  return s > 0 && t > 0 && s + t < 1 && along > 0 && along < 1;
}

// How deep a spike comes through a face, to the side of a point, and with which volume; 0 where it does not.
struct Depth {
  double depth = 0, volume = 0;
};

Depth depth_of(const Spike& spike, const Point* face, const Point& side) {
  bool is_pierced = false;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < i; ++k) {
      is_pierced = is_pierced || pierces(spike.corners[i], spike.corners[k], face);
    }
  }
  if (!is_pierced) {
    return {};
  }
  Point normal = unit(cross(minus(face[1], face[0]), minus(face[2], face[0])));
  const double turn = dot(normal, minus(side, face[0])) > 0 ? 1 : -1;
  double distance[4], share = 0;
  Depth found;
  for (int i = 0; i < 4; ++i) {
    distance[i] = turn * dot(normal, minus(spike.corners[i], face[0]));
    found.depth = std::max(found.depth, distance[i]);
  }
  for (int i = 0; i < 4; ++i) {  // of a simplex above a plane
    if (distance[i] <= 0) {
      continue;
    }
    double term = distance[i] * distance[i] * distance[i];
    for (int k = 0; k < 4; ++k) {
      term /= k == i ? 1 : distance[i] - distance[k];
    }
    share += term;
  }
  const Point a = minus(spike.corners[1], spike.corners[0]), b = minus(spike.corners[2], spike.corners[0]),
              c = minus(spike.corners[3], spike.corners[0]);
  found.volume = share * std::fabs(dot(a, cross(b, c))) / 6;
  return found;
}

dsw_status add_triangle(dsw_scene* scene, const Point* at, dsw_level level, dsw_body_id* body) {
  static constexpr std::uint32_t kOffsets[2] = {0, 3}, kCorners[3] = {0, 1, 2};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = level;
  desc.positions = at[0].data();
  desc.vertex_count = 3;
  desc.face_offsets = kOffsets;
  desc.face_corners = kCorners;
  desc.face_count = 1;
  desc.face_corner_count = 3;
  return dsw_body_create(scene, &desc, body);
}

// Moves a triangle that is free with its face. `after`: targets, then where it stopped.
bool move_triangle(dsw_scene* scene, const Point* at, dsw_level level, Point* after) {
  dsw_body_id body;
  std::size_t count = 0;
  if (add_triangle(scene, at, DSW_LEVEL_FACES, &body) != DSW_STATUS_OK) {
    return false;
  }
  physics::check(dsw_body_set_level(scene, body, level), "lowering the level");
  physics::check(dsw_body_move(scene, body, after[0].data(), 3, 0, nullptr, nullptr), "moving a triangle");
  physics::check(dsw_body_get_positions(scene, body, after[0].data(), 3, 0, nullptr, &count), "reading positions");
  physics::check(dsw_body_destroy(scene, body), "removing a triangle");
  return true;
}

void depths_at(dsw_level level, const char* name, int trials, Statements* out) {
  Random random(23);
  const Tetrahedra mesh(4, &random);
  std::vector<Spike> spikes;
  for (std::uint32_t v = 0; v < mesh.cells.size() / 4; ++v) {
    const dsw_volume_id volume = {v, 1};
    if (random.between(0, 1) >= 0.06) {
      continue;
    }
    physics::check(dsw_environment_mark_volumes(mesh.environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                   "marking");
    Spike spike;
    for (std::size_t k = 0; k < 4; ++k) {
      spike.corners[k] = to_point(&mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * v + k])]);
    }
    spikes.push_back(spike);
  }
  const physics::Scene scene = make_scene(mesh.environment.get(), 0);
  std::vector<double> deep, large;
  double moves = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Point at[3] = {{random.between(0.2, 3.8), random.between(0.2, 3.8), random.between(0.2, 3.8)}, {}, {}};
    at[1] = random.near(at[0], 1.5), at[2] = random.near(at[0], 1.5);
    Point after[3] = {random.near(at[0], 1), at[1], at[2]};
    if (!move_triangle(scene.get(), at, level, after)) {
      continue;
    }
    ++moves;
    const Point way = minus(after[0], at[0]), area = cross(minus(after[1], after[0]), minus(after[2], after[0]));
    const double length = std::sqrt(dot(way, way)), height = std::fabs(dot(unit(area), way));
    Depth most;
    for (const Spike& spike : spikes) {
      const Depth depth = depth_of(spike, after, at[0]);
      most.depth = std::max(most.depth, depth.depth);
      most.volume = std::max(most.volume, depth.volume);
    }
    if (most.depth > 0) {
      deep.push_back(most.depth / length);
      large.push_back(most.volume / (std::sqrt(dot(area, area)) / 2 * height / 3));
    }
  }
  const std::string where = name;
  out->push_back({"4.3", where + ": moves of a vertex of a free triangle", moves, ""});
  out->push_back(
      {"4.3", where + ": share with a spike through the face", static_cast<double>(deep.size()) / moves, ""});
  for (const double part : {0.5, 0.99, 1.0}) {
    const std::string which = part == 0.5 ? ", median" : part == 1 ? ", most" : ", 99 of 100";
    const double bound = level == DSW_LEVEL_EDGES_SWEPT ? 1 + 1e-9 : HUGE_VAL;
    out->push_back({"4.3", where + ": depth over displacement" + which, quantile(deep, part), "at most 1", bound});
    out->push_back({"4.3", where + ": volume over face times displacement / 3" + which, quantile(large, part),
                    "at most 1", bound});
  }
}

}  // namespace

void depths(int trials, Statements* out) {
  depths_at(DSW_LEVEL_EDGES, "EDGES", trials, out);
  depths_at(DSW_LEVEL_EDGES_SWEPT, "EDGES_SWEPT", trials, out);
}

}  // namespace paper
