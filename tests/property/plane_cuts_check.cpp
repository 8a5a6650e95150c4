// What has to hold after each cut, tear, opening or tie in the plane.
#include "environment/validity.h"
#include "map/integrity.h"
#include "path_truth.h"
#include "plane_cuts.h"
#include "sweep/body_probe.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

/// Twice the area of a triangle, exactly, over the square of a power of two.
class Areas {
 public:
  explicit Areas(const plane::World& world) : world_(world) {
    for (const plane::Vec& p : world.points)
      lowest_ = std::min({lowest_, lowest_exponent(p[0]), lowest_exponent(p[1])});
  }
  Big of(const plane::Vec& a, const plane::Vec& b, const plane::Vec& c) {
    const auto to = [&](double x) { return to_big(x, -lowest_); };
    return (to(b[0]) - to(a[0])) * (to(c[1]) - to(a[1])) - (to(b[1]) - to(a[1])) * (to(c[0]) - to(a[0]));
  }
  Big of_cell(const std::vector<int>& loop) {
    Big sum = 0;
    for (size_t i = 1; i + 1 < loop.size(); ++i) sum += of(at(loop[0]), at(loop[i]), at(loop[i + 1]));
    return sum;
  }
  /// Whether p and q, in a line with `from`, lie on one side of it.
  static bool ahead(const plane::Vec& from, const plane::Vec& p, const plane::Vec& q) {
    for (size_t k = 0; k < 2; ++k) {
      if ((p[k] < from[k] && q[k] < from[k]) || (p[k] > from[k] && q[k] > from[k])) return true;
    }
    return false;
  }
  const plane::Vec& at(int vertex) const { return world_.points[static_cast<size_t>(vertex)]; }
  /// For a point that is none of the world's.
  void see(const double* p) { lowest_ = std::min({lowest_, lowest_exponent(p[0]), lowest_exponent(p[1])}); }

 private:
  const plane::World& world_;
  int lowest_ = 0;
};

std::vector<dsw_vertex_origin> cut_vertices(const EnvironmentPtr& environment) {
  const dsw_vertex_origin* vertices = change_of(environment.get()).vertices;
  const size_t count = change_of(environment.get()).vertex_count;
  return {vertices, vertices + count};
}
std::vector<dsw_volume_change> changes(const EnvironmentPtr& environment) {
  const dsw_volume_change* changes = change_of(environment.get()).volumes;
  const size_t count = change_of(environment.get()).volume_count;
  return {changes, changes + count};
}

}  // namespace

std::string PlaneCuts::check(bool was_cut) {
  if (const char* const broken = check_integrity(env().map)) return broken;
  std::string wrong = check_cells();
  if (!wrong.empty()) return wrong;
  const dsw_status partition = dsw_environment_check(environment_.get(), nullptr);
  crosses_ = partition == DSW_STATUS_BOUNDARY_CROSSES;
  if (!crosses_ && partition != DSW_STATUS_OK) return dsw_last_error_message();
  crossed += crosses_ ? 1u : 0u;
  wrong = check_folds(was_cut);
  if (!wrong.empty()) return wrong;
  for (int i = 0; !crosses_ && i < 8; ++i) {
    if (plane::locate(world_, some_point()) == -2) return "two cells contain one point";
  }
  return check_inhabitants();
}

/// Each cell is the star of its centre; all together fill what the outer boundary goes round.
std::string PlaneCuts::check_cells() const {
  Areas areas(world_);
  std::vector<plane::Vec> centres;
  for (const uint32_t number : numbers_) {
    const dsw::Cell c = env().map.cell(number);
    const CellState state = check_cell(env(), c);
    if (state != CellState::kValid && state != CellState::kValidConvex) return "a cell is not valid";
    centres.emplace_back();
    centre(env(), c, centres.back().data());
    if (env().map.form(c) != Form::kSimplex) areas.see(centres.back().data());
  }
  Big sum = 0, outer = 0;
  for (size_t i = 0; i < world_.cells.size(); ++i) {
    const std::vector<int>& loop = world_.cells[i];
    const Big area = areas.of_cell(loop);
    if (area <= 0) return "a cell has no area";
    sum += area;
    for (size_t k = 0; loop.size() > 3 && k < loop.size(); ++k) {
      if (areas.of(centres[i], areas.at(loop[k]), areas.at(loop[(k + 1) % loop.size()])) <= 0)
        return "a cell is no star";
    }
  }
  const plane::Vec origin{0, 0};
  for (const plane::Side& side : world_.sides) {
    if (side.cell[1] < 0) outer += areas.of(origin, areas.at(side.a), areas.at(side.b));
    const std::vector<int>* const beyond =
        side.cell[1] < 0 ? nullptr : &world_.cells[static_cast<size_t>(side.cell[1])];
    if (beyond == nullptr) continue;
    const auto local = static_cast<size_t>(side.local[1]);
    if ((*beyond)[local] != side.b || (*beyond)[(local + 1) % beyond->size()] != side.a)
      return "a side has other ends beyond";
  }
  return sum == outer ? "" : "the cells do not fill what the outer boundary encloses";
}

