// Points located without a hint in a million tetrahedra, beside CGAL's triangulation hierarchy on the same
// tetrahedra. The nearest obstacle without a limit, beside CGAL's tree of boxes of the outer boundary.
#include "parts.h"

#include "timing.h"

#include "dartsweep/dartsweep.h"
#include "scenes/random.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace dsw::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel>;
using Storage = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Storage, CGAL::Fast_location>;

constexpr std::size_t kPoints = 20000;

void expect_ok(dsw_status status) {
  if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
}

struct Destroy {
  void operator()(dsw_environment* environment) const { dsw_environment_destroy(environment); }
  void operator()(dsw_scene* scene) const { dsw_scene_destroy(scene); }
};
using EnvironmentOwner = std::unique_ptr<dsw_environment, Destroy>;

/** Tetrahedra that both libraries get: cell i of the mesh has i as CGAL's info. */
struct Tetrahedra {
  Delaunay delaunay;
  std::vector<double> points;
  std::vector<std::int32_t> corners;

  explicit Tetrahedra(std::size_t cells) {
    scenes::Random random(11);
    std::vector<Kernel::Point_3> places(static_cast<std::size_t>(static_cast<double>(cells) / 6.7));
    for (auto& place : places) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      place = Kernel::Point_3(x, y, z);
    }
    delaunay.insert(places.begin(), places.end());
    for (const auto& vertex : delaunay.finite_vertex_handles()) {
      vertex->info() = static_cast<std::uint32_t>(points.size() / 3);
      points.insert(points.end(), {vertex->point().x(), vertex->point().y(), vertex->point().z()});
    }
    for (const auto& cell : delaunay.finite_cell_handles()) {
      cell->info() = static_cast<std::uint32_t>(corners.size() / 4);
      for (int i = 0; i < 4; ++i) corners.push_back(static_cast<std::int32_t>(cell->vertex(i)->info()));
    }
  }
  EnvironmentOwner make(std::uint32_t flags) const {
    dsw_environment_desc desc;
    dsw_environment_desc_init(&desc, sizeof desc);
    desc.flags = flags;
    desc.points = points.data();
    desc.point_count = points.size() / 3;
    desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
    desc.volume_count = corners.size() / 4;
    desc.index_bytes = 4;
    desc.connectivity = corners.data();
    desc.connectivity_count = corners.size();
    dsw_environment* environment = nullptr;
    expect_ok(dsw_environment_create(nullptr, &desc, &environment, nullptr));
    return EnvironmentOwner(environment);
  }
};

std::vector<double> random_points(std::size_t count, double low, double high, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<double> points(3 * count);
  for (double& x : points) x = random.uniform(low, high);
  return points;
}

std::uint32_t locate(const dsw_environment* environment, const double* point) {
  dsw_volume_id volume;
  expect_ok(dsw_environment_locate(environment, point, {0, 0}, &volume, nullptr));
  return volume.generation == 0 ? UINT32_MAX : volume.index;
}

/** Microseconds of processor time a point, and of the slowest thousandth. */
struct Times {
  double mean = 0, slowest = 0;
};

template <class Find>
Times time_points(const std::vector<double>& points, Find find) {
  std::vector<double> times(points.size() / 3);
  const double all = cpu_time_ns([&] {
    for (std::size_t i = 0; i < times.size(); ++i) find(&points[3 * i]);
  });
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = time_ns([&] { find(&points[3 * i]); });
  std::sort(times.begin(), times.end());
  return {1e-3 * all / static_cast<double>(times.size()), 1e-3 * times[times.size() - times.size() / 1000 - 1]};
}

std::uint64_t bytes_of(const dsw_environment* environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  expect_ok(dsw_environment_get_info(environment, &info));
  return info.memory_bytes;
}

