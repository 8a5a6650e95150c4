#include "plane_cuts.h"
#include "snapshot_support.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

std::vector<dsw_volume_id> whole_volumes(const EnvironmentPtr& environment) {
  const dsw_volume_id* volumes = change_of(environment.get()).whole;
  const size_t count = change_of(environment.get()).whole_count;
  return {volumes, volumes + count};
}
}  // namespace

PlaneCuts::PlaneCuts(const plane::Turn& turn, uint64_t seed, bool inhabited)
    : rng_(seed),
      world_(plane::make_world(turn, rng_)),
      environment_(plane::make_environment(turn, world_, rng_)),
      coarse_(turn.coarse()) {
  if (environment_ == nullptr) return;
  for (size_t k = 0; k < 2; ++k) size_ = std::max(size_, env().upper[k] - env().lower[k]);
  unit_ = std::exp2(std::floor(std::log2(size_)));
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = rng_.chance(0.5) ? uint32_t{DSW_FEATURE_LIVE_CHANGES} : 0;
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_scene_create(environment_.get(), &desc, &scene), DSW_STATUS_OK) << dsw_last_error_message();
  scene_.reset(scene);
  read();
  mark();
  if (inhabited) add_inhabitants();
  // From here on there are tables for changes, which are saved.
  dsw_environment_tear_faces(environment_.get(), nullptr, nullptr, 0, 0, nullptr);
}

void PlaneCuts::add_inhabitants() {
  for (int i = 0; i < 12; ++i) {
    const plane::Vec p = some_point();
    dsw_particle_id id;
    dsw_particle_create(scene_.get(), p.data(), {0, 0}, &id);
  }
  for (int tries = 0; tries < 6; ++tries) {
    const plane::Vec p = some_point();
    const double share = rng_.chance(0.5) ? 1 : 0.2;
    const plane::Vec beyond = some_point(), q = mix(p, beyond, share);
    const double positions[4] = {p[0], p[1], q[0], q[1]};
    const uint32_t edge[2] = {0, 1};
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.positions = positions;
    desc.vertex_count = 2;
    desc.edges = edge;
    desc.edge_count = 1;
    desc.level = rng_.chance(0.5) ? DSW_LEVEL_EDGES : DSW_LEVEL_EDGES_SWEPT;
    dsw_body_id id;
    dsw_body_create(scene_.get(), &desc, &id);
  }
}

/// The oracle's picture, with sides as the environment has joined them.
void PlaneCuts::read() {
  const Environment<2>& e = env();
  world_ = plane::World();
  numbers_.clear();
  world_.points.resize(e.map.vertex_count);
  for (uint32_t v = 0; v < e.map.vertex_count; ++v) std::copy_n(e.point(v), 2, world_.points[v].begin());
  std::map<uint32_t, int> places;
  for_each_cell(e.map, [&](dsw::Cell c) {
    places[c.unit] = static_cast<int>(numbers_.size());
    numbers_.push_back(e.map.index(c));
    world_.cells.emplace_back();
    for (uint32_t k = 0; k < e.map.vertices_of(c); ++k) {
      world_.cells.back().push_back(static_cast<int>(e.map.vertex(c, k)));
    }
    world_.cell_marked.push_back(e.map.marked(c) ? 1 : 0);
  });
  for_each_cell(e.map, [&](dsw::Cell c) {
    for (uint32_t f = 0; f < e.map.facets_of(c); ++f) {
      const HalfFacet h = e.map.half_facet(c, f), o = e.map.opposite(h);
      const dsw::Cell beyond = o.valid() ? e.map.cell_of(o) : dsw::Cell{};
      if (o.valid() && o.word < h.word) continue;
      plane::Side side{};
      side.a = static_cast<int>(e.map.vertex(c, f));
      side.b = static_cast<int>(e.map.vertex(c, (f + 1) % e.map.vertices_of(c)));
      side.cell[0] = places[c.unit];
      side.cell[1] = o.valid() ? places[beyond.unit] : -1;
      side.local[0] = static_cast<int>(f);
      side.local[1] = o.valid() ? static_cast<int>(e.map.local_of(o, beyond)) : -1;
      side.marked = e.map.facet_marked(h);
      world_.sides.push_back(side);
    }
  });
}