/// Vertices of the outer boundary round which cells turn by more than there is.
std::set<int> PlaneCuts::folded_vertices() const {
  const Map<2>& map = env().map;
  Areas areas(world_);
  std::set<int> folded;
  for (const plane::Side& side : world_.sides) {
    if (side.cell[1] >= 0) continue;
    const plane::Vec &at = areas.at(side.a), &first = areas.at(side.b);
    // Whether a corner, counter-clockwise from u to v, has the first side's direction in it, u's included and v's not.
    const auto passes_first = [&](const plane::Vec& u, const plane::Vec& v) {
      const auto is_before = [&](const plane::Vec& p, const plane::Vec& q) { return areas.of(at, p, q) > 0; };
      const auto same_way = [&](const plane::Vec& p) {
        return areas.of(at, p, first) == 0 && areas.ahead(at, p, first);
      };
      if (same_way(u)) return true;
      if (same_way(v)) return false;
      const Big turn = areas.of(at, u, v);
      if (turn > 0) return is_before(u, first) && is_before(first, v);
      if (turn < 0) return is_before(u, first) || is_before(first, v);
      return is_before(u, first);  // half of the way
    };
    dsw::Cell c = map.cell(numbers_[static_cast<size_t>(side.cell[0])]);
    bool begun = false;
    for (auto f = static_cast<uint32_t>(side.local[0]);;) {
      const uint32_t n = map.vertices_of(c), last = (f + n - 1) % n;
      const auto corner = [&](uint32_t k) { return areas.at(static_cast<int>(map.vertex(c, k))); };
      if (begun && passes_first(corner((f + 1) % n), corner(last))) {
        folded.insert(side.a);
        break;
      }
      begun = true;
      const HalfFacet o = map.opposite(map.half_facet(c, last));
      if (!o.valid()) break;
      c = map.cell_of(o);
      f = map.local_of(o, c);
    }
  }
  return folded;
}

/// The outer boundary folds only by the rounding of vertices that a cut has brought: there or beside one. What lies
/// farther off can overlap.
std::string PlaneCuts::check_folds(bool was_cut) {
  std::set<int> folded = folded_vertices(), rounded;
  folded.swap(folded_);
  for (const dsw_vertex_origin& v : cut_vertices(environment_)) rounded.insert(static_cast<int>(v.vertex.index));
  std::set<int> excused = folded;
  for (const plane::Side& side : world_.sides) {
    if (!was_cut || side.cell[1] >= 0 || rounded.count(side.a) + rounded.count(side.b) == 0) continue;
    excused.insert({side.a, side.b});
  }
  const bool all = std::includes(excused.begin(), excused.end(), folded_.begin(), folded_.end());
  return all ? "" : "the outer boundary is folded";
}

std::string PlaneCuts::check_inhabitants() {
  std::map<uint32_t, int> places;
  for (size_t i = 0; i < numbers_.size(); ++i) places[env().map.cell(numbers_[i]).unit] = static_cast<int>(i);
  const auto is_in = [&](dsw::Cell c, const double* at) {
    if (places.count(c.unit) == 0 || env().map.marked(c) || !contains(env(), c, at)) return false;
    return crosses_ || plane::locate(world_, {at[0], at[1]}) == places[c.unit];
  };
  for (const ParticleState<2>& p : scene().particles) {
    if (p.cell.valid() && !is_in(p.cell, p.position)) return "a particle is not in its cell";
  }
  BodyProbe<2> probe(env(), Obstacle::kCells);
  for (const BodyRecord<2>& record : scene().bodies) {
    const Body<2>& body = record.body;
    for (const BodyVertex<2>& v : body.vertices) {
      if (v.cell.valid() && !is_in(v.cell, v.position)) return "a vertex of a body is not in its cell";
    }
    if (body.vertices.empty()) continue;
    if (!probe.is_free(body, {})) return "a body is not free";
    const BodyVertex<2>&p = body.vertices[0], &q = body.vertices[1];
    const plane::Flight flight =
        plane::cast(world_, places[p.cell.unit], {p.position[0], p.position[1]}, {q.position[0], q.position[1]});
    if (!crosses_ && (flight.outcome != plane::Flight::kReached || flight.cells.back() != places[q.cell.unit])) {
      return "an edge of a body passes a wall";
    }
  }
  return "";
}

