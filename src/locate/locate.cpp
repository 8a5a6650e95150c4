#include "locate/locate.h"

#include "base/compiler.h"
#include "base/sort.h"

namespace dsw {
namespace {

template <int D>
bool holds(const Environment<D>& env, Cell c, const double* point) noexcept {
  return c.valid() && box_holds(env, c, point) && admits(env, c) && contains(env, c, point);
}

/** The cell of a point, if a walk from a cell finds it. */
template <int D>
Cell walk(const Environment<D>& env, const double* point, Cell from, CastCounters* counters) noexcept {
  if (!admits(env, from)) return {};
  // A good hint: the walk would end where it begins.
  if (env.map.form(from) == Form::kSimplex && contains(env, from, point)) return from;
  double start[D];
  centre(env, from, start);
  // The centre of a sliver can round to a point outside of it, from where no walk may start.
  if (env.map.form(from) == Form::kSimplex && !contains(env, from, start)) return {};
  CastRequest request{start, point, from};
  request.through_walls = true;
  const CastResult walked = cast(env, request, counters);
  return walked.end == CastEnd::kReached ? walked.cell : Cell{};
}

/** Cells that may contain a point, by index. They are looked at in ascending order: the first that contains it is
 * the one. */
template <int D>
class Candidates {
 public:
  Candidates(const Environment<D>& env, const double* point) noexcept : env_(env), point_(point) {}

  void add(uint32_t index) noexcept {
    const Cell c = env_.map.cell(index);
    if (!c.valid()) return;
    prefetch_line(env_.map.record(c));
    indices_[count_++] = index;
    if (count_ == kMost) look();
  }
  Cell lowest() noexcept {
    look();
    return lowest_ == kNoCell ? Cell{} : env_.map.cell(lowest_);
  }

 private:
  static constexpr uint32_t kMost = 32;

  void prefetch_vertices(uint32_t index) const noexcept {
    const Cell c = env_.map.cell(index);
    for (uint32_t i = 0, count = env_.map.vertices_of(c); i < count; ++i) prefetch_line(env_.point(c, i));
  }
  void look() noexcept {
    dsw::sort(indices_, indices_ + count_);
    for (uint32_t i = 0; i < count_; ++i) prefetch_vertices(indices_[i]);
    for (uint32_t i = 0; i < count_ && indices_[i] < lowest_; ++i) {
      if (holds(env_, env_.map.cell(indices_[i]), point_)) lowest_ = indices_[i];
    }
    count_ = 0;
  }

  const Environment<D>& env_;
  const double* point_;
  uint32_t indices_[kMost], count_ = 0, lowest_ = kNoCell;
};

/** The cell of lowest index that contains a point. */
template <int D>
Cell find_anywhere(const Environment<D>& env, const double* point) noexcept {
  Candidates<D> candidates(env, point);
  if (env.index.visit(env, point, [&](uint32_t index) { candidates.add(index); })) return candidates.lowest();
  for (uint32_t i = 0, count = env.map.index_count(); i < count; ++i) {
    if (holds(env, env.map.cell(i), point)) return env.map.cell(i);
  }
  return {};
}

}  // namespace

template <int D>
LocateResult locate(const Environment<D>& env, const double* point, Cell hint, CastCounters* counters) noexcept {
  Cell found;
  if (hint.valid()) found = walk(env, point, hint, counters);
  if (!found.valid()) found = find_anywhere(env, point);
  return {found};
}

template LocateResult locate(const Environment<2>&, const double*, Cell, CastCounters*) noexcept;
template LocateResult locate(const Environment<3>&, const double*, Cell, CastCounters*) noexcept;

}  // namespace dsw
