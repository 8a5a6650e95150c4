// Moves of figure 12 for valgrind: edges_counted FOLDER VARIANT [STEPS] lets the surface fall by steps, and prints how many
// vertices have moved, how many edges were swept and skipped, how many vertices have met something, and a sum of the last
// positions. Instructions are those of dsw_body_move.
#include "fall_case.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace {

using namespace dsw::bench;

/** FNV-1a of the bits. */
std::uint64_t sum_of(const std::vector<double>& values) {
  std::uint64_t sum = 14695981039346656037u;
  for (const double value : values) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) sum = (sum ^ byte) * 1099511628211u;
  }
  return sum;
}

void run(const char* folder, const Variant& variant, std::size_t steps) {
  const Fall fall = make_fall(hand_path(folder), kFineCube);
  World world(fall.pyramids.mesh, 1);
  mark_obstacles(world, fall);
  Flock flock(world.environment(), variant, fall.shape, fall.surface.points);
  std::size_t moved = 0, swept = 0, skipped = 0, stopped = 0;
  for (std::size_t step = 1; step <= steps; ++step) {
    const auto targets = place(fall, step);
    flock.move(targets.data());
    moved += fall.shape.vertices;
    swept += flock.swept();
    skipped += flock.skipped();
    stopped += flock.stopped();
  }
  std::vector<double> at;
  std::vector<dsw_volume_id> volumes;
  flock.places(at, volumes);
  std::printf("%zu %zu %zu %zu %016llx\n", moved, swept, skipped, stopped, static_cast<unsigned long long>(sum_of(at)));
}

}  // namespace

int main(int argc, char** argv) {
  const auto& variants = fall_variants();
  const auto found = std::find_if(variants.begin(), variants.end(),
                                  [&](const Variant& variant) { return argc > 2 && variant.name == argv[2]; });
  if (found == variants.end()) {
    std::fprintf(stderr, "usage: %s FOLDER VARIANT [STEPS], VARIANT one of", argv[0]);
    for (const Variant& variant : variants) std::fprintf(stderr, " %s", variant.name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  try {
    run(argv[1], *found, argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 60);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
