#include "walk/fastest.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include "base/error.h"
#include "environment/builder.h"
#include "walk/cast.h"

namespace dsw {
namespace {

constexpr int kSide = 4;         // cells along a side of the lattice
constexpr uint32_t kRounds = 4;  // the fastest of so many counts: others were disturbed
constexpr uint32_t kPackets = 2;
constexpr uint32_t kSamples = 512;  // cells of an environment that are looked at

enum class Cells { kTetrahedra, kFlatBoxes, kWarpedBoxes, kPolyhedra };
constexpr Cells kAllCells[] = {Cells::kTetrahedra, Cells::kFlatBoxes, Cells::kWarpedBoxes, Cells::kPolyhedra};

/** Numbers in -1 .. 1, the same in every run. */
class Noise {
 public:
  double next() noexcept {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(static_cast<int64_t>(state_) >> 11) * 0x1p-52;
  }

 private:
  uint64_t state_ = 1;
};

/** A lattice of unit cubes. */
class Lattice {
 public:
  explicit Lattice(Cells cells) {
    Noise noise;
    const double jitter = cells == Cells::kWarpedBoxes || cells == Cells::kPolyhedra ? 0.05 : 0;
    for (int n = 0; n < kPoints * kPoints * kPoints; ++n) {
      for (const int x : {n % kPoints, n / kPoints % kPoints, n / (kPoints * kPoints)}) {
        points_.push_back(x + jitter * noise.next());
      }
    }
    for (int n = 0; n < kSide * kSide * kSide; ++n) add_cube(cells, n % kSide, n / kSide % kSide, n / (kSide * kSide));
  }

  /** Throws. */
  void build(Environment<3>& env) const {
    dsw_environment_desc description{};
    description.points = points_.data();
    description.point_count = points_.size() / 3;
    description.cell_types = types_.data();
    description.volume_count = types_.size();
    description.offsets = offsets_.data();
    description.connectivity = connectivity_.data();
    description.connectivity_count = connectivity_.size();
    description.flags = DSW_ENVIRONMENT_NO_LOCATE_TREE;
    BuildReport report;
    dsw::build(env, check_description<3>(description), report);
  }

 private:
  static constexpr int kPoints = kSide + 1;

