#include "plane_walls.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

Vec mirrored(const Vec& p) { return {-p[0], -p[1], 0}; }

/// Sign of twice the area of a triangle.
int turn_of(const Vec& a, const Vec& b, const Vec& c) {
  int lowest = 0;
  for (const Vec* p : {&a, &b, &c}) lowest = std::min({lowest, lowest_exponent((*p)[0]), lowest_exponent((*p)[1])});
  Big u[2], v[2];
  for (size_t k = 0; k < 2; ++k) {
    u[k] = to_big(b[k], -lowest) - to_big(a[k], -lowest);
    v[k] = to_big(c[k], -lowest) - to_big(a[k], -lowest);
  }
  return sgn(Big(u[0] * v[1] - u[1] * v[0]));
}

/// Strictly, along an axis.
template <class Points>
bool are_apart(const Points& a, const std::vector<Vec>& b) {
  for (size_t k = 0; k < 2; ++k) {
    const auto before = [k](const Vec& x, const Vec& y) { return x[k] < y[k]; };
    const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), before);
    const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), before);
    if ((*a_high)[k] < (*b_low)[k] || (*b_high)[k] < (*a_low)[k]) return true;
  }
  return false;
}

}  // namespace

Obstacle::Obstacle(const std::vector<Vec>& at) {
  for (const Vec& p : at) world_.points.push_back(flat(mirrored(p)));
  if (at.size() == 2) world_.sides.push_back({0, 1, {0, 1}, {0, 0}, true});  // met from both sides
  sweeps_ = std::make_unique<PlaneSweeps>(world_, at.size() == 1 ? std::vector<int>{0} : std::vector<int>{});
}

std::optional<double> Obstacle::first(const VertexMove& move, dsw_level level) {
  const MoveTruth truth = sweeps_->move(move, level);
  if (truth.events.empty()) return std::nullopt;
  return truth.events[0].time;
}

std::optional<double> Obstacle::met_by_vertex(const Vec& from, const Vec& to) {
  return first({mirrored(from), mirrored(to), {}, {}}, DSW_LEVEL_POINTS);
}

std::optional<double> Obstacle::met_by_side(const Vec& from, const Vec& to, const Vec& other) {
  return first({mirrored(from), mirrored(to), {mirrored(other)}, {}}, DSW_LEVEL_EDGES_SWEPT);
}

int Obstacle::passed_by_side(const std::array<Vec, 2>& from, const std::array<Vec, 2>& to) {
  int passed = 0;
  if (met_by_side(from[0], to[0], from[1])) passed += turn_of(from[0], to[0], from[1]);
  if (met_by_side(from[1], to[1], to[0])) passed += turn_of(to[0], from[1], to[1]) * -1;
  return passed;
}

WallValidator::WallValidator(const plane::World& world, const std::vector<int>& marked_vertices,
                             const Deformed& deformed)
    : world_(world), marked_vertices_(marked_vertices), d_(deformed) {}

Vec WallValidator::on_way(int vertex, double fraction) const {
  const auto v = static_cast<size_t>(vertex);
  return point_on_way(d_.start[v], d_.target[v], fraction);
}

/// Where a vertex is from step to step.
std::vector<Vec> WallValidator::places(int vertex, double way, uint32_t steps) const {
  std::vector<Vec> list;
  for (uint32_t s = 0; s <= steps; ++s) list.push_back(on_way(vertex, way * s / steps));
  return list;
}

/// Whether edges of bodies meet it.
bool WallValidator::is_impassable(int vertex, dsw_level level) const {
  const auto has = [&](const plane::Side& s) { return world_.impassable(s) && (s.a == vertex || s.b == vertex); };
  return std::any_of(world_.sides.begin(), world_.sides.end(), has) ||
         (level >= DSW_LEVEL_EDGES_SWEPT &&
          std::find(marked_vertices_.begin(), marked_vertices_.end(), vertex) != marked_vertices_.end());
}

bool WallValidator::knows(const Part& part) const {
  // In one step a vertex goes where it is, or stays.
  const bool all_places = d_.report.steps == 1 || d_.report.contact_count + d_.report.invalid_count == 0;
  return part.at_rest && d_.whole && d_.options.method == DSW_DEFORM_SWEPT && d_.report.outcome != DSW_DEFORM_REFUSED &&
         all_places;
}