/// From a segment, over unit_.
double PlaneCuts::distance(const plane::Vec& p, const plane::Vec& a, const plane::Vec& b) const {
  const plane::Vec u{(b[0] - a[0]) / unit_, (b[1] - a[1]) / unit_}, w{(p[0] - a[0]) / unit_, (p[1] - a[1]) / unit_};
  const double length = std::hypot(u[0], u[1]);
  if (!(length > 0)) return std::hypot(w[0], w[1]);
  const double t = std::min(std::max((w[0] * (u[0] / length) + w[1] * (u[1] / length)) / length, 0.0), 1.0);
  return std::hypot(w[0] - t * u[0], w[1] - t * u[1]);
}

/// Over unit_: how far from a place its coordinates and what follows from them can be.
double PlaneCuts::rounding(const plane::Vec& p) const { return 1e-12 * (1 + std::hypot(p[0] / unit_, p[1] / unit_)); }

/// Ends of the cut's sides are as near to the path as was reported, and the path to the cut, in the cells that were
/// split; sides have before and behind of the path on their sides.
std::string PlaneCuts::check_cut(const Path& path, const plane::World& before, const std::vector<uint32_t>& numbers,
                                 const dsw_change& report, bool unsewn) {
  const Map<2>& map = env().map;
  const double slack = report.distance / unit_ * (1 + 1e-9) + rounding(path[0]);
  std::vector<std::array<plane::Vec, 2>> sides;
  const std::vector<dsw_cut_face> faces = cut_faces(environment_);
  if (faces.size() != report.face_count) return "sides of the cut are counted wrongly";
  for (const dsw_cut_face& f : faces) {
    if (!map.is_alive(f.front.volume, f.front.generation) || !map.is_alive(f.back.volume, f.back.generation)) {
      return "a side of the cut is not alive";
    }
    const dsw::Cell front = map.cell(f.front.volume), back = map.cell(f.back.volume);
    const HalfFacet h = map.half_facet(front, f.front.local), o = map.half_facet(back, f.back.local);
    if (unsewn ? map.opposite(h).valid() || map.opposite(o).valid() : map.opposite(h) != o) {
      return "a side of the cut is not joined as it should be";
    }
    const double *const a = env().point(front, f.front.local), *const b = env().point(
                                                                   front, (f.front.local + 1) % map.vertices_of(front));
    sides.push_back({plane::Vec{a[0], a[1]}, plane::Vec{b[0], b[1]}});
    for (const plane::Vec& end : sides.back()) {
      double least = HUGE_VAL;
      for (size_t i = 0; i + 1 < path.size(); ++i) least = std::min(least, distance(end, path[i], path[i + 1]));
      if (!coarse_ && least > slack) return "the cut is farther from the path than reported";
      ++sides_checked;
    }
  }
  const std::string mixed_up = check_sides(path);
  if (!mixed_up.empty()) return mixed_up;
  for (const dsw_vertex_origin& v : cut_vertices(environment_)) {
    if (!(v.weights[0] > 0 && v.weights[1] > 0) || std::fabs(v.weights[0] + v.weights[1] - 1) > 1e-15) return "weights";
    const plane::Vec &a = world_.points[v.from[0].index], &b = world_.points[v.from[1].index];
    if (distance(world_.points[v.vertex.index], mix(a, b, v.weights[1]), mix(a, b, v.weights[1])) > rounding(a))
      return "a vertex of the cut is not where it is said to be";
  }
  if (coarse_ || crosses_) return "";
  std::map<uint32_t, int> heirs;
  for (const dsw_volume_change& change : changes(environment_)) ++heirs[change.before.index];
  plane::World passable = before;
  std::fill(passable.cell_marked.begin(), passable.cell_marked.end(), char{0});
  for (plane::Side& side : passable.sides) side.marked = false;
  // A path that leaves the environment and comes back is cut in one of its parts only.
  for (size_t k = 0; path.size() > 2 && k + 1 < path.size(); ++k) {
    const int cell = plane::locate(passable, path[k]);
    if (cell < 0 || plane::cast(passable, cell, path[k], path[k + 1]).outcome != plane::Flight::kReached) return "";
  }
  for (int i = 0; i < 20; ++i) {
    const size_t k = rng_.below(path.size() - 1);
    const plane::Vec p = mix(path[k], path[k + 1], rng_.unit());
    const int cell = plane::locate(before, p);
    if (cell < 0 || heirs[numbers[static_cast<size_t>(cell)]] < 2) continue;
    // Where the path runs along a side, its rounded points can lie on the other side of that.
    const std::vector<int>& loop = before.cells[static_cast<size_t>(cell)];
    double rim = HUGE_VAL, least = HUGE_VAL;
    for (size_t j = 0; j < loop.size(); ++j) {
      const auto a = static_cast<size_t>(loop[j]), b = static_cast<size_t>(loop[(j + 1) % loop.size()]);
      rim = std::min(rim, distance(p, before.points[a], before.points[b]));
    }
    if (rim < rounding(p)) continue;
    for (const auto& side : sides) least = std::min(least, distance(p, side[0], side[1]));
    if (least > slack) return "the path is farther from the cut than reported";
    ++points_checked;
  }
  return "";
}