std::string PlaneCuts::saved() const { return saved_both(scene_.get()); }

dsw::Cell PlaneCuts::some_cell() { return env().map.cell(numbers_[rng_.below(numbers_.size())]); }

plane::Vec PlaneCuts::vertex_near(dsw::Cell c) {
  const double* const p = env().point(c, rng_.below(env().map.vertices_of(c)));
  return {p[0], p[1]};
}

/// In cells, on sides, at vertices.
plane::Vec PlaneCuts::some_point() {
  const dsw::Cell c = some_cell();
  const plane::Vec p = vertex_near(c), q = vertex_near(c), r = vertex_near(rng_.chance(0.7) ? c : some_cell());
  if (rng_.chance(0.1)) return p;
  if (rng_.chance(0.1)) return mix(p, q, 0.5);
  const double across = rng_.unit(), along = rng_.unit();
  return mix(mix(p, q, along), r, across);
}

/// Through the environment somewhere, through vertices and along sides; straight, bent, folded, or of no extent; small
/// or large.
PlaneCuts::Path PlaneCuts::some_path() {
  Path path{some_point()};
  const uint32_t count = 2 + (rng_.chance(0.5) ? 0 : rng_.below(6u));
  const double sizes[] = {1e-6, 0.02, 0.2, 0.5, 3};
  const double reach = size_ * sizes[rng_.below(5u)];
  while (path.size() < count) {
    const plane::Vec last = path.back();
    plane::Vec next = some_point();
    switch (rng_.below(6u)) {
      case 0:
        next = vertex_near(some_cell());
        break;
      case 1:
        next = {last[0] + rng_.range(-reach, reach), last[1] + rng_.range(-reach, reach)};
        break;
      case 2:
        next = {last[0], next[1]};
        break;
      case 3:
        if (rng_.chance(0.2)) next = last;
        break;
      default:
        break;
    }
    path.push_back(next);
  }
  if (rng_.chance(0.6)) {  // on to the outside
    path.front() = mix(path[0], path[1], -3 - 10 * rng_.unit());
    path.back() = mix(path[count - 2], path[count - 1], 4 + 10 * rng_.unit());
  }
  for (const plane::Vec& p : path) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return {some_point(), some_point()};
  }
  return path;
}

dsw_status PlaneCuts::cut(const Path& path, const dsw_cut_desc& given) {
  dsw_cut_desc desc = given;
  desc.points = path[0].data();
  desc.rows = static_cast<uint32_t>(path.size());
  desc.columns = 1;
  const plane::World before = world_;
  const std::vector<uint32_t> numbers = numbers_;
  dsw_change report = empty_change();
  const dsw_status status = dsw_environment_cut(environment_.get(), &desc, &report);
  if (status != DSW_STATUS_OK) return status;
  read();
  split += report.volumes_split;
  whole += report.whole_count;
  const bool unsewn = (desc.flags & DSW_CUT_UNSEW) != 0;
  if (unsewn) {
    for (const dsw_cut_face& f : cut_faces(environment_)) unsewn_.push_back({f.front, f.back});
  }
  wrong_ = check_cut(path, before, numbers, report, unsewn);
  return status;
}

dsw_status PlaneCuts::tear() {
  std::vector<dsw_face_id> faces;
  std::vector<double> loads;
  for (uint32_t i = 0; i < 3; ++i) {
    const dsw::Cell c = some_cell();
    faces.push_back(face_id(env().map, env().map.half_facet(c, rng_.below(env().map.facets_of(c)))));
    loads.push_back(rng_.unit());
  }
  const dsw_status status =
      dsw_environment_tear_faces(environment_.get(), faces.data(), loads.data(), faces.size(), 0.5, nullptr);
  if (status == DSW_STATUS_OK) {
    for (const dsw_cut_face& f : cut_faces(environment_)) unsewn_.push_back({f.front, f.back});
  }
  return status;
}

