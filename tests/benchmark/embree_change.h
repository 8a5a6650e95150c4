// Ways to keep an Embree scene up to date when a few walls of a lattice appear and vanish.
#ifndef DARTSWEEP_TESTS_BENCHMARK_EMBREE_CHANGE_H
#define DARTSWEEP_TESTS_BENCHMARK_EMBREE_CHANGE_H

#include "engine.h"

namespace dsw::bench {

/** Walls that one change takes away and brings, by id: slots that are reused, so ids stay dense. */
struct WallChange {
  std::vector<dsw_volume_id> volumes;  // the cells that become impassable or passable
  bool impassable = false;
  struct Item {
    std::uint32_t id;
    scenes::Wall wall;
  };
  std::vector<Item> removed, added;
};

class EmbreeUpdater {
 public:
  explicit EmbreeUpdater(std::string name) : name_(std::move(name)) {}
  virtual ~EmbreeUpdater() = default;
  EmbreeUpdater(const EmbreeUpdater&) = delete;
  EmbreeUpdater& operator=(const EmbreeUpdater&) = delete;

  const std::string& name() const { return name_; }
  /** Timed: new triangles in place and the scene ready for rays. */
  virtual void apply(const WallChange& change) = 0;

 private:
  std::string name_;
};

/** All triangles in one geometry, rebuilt fast or refitted (a triangle that is gone shrinks to a point). */
std::unique_ptr<EmbreeUpdater> make_embree_single(const WallMesh& walls, std::size_t slots, bool refit);

/** Geometries of `chunk`^3 cells each in one dynamic scene; only touched ones are rebuilt, then the top. With
 * `instances` each chunk is a scene of its own, instanced. */
std::unique_ptr<EmbreeUpdater> make_embree_chunks(const WallMesh& walls, double chunk, bool instances);

}  // namespace dsw::bench

#endif
