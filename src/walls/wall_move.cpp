#include "walls/wall_move.h"

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "base/vec.h"
#include "contact/names.h"
#include "response/insertion.h"
#include "walls/describe.h"

namespace dsw {
namespace {

constexpr int kMostPushes = 16;

}  // namespace

template <int D>
WallMove<D>::WallMove(Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around)
    : env_(env), all_(all), around_(around), walls_(env), sweeps_(env), rigid_(env, all, around) {}

/** A try to move a vertex: unless it is kept, all is where it was afterwards, which is free as the wall is there, too, and what
 * was met counts as held. */
template <int D>
class WallMove<D>::Try {
 public:
  Try(WallMove& of, uint32_t v, WallRecord& record) noexcept
      : of_(of), v_(v), record_(record), contacts_(record.contacts.size()), pushed_(record.pushed) {
    std::copy_n(of.env_.point(v), D, from);
    of.pushed_.clear();
    of.relocated_.clear();
  }
  Try(const Try&) = delete;
  Try& operator=(const Try&) = delete;
  ~Try() {
    if (is_kept_) return;
    of_.relocated_.take_back();
    if (!is_same_place<D>(from, of_.env_.point(v_))) of_.put(v_, from);
    of_.pushed_.take_back();
    record_.pushed = pushed_;
    for (size_t i = contacts_; i < record_.contacts.size(); ++i) record_.contacts[i].response = DSW_WALL_HOLD;
  }
  Moved keep(Moved result) noexcept {
    is_kept_ = true;
    return result;
  }

  double from[D];

