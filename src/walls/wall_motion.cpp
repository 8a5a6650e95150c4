#include "walls/wall_motion.h"

#include "contact/names.h"

namespace dsw {
namespace {

constexpr int kMostShortened = 52;

}  // namespace

WallMotion::WallMotion(Environment<3>& env, Occupants& all)
    : env_(env), all_(all), around_(env, all), move_(env, all, around_), turns_(Allocator<uint32_t>(env.memory)) {}

void WallMotion::run(double* next, const WallSettings& settings, WallRecord& record) {
  record.clear();
  double way = 1;
  try {
    if (try_ways(next, settings, record, &way) == Went::kRefused) {
      record.outcome = DSW_DEFORM_REFUSED;
      record.fraction = 0;
      return;
    }
    finish(way, record);
  } catch (...) {
    around_.points().take_back();
    all_.restore();
    throw;
  }
}

/** The whole way, or where something stops it, the largest of 1/2, 1/4 ... that is not stopped. */
WallMotion::Went WallMotion::try_ways(double* next, const WallSettings& settings, WallRecord& record, double* way) {
  int shortened = 0;
  Array<dsw_wall_contact> stopped{Allocator<dsw_wall_contact>(env_.memory)};
  for (uint32_t halvings = 0;;) {
    all_.save(settings.response == DSW_WALL_INSERT);
    const Went went = try_way(next, *way, halvings, settings, record);
    if (went == Went::kThrough) {
      if (*way != 1) record.contacts.swap(stopped);
      return went;
    }
    around_.points().take_back();
    all_.restore();
    record.pushed = 0;
    if (went == Went::kRefused) return went;
    if (went == Went::kStopped) {
      stopped.assign(record.contacts.end() - 1, record.contacts.end());
      record.invalid.clear();
      *way = ++shortened == kMostShortened ? 0 : *way / 2;
      halvings = 0;
    } else {
      ++halvings;
    }
    record.contacts.clear();
  }
}

WallMotion::Went WallMotion::try_way(double* next, double way, uint32_t halvings, const WallSettings& settings,
                                     WallRecord& record) {
  const uint32_t steps = 1u << halvings;
  const bool last = halvings == settings.most_halvings;
  around_.find_occupants();
  around_.begin(next);
  record.steps = steps;
  for (uint32_t s = 0; s < steps; ++s) {
    const double before = way * s / steps, after = way * (s + 1) / steps;
    around_.begin_step(before);
    while (around_.find_turns(turns_)) {
      for (const uint32_t v : turns_) {
        double to[3];
        around_.points().at(v, after, to);
        const WallMove::Moved moved = move_.move(v, to, settings, record);
        if (moved == WallMove::Moved::kStopped) return Went::kStopped;
        if (moved != WallMove::Moved::kInvalid) continue;
        if (!last) return Went::kInvalid;
        move_.find_invalid(v, to, record.invalid);
        if (settings.refuses_invalid) return Went::kRefused;
      }
    }
    around_.end_step(after);
  }
  return Went::kThrough;
}

void WallMotion::finish(double way, WallRecord& record) {
  MovingPoints& points = around_.points();
  record.near = static_cast<uint32_t>(around_.near_count());
  record.fraction = way;
  for (const uint32_t v : points.touched()) {
    double to[3];
    points.at(v, way, to);
    if (!std::equal(to, to + 3, env_.point(v))) record.held.push_back({v, env_.map.vertex_generation(v)});
  }
  record.outcome = way != 1 ? DSW_DEFORM_FRACTION : record.held.empty() ? DSW_DEFORM_DONE : DSW_DEFORM_HELD;
  if (way != 1) points.shorten(way);
  points.finish();
}

}  // namespace dsw