/// Lips that cuts and tears have left, or sides between cells of a cluster that lie on different sides of a line.
dsw_status PlaneCuts::open() {
  const Map<2>& map = env().map;
  std::vector<dsw_cut_face> faces;
  std::set<uint32_t> named;
  const auto is_alive = [&](dsw_face_id f) { return map.is_alive(f.volume, f.generation); };
  for (const auto& pair : unsewn_) {
    if (!is_alive(pair[0]) || !is_alive(pair[1]) || rng_.chance(0.2)) continue;
    const HalfFacet h = map.half_facet(map.cell(pair[0].volume), pair[0].local);
    const HalfFacet o = map.half_facet(map.cell(pair[1].volume), pair[1].local);
    if (map.opposite(h).valid() || named.count(h.word) + named.count(o.word) != 0) continue;
    named.insert({h.word, o.word});
    faces.push_back({pair[0], pair[1]});
  }
  if (faces.empty() || rng_.chance(0.5)) {
    const plane::Vec p = some_point(), q = some_point();
    const auto is_before = [&](dsw::Cell c) {
      double at[2];
      centre(env(), c, at);
      return (at[0] - p[0]) / unit_ * ((q[1] - p[1]) / unit_) > (at[1] - p[1]) / unit_ * ((q[0] - p[0]) / unit_);
    };
    const bool only_walls = rng_.chance(0.5);
    for (const plane::Side& side : world_.sides) {
      if (side.cell[1] < 0) continue;
      const dsw::Cell c = map.cell(numbers_[static_cast<size_t>(side.cell[0])]),
                      beyond = map.cell(numbers_[static_cast<size_t>(side.cell[1])]);
      if (is_before(c) == is_before(beyond) || rng_.chance(0.1)) continue;
      if (only_walls && !(map.marked(c) && map.marked(beyond))) continue;
      const dsw_face_id id = face_id(map, map.half_facet(c, static_cast<uint32_t>(side.local[0])));
      faces.push_back({id, id});
    }
  }
  const double widths[] = {1e-9, 0.01, 0.1, 1};
  dsw_open_crack_desc desc = defaults(dsw_open_crack_desc_init);
  desc.faces = faces.data();
  desc.face_count = faces.size();
  desc.width = std::max(size_ * widths[rng_.below(4u)], 5e-324);
  desc.region = rng_.chance(0.5) ? 99 : 0;
  dsw_change report = empty_change();
  const dsw_status status = dsw_environment_open_crack(environment_.get(), &desc, &report);
  if (status != DSW_STATUS_OK) return status;
  read();
  opened += report.face_count;
  parted += report.vertices_parted;
  wrong_ = check_opening(report, desc.width);
  return status;
}

/// One or two closed lines, of any shape and sense.
dsw_status PlaneCuts::carve() {
  Path points;
  std::vector<uint32_t> segments;
  for (uint32_t loops = 1 + rng_.below(2u); loops > 0; --loops) {
    const auto first = static_cast<uint32_t>(points.size()), count = 2 + rng_.below(5u);
    for (uint32_t i = 0; i < count; ++i) {
      points.push_back(some_point());
      segments.insert(segments.end(), {first + i, first + (i + 1) % count});
    }
  }
  dsw_carve_desc desc = defaults(dsw_carve_desc_init);
  desc.points = points[0].data();
  desc.point_count = points.size();
  desc.triangles = segments.data();
  desc.triangle_count = segments.size() / 2;
  desc.flags = rng_.chance(0.2) ? uint32_t{DSW_CARVE_WHOLE} : 0;
  if (rng_.chance(0.5)) desc.start = volume_id(env().map, some_cell());
  dsw_change report = empty_change();
  const dsw_status status = dsw_environment_carve(environment_.get(), &desc, &report);
  if (status == DSW_STATUS_OK) split += report.volumes_split;
  return status;
}

dsw_status PlaneCuts::tie() {
  const Path path = some_path();
  dsw_tie_desc desc = defaults(dsw_tie_desc_init);
  desc.points = path[0].data();
  desc.point_count = path.size();
  if (rng_.chance(0.5)) desc.start = volume_id(env().map, some_cell());
  dsw_change report = empty_change();
  const dsw_status status = dsw_environment_tie(environment_.get(), &desc, &report);
  if (status == DSW_STATUS_OK) split += report.volumes_split;
  return status;
}

