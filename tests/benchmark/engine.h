// What every engine of the benchmark answers: the first wall that a segment meets, and when.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ENGINE_H
#define DARTSWEEP_TESTS_BENCHMARK_ENGINE_H

#include "scenes/mesh.h"

#include "dartsweep/ids.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dsw::bench {

using scenes::kNone;

/** Casts in the order in which they are made; `batch` of them belong to one step and are handed over in one call. */
struct Segments {
  std::vector<double> from, to;  // 3 a cast
  std::vector<dsw_volume_id> starts;
  std::size_t batch = 0;

  std::size_t count() const { return from.size() / 3; }
};

struct Answer {
  std::uint32_t wall = kNone;  // index of the wall met first
  double time = 1.0;           // fraction of the segment
};

/** The impassable faces as triangles. */
struct WallMesh {
  WallMesh(const std::vector<double>& mesh_points, std::vector<scenes::Wall> mesh_walls);

  const std::vector<double>* points;  // of the whole mesh, borrowed
  std::vector<scenes::Wall> walls;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_wall;
  double extent = 0.0;  // largest absolute coordinate of a wall

  const double* point(std::size_t index) const { return points->data() + 3 * index; }
};

class Engine {
 public:
  explicit Engine(std::string name) : name_(std::move(name)) {}
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const std::string& name() const { return name_; }
  /** Takes over casts in its own format; not timed. They stay as they are until the next call. */
  virtual void prepare(const Segments& segments) = 0;
  /** Answers casts first .. first+count-1, in its own format; timed. */
  virtual void run(std::size_t first, std::size_t count) = 0;
  /** Cast first+i of the last run; not timed. */
  virtual Answer answer(std::size_t i) const = 0;

 private:
  std::string name_;
};

/** Nanoseconds a cast in the median batch of the prepared casts, after one batch that warms the caches. Batches take
 * less than a scheduler's slice, so other work on the machine disturbs few of them. */
double time_casts(Engine& engine, const Segments& segments);

/** Prepares each engine, runs a few steps in turns and keeps the fastest. */
std::unique_ptr<Engine> keep_fastest(std::vector<std::unique_ptr<Engine>> engines, const Segments& segments);

}  // namespace dsw::bench

#endif