 private:
  WallMove& of_;
  uint32_t v_;
  WallRecord& record_;
  size_t contacts_;
  uint32_t pushed_;
  bool is_kept_ = false;
};

template <int D>
typename WallMove<D>::Moved WallMove<D>::move(uint32_t v, const double* to, const WallSettings& settings,
                                              WallRecord& record) {
  if (is_same_place<D>(to, env_.point(v))) return Moved::kYes;
  Try attempt(*this, v, record);
  const double* const from = attempt.from;
  look_round(v);
  for (int pushes = 0; walls_.has_walls() && find_hits(from, to); ++pushes) {
    record.contacts.push_back(describe(env_, all_, hits_.front(), from, to, settings.response));
    if (settings.response == DSW_WALL_STOP) return attempt.keep(Moved::kStopped);
    if (settings.response == DSW_WALL_INSERT && is_rigid(hits_.front().feature)) {
      record.contacts.back().response = DSW_WALL_PUSH;
    }
    if (settings.response == DSW_WALL_HOLD || pushes == kMostPushes || !make_room(from, to, pushes, settings, record)) {
      return Moved::kHeld;
    }
    look_round(v);  // what was pushed can have opened cells
  }
  put(v, to);
  // An invalid cell counts as impassable: near a thick body none may become so.
  if ((has_thick() && !is_star_valid()) || !locate_all()) return Moved::kInvalid;
  // What goes from cell to cell is followed only where the cells fill the same space before and after.
  if (!relocated_.empty()) {
    if (!is_star_valid()) return Moved::kInvalid;
    put(v, from);
    if (!is_star_valid()) return Moved::kInvalid;
    put(v, to);
  }
  return attempt.keep(Moved::kYes);
}

/** Finds the cells at a vertex, its walls, and what lies in these cells. */
template <int D>
void WallMove<D>::look_round(uint32_t v) {
  sweeps_.partners = all_.partners;
  star_ = &around_.find_star(v);
  around_.find_features(features_);
  walls_.start(v, *star_, around_.is_star_passable());
}

template <int D>
bool WallMove<D>::is_star_valid() const noexcept {
  return dsw::all_of(star_->begin(), star_->end(), [&](Cell c) { return admits(env_, c); });
}

template <int D>
bool WallMove<D>::has_thick() const noexcept {
  return dsw::any_of(features_.begin(), features_.end(), [&](const Feature& each) {
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
  dsw::sort(hits_.begin(), hits_.end());
  return !hits_.empty();
}

/** Moves what is hit out of the wall's way, what is touched first before the rest, each thing along ways that are free;
 * whether all of it could go. `pushes` have not been enough before. */
template <int D>
bool WallMove<D>::make_room(const double* from, const double* to, int pushes, const WallSettings& settings,
                            WallRecord& record) {
  for (size_t i = 0; i < hits_.size(); ++i) {
    WallHit hit = hits_[i];
    // What was pushed before can have taken this along.
    if (i != 0 && (!is_there(hit.feature) || !walls_.meets(all_, hits_[i].feature, from, to, &hit))) continue;
    if (!make_room_for(hit, from, to, pushes, settings, record)) return false;
  }
  return true;
}

/** Whether a feature has not been split. */
template <int D>
bool WallMove<D>::is_there(const Feature& feature) const noexcept {
  if (feature.is_point()) return true;
  const Body<D>& body = *all_.bodies[feature.owner].body;
  return feature.kind == Feature::kEdge ? body.has_edge(feature.index) : body.has_face(feature.index);
}

template <int D>
bool WallMove<D>::make_room_for(WallHit& hit, const double* from, const double* to, int pushes,
                                const WallSettings& settings, WallRecord& record) {
  const Feature& f = hit.feature;
  if (is_rigid(f)) {
    pushed_.note_rigid(f.owner);
    if (!rigid_.push(hit, walls_, sweeps_, from, to)) return false;
    record.pushed += static_cast<uint32_t>(all_.bodies[f.owner].body->vertex_slots.alive_count());
    return true;
  }
  const double radius = f.kind == Feature::kParticle ? 0 : all_.bodies[f.owner].body->radius;
  measure(env_, all_, from, to, hit);
  const Vec way = way_out<D>(hit, from, to, radius, pushes);
  if (f.is_point()) {
    if (!push(f, way)) return false;
    ++record.pushed;
    return true;
  }
  const Body<D>& body = *all_.bodies[f.owner].body;
  if (f.kind == Feature::kFace) return push_corners(f.owner, body.faces[f.index].corners, 3, hit.weights, way, record);
  const uint32_t middle = settings.response == DSW_WALL_INSERT ? insert(hit, settings.min_part) : kNone;
  if (middle != kNone) {
    constexpr double kWhole[1] = {1};
    return push_corners(f.owner, &middle, 1, kWhole, way, record);
  }
  return push_corners(f.owner, body.edges[f.index].ends, 2, hit.weights, way, record);
}

/** Pushes corners so that the point between them which has these weights goes a way. Corners that have been pushed less in
 * this deformation go first, until they have been pushed as far as the others: so walls tilt a touched edge or face no
 * more than they must. */
template <int D>
bool WallMove<D>::push_corners(uint32_t owner, const uint32_t* corners, int count, const double* weights,
                               const Vec& way, WallRecord& record) {
  const Vec along = unit(way);
  const double size = length(way);
  double before[3] = {}, level = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; ++k) {
    const double* const start = all_.saved_position(owner, corners[k]);
    const double* const now = all_.bodies[owner].body->position(corners[k]);
    before[k] = start == nullptr ? 0 : dot(difference<D>(now, start), along) / size;
    if (!std::isfinite(before[k])) before[k] = 0;
  }
  // The least level at which the corners below it take the point all of its way.
  for (int last = 0; last < count; ++last) {
    double weight = 0, sum = 0;
    for (int k = 0; k < count; ++k) {
      if (before[k] > before[last]) continue;
      weight += weights[k];
      sum += weights[k] * before[k];
    }
    if (weight > 0) level = std::min(level, std::max((1 + sum) / weight, before[last]));
  }
  for (int k = 0; k < count; ++k) {
    const double part = std::isfinite(level) ? level - before[k] : 1;
    if (!(part > 0) || weights[k] == 0) continue;
    if (!push({Feature::kVertex, owner, corners[k]}, part * way)) return false;
    ++record.pushed;
  }
  return true;
}

template <int D>
bool WallMove<D>::push(const Feature& point, const Vec& way) {
  const double* const at = position(all_, point);
  double target[D];
  store<D>(to_vec<D>(at) + way, target);
  if (!is_finite<D>(target)) return false;
  if (point.kind == Feature::kParticle) {
    const CastResult flight = cast(env_, at, target, cell_of(all_, point));
    if (flight.end != CastEnd::kReached) return false;
    pushed_.note(point);
    set_location(all_, point, target, flight.cell);
    around_.note_point(point);
    return true;
  }
  Body<D>& body = *all_.bodies[point.owner].body;
  Cell cell;
  if (body.radius > 0) around_.open_ways(point.owner, point.index, target);
  if (!sweeps_.is_free(body, point.index, target, &cell)) return false;
  pushed_.note(point);
  set_location(all_, point, target, cell);
  return around_.note_vertex(point.owner, point.index);
}

/** Puts a vertex on an edge where it is hit; kNone where that cannot be. */
template <int D>
uint32_t WallMove<D>::insert(const WallHit& hit, double min_part) {
  if (!(hit.along >= min_part && hit.along <= 1 - min_part)) return kNone;
  const uint32_t owner = hit.feature.owner;
  Body<D>& body = *all_.bodies[owner].body;
  // The parts of an edge that got its vertex in this deformation are pushed: each vertex of a wall would split them.
  for (const uint32_t end : body.edges[hit.feature.index].ends) {
    if (all_.saved_position(owner, end) == nullptr) return kNone;
  }
  Cell cell;
  if (!can_bend(env_, sweeps_, body, hit.feature.index, hit.point, &cell)) return kNone;
  dsw_body_edit edit;
  MoveRecord& edits = *all_.bodies[owner].record;
  reserve_more(edits.edits, 1);
  reserve_more(body.inserted, 1);
  const uint32_t middle = insert_vertex(body, hit.feature.index, hit.point, cell, hit.along, &edit);
  edits.edits.push_back(edit);
  body.inserted.push_back(middle);
  around_.note_vertex(owner, middle);
  return middle;
}

/** Finds the cells in which things are now; false if one is in none that is valid or an edge or face is not free. */
template <int D>
bool WallMove<D>::locate_all() {
  for (const Feature& feature : features_) {
    if (!feature.is_point()) break;  // these come first
    const Cell now = find_cell(feature);
    if (!now.valid()) return false;
    if (now == cell_of(all_, feature)) continue;
    relocated_.note(feature);
    set_location(all_, feature, position(all_, feature), now);
    around_.note_point(feature);
  }
  for (const Feature& feature : features_) {
    if (feature.is_point()) continue;
    if (!around_.trace(feature)) return false;
    around_.note_traced(feature);
  }
  return true;
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
  if (dsw::all_of(star_->begin(), star_->end(), [&](Cell c) { return told_.contains(c); })) return;
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