dsw_status PlaneCuts::mark() {
  std::vector<dsw_volume_id> volumes;
  for (const uint32_t number : numbers_) {
    if (rng_.chance(0.25)) volumes.push_back(volume_id(env().map, env().map.cell(number)));
  }
  const dsw_mark as = rng_.chance(0.7) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  return dsw_environment_mark_volumes(environment_.get(), volumes.data(), volumes.size(), as, DSW_MARK_SKIP_OCCUPIED,
                                      nullptr);
}

dsw_status PlaneCuts::call(Operation operation) {
  switch (operation) {
    case kTear:
      return tear();
    case kOpen:
      return open();
    case kCarve:
      return carve();
    case kTie:
      return tie();
    case kMark:
      return mark();
    default:
      break;
  }
  dsw_cut_desc desc = defaults(dsw_cut_desc_init);
  desc.flags = rng_.chance(0.3) ? uint32_t{DSW_CUT_UNSEW} : 0;
  const double snaps[] = {0, 1e-12, 0.25, 0.05};
  desc.snap = snaps[rng_.below(4u)];
  if (rng_.chance(0.7)) desc.start = volume_id(env().map, some_cell());
  return cut(some_path(), desc);
}

std::string PlaneCuts::step() {
  const Operation operations[] = {kCut, kCut, kCut, kCut, kTear, kOpen, kOpen, kCarve, kTie, kMark};
  const Operation operation = operations[rng_.below(10u)];
  const std::string before = saved();
  wrong_.clear();
  const dsw_status status = call(operation);
  if (status == DSW_STATUS_OK) {
    ++done[operation];
  } else if (status == DSW_STATUS_OCCUPIED) {
    ++occupied[operation];
    if (saved() != before) return "something has changed though it was occupied";
  } else {
    return std::to_string(operation) + ": " + dsw_last_error_message();
  }
  read();
  return wrong_.empty() ? check(operation == kCut || operation == kCarve || operation == kTie) : wrong_;
}

/// Cells with points farther from the line than the cut is, on both sides, have to be known as whole.
std::string PlaneCuts::cut_all(uint64_t seed) {
  Rng rng(seed);
  const double angle = rng.range(0, 6.283);
  const plane::Vec middle = some_point(), way{std::cos(angle) * 10 * size_, std::sin(angle) * 10 * size_};
  const Path path{{middle[0] - way[0], middle[1] - way[1]}, {middle[0] + way[0], middle[1] + way[1]}};
  const auto height = [&](const plane::Vec& p) {
    return -std::sin(angle) * ((p[0] - middle[0]) / unit_) + std::cos(angle) * ((p[1] - middle[1]) / unit_);
  };
  dsw_cut_desc desc = defaults(dsw_cut_desc_init);
  desc.start = volume_id(env().map, some_cell());
  through_all_ = true;
  std::set<uint32_t> is_whole;
  for (;;) {
    wrong_.clear();
    if (cut(path, desc) != DSW_STATUS_OK) return dsw_last_error_message();
    if (wrong_.empty()) wrong_ = check(true);
    if (!wrong_.empty()) return wrong_;
    const std::vector<dsw_volume_id> kept = whole_volumes(environment_);
    for (const dsw_volume_id id : kept) is_whole.insert(id.index);
    const double slack = 0.011 * size_ / unit_ + rounding(middle);
    const dsw_volume_id last = desc.start;
    desc.start = {0, 0};
    for (size_t i = 0; i < world_.cells.size(); ++i) {
      bool left = false, right = false;
      for (const int v : world_.cells[i]) {
        const double h = height(world_.points[static_cast<size_t>(v)]);
        left = left || h > slack;
        right = right || h < -slack;
      }
      if (!coarse_ && left && right && is_whole.count(numbers_[i]) == 0)
        desc.start = volume_id(env().map, env().map.cell(numbers_[i]));
    }
    if (desc.start.generation == 0) return "";
    // The line meets an environment that is not convex in several parts; each is a cut of its own.
    if (same(desc.start, last)) return "a cell is crossed, and neither split nor known as whole";
  }
}

}  // namespace dsw::oracle
