#include "query/sweeps.h"

#include <algorithm>

#include "base/batch.h"
#include "base/dimensions.h"
#include "contact/geometry.h"
#include "query/report.h"
#include "query/starts.h"

namespace dsw {
namespace {

template <int D>
void report_contact(const Environment<D>& env, const EdgeMotion& m, const SweepContact& contact, dsw_sweep& sweep) {
  const Touch touch = touch_of(env, m.p, m.to, contact);
  sweep.outcome = DSW_OUTCOME_CONTACT;
  sweep.time = touch.time;
  sweep.edge_parameter = touch.along;
  std::copy_n(touch.position, 3, sweep.position);
  std::copy_n(touch.point, 3, sweep.point);
  sweep.contact = touch.other;
}

/** The sweeps of one thread. */
template <int D>
class Sweeper {
 public:
  Sweeper(const Environment<D>& env, const SweepOptions& options) : env_(env), options_(options), flood_(env) {}

  void sweep(const EdgeMotion& m, Cell start, dsw_sweep& sweep) {
    sweep = dsw_sweep{};
    std::copy_n(m.p, D, sweep.position);
    sweep.volume = volume_id(env_.map, start);
    if (!is_passable(env_, start)) {
      sweep.outcome = start.valid() ? DSW_OUTCOME_IMPASSABLE : DSW_OUTCOME_OUTSIDE;
      return;
    }
    if (!options_.start_free) {
      const CastEnd edge = fly(m.p, m.q, start, sweep).end;
      if (edge == CastEnd::kHit) sweep.outcome = DSW_OUTCOME_IMPASSABLE;
      if (edge != CastEnd::kReached) return;
    }
    const CastResult path = fly(m.p, m.to, start, sweep);
    if (path.end == CastEnd::kWorkLimit) return;
    const bool flooded = needs_flood(m, path, sweep);
    if (sweep.outcome == DSW_OUTCOME_WORK_LIMIT) return;
    if (flooded && !is_flat(m)) {
      uint32_t left = 0;
      if (!work_left(sweep, left)) return;
      const SweepResult swept = flood_.sweep(m, start, left);
      sweep.volumes_visited += swept.volumes_visited;
      if (swept.end == SweepEnd::kWorkLimit) {
        sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
        return;
      }
      if (swept.end == SweepEnd::kContact && !is_path_first(m, path, swept.contact)) {
        return report_contact(env_, m, swept.contact, sweep);
      }
    }
    if (path.end == CastEnd::kHit) return report_contact(env_, m, path_contact(env_, path), sweep);
    sweep.outcome = DSW_OUTCOME_REACHED;
    sweep.time = 1;
    sweep.volume = volume_id(env_.map, path.cell);
    std::copy_n(m.to, D, sweep.position);
  }

 private:
  /** Whether the path is all there is: a flood in the plane would look at nothing, and there may be no work left. */
  static bool is_flat(const EdgeMotion& m) {
    const double* const path[2] = {m.p, m.to};
    return D == 2 && orient<2>(path, m.q) == 0;
  }

  /** Whether the path meets something before the rest does. In space the flood has seen that, too. */
  bool is_path_first(const EdgeMotion& m, const CastResult& path, const SweepContact& rest) const {
    if constexpr (D == 3) return false;
    return path.end == CastEnd::kHit && comes_before(env_.map, m.p, m.to, path_contact(env_, path), rest);
  }

  /** How many cells may still be looked at; 0: as many as it takes. False, and the outcome is set, if none may. */
  bool work_left(dsw_sweep& sweep, uint32_t& left) const {
    left = options_.max_volumes == 0 ? 0 : options_.max_volumes - sweep.volumes_visited;
    if (options_.max_volumes == 0 || left != 0) return true;
    sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
    return false;
  }

  CastResult fly(const double* from, const double* to, Cell start, dsw_sweep& sweep) const {
    CastResult result;
    result.end = CastEnd::kWorkLimit;
    uint32_t left = 0;
    if (!work_left(sweep, left)) return result;
    result = cast(env_, from, to, start, left);
    sweep.volumes_visited += result.volumes_visited;
    if (result.end == CastEnd::kWorkLimit) sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
    return result;
  }

  /** Whether the triangle has to be looked at; the outcome is set if the work limit leaves that open. */
  bool needs_flood(const EdgeMotion& m, const CastResult& path, dsw_sweep& sweep) const {
    if (!covers_edges(options_.level)) return false;
    if (sweeps_edges(options_.level) || path.end == CastEnd::kHit) return true;
    return fly(m.to, m.q, path.cell, sweep).end == CastEnd::kHit;
  }

  const Environment<D>& env_;
  const SweepOptions& options_;
  SweepFlood<D> flood_;
};

}  // namespace

template <int D>
void sweep_edges(const Environment<D>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                 PointArray from, PointArray to, PointArray fixed, const SweepOptions& options, dsw_sweep* sweeps) {
  const Starts<D> where(env, starts, options.start_known);
  share_or_throw([&](auto& chunk) { share_out(parallel, count, chunk); },
                 [&](size_t begin, size_t end) {
                   Sweeper<D> sweeper(env, options);
                   for (size_t i = begin; i < end; ++i) {
                     sweeper.sweep({from[i], to[i], fixed[i]}, where.find(i, from[i]), sweeps[i]);
                   }
                 });
}

DSW_INSTANTIATE(sweep_edges);

}  // namespace dsw
