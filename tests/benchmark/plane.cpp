// Particles in Delaunay triangulations of the plane: a short move of ours, which finds what is in the way and is
// verified, beside CGAL's walk from triangle to triangle, which only finds where the target is.
#include "parts.h"

#include "plane_case.h"
#include "timing.h"

namespace dsw::bench {

namespace {

using namespace plane;

/** Points that step about in the middle of the square, the same for all. */
class Steps {
 public:
  Steps(std::size_t count, double length) : length_(length) {
    for (std::size_t i = 0; i < 2 * count; ++i) at_.push_back(random_.uniform(0.1, 0.9));
  }
  const std::vector<double>& at() const { return at_; }
  void next() {
    for (std::size_t i = 0; i < at_.size(); i += 2) {
      const double angle = random_.uniform(0, 6.283185307179586);
      at_[i] = inside(at_[i] + length_ * std::cos(angle));
      at_[i + 1] = inside(at_[i + 1] + length_ * std::sin(angle));
    }
  }

 private:
  static double inside(double x) { return std::min(std::max(x, 0.1), 0.9); }

  scenes::Random random_{5};
  double length_;
  std::vector<double> at_;
};

/** Particles of a scene with some features. */
struct Crowd {
  dsw_scene* scene = nullptr;
  std::vector<dsw_particle_id> particles;

  Crowd(dsw_environment* environment, std::uint32_t features, const std::vector<double>& at)
      : particles(at.size() / 2) {
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = features;
    check(dsw_scene_create(environment, &desc, &scene));
    check(dsw_scene_create_particles(scene, at.data(), particles.size(), 0, nullptr, particles.data(), nullptr));
  }
  ~Crowd() { dsw_scene_destroy(scene); }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  void move(const std::vector<double>& to) {
    check(dsw_scene_move_particles(scene, particles.data(), particles.size(), to.data(), 0, nullptr, nullptr));
  }
};

struct Figures {
  double tests_per_cast, bytes_per_triangle;
};

/** `step`: in edges of triangles that were all alike. */
Figures run_size(const std::string& key, std::size_t count, double step, bool quick, Report& report) {
  constexpr std::size_t kParticles = 1000;  // fewer than are worth threads
  const Triangles triangles(count);
  Steps steps(kParticles, step * edge_of(count));
  Crowd ours(triangles.environment, 0, steps.at());
  Crowd counted(triangles.environment, DSW_FEATURE_STATISTICS, steps.at());
  std::vector<Delaunay::Face_handle> faces;
  for (std::size_t i = 0; i < kParticles; ++i) {
    faces.push_back(triangles.delaunay.locate(Kernel::Point_2(steps.at()[2 * i], steps.at()[2 * i + 1])));
  }
  std::vector<double> our_ns, cgal_ns;
  double differences = 0;
  for (int round = 0; round < (quick ? 20 : 100); ++round) {
    steps.next();
    const std::vector<double>& to = steps.at();
    our_ns.push_back(time_ns([&] { ours.move(to); }) / kParticles);
    cgal_ns.push_back(time_ns([&] {
                        for (std::size_t i = 0; i < kParticles; ++i) {
                          faces[i] = triangles.delaunay.locate(Kernel::Point_2(to[2 * i], to[2 * i + 1]), faces[i]);
                        }
                      }) /
                      kParticles);
    counted.move(to);
    std::vector<dsw_volume_id> volumes(kParticles);
    check(dsw_scene_get_particle_positions(ours.scene, ours.particles.data(), kParticles, nullptr, 0, volumes.data()));
    for (std::size_t i = 0; i < kParticles; ++i) differences += volumes[i].index != faces[i]->info() ? 1 : 0;
  }
  dsw_statistics s{};
  s.struct_size = sizeof s;
  check(dsw_scene_get_statistics(counted.scene, &s));
  dsw_environment_info info{};
  info.struct_size = sizeof info;
  check(dsw_environment_get_info(triangles.environment, &info));
  const double casts = static_cast<double>(s.casts);
  const Figures figures{static_cast<double>(s.orientation_tests) / casts,
                        static_cast<double>(info.memory_bytes) / info.volume_count};
  report.set("plane." + key + ".ns_per_move", median(our_ns));
  report.set("plane." + key + ".cgal_ns_per_locate", median(cgal_ns));
  report.set("plane." + key + ".vs_cgal", median_ratio(cgal_ns, our_ns));
  report.set("plane." + key + ".differences", differences);
  report.set("plane." + key + ".cells_per_cast", static_cast<double>(s.volumes_visited) / casts);
  report.set("plane." + key + ".orientation_tests_per_cast", figures.tests_per_cast);
  return figures;
}

}  // namespace

void run_plane(const Options& options, Report& report) {
  run_plane_rays(options, report);
  run_size("1e3", 1000, 0.1, options.quick, report);
  run_size("1e4", 10000, 0.1, options.quick, report);
  run_size("1e5", 100000, 0.1, options.quick, report);
  const Figures large = run_size("1e6", 1000000, 0.1, options.quick, report);
  run_size("1e5.farther", 100000, 0.3, options.quick, report);
  run_size("1e5.far", 100000, 3, options.quick, report);
  report.set("plane.orientation_tests_per_cast", large.tests_per_cast);
  report.set("plane.bytes_per_triangle", large.bytes_per_triangle);
}

}  // namespace dsw::bench
