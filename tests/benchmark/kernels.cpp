// Every kernel that the processor has, on the same casts: the library must choose the fastest.
#include "parts.h"

#include "timing.h"
#include "walk_scenes.h"

#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace dsw::bench {

namespace {

struct Kernel {
  const char* name;
  std::uint32_t kernel;
};
constexpr Kernel kKernels[] = {{"fastest", DSW_KERNEL_FASTEST},
                               {"portable", DSW_KERNEL_PORTABLE},
                               {"avx2", DSW_KERNEL_AVX2},
                               {"avx512", DSW_KERNEL_AVX512}};

bool has(std::uint32_t kernel) {
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.kernel = kernel;
  dsw_context* context = nullptr;
  const dsw_status status = dsw_context_create(&desc, &context);
  if (status == DSW_STATUS_UNSUPPORTED) return false;
  check(status);
  check(dsw_context_destroy(context));
  return true;
}

}  // namespace

void run_kernels(const Options& options, Report& report) {
  const int rounds = options.quick ? 7 : 15;
  for (const std::string scene_name : {"hex", "hex_warped", "tet_short", "tet_long"}) {
    const WalkScene scene = make_walk_scene(scene_name, scene_name == "tet_long" ? 13500 : 90000);
    const WallMesh no_walls(scene.mesh.points, {});
    std::map<std::string, std::unique_ptr<World>> worlds;
    std::map<std::string, std::unique_ptr<Ours>> engines;
    for (const Kernel& kernel : kKernels) {
      if (!has(kernel.kernel)) continue;
      World& world = *(worlds[kernel.name] = std::make_unique<World>(scene.mesh, 1, false, kernel.kernel));
      Ours& engine = *(engines[kernel.name] = std::make_unique<Ours>(world, no_walls));
      engine.prepare(scene.prepare(world));
    }
    const Segments segments = scene.prepare(*worlds.at("fastest"));
    std::map<std::string, std::vector<double>> times;
    for (int round = 0; round < rounds; ++round) {
      for (const auto& [name, engine] : engines) times[name].push_back(time_casts(*engine, segments));
    }
    // All ran the last batch last: the reports must be the same bits.
    const std::size_t last = (segments.count() - 1) % segments.batch + 1;
    for (const auto& [name, engine] : engines) {
      if (std::memcmp(engine->flights().data(), engines.at("fastest")->flights().data(), last * sizeof(dsw_flight)) !=
          0) {
        throw std::runtime_error("kernel " + name + " gives other reports");
      }
      report.set("walk.kernel." + name + "." + scene_name + "_ns", median(times[name]));
    }
    double least = 0;
    for (const auto& [name, all] : times) {
      const double ns = median(all);
      if (name != "fastest" && (least == 0 || ns < least)) least = ns;
    }
    report.set("walk.kernel.chosen_over_best." + scene_name, median(times.at("fastest")) / least);
  }
}

}  // namespace dsw::bench
