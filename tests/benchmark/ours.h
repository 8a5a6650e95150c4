// Dartsweep through its C interface.
#ifndef DARTSWEEP_TESTS_BENCHMARK_OURS_H
#define DARTSWEEP_TESTS_BENCHMARK_OURS_H

#include "engine.h"

#include "dartsweep/dartsweep.h"

#include <cstddef>
#include <unordered_map>

namespace dsw::bench {

/** Throws with the library's message unless the status is DSW_STATUS_OK. */
void check(dsw_status status);

/** What the library has asked from its context's allocator. */
struct MemoryUse {
  std::size_t now = 0, most = 0;
};

/** A context, an environment made from a mesh, and a scene on it. */
class World {
 public:
  /** @param count_memory lends an allocator that fills memory(): single-threaded worlds only. */
  World(const scenes::VolumeMesh& mesh, std::uint32_t threads, bool count_memory = false,
        std::uint32_t kernel = DSW_KERNEL_FASTEST);
  /** What another one is, coarsened; in the other's context, so it must go first. `map`: one entry a cell of that. */
  World(const World& fine, std::vector<std::uint32_t>& map, dsw_coarsen_report& report);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dsw_environment* environment() const { return environment_; }
  const MemoryUse& memory() const { return memory_; }
  const dsw_build_report& build_report() const { return build_report_; }
  dsw_environment_info info() const;

  /** The scene, made when first asked for. */
  dsw_scene* scene(std::uint32_t features = 0);
  void close_scene();

 private:
  MemoryUse memory_;
  dsw_context* context_ = nullptr;
  dsw_environment* environment_ = nullptr;
  dsw_scene* scene_ = nullptr;
  dsw_build_report build_report_{};
};

/** Ids of cells, asked one by one. */
std::vector<dsw_volume_id> volume_ids(const World& world, const std::vector<std::uint32_t>& cells);

/** Marks cells impassable. */
void mark_cells(World& world, const std::vector<std::uint8_t>& impassable);

/** Marks triangles, given by points, impassable. */
void mark_triangles(World& world, const std::vector<std::array<std::uint32_t, 3>>& triangles);

/** Sets the diagonals of four-cornered walls as the environment cut these faces, so that peers see the same surface. */
void adopt_triangulation(const World& world, const scenes::VolumeMesh& mesh, std::vector<scenes::Wall>& walls);

/** Fills `starts` from near-by cells and drops casts that do not start in a passable volume (in a jittered lattice some
 * points near an obstacle lie in it). What is left has batches as even as before. @return how many were dropped. */
std::size_t locate_starts(const World& world, const std::vector<std::uint32_t>& cells, Segments& segments);

/** Casts of known start through dsw_environment_cast_segments, one call a batch. */
class Ours final : public Engine {
 public:
  Ours(const World& world, const WallMesh& walls, std::uint32_t flags = DSW_CAST_START_KNOWN);

  void prepare(const Segments& segments) override;
  void run(std::size_t first, std::size_t count) override;
  Answer answer(std::size_t i) const override { return answer_of(flights_[i]); }

  const std::vector<dsw_flight>& flights() const { return flights_; }
  /** What a flight says of the walls. */
  Answer answer_of(const dsw_flight& flight) const;

 private:
  const World& world_;
  dsw_cast_options options_{};
  Segments segments_;
  std::vector<dsw_flight> flights_;
  std::unordered_map<std::uint64_t, std::uint32_t> wall_of_face_;
};

/** Counters of one kind of pass, see count_work. */
struct Work {
  double casts = 0, cells = 0, orientation_tests = 0, exact_fallbacks = 0, ties = 0, contacts = 0;
};

/** Repeats the casts of the first `batches` batches from particles of a scene with statistics. */
Work count_work(World& world, const Segments& segments, std::size_t batches);

}  // namespace dsw::bench

#endif
