// Ways to keep an Embree scene up to date when a few walls of a lattice appear and vanish.
#ifndef DARTSWEEP_TESTS_BENCHMARK_EMBREE_CHANGE_H
#define DARTSWEEP_TESTS_BENCHMARK_EMBREE_CHANGE_H

#include "embree_casts.h"

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

/** An engine whose walls change. Its answers name no wall (0 stands for any). */
class ChangingEngine : public Engine {
 public:
  using Engine::Engine;
  /** Timed: new triangles in place and the engine ready for casts. */
  virtual void apply(const WallChange& change) = 0;
};

/** Single rays as rtcIntersect1 answers them. */
class EmbreeUpdater : public ChangingEngine {
 public:
  using ChangingEngine::ChangingEngine;
  void prepare(const Segments& segments) override { casts_.prepare(segments); }
  void run(std::size_t first, std::size_t count) override { casts_.run(rays_meet(), first, count); }
  Answer answer(std::size_t i) const override {
    const auto& result = casts_.result(i);
    return result.primitive == kNone ? Answer{} : Answer{0, static_cast<double>(result.time)};
  }

 protected:
  virtual RTCSceneTy* rays_meet() const = 0;

 private:
  EmbreeCasts casts_;
};

/** All triangles in one geometry, rebuilt fast or refitted (a triangle that is gone shrinks to a point). */
std::unique_ptr<EmbreeUpdater> make_embree_single(const WallMesh& walls, std::size_t slots, bool refit);

/** Geometries of `chunk`^3 cells each in one dynamic scene; only touched ones are rebuilt, then the top. With
 * `instances` each chunk is a scene of its own, instanced. */
std::unique_ptr<EmbreeUpdater> make_embree_chunks(const WallMesh& walls, double chunk, bool instances);

}  // namespace dsw::bench

#endif
