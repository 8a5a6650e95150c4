// Casts for valgrind: walk_counted SCENE [CASTS] prints how many casts there are and how many cells they visit.
// Instructions are those of dsw_environment_cast_segments.
#include "walk_scenes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
  using namespace dsw::bench;
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s hex|hex_warped|tet_short|tet_long [CASTS]\n", argv[0]);
    return 2;
  }
  try {
    const WalkScene scene = make_walk_scene(argv[1], argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 9000);
    World world(scene.mesh, 1);
    Ours engine(world, WallMesh(scene.mesh.points, {}));
    const Segments segments = scene.prepare(world);
    engine.prepare(segments);
    std::size_t casts = 0, cells = 0;
    for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
      const std::size_t count = std::min(segments.batch, segments.count() - first);
      engine.run(first, count);
      casts += count;
      for (std::size_t i = 0; i < count; ++i) cells += engine.flights()[i].volumes_visited;
    }
    std::printf("%zu %zu\n", casts, cells);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