/** A wave through all points, so that what is known of where cells lie has to be found out anew. */
void run_moved(const Tetrahedra& tets, const std::vector<double>& points, Report& report) {
  const EnvironmentOwner environment = tets.make(0);
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* made = nullptr;
  expect_ok(dsw_scene_create(environment.get(), &desc, &made));
  const std::unique_ptr<dsw_scene, Destroy> scene(made);
  for (int i = 0; i < 20; ++i) locate(environment.get(), &points[0]);
  std::vector<double> next[2] = {tets.points, tets.points}, first, later;
  for (int step = 1; step <= 6; ++step) {
    std::vector<double>& to = next[step % 2];
    for (std::size_t i = 0; i < to.size(); i += 3)
      to[i + 2] = tets.points[i + 2] + 0.02 * std::sin(6 * tets.points[i] + step);
    expect_ok(
        dsw_environment_deform(dsw_scene_get_environment(scene.get()), to.data(), to.size() / 3, nullptr, nullptr));
    first.push_back(1e-6 * cpu_time_ns([&] { locate(environment.get(), &points[0]); }));
    later.push_back(time_points(points, [&](const double* p) { locate(environment.get(), p); }).mean);
  }
  report.set("locate.moved_first_ms.n1e6", median(first));
  report.set("locate.moved_us.n1e6", median(later));
}

dsw_nearest nearest_of(const dsw_environment* environment, const double* point, dsw_volume_id volume) {
  dsw_nearest nearest;
  expect_ok(dsw_environment_find_nearest(environment, point, volume, HUGE_VAL, &nearest));
  return nearest;
}

/** Times of dsw_environment_find_nearest without a limit, in microseconds a point, and the volumes looked at. */
struct NearestTimes {
  double mean = 0, median_of_all = 0, slowest = 0, cells = 0, differ = 0;
};

/** `without` has no tree: the first points are asked there, too, and must get the same bits. */
NearestTimes time_nearest(const dsw_environment* environment, const dsw_environment* without,
                          const std::vector<double>& points, std::size_t count, std::size_t compared) {
  std::vector<double> times;
  NearestTimes result;
  for (std::size_t i = 0; i < count; ++i) {
    dsw_volume_id volume;
    dsw_location place;
    dsw_nearest nearest;
    const double* const p = &points[3 * i];
    expect_ok(dsw_environment_locate(environment, p, {0, 0}, &volume, &place));
    if (place != DSW_LOCATION_PASSABLE) continue;
    times.push_back(1e-3 * cpu_time_ns([&] { nearest = nearest_of(environment, p, volume); }));
    result.cells += nearest.volumes_visited;
    if (i >= compared) continue;
    dsw_nearest other = nearest_of(without, p, volume);
    other.volumes_visited = nearest.volumes_visited;
    result.differ += std::memcmp(&other, &nearest, sizeof other) == 0 ? 0 : 1;
  }
  const auto asked = static_cast<double>(times.size());
  result.mean = std::accumulate(times.begin(), times.end(), 0.0) / asked;
  result.cells /= asked;
  std::sort(times.begin(), times.end());
  result.median_of_all = times[times.size() / 2];
  result.slowest = times[times.size() - times.size() / 100 - 1];
  return result;
}

/** The outer boundary of all tetrahedra in CGAL's tree of boxes. */
class BoundaryTree {
 public:
  explicit BoundaryTree(const Delaunay& delaunay) {
    std::vector<Delaunay::Cell_handle> outer;
    delaunay.incident_cells(delaunay.infinite_vertex(), std::back_inserter(outer));
    for (const auto& cell : outer)
      triangles_.push_back(delaunay.triangle(cell, cell->index(delaunay.infinite_vertex())));
    tree_.rebuild(triangles_.begin(), triangles_.end());
    tree_.accelerate_distance_queries();
  }
  double distance(const double* p) const {
    return std::sqrt(tree_.squared_distance(Kernel::Point_3(p[0], p[1], p[2])));
  }