  void add_cube(Cells cells, int x, int y, int z) {
    const int64_t a = x + kPoints * (y + kPoints * z), b = a + kPoints * kPoints;
    const int64_t c[8] = {a, a + 1, a + 1 + kPoints, a + kPoints, b, b + 1, b + 1 + kPoints, b + kPoints};
    switch (cells) {
      case Cells::kTetrahedra:  // six round a diagonal
        for (const auto& [s, t] :
             std::initializer_list<std::pair<int, int>>{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}) {
          add(DSW_CELL_TYPE_TETRA, {c[0], c[s], c[t], c[6]});
        }
        break;
      case Cells::kPolyhedra:
        add(DSW_CELL_TYPE_POLYHEDRON,
            {6, 4,    c[0], c[4], c[7], c[3], 4,    c[1], c[2], c[6], c[5], 4,    c[0], c[1], c[5], c[4],
             4, c[3], c[7], c[6], c[2], 4,    c[0], c[3], c[2], c[1], 4,    c[4], c[5], c[6], c[7]});
        break;
      default:
        add(DSW_CELL_TYPE_HEXAHEDRON, {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
    }
  }
  void add(dsw_cell_type type, std::initializer_list<int64_t> stream) {
    types_.push_back(static_cast<uint8_t>(type));
    connectivity_.insert(connectivity_.end(), stream);
    offsets_.push_back(static_cast<int64_t>(connectivity_.size()));
  }

  std::vector<double> points_;
  std::vector<uint8_t> types_;
  std::vector<int64_t> offsets_{0}, connectivity_;
};

/** Casts from the middle of cells to somewhere in their neighbourhood, as bodies make them; one in eight goes far. */
class Course {
 public:
  explicit Course(Cells cells) : env_(nullptr), ends_(size_t{kPackets} * kPacket) {
    Lattice(cells).build(env_);
    Noise noise;
    for (size_t i = 0; i < ends_.size(); ++i) {
      Ends& ends = ends_[i];
      const auto share = 0.5 + 0.5 * noise.next();
      ends.start = env_.map.cell(static_cast<uint32_t>(share * (env_.map.cell_count - 1)));
      centre(env_, ends.start, ends.from);
      for (int k = 0; k < 3; ++k) ends.to[k] = ends.from[k] + (i % 8 == 0 ? 4 : 0.6) * noise.next();
    }
  }

  /** Seconds of the fastest round. */
  double time(Instructions instructions) noexcept {
    using Clock = std::chrono::steady_clock;
    env_.kernels = &kernels_of(instructions);
    double least = HUGE_VAL;
    for (uint32_t round = 0; round < kRounds; ++round) {
      const Clock::time_point begin = Clock::now();
      for (uint32_t packet = 0; packet < kPackets; ++packet) cast_packet(&ends_[size_t{packet} * kPacket]);
      least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count());
    }
    return least;
  }

 private:
  struct Ends {
    double from[3], to[3];
    Cell start;
  };

  void cast_packet(const Ends* ends) noexcept {
    CastRequest requests[kPacket];
    CastResult results[kPacket];
    for (uint32_t i = 0; i < kPacket; ++i) {
      requests[i].from = ends[i].from;
      requests[i].to = ends[i].to;
      requests[i].start = ends[i].start;
    }
    cast_side_by_side(env_, requests, kPacket, results, nullptr);
  }

  Environment<3> env_;
  std::vector<Ends> ends_;
};

Instructions fastest(Cells cells) {
  Course course(cells);
  Instructions best = Instructions::kPortable;
  double least = course.time(best);
  for (uint32_t i = 1; i < kInstructionSets; ++i) {
    const auto instructions = static_cast<Instructions>(i);
    if (!supports(instructions)) break;
    const double seconds = course.time(instructions);
    if (seconds < least) {
      least = seconds;
      best = instructions;
    }
  }
  return best;
}

/** Returns the lattice that stands for cells of a kind. */
Cells lattice_of(uint32_t kind_bits) noexcept {
  switch (static_cast<Form>(kind_bits >> 1)) {
    case Form::kSimplex:
    case Form::kPyramid:
      return Cells::kTetrahedra;
    case Form::kBox:
      return (kind_bits & 1) != 0 ? Cells::kFlatBoxes : Cells::kWarpedBoxes;
    default:
      return Cells::kPolyhedra;
  }
}

/** The kernels of all environments that name none. */
Kernels& shared_kernels() noexcept {
  static Kernels kernels(most_instructions());
  return kernels;
}

/** Measures what serves `cells` best. Without memory nothing changes. */
void measure(Cells cells) noexcept {
  try {
    const Instructions best = fastest(cells);
    for (uint32_t kind = 0; kind < Kernels::kKinds; ++kind) {
      if (lattice_of(kind) == cells) shared_kernels().set(kind, best);
    }
  } catch (const std::bad_alloc&) {
  } catch (const Error&) {
  }
}

}  // namespace

const Kernels& fastest_kernels() noexcept { return shared_kernels(); }

void measure_kernels(const Environment<3>& env) noexcept {
  if (env.kernels != &fastest_kernels() || named_instructions().is_named || !supports(Instructions::kAvx2)) return;
  static std::once_flag is_measured[std::size(kAllCells)];
  const uint32_t count = env.map.index_count();
  for (uint32_t i = 0; i < count; i += count / kSamples + 1) {
    const Cell c = env.map.cell(i);
    if (!c.valid()) continue;
    const Cells cells = lattice_of(env.map.kind_bits(c));
    std::call_once(is_measured[static_cast<uint32_t>(cells)], measure, cells);
  }
}

}  // namespace dsw
