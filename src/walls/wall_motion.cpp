#include "walls/wall_motion.h"

#include "base/position.h"
#include "contact/names.h"

namespace dsw {

template <int D>
WallMotion<D>::WallMotion(Environment<D>& env, Occupants<D>& all)
    : env_(env), all_(all), around_(env, all), move_(env, all, around_) {}

template <int D>
void WallMotion<D>::run(double* next, const WallSettings& settings, WallRecord& record) {
  const bool inserts = settings.response == DSW_WALL_INSERT;
  holds_ = 0;
  is_limited_ = false;
  const auto take_back = [&] { around_.points().take_back(); };
  const auto try_way = [&](double way) {
    for (uint32_t halvings = 0;; ++halvings) {
      const Went went = try_steps(next, way, halvings, settings, record);
      if (went != Went::kInvalid) return went;
      take_back();
      all_.restore();
      record.clear();
      all_.save(inserts);
    }
  };
  try {
    if (find_way(all_, inserts, record, try_way, take_back)) finish(record);
  } catch (...) {
    take_back();
    all_.restore();
    throw;
  }
}

/** One way in 2^halvings steps; kInvalid: smaller steps are wanted. */
template <int D>
Went WallMotion<D>::try_steps(double* next, double way, uint32_t halvings, const WallSettings& settings,
                              WallRecord& record) {
  const uint32_t steps = 1u << halvings;
  const bool last = halvings == settings.most_halvings;
  around_.find_occupants();
  around_.begin(next);
  move_.begin();
  record.steps = steps;
  for (uint32_t s = 0; s < steps; ++s) {
    const double before = way * s / steps, after = way * (s + 1) / steps;
    around_.begin_step(before);
    while (around_.find_turns(turns_)) {
      for (const uint32_t v : turns_) {
        double to[D];
        around_.points().at(v, after, to);
        const typename WallMove<D>::Moved moved = move_.move(v, to, settings, record);
        if (moved == WallMove<D>::Moved::kStopped) {
          record.invalid.clear();  // that did not stop it
          return Went::kStopped;
        }
        if (moved == WallMove<D>::Moved::kYes) continue;
        if (moved == WallMove<D>::Moved::kInvalid) {
          if (!last) return Went::kInvalid;
          move_.find_invalid(v, to, record.invalid);
          if (settings.refuses_invalid) {
            if (record.invalid.empty()) move_.find_around(record.invalid);
            return Went::kRefused;
          }
        }
        if (++holds_ < settings.max_holds) continue;
        is_limited_ = true;
        if (settings.response == DSW_WALL_STOP) return Went::kLimited;
        around_.end_step(way);  // near vertices stay where they are now
        return Went::kThrough;
      }
    }
    around_.end_step(after);
  }
  return Went::kThrough;
}

template <int D>
void WallMotion<D>::finish(WallRecord& record) {
  MovingPoints<D>& points = around_.points();
  const double way = record.fraction;
  record.near = static_cast<uint32_t>(around_.near_count());
  for (const uint32_t v : points.touched()) {
    double to[D];
    points.at(v, way, to);
    if (!is_same_place<D>(to, env_.point(v))) record.held.push_back({v, env_.map.vertex_generation(v)});
  }
  record.outcome = is_limited_           ? DSW_DEFORM_LIMITED
                   : way != 1            ? DSW_DEFORM_FRACTION
                   : record.held.empty() ? DSW_DEFORM_DONE
                                         : DSW_DEFORM_HELD;
  if (way != 1) points.shorten(way);
  points.finish();
}

template class WallMotion<2>;
template class WallMotion<3>;

}  // namespace dsw
