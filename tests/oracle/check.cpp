#include "check.h"

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace dsw::oracle {
namespace {

bool same_bits(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

}  // namespace

void Report::begin(const std::string& scene, const std::string& reproduce) {
  scene_ = &scenes[scene];
  reproduce_ = reproduce;
}

void Report::flight(const Walk& walk) {
  for (Tally* t : {&total, scene_}) {
    ++t->casts;
    t->ties += walk.tie;
    t->contacts += walk.outcome == Walk::kContact;
  }
}

void Report::stuck(const std::string& text) {
  ++total.stuck;
  ++scene_->stuck;
  if (show_stuck) std::printf("STUCK [%s] %s\n", reproduce_.c_str(), text.c_str());
}

void Report::mismatch(const std::string& text) {
  ++total.mismatches;
  ++scene_->mismatches;
  if (printed_++ < print_most_) std::printf("MISMATCH [%s] %s\n", reproduce_.c_str(), text.c_str());
  std::fflush(stdout);
}

void Report::lost(const std::string& text) {
  ++total.lost;
  ++scene_->lost;
  if (printed_++ < print_most_) std::printf("LOST [%s] %s\n", reproduce_.c_str(), text.c_str());
  std::fflush(stdout);
}

bool Checker::same_volume(dsw_volume_id id, int cell) const {
  if (cell < 0) return id.index == 0 && id.generation == 0;
  const dsw_volume_id want = world_.ids[static_cast<size_t>(cell)];
  return id.index == want.index && id.generation == want.generation;
}

bool Checker::same_face(dsw_face_id id, int face) const {
  if (face < 0) return id.volume == 0 && id.generation == 0 && id.local == 0;
  const Face& f = world_.faces[static_cast<size_t>(face)];
  const dsw_volume_id owner = world_.ids[static_cast<size_t>(f.cell[0])];
  return id.volume == owner.index && id.generation == owner.generation && id.local == static_cast<uint32_t>(f.local[0]);
}

bool Checker::compare_hit(const Walk& walk, const dsw_flight& flight, const std::string& what) {
  const Triangle& t = world_.triangles[static_cast<size_t>(walk.triangle)];
  const Face& face = world_.faces[static_cast<size_t>(walk.face)];
  const int behind = t.cell[walk.side > 0 ? 1 : 0];
  std::string wrong;
  if (flight.outcome != DSW_OUTCOME_CONTACT) wrong += " outcome " + std::to_string(flight.outcome) + " for a contact";
  if (!(flight.time == walk.time)) wrong += " time " + number(flight.time) + " for " + number(walk.time);
  if (!same_face(flight.contact.wall, walk.face)) {
    wrong += " face " + name(flight.contact.wall) + " for " + std::to_string(face.cell[0]) + "/" +
             std::to_string(face.local[0]);
  }
  if (!same_volume(flight.contact.behind, behind))
    wrong += " behind " + name(flight.contact.behind) + " for " + std::to_string(behind);
  if (flight.contact.kind != DSW_CONTACT_PLANE) wrong += " kind " + std::to_string(flight.contact.kind);
  const bool by_face = face.marked || behind < 0;
  if (flight.contact.marked_kind != (by_face ? DSW_CELL_FACE : DSW_CELL_VOLUME))
    wrong += " obstacle " + std::to_string(flight.contact.marked_kind);
  const auto tagged = static_cast<size_t>(behind >= 0 ? behind : walk.cell);
  const uint32_t tag = world_.mesh.tags.empty() ? 0 : world_.mesh.tags[tagged];
  if (flight.contact.tag != tag) wrong += " tag " + std::to_string(flight.contact.tag) + " for " + std::to_string(tag);
  double tolerance = 0;
  const Vec normal = world_.unit_normal(walk.triangle, &tolerance);
  for (size_t k = 0; k < 3; ++k) {
    const double want = -walk.side * normal[k];
    if (!(std::fabs(flight.contact.normal[k] - want) <= tolerance)) {
      wrong += " normal[" + std::to_string(k) + "] " + number(flight.contact.normal[k]) + " for " + number(want);
    }
  }
  if (!wrong.empty()) report_.mismatch(what + wrong);
  return wrong.empty();
}

void Checker::compare_crossings(const Walk& walk, const dsw_crossing* crossings, size_t count, uint32_t max_volumes,
                                const std::string& what) {
  const size_t expected = limited(walk, max_volumes) ? max_volumes : walk.steps.size();
  std::string wrong;
  if (count != expected) wrong = " " + std::to_string(count) + " crossings for " + std::to_string(expected);
  for (size_t i = 0; i < count && i < expected && wrong.empty(); ++i) {
    const Step& step = walk.steps[i];
    if (!same_volume(crossings[i].volume, step.cell) || !same_face(crossings[i].face, step.face) ||
        !(crossings[i].time == step.time)) {
      wrong = " crossing " + std::to_string(i) + " is " + name(crossings[i].volume) + " by " + name(crossings[i].face) +
              " at " + number(crossings[i].time) + " for " + std::to_string(step.cell) + " at " + number(step.time);
    }
  }
  if (!wrong.empty()) report_.mismatch(what + wrong);
}

void Checker::free_cast(const Vec& p, const Vec& q, Way way, dsw_volume_id hint, bool known, uint32_t max_volumes,
                        int start) {
  const BodyPoint from = world_.body(p.data()), to = world_.body(q.data());
  const Walk walk = world_.cast(from, to, start);
  report_.flight(walk);
  std::string what = "cast from " + hex(p) + " to " + hex(q) + " start " + name(hint) + (known ? " known" : "") +
                     " way " + std::to_string(way) + " limit " + std::to_string(max_volumes) + ":";
  if (walk.outcome == Walk::kBroken) {
    report_.mismatch(what + " environment is no partition: " + walk.fault);
    return;
  }
  if (known && walk.outcome == Walk::kOutside) {
    known = false;
  } else if (known) {
    hint = world_.ids[static_cast<size_t>(walk.steps.empty() ? walk.cell : walk.steps[0].cell)];
  }
  dsw_cast_options options = defaults(dsw_cast_options_init);
  if (known) options.flags |= DSW_CAST_START_KNOWN;
  if (way == kNoDetail) options.flags |= DSW_CAST_NO_DETAIL;
  options.max_volumes = max_volumes;
  dsw_flight flight;
  std::memset(&flight, 0xee, sizeof flight);
  std::vector<dsw_crossing> crossings(walk.steps.size() + 8);
  size_t count = 0;
  dsw_status status;
  if (way == kPath) {
    status = dsw_environment_cast_path(environment_, hint, p.data(), q.data(), &options, crossings.data(),
                                       crossings.size(), &count, &flight);
  } else if (way == kBatch) {
    status = dsw_environment_cast_segments(environment_, 1, &hint, p.data(), q.data(), 0, &options, &flight);
  } else {
    status = dsw_environment_cast(environment_, hint, p.data(), q.data(), &options, &flight);
  }
  if (status != DSW_STATUS_OK) {
    report_.mismatch(what + " " + dsw_status_string(status) + ": " + dsw_last_error_message());
    return;
  }
  if (walk.outcome == Walk::kOutside || walk.outcome == Walk::kImpassable) {
    const dsw_outcome want = walk.outcome == Walk::kOutside ? DSW_OUTCOME_OUTSIDE : DSW_OUTCOME_IMPASSABLE;
    if (flight.outcome != want) {
      report_.mismatch(what + " outcome " + std::to_string(flight.outcome) + " for " + std::to_string(want));
    }
    return;
  }
  if (way == kPath) compare_crossings(walk, crossings.data(), count, max_volumes, what);
  const size_t visited = limited(walk, max_volumes) ? max_volumes : walk.steps.size();
  if (flight.volumes_visited != visited) {
    report_.mismatch(what + " volumes_visited " + std::to_string(flight.volumes_visited) + " for " +
                     std::to_string(visited));
  }
  const int last = walk.steps[visited - 1].cell;
  if (!same_volume(flight.volume, last)) {
    report_.mismatch(what + " volume " + name(flight.volume) + " for " + std::to_string(last));
    if (walk.outcome == Walk::kReached && visited == walk.steps.size()) report_.lost(what);
  }
  const bool stopped = limited(walk, max_volumes);
  const dsw_outcome want = stopped                          ? DSW_OUTCOME_WORK_LIMIT
                           : walk.outcome == Walk::kContact ? DSW_OUTCOME_CONTACT
                                                            : DSW_OUTCOME_REACHED;
  if (flight.outcome != want) {
    report_.mismatch(what + " outcome " + std::to_string(flight.outcome) + " for " + std::to_string(want));
    return;
  }
  if (way == kNoDetail) return;
  if (want == DSW_OUTCOME_CONTACT) {
    compare_hit(walk, flight, what);
  } else {
    const double zero[3] = {0, 0, 0};
    if (!same_bits(flight.contact.normal, zero) || !same_face(flight.contact.wall, -1) ||
        !same_volume(flight.contact.behind, -1) || flight.contact.kind != DSW_CONTACT_NONE ||
        flight.contact.marked_kind != DSW_CELL_NONE || flight.contact.tag != 0) {
      report_.mismatch(what + " members of a contact are set without one");
    }
  }
  if (want == DSW_OUTCOME_REACHED && !(flight.time == 1 && same_bits(flight.position, q.data()))) {
    report_.mismatch(what + " reached at time " + number(flight.time) + " position " + hex(flight.position));
  }
  if (stopped && !(flight.time >= 0 && flight.time <= walk.steps[visited - 1].time)) {
    report_.mismatch(what + " work limit at time " + number(flight.time) + " after " +
                     number(walk.steps[visited - 1].time));
  }
  for (size_t k = 0; k < 3; ++k) {
    const double u = q[k] - p[k], at = p[k] + flight.time * u;
    const double allowed = 1e-15 * (std::fabs(p[k]) + std::fabs(flight.time * u)) + 2 * DBL_TRUE_MIN;
    if (std::isfinite(u) && !(std::fabs(flight.position[k] - at) <= allowed)) {
      report_.mismatch(what + " position " + hex(flight.position) + " off at time " + number(flight.time));
      break;
    }
  }
}

void Checker::locate(const Vec& p, dsw_volume_id hint) {
  const BodyPoint body = world_.body(p.data());
  const int cell = world_.locate(body);
  dsw_volume_id volume;
  dsw_location location;
  const std::string what = "locate " + hex(p) + " hint " + name(hint) + ":";
  const dsw_status status = dsw_environment_locate(environment_, p.data(), hint, &volume, &location);
  if (status != DSW_STATUS_OK) {
    report_.mismatch(what + " " + dsw_status_string(status) + ": " + dsw_last_error_message());
    return;
  }
  const dsw_location want = cell < 0                                             ? DSW_LOCATION_OUTSIDE
                            : world_.cell_marked[static_cast<size_t>(cell)] != 0 ? DSW_LOCATION_IMPASSABLE
                                                                                 : DSW_LOCATION_PASSABLE;
  if (!same_volume(volume, cell) || location != want) {
    report_.mismatch(what + " " + name(volume) + " location " + std::to_string(location) + " for " +
                     std::to_string(cell) + " location " + std::to_string(want));
  }
}

void Checker::move(dsw_scene* scene, dsw_particle_id particle, const Vec& target, uint32_t max_volumes,
                   bool with_crossings) {
  Vec old_position, position;
  dsw_volume_id old_volume, volume;
  if (dsw_particle_get_position(scene, particle, old_position.data(), &old_volume) != DSW_STATUS_OK) {
    report_.mismatch(std::string("particle_get: ") + dsw_last_error_message());
    return;
  }
  const BodyPoint from = world_.body(old_position.data()), to = world_.body(target.data());
  const Walk walk = world_.cast(from, to, static_cast<int>(old_volume.index));
  report_.flight(walk);
  const std::string what = "move from " + hex(old_position) + " in " + name(old_volume) + " to " + hex(target) +
                           " limit " + std::to_string(max_volumes) + ":";
  if (walk.outcome == Walk::kBroken || walk.steps.empty()) {
    report_.mismatch(what + " no walk: " + walk.fault);
    return;
  }
  dsw_cast_options options = defaults(dsw_cast_options_init);
  options.max_volumes = max_volumes;
  dsw_flight flight;
  std::memset(&flight, 0xee, sizeof flight);
  dsw_status status = dsw_particle_move(scene, particle, target.data(), &options, &flight);
  if (status == DSW_STATUS_OK) status = dsw_particle_get_position(scene, particle, position.data(), &volume);
  if (status != DSW_STATUS_OK) {
    report_.mismatch(what + " " + dsw_status_string(status) + ": " + dsw_last_error_message());
    return;
  }
  if (!same_bits(position.data(), flight.position) || volume.index != flight.volume.index ||
      volume.generation != flight.volume.generation) {
    report_.mismatch(what + " the particle is at " + hex(position) + " in " + name(volume) + ", reported " +
                     hex(flight.position) + " in " + name(flight.volume));
  }
  const bool stopped = limited(walk, max_volumes);
  const size_t visited = stopped ? max_volumes : walk.steps.size();
  const dsw_outcome want = stopped                          ? DSW_OUTCOME_WORK_LIMIT
                           : walk.outcome == Walk::kContact ? DSW_OUTCOME_CONTACT
                                                            : DSW_OUTCOME_REACHED;
  if (flight.outcome != want) {
    report_.mismatch(what + " outcome " + std::to_string(flight.outcome) + " for " + std::to_string(want));
  } else if (want == DSW_OUTCOME_CONTACT) {
    compare_hit(walk, flight, what);
  } else if (want == DSW_OUTCOME_REACHED && !(flight.time == 1 && same_bits(position.data(), target.data()))) {
    report_.mismatch(what + " reached " + hex(position) + " at " + number(flight.time));
  } else if (stopped && !(flight.time >= 0 && flight.time <= walk.steps[visited - 1].time)) {
    report_.mismatch(what + " work limit at time " + number(flight.time));
  }
  if (flight.volumes_visited != visited) {
    report_.mismatch(what + " volumes_visited " + std::to_string(flight.volumes_visited) + " for " +
                     std::to_string(visited));
  }
  if (with_crossings) {
    const dsw_crossing* crossings = nullptr;
    const size_t* first = nullptr;
    size_t flights = 0;
    if (dsw_scene_get_crossings(scene, &crossings, &first, &flights) != DSW_STATUS_OK || flights != 1) {
      report_.mismatch(what + " no crossings");
    } else {
      compare_crossings(walk, crossings + first[0], first[1] - first[0], max_volumes, what);
    }
  }
  // Wherever it stopped: the way there is free and the recorded volume holds it.
  const BodyPoint there = world_.body(position.data());
  const Walk way = world_.cast(from, there, static_cast<int>(old_volume.index));
  if (way.outcome != Walk::kReached) report_.mismatch(what + " the move to " + hex(position) + " is not free");
  if (!same_volume(volume, way.cell) || !world_.contains(static_cast<int>(volume.index), there)) {
    report_.lost(what + " recorded volume " + name(volume) + " does not hold " + hex(position) + ", that is in " +
                 std::to_string(way.cell));
  }
  if (want == DSW_OUTCOME_CONTACT && same_bits(position.data(), old_position.data())) {
    double gone = 0;
    for (size_t k = 0; k < 3; ++k) gone = std::max(gone, std::fabs(walk.time * (target[k] - old_position[k])));
    if (gone > 1e-6 * world_.size) report_.stuck(what);
  }
}

}  // namespace dsw::oracle
