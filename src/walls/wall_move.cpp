#include "walls/wall_move.h"

#include "base/vec.h"
#include "contact/names.h"
#include "response/insertion.h"
#include "walls/describe.h"

namespace dsw {
namespace {

constexpr int kMostPushes = 4;

}  // namespace

template <int D>
WallMove<D>::WallMove(Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around)
    : env_(env), all_(all), around_(around), walls_(env), sweeps_(env), rigid_(env, all, around) {}

template <int D>
typename WallMove<D>::Moved WallMove<D>::move(uint32_t v, const double* to, const WallSettings& settings,
                                              WallRecord& record) {
  double from[D];
  std::copy_n(env_.point(v), D, from);
  if (std::equal(from, from + D, to)) return Moved::kYes;
  look_round(v);
  for (int pushes = 0; walls_.has_walls() && find_hits(from, to); ++pushes) {
    record.contacts.push_back(describe(env_, all_, hits_.front(), v, from, to, settings.response));
    if (settings.response == DSW_WALL_STOP) return Moved::kStopped;
    if (settings.response == DSW_WALL_INSERT && is_rigid(hits_.front().feature)) {
      record.contacts.back().response = DSW_WALL_PUSH;
    }
    if (settings.response == DSW_WALL_HOLD || pushes == kMostPushes || !make_room(from, to, settings, record)) {
      record.contacts.back().response = DSW_WALL_HOLD;
      return Moved::kHeld;
    }
    look_round(v);  // what was pushed can have opened cells
  }
  put(v, to);
  // An invalid cell counts as impassable: near a thick body none may become so.
  bool fine = (!has_thick() || is_star_valid()) && locate_all();
  // What goes from cell to cell is followed only where the cells fill the same space before and after.
  if (fine && !before_.empty()) {
    fine = is_star_valid();
    if (fine) {
      put(v, from);
      fine = is_star_valid();
      put(v, to);
    }
    if (!fine) restore_locations();
  }
  if (fine) return Moved::kYes;
  put(v, from);
  return Moved::kInvalid;
}

/** Finds the cells at a vertex, its walls, and what lies in these cells. */
template <int D>
void WallMove<D>::look_round(uint32_t v) {
  sweeps_.partners = all_.partners;
  star_ = &around_.find_star(v);
  around_.find_features(features_);
  walls_.start(v, *star_);
}

template <int D>
bool WallMove<D>::is_star_valid() const noexcept {
  return std::all_of(star_->begin(), star_->end(), [&](Cell c) { return admits(env_, c); });
}

template <int D>
bool WallMove<D>::has_thick() const noexcept {
  return std::any_of(features_.begin(), features_.end(), [&](const Feature& each) {
    return each.kind != Feature::kParticle && all_.bodies[each.owner].body->radius > 0;
  });
}

template <int D>
void WallMove<D>::put(uint32_t v, const double* position) {
  around_.points().put(v, position);
  around_.forget_cells_at(v);
}

template <int D>
bool WallMove<D>::find_hits(const double* from, const double* to) {
  hits_.clear();
  for (const Feature& feature : features_) {
    WallHit hit;
    if (walls_.meets(all_, feature, from, to, &hit)) hits_.push_back(hit);
  }
  std::sort(hits_.begin(), hits_.end());
  return !hits_.empty();
}

/** Moves what is hit as the wall's vertex moves, each thing along a way that is free; whether all of it could go. */
template <int D>
bool WallMove<D>::make_room(const double* from, const double* to, const WallSettings& settings, WallRecord& record) {
  if (!push_rigid(from, to, record)) return false;
  points_.clear();
  for (const WallHit& hit : hits_) {
    const Feature& f = hit.feature;
    if (is_rigid(f)) continue;
    if (f.is_point()) {
      points_.push_back(f);
    } else if (f.kind == Feature::kFace) {
      for (const uint32_t v : all_.bodies[f.owner].body->faces[f.index].corners) {
        points_.push_back({Feature::kVertex, f.owner, v});
      }
    } else {
      const uint32_t middle = settings.response == DSW_WALL_INSERT ? insert(hit, from, to, settings.min_part) : kNone;
      if (middle != kNone) {
        points_.push_back({Feature::kVertex, f.owner, middle});
        continue;
      }
      for (const uint32_t v : all_.bodies[f.owner].body->edges[f.index].ends) {
        points_.push_back({Feature::kVertex, f.owner, v});
      }
    }
  }
  std::sort(points_.begin(), points_.end());
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  for (const Feature& point : points_) {
    if (!push(point, from, to)) return false;
    ++record.pushed;
  }
  return true;
}

/** Moves each rigid body that is hit as a whole. */
template <int D>
bool WallMove<D>::push_rigid(const double* from, const double* to, WallRecord& record) {
  pushed_.clear();
  for (const WallHit& hit : hits_) {
    const uint32_t owner = hit.feature.owner;
    if (!is_rigid(hit.feature) || std::find(pushed_.begin(), pushed_.end(), owner) != pushed_.end()) continue;
    if (!rigid_.push(hit, walls_, sweeps_, from, to)) return false;
    pushed_.push_back(owner);
    record.pushed += static_cast<uint32_t>(all_.bodies[owner].body->vertex_slots.alive_count());
  }
  return true;
}

template <int D>
bool WallMove<D>::push(const Feature& point, const double* from, const double* to) {
  const double* const at = position(all_, point);
  const double radius = point.kind == Feature::kParticle ? 0 : all_.bodies[point.owner].body->radius;
  double target[D];
  store<D>(to_vec<D>(at) + push_way(difference<D>(to, from), radius), target);
  if (!is_finite<D>(target)) return false;
  if (point.kind == Feature::kParticle) {
    const CastResult way = cast(env_, at, target, cell_of(all_, point));
    if (way.end != CastEnd::kReached) return false;
    set_location(all_, point, target, way.cell);
    around_.note_point(point);
    return true;
  }
  Body<D>& body = *all_.bodies[point.owner].body;
  Cell cell;
  if (radius > 0) around_.open_ways(point.owner, point.index, target);
  if (!sweeps_.is_free(body, point.index, target, &cell)) return false;
  set_location(all_, point, target, cell);
  return around_.note_vertex(point.owner, point.index);
}

/** Puts a vertex on an edge where it is hit; kNone where that cannot be. */
template <int D>
uint32_t WallMove<D>::insert(const WallHit& hit, const double* from, const double* to, double min_part) {
  const WallTouch touch = describe_touch(env_, all_, hit, from, to);
  if (!(touch.along >= min_part && touch.along <= 1 - min_part)) return kNone;
  const uint32_t owner = hit.feature.owner;
  Body<D>& body = *all_.bodies[owner].body;
  Cell cell;
  if (!can_bend(env_, sweeps_, body, hit.feature.index, touch.point, &cell)) return kNone;
  dsw_body_edit edit;
  MoveRecord& edits = *all_.bodies[owner].record;
  reserve_more(edits.edits, 1);
  reserve_more(body.inserted, 1);
  const uint32_t middle = insert_vertex(body, hit.feature.index, touch.point, cell, touch.along, &edit);
  edits.edits.push_back(edit);
  body.inserted.push_back(middle);
  around_.note_vertex(owner, middle);
  return middle;
}

/** Finds the cells in which things are now; false, and points back in theirs, if one is in none that is valid or an
 * edge or face is not free. */
template <int D>
bool WallMove<D>::locate_all() {
  before_.clear();
  bool fine = true;
  for (const Feature& feature : features_) {
    if (!feature.is_point()) break;  // these come first
    const Cell old = cell_of(all_, feature), now = find_cell(feature);
    fine = now.valid();
    if (!fine) break;
    if (now == old) continue;
    before_.push_back({feature, old});
    set_location(all_, feature, position(all_, feature), now);
    around_.note_point(feature);
  }
  for (const Feature& feature : features_) {
    if (!fine || feature.is_point()) continue;
    fine = around_.trace(feature);
    if (fine) around_.note_traced(feature);
  }
  if (!fine) restore_locations();
  return fine;
}

template <int D>
void WallMove<D>::restore_locations() noexcept {
  for (const Location& each : before_) set_location(all_, each.point, position(all_, each.point), each.cell);
  before_.clear();
}

template <int D>
Box<D> WallMove<D>::box_of(Cell c) const noexcept {
  Box<D> box;
  env_.map.for_each_vertex(c, [&](uint32_t v) { box.add(env_.point(v)); });
  return box;
}

template <int D>
Cell WallMove<D>::find_cell(const Feature& point) const {
  const double* const at = position(all_, point);
  const Cell old = cell_of(all_, point);
  if (admits(env_, old) && contains(env_, old, at)) return old;
  for (const Cell c : *star_) {
    // What a valid cell contains lies in its box, which is sooner asked than whether the cell is valid.
    if (c != old && box_of(c).contains(at) && !is_closed(env_, c) && contains(env_, c, at)) return c;
  }
  return {};
}

template <int D>
void WallMove<D>::find_invalid(uint32_t v, const double* to, Array<dsw_volume_id>& invalid) {
  if (std::all_of(star_->begin(), star_->end(), [&](Cell c) { return told_.contains(c); })) return;
  double from[D];
  std::copy_n(env_.point(v), D, from);
  put(v, to);
  for (const Cell c : *star_) {
    if (told_.contains(c) || admits(env_, c)) continue;
    told_.insert(c);
    invalid.push_back(volume_id(env_.map, c));
  }
  put(v, from);
}

template <int D>
void WallMove<D>::find_around(Array<dsw_volume_id>& cells) const {
  for (const Cell c : *star_) cells.push_back(volume_id(env_.map, c));
}

template class WallMove<2>;
template class WallMove<3>;

}  // namespace dsw
