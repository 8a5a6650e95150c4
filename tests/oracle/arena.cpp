#include "arena.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>

namespace dsw::oracle {
namespace {

/// The distance of a point from segment a b.
double distance(const Vec& a, const Vec& b, const double* point) {
  double most = DBL_MIN;
  for (size_t k = 0; k < 3; ++k) most = std::max({most, std::fabs(b[k] - a[k]), std::fabs(point[k] - a[k])});
  Vec u, w;
  for (size_t k = 0; k < 3; ++k) {
    u[k] = (b[k] - a[k]) / most;
    w[k] = (point[k] - a[k]) / most;
  }
  const double square = dot(u, u), by = square > 0 ? std::min(1.0, std::max(0.0, dot(u, w) / square)) : 0;
  for (size_t k = 0; k < 3; ++k) w[k] -= by * u[k];
  return length(w) * most;
}

double largest(const Sweep& s) {
  double most = 0;
  for (const Vec* p : {&s.from, &s.to, &s.fixed}) {
    for (double x : *p) most = std::max(most, std::fabs(x));
  }
  return most;
}

/// What is wrong with the position of the moving end at the time of a report.
std::string wrong_position(const Sweep& s, const dsw_sweep& got) {
  for (size_t k = 0; k < 3; ++k) {
    const double way = got.time * (s.to[k] - s.from[k]), at = s.from[k] + way;
    const double allowed = 1e-15 * (std::fabs(s.from[k]) + std::fabs(way)) + 2 * DBL_TRUE_MIN;
    if (!(std::fabs(got.position[k] - at) <= allowed)) return " position " + hex(got.position);
  }
  return "";
}

/// The wall of a contact in the words of a swept edge's report.
dsw_sweep as_sweep(const dsw_body_contact& c) {
  dsw_sweep s;
  std::memset(&s, 0, sizeof s);
  for (size_t k = 0; k < 3; ++k) {
    s.position[k] = c.position[k];
    s.point[k] = c.point[k];
    s.contact.normal[k] = c.contact.normal[k];
  }
  s.time = c.time;
  s.edge_parameter = c.edge_parameter;
  s.contact.front = c.contact.front;
  s.contact.wall = c.contact.wall;
  s.contact.obstacle = c.contact.obstacle;
  s.contact.behind = c.contact.behind;
  s.contact.kind = c.contact.kind;
  s.contact.marked_kind = c.contact.marked_kind;
  s.contact.tag = c.contact.tag;
  return s;
}

/// Whether an obstacle that is a face, an edge or a vertex says so.
bool names_obstacle(const SweepEvent& e, const dsw_body_contact& c) {
  const dsw_cell& o = c.contact.obstacle;
  if (e.vertex >= 0) {
    return c.contact.kind == DSW_CONTACT_VERTEX && o.kind == DSW_CELL_VERTEX &&
           o.index == static_cast<uint32_t>(e.vertex) && o.generation == 1 && o.local == 0;
  }
  return (c.contact.kind == DSW_CONTACT_PLANE && o.kind == DSW_CELL_FACE && o.index == c.contact.wall.volume &&
          o.generation == c.contact.wall.generation && o.local == c.contact.wall.local) ||
         (c.contact.kind == DSW_CONTACT_EDGE && o.kind == DSW_CELL_EDGE);
}

}  // namespace

double dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
double length(const Vec& x) { return std::sqrt(dot(x, x)); }

bool Arena::same_volume(dsw_volume_id id, int cell) const {
  if (cell < 0) return id.index == 0 && id.generation == 0;
  return same_id(id, ids()[static_cast<size_t>(cell)]);
}

/// The face with that canonical name, or -1.
int Arena::face_named(dsw_face_id id) const {
  if (id.volume >= ids().size() || id.generation != ids()[id.volume].generation) return -1;
  const std::vector<int>& faces = faces_of(static_cast<int>(id.volume));
  if (id.local >= faces.size()) return -1;
  const int face = faces[id.local];
  return wall(face).cell[0] == static_cast<int>(id.volume) ? face : -1;
}

bool Arena::impassable(int face) const {
  const Wall w = wall(face);
  return w.marked || w.cell[1] < 0 || marked(w.cell[0]) || marked(w.cell[1]);
}

std::string Arena::wrong_wall(const dsw_sweep& got, const std::vector<int>& around,
                              const std::vector<dsw_cell_kind>& alone) const {
  if (got.contact.front.index >= ids().size()) return " front " + name(got.contact.front);
  const bool lone = std::none_of(around.begin(), around.end(), [&](int f) { return impassable(f); });
  const bool front_there = std::any_of(around.begin(), around.end(), [&](int f) {
    const Wall w = wall(f);
    return same_volume(got.contact.front, w.cell[0]) || (w.cell[1] >= 0 && same_volume(got.contact.front, w.cell[1]));
  });
  if (!front_there || marked(static_cast<int>(got.contact.front.index))) return " front " + name(got.contact.front);
  if (lone) {
    const bool right = none(got.contact.wall) && same_volume(got.contact.behind, -1) && got.contact.tag == 0 &&
                       std::count(alone.begin(), alone.end(), got.contact.marked_kind) != 0;
    return right ? "" : " a face, an obstacle or a tag where there is no wall";
  }
  const int face = face_named(got.contact.wall);
  if (face < 0 || !impassable(face)) return " face " + name(got.contact.wall) + " is not canonical or not impassable";
  if (std::find(around.begin(), around.end(), face) == around.end()) {
    return " face " + name(got.contact.wall) + " does not bear the obstacle";
  }
  const Wall w = wall(face);
  if (got.contact.marked_kind != (w.marked || w.cell[1] < 0 ? DSW_CELL_FACE : DSW_CELL_VOLUME)) {
    return " obstacle " + std::to_string(got.contact.marked_kind);
  }
  // Behind the face as seen from the front; where the front does not touch it, behind may be either side.
  for (size_t side = 0; side < 2; ++side) {
    const int behind = w.cell[side], other = w.cell[1 - side];
    if (same_volume(got.contact.front, behind) && other >= 0) continue;
    if (!same_volume(got.contact.behind, behind)) continue;
    if (got.contact.tag == tag(behind >= 0 ? behind : other)) return "";
    if (other < 0 && got.contact.tag == tag(static_cast<int>(got.contact.front.index))) return "";
  }
  return " behind " + name(got.contact.behind) + " or tag " + std::to_string(got.contact.tag) + " of face " +
         name(got.contact.wall) + " from " + name(got.contact.front);
}

/// The moving end on a face.
std::string Arena::wrong_at_path(const SweepEvent& event, const dsw_sweep& got) const {
  const Wall met = this->met(event);
  const int front = met.cell[event.side > 0 ? 0 : 1], behind = met.cell[event.side > 0 ? 1 : 0];
  if (got.contact.kind != DSW_CONTACT_PLANE || !names_wall(got.contact))
    return " kind " + std::to_string(got.contact.kind);
  if (face_named(got.contact.wall) != face_of(event)) return " face " + name(got.contact.wall);
  if (!same_volume(got.contact.front, front))
    return " front " + name(got.contact.front) + " for " + std::to_string(front);
  if (!same_volume(got.contact.behind, behind))
    return " behind " + name(got.contact.behind) + " for " + std::to_string(behind);
  if (got.edge_parameter != 0) return " along " + number(got.edge_parameter);
  if (got.contact.marked_kind != (met.marked || behind < 0 ? DSW_CELL_FACE : DSW_CELL_VOLUME)) {
    return " obstacle " + std::to_string(got.contact.marked_kind);
  }
  if (got.contact.tag != tag(behind >= 0 ? behind : front)) return " tag " + std::to_string(got.contact.tag);
  return normal_fits(event, got.contact.normal) ? "" : " normal " + hex(got.contact.normal);
}

/// The normal of a contact of an edge: across it and the obstacle, against the motion. In doubles, so only where it is
/// well determined. What is met in the plane goes across that.
std::string Arena::wrong_across(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  const auto [a, b] = ends_of(event);
  double most = largest(s);
  for (const Vec* p : {&a, &b}) {
    for (double x : *p) most = std::max(most, std::fabs(x));
  }
  const int e = -std::ilogb(most);
  Vec edge, swept, move;
  for (size_t k = 0; k < 3; ++k) {
    edge[k] = std::ldexp(b[k], e) - std::ldexp(a[k], e);
    move[k] = std::ldexp(s.to[k], e) - std::ldexp(s.from[k], e);
    swept[k] = std::ldexp(s.fixed[k], e) - (std::ldexp(s.from[k], e) + event.time * move[k]);
  }
  if (dimension == 2) edge = {0, 0, 1};
  Vec n;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = swept[i] * edge[j] - swept[j] * edge[i];
  }
  const double size = length(n), grain = std::ldexp(DBL_TRUE_MIN, e) * length(edge);
  const double tolerance = (1e-14 * (length(edge) + length(swept)) + 4 * grain) / size + 1e-13;
  if (!(size > 0) || !(tolerance < 1e-4)) return "";
  const double against = dot(n, move);
  for (double& x : n) x /= against > 0 ? -size : size;
  const Vec reported = {got.contact.normal[0], got.contact.normal[1], got.contact.normal[2]};
  const double cosine = dot(n, reported);
  // A motion that lies in the plane of both leaves the side to rounding.
  if (std::fabs(against) <= tolerance * size * length(move)) {
    return std::fabs(std::fabs(cosine) - 1) <= tolerance ? "" : " normal is not across the edges";
  }
  for (size_t k = 0; k < 3; ++k) {
    if (!(std::fabs(reported[k] - n[k]) <= tolerance)) return " normal " + hex(reported) + " for " + hex(n);
  }
  return "";
}