/// Exactly: beside a vertex that came the edge goes on, on either side of the cut, to that end of it that is there.
/// Between two vertices that there were, at least one neighbour of theirs is where it should be; if a path ends, that
/// hangs on more.
std::string PlaneCuts::check_sides(const Path& path) const {
  const Map<2>& map = env().map;
  const PathTruth truth(world_, path);
  std::map<uint32_t, std::array<int, 2>> edges;
  for (const dsw_vertex_origin& v : cut_vertices(environment_)) {
    edges[v.vertex.index] = {static_cast<int>(v.from[0].index), static_cast<int>(v.from[1].index)};
  }
  for (const dsw_cut_face& f : cut_faces(environment_)) {
    bool all_old = true, right = false;
    for (const int side : {-1, 1}) {  // behind the path is on its left
      const dsw_face_id face = side < 0 ? f.front : f.back;
      const dsw::Cell c = map.cell(face.volume);
      const uint32_t n = map.vertices_of(c);
      for (const uint32_t end : {0u, 1u}) {
        const uint32_t vertex = map.vertex(c, (face.local + end) % n);
        const auto beside = static_cast<int>(map.vertex(c, (face.local + (end == 0 ? n - 1 : 2)) % n));
        if (edges.count(vertex) == 0) {
          right = right || truth.left(0, beside) == side;
          continue;
        }
        all_old = false;
        const auto [a, b] = edges[vertex];
        std::vector<size_t> by;
        for (size_t k = 0; k + 1 < path.size(); ++k) {
          if (truth.crosses(k, a, b)) by.push_back(k);
        }
        if (by.empty()) return "a vertex of the cut is on an edge that the path does not cross";
        if (by.size() != 1) continue;  // the path has come back from somewhere else
        if (beside != (truth.left(by[0], a) == side ? a : b)) return "before and behind of the path are mixed up";
      }
    }
    if (through_all_ && all_old && !right) return "before and behind of the path are mixed up";
  }
  return "";
}

std::string PlaneCuts::check_opening(const dsw_change& report, double width) {
  const std::vector<dsw_vertex_origin> vertices = cut_vertices(environment_);
  if (vertices.size() != 2 * report.vertices_parted) return "vertices that come apart are counted wrongly";
  for (size_t i = 0; i < vertices.size(); i += 2) {
    const plane::Vec &p = world_.points[vertices[i].vertex.index], &q = world_.points[vertices[i + 1].vertex.index];
    const double apart = unit_ * std::hypot((p[0] - q[0]) / unit_, (p[1] - q[1]) / unit_);
    if (coarse_) continue;
    if (apart < report.smallest_width * (1 - 1e-9) || apart > report.largest_width * (1 + 1e-9)) return "widths";
  }
  const double slack = unit_ * rounding({env().upper[0], env().upper[1]});
  if (!coarse_ && report.largest_width > width * (1 + 1e-9) + slack) return "a crack opens too far";
  const std::vector<dsw_cut_face> faces = cut_faces(environment_);
  if (faces.size() != report.face_count) return "sides that open are counted wrongly";
  const std::vector<dsw_volume_change> all = changes(environment_);
  std::set<uint32_t> gaps;
  for (size_t i = all.size() - faces.size(); i < all.size(); ++i) gaps.insert(all[i].after.index);
  for (size_t i = 0; i < faces.size(); ++i) {
    const dsw_volume_id gap = all[all.size() - faces.size() + i].after;
    const Map<2>& map = env().map;
    const dsw::Cell c = map.cell(gap.index);
    if (!map.is_alive(gap.index, gap.generation) || map.marked(c)) return "a gap is no passable cell";
    size_t lips = 0, walls = 0, spaces = 0;
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet o = map.opposite(map.half_facet(c, f));
      if (!o.valid()) continue;
      const dsw::Cell beyond = map.cell_of(o);
      const dsw_face_id id = face_id(map, o);
      const bool is_lip = same(id, faces[i].front) || same(id, faces[i].back);
      lips += is_lip ? 1u : 0u;
      walls += is_lip && map.marked(beyond) ? 1u : 0u;
      spaces += !is_lip && !map.marked(beyond) && gaps.count(map.index(beyond)) == 0 ? 1u : 0u;
    }
    into_space += walls == 2 && spaces != 0 ? 1u : 0u;
    if (lips != 2) return "a gap does not lie between its lips";
  }
  return "";
}

}  // namespace dsw::oracle