std::string WallValidator::passed(const Part& part) const {
  const bool one_step = d_.report.steps == 1;
  const auto way_of = [&](int v) {
    const auto i = static_cast<size_t>(v);
    return one_step ? std::vector<Vec>{d_.start[i], d_.now[i]} : places(v, d_.report.fraction, d_.report.steps);
  };
  Obstacle obstacle(part.at);
  if (part.at.size() == 1) {
    for (size_t i = 0; i < world_.sides.size(); ++i) {
      const plane::Side& side = world_.sides[i];
      if (!world_.impassable(side)) continue;
      const std::vector<Vec> a = way_of(side.a), b = way_of(side.b);
      int passed = 0;
      for (size_t s = 1; s < a.size(); ++s) {
        const std::array<Vec, 4> swept = {a[s - 1], a[s], b[s - 1], b[s]};
        if (!are_apart(swept, part.at)) passed += obstacle.passed_by_side({a[s - 1], b[s - 1]}, {a[s], b[s]});
      }
      if (passed != 0)
        return "side " + std::to_string(side.a) + "-" + std::to_string(side.b) + " passed " + hex(part.at[0]);
    }
    return "";
  }
  for (int v = 0; v < static_cast<int>(d_.now.size()); ++v) {
    if (!is_impassable(v, part.level)) continue;
    const std::vector<Vec> way = way_of(v);
    for (size_t s = 1; s < way.size(); ++s) {
      const std::array<Vec, 2> swept = {way[s - 1], way[s]};
      if (are_apart(swept, part.at) || !obstacle.met_by_vertex(way[s - 1], way[s])) continue;
      return "vertex " + std::to_string(v) + " passed " + hex(part.at[0]) + " " + hex(part.at[1]);
    }
  }
  return "";
}

/// Whether it is a side that has the vertices, by its canonical name, or none where there is none.
std::string WallValidator::wrong_wall(const dsw_wall_contact& c) const {
  const int moving = static_cast<int>(c.moving.index), other = static_cast<int>(c.others[0].index);
  const bool has_other = c.others[0].generation != 0, at_point = c.edge.generation == 0;
  if (c.moving.generation != 1 || has_other != at_point || c.others[1].generation != 0 || c.face.generation != 0) {
    return "vertices of the wall";
  }
  if (none(c.contact.wall)) {
    return at_point || is_impassable(moving, DSW_LEVEL_EDGES) || !is_impassable(moving, DSW_LEVEL_EDGES_SWEPT)
               ? "no wall"
               : "";
  }
  for (const plane::Side& s : world_.sides) {
    if (static_cast<uint32_t>(s.cell[0]) != c.contact.wall.volume ||
        static_cast<uint32_t>(s.local[0]) != c.contact.wall.local)
      continue;
    const bool at_ends =
        has_other ? (s.a == moving && s.b == other) || (s.a == other && s.b == moving) : s.a == moving || s.b == moving;
    const bool known = c.contact.tag == world_.tags[static_cast<size_t>(s.cell[0])] ||
                       (s.cell[1] >= 0 && c.contact.tag == world_.tags[static_cast<size_t>(s.cell[1])]);
    return at_ends && known && world_.impassable(s) && c.contact.wall.generation == 1 ? ""
                                                                                      : "wall " + name(c.contact.wall);
  }
  return "no such wall " + name(c.contact.wall);
}

std::string WallValidator::wrong_contact(const dsw_wall_contact& c, const Part* part) const {
  const double length = std::hypot(c.contact.normal[0], c.contact.normal[1]);
  if (!(std::fabs(length - 1) <= 1e-14) || c.contact.normal[2] != 0) return "normal " + hex(c.contact.normal);
  if (d_.options.method != DSW_DEFORM_SWEPT)
    return c.moving.generation == 0 && !none(c.contact.wall) ? "" : "walls of a contact";
  const std::string wall = wrong_wall(c);
  if (!wall.empty()) return wall;
  // Contacts of a way that was cut short are those of the way before.
  const double fraction = d_.report.fraction;
  const double way = fraction == 1 ? 1 : fraction == 0 ? std::ldexp(1, -52) : 2 * fraction;
  const uint32_t most_steps = 1u << d_.options.most_halvings;
  const Vec from = {c.from[0], c.from[1], 0}, to = {c.to[0], c.to[1], 0};
  const std::vector<Vec> known = places(static_cast<int>(c.moving.index), way, most_steps);
  const auto is_known = [&](const Vec& p) { return std::find(known.begin(), known.end(), p) != known.end(); };
  if (!is_known(from) || !is_known(to)) return "a flight from " + hex(from) + " to " + hex(to);
  if (c.edge.generation == 0) {
    const Vec point = {c.point[0], c.point[1], 0};
    if (part != nullptr && part->at[0] != point) return "point " + hex(point);
    Obstacle obstacle({point});
    for (const Vec& other : places(static_cast<int>(c.others[0].index), way, most_steps)) {
      const std::array<Vec, 3> swept = {from, to, other};
      if (are_apart(swept, {point})) continue;
      if (obstacle.met_by_side(from, to, other) == c.time) return "";
    }
    return "no side meets " + hex(point) + " at " + number(c.time);
  }
  if (part == nullptr) return "";
  const std::optional<double> time = Obstacle(part->at).met_by_vertex(from, to);
  return time == c.time ? "" : "time " + number(c.time) + " for " + (time ? number(*time) : "none");
}

}  // namespace dsw::oracle