/// Position and point: at its time and place along the edge, and on the obstacle.
std::string Arena::wrong_place(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  const double most = largest(s);
  if (!(most < DBL_MAX / 4)) return "";
  const std::string wrong = wrong_position(s, got);
  if (!wrong.empty()) return wrong;
  if (!(got.edge_parameter >= 0 && got.edge_parameter <= 1)) return " along " + number(got.edge_parameter);
  const double allowed = 32 * DBL_EPSILON * most + 4 * DBL_TRUE_MIN;
  Vec there;
  for (size_t k = 0; k < 3; ++k) there[k] = got.position[k] + got.edge_parameter * (s.fixed[k] - got.position[k]);
  const double off = distance(there, there, got.point);
  if (!(off <= allowed)) {
    return " point " + hex(got.point) + " is not at along " + number(got.edge_parameter) + ", off by " +
           number(off / size());
  }
  if (event.triangle >= 0) return "";
  const auto [a, b] = ends_of(event);
  const double away = distance(a, b, got.point);
  if (away <= allowed) return "";
  return " point " + hex(got.point) + " is not on the obstacle, off by " + number(away / size());
}

std::string Arena::wrong_event(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  std::string wrong;
  if (event.triangle >= 0) {
    wrong = wrong_at_path(event, got);
  } else {
    wrong = wrong_wall(got, faces_round(event), {dimension == 3 ? DSW_CELL_EDGE : DSW_CELL_VERTEX});
    if (wrong.empty()) wrong = wrong_name(event, got);
    if (wrong.empty()) wrong = wrong_across(s, event, got);
  }
  return wrong + wrong_place(s, event, got);
}

std::string Arena::wrong_contact(const VertexMove& f, const SweepEvent& e, const dsw_body_contact& c) const {
  if (!names_obstacle(e, c)) {
    return " kind " + std::to_string(c.contact.kind) + " with obstacle " + std::to_string(c.contact.obstacle.index) +
           " of kind " + std::to_string(c.contact.obstacle.kind);
  }
  const dsw_sweep wall = as_sweep(c);
  if (e.face >= 0) return wrong_at_face(f, e, c, wall);
  return wrong_event({f.from, f.to, f.fixed.empty() ? f.from : f.fixed[0], {}}, e, wall);
}

}  // namespace dsw::oracle