 private:
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
  std::vector<Kernel::Triangle_3> triangles_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

/** Where only the outer boundary is impassable, and then with single tetrahedra impassable everywhere. */
void run_nearest(const Tetrahedra& tets, dsw_environment* environment, dsw_environment* without,
                 const std::vector<double>& points, Report& report) {
  const std::uint64_t before = bytes_of(environment);
  double first = 0;  // until the tree is there: floods, and to make it
  for (std::size_t i = 0; bytes_of(environment) == before && i < 100; ++i) {
    dsw_volume_id volume;
    expect_ok(dsw_environment_locate(environment, &points[3 * i], {0, 0}, &volume, nullptr));
    first += 1e-6 * cpu_time_ns([&] { nearest_of(environment, &points[3 * i], volume); });
  }
  const NearestTimes flood = time_nearest(without, without, points, 100, 0);
  const NearestTimes tree = time_nearest(environment, without, points, kPoints / 4, 200);
  const NearestTimes deep =
      time_nearest(environment, without, random_points(kPoints / 4, 0.4, 0.6, 8), kPoints / 4, 20);
  const BoundaryTree peer(tets.delaunay);
  const Times cgal = time_points(points, [&](const double* p) { peer.distance(p); });
  report.set("nearest.unlimited_us.n1e6", tree.mean);
  report.set("nearest.unlimited_median_us.n1e6", tree.median_of_all);
  report.set("nearest.unlimited_slowest_us.n1e6", tree.slowest);
  report.set("nearest.unlimited_cells.n1e6", tree.cells);
  report.set("nearest.deep_us.n1e6", deep.mean);
  report.set("nearest.cgal_us.n1e6", cgal.mean);
  report.set("nearest.flood_us.n1e6", flood.mean);
  report.set("nearest.flood_cells.n1e6", flood.cells);
  report.set("nearest.first_ms.n1e6", first);
  report.set("nearest.bytes_per_cell.n1e6",
             static_cast<double>(bytes_of(environment) - before) / static_cast<double>(tets.corners.size() / 4));

  std::vector<dsw_volume_id> marked(300);
  const std::vector<double> places = random_points(marked.size(), 0.02, 0.98, 9);
  for (std::size_t i = 0; i < marked.size(); ++i) {
    expect_ok(dsw_environment_locate(environment, &places[3 * i], {0, 0}, &marked[i], nullptr));
  }
  for (dsw_environment* const each : {environment, without}) {
    expect_ok(dsw_environment_mark_volumes(each, marked.data(), marked.size(), DSW_MARK_IMPASSABLE, 0, nullptr));
  }
  const NearestTimes among = time_nearest(environment, without, points, kPoints / 4, 500);
  report.set("nearest.among_us.n1e6", among.mean);
  report.set("nearest.among_slowest_us.n1e6", among.slowest);
  report.set("nearest.differ.n1e6", tree.differ + deep.differ + among.differ);
}

}  // namespace

void run_locate(const Options& options, Report& report) {
  const Tetrahedra tets(1000000);
  const std::vector<double> inside = random_points(kPoints, 0.02, 0.98, 5), outside = random_points(kPoints, 1.1, 2, 6);
  const EnvironmentOwner environment = tets.make(0), without = tets.make(DSW_ENVIRONMENT_NO_LOCATE_TREE);
  const double cells = static_cast<double>(tets.corners.size() / 4);
  const std::uint64_t before = bytes_of(environment.get());
  const auto ours = [&](const double* p) { return locate(environment.get(), p); };
  const auto cgal = [&](const double* p) { return tets.delaunay.locate(Kernel::Point_3(p[0], p[1], p[2])); };

  double most = 0, scans = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    most = std::max(most, 1e-6 * cpu_time_ns([&] { ours(&inside[3 * i]); }));
    scans += 1e-6 * cpu_time_ns([&] { locate(without.get(), &inside[3 * i]); }) / 20;
  }
  double differ = 0;
  for (std::size_t i = 0; i < 1000; ++i) differ += ours(&inside[3 * i]) == cgal(&inside[3 * i])->info() ? 0 : 1;

  std::vector<double> of_ours, of_cgal, slowest, slowest_cgal;
  for (int round = 0; round < (options.quick ? 5 : 11); ++round) {
    const Times a = time_points(inside, ours), b = time_points(inside, cgal);
    of_ours.push_back(a.mean);
    of_cgal.push_back(b.mean);
    slowest.push_back(a.slowest);
    slowest_cgal.push_back(b.slowest);
  }
  report.set("locate.cells.n1e6", cells);
  report.set("locate.no_hint_us.n1e6", median(of_ours));
  report.set("locate.cgal_us.n1e6", median(of_cgal));
  report.set("locate.vs_cgal.n1e6", median_ratio(of_cgal, of_ours));
  report.set("locate.slowest_us.n1e6", median(slowest));
  report.set("locate.cgal_slowest_us.n1e6", median(slowest_cgal));
  report.set("locate.differ.n1e6", differ);
  report.set("locate.outside_us.n1e6", time_points(outside, ours).mean);
  report.set("locate.scan_ms.n1e6", scans);
  report.set("locate.first_ms.n1e6", most);
  report.set("locate.bytes_per_cell.n1e6", static_cast<double>(bytes_of(environment.get()) - before) / cells);
  run_moved(tets, inside, report);
  run_nearest(tets, environment.get(), without.get(), inside, report);
}

}  // namespace dsw::bench
