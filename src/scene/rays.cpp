// The environment answers first, for the whole batch. Then bodies are asked for what is earlier, or nearer, than that.

#include "scene/rays.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/batch.h"
#include "base/dimensions.h"
#include "contact/describe.h"
#include "locate/distances.h"
#include "proximity/segment_touch.h"
#include "query/segment_range.h"
#include "scene/body_places.h"
#include "scene/near_bodies.h"

namespace dsw {
namespace {

/** Rows of bits over a box: which of its parts may hold a body. It tells most segments that none is near, in a fraction of
 * the time of a cast. */
template <int D>
class BodyMap {
 public:
  void set_frame(const Box<D>& all) noexcept {
    for (int k = 0; k < D; ++k) {
      const double width = all.upper[k] - all.lower[k];
      lower_[k] = all.lower[k];
      scale_[k] = width > 0x1p-900 && width < 0x1p+900 ? kParts * (1 - 0x1p-20) / width : 0;
    }
  }
  void add(const Box<D>& box) noexcept {
    for_each_row(box.lower, box.upper, [&](int row, uint32_t bits) {
      rows_[row] |= bits;
      return true;
    });
  }
  /** Whether a box may overlap one that was added. */
  bool may_hold(const double* lower, const double* upper) const noexcept {
    return !for_each_row(lower, upper, [&](int row, uint32_t bits) { return (rows_[row] & bits) == 0; });
  }

 private:
  static constexpr int kParts = 32;

  int part(int k, double x) const noexcept {  // monotone
    const double at = (x - lower_[k]) * scale_[k];
    return at >= kParts ? kParts - 1 : at > 0 ? static_cast<int>(at) : 0;
  }
  template <class Visit>
  bool for_each_row(const double* lower, const double* upper, const Visit& visit) const noexcept {
    const uint32_t low = ~0u << part(0, lower[0]), high = ~0u >> (kParts - 1 - part(0, upper[0]));
    const int y = part(1, lower[1]), last_y = part(1, upper[1]);
    const int z = D == 3 ? part(D - 1, lower[D - 1]) : 0, last_z = D == 3 ? part(D - 1, upper[D - 1]) : 0;
    for (int i = z; i <= last_z; ++i) {
      for (int j = y; j <= last_y; ++j) {
        if (!visit(i * kParts + j, low & high)) return false;
      }
    }
    return true;
  }

  double lower_[D] = {}, scale_[D] = {};
  uint32_t rows_[kParts * (D == 3 ? kParts : 1)] = {};
};

/** The bodies of a scene that can be near a place. Several threads may ask at a time. */
template <int D>
class BodiesAbout {
 public:
  /** O(bodies), of scenes without boxes O(their vertices). */
  explicit BodiesAbout(const Scene<D>& scene) : scene_(scene) {
    const auto bounds_of = [&](const Body<D>& body) {
      Box<D> bounds;
      if (scene.keeps_boxes()) {
        bounds = fresh_boxes(body).bounds;
      } else {
        for (uint32_t v = 0; v < body.vertices.size(); ++v) {
          if (body.has_vertex(v)) bounds.add(body.position(v));
        }
      }
      return bounds.empty() ? bounds : widened(bounds, body.radius);
    };
    for_each_body(scene, [&](uint32_t, const BodyRecord<D>& of) {
      const Box<D> bounds = bounds_of(of.body);
      if (!bounds.empty()) all_.add(bounds);
    });
    if (all_.empty()) return;
    map_.set_frame(all_);
    for_each_body(scene, [&](uint32_t, const BodyRecord<D>& of) {
      const Box<D> bounds = bounds_of(of.body);
      if (!bounds.empty()) map_.add(bounds);
    });
  }

  /** Lists those segments of a batch whose boxes overlap that of all bodies; returns how many. Most are far from it: nothing
   * but this is asked of them, and what it needs stays in registers. */
  size_t find_near(PointArray from, PointArray to, size_t begin, size_t end, size_t* near) const noexcept {
    const Box<D> all = all_;
    size_t count = 0;
    for (size_t i = begin; i < end; ++i) {
      const double *const p = from[i], *const q = to[i];
      double gap = 0;  // the sign of a difference is exact
      for (int k = 0; k < D; ++k) {
        gap = std::max(gap, std::max(all.lower[k] - std::max(p[k], q[k]), std::min(p[k], q[k]) - all.upper[k]));
      }
      near[count] = i;
      count += gap > 0 ? 0u : 1u;
    }
    return count;
  }
  /** Whether the box of a segment may overlap that of one of the bodies, if it overlaps that of all. */
  bool may_meet(const double* from, const double* to) const noexcept {
    double lower[D], upper[D];
    for (int k = 0; k < D; ++k) {
      lower[k] = std::min(from[k], to[k]);
      upper[k] = std::max(from[k], to[k]);
    }
    return map_.may_hold(lower, upper);
  }
  template <class Visit>
  void visit(const Box<D>& box, Visit visit) const {
    if (!all_.overlaps(box)) return;
    const auto name = [&](uint32_t slot) {
      return Partner<D>{&scene_.bodies[slot].body, slot, scene_.body_slots.generation(slot)};
    };
    if (!scene_.keeps_boxes()) {
      for_each_body(scene_, [&](uint32_t slot, const BodyRecord<D>&) { visit(name(slot)); });
    } else {
      scene_.body_boxes.visit(box, [&](uint32_t slot) {
        visit(name(slot));
        return true;
      });
    }
  }

 private:
  const Scene<D>& scene_;
  Box<D> all_;  // all bodies are in it
  BodyMap<D> map_;
};

/** What a segment has met of a body, in place of what it met of the environment. */
template <int D>
void report_body(const Environment<D>& env, const double* from, const double* to, Cell start,
                 const SegmentTouch<D>& touch, dsw_flight* flight) noexcept {
  clear(flight);
  flight->outcome = DSW_OUTCOME_CONTACT;
  flight->time = touch.time;
  point_at<D>(from, to, touch.time, flight->position);
  const Vec normal = touch.is_thick ? touch.away : normal_on_way<D>(from, to, touch);
  store<D>(normal + Vec::Zero(), flight->contact.normal);  // never -0
  flight->contact.kind = contact_kind(touch.other_part.kind);
  if (!start.valid()) return;
  const CastResult way = cast<D>(env, from, flight->position, start);
  flight->volume = flight->contact.front = volume_id(env.map, way.cell);
  flight->volumes_visited = way.volumes_visited;
}

void leave_out_detail(dsw_flight* flight) noexcept {
  const dsw_flight given = *flight;
  clear(flight);
  flight->outcome = given.outcome;
  flight->volume = given.volume;
  flight->volumes_visited = given.volumes_visited;
}

template <int D>
class RayBatch {
 public:
  RayBatch(const Scene<D>& scene, const dsw_volume_id* starts, PointArray from, PointArray to,
           const SegmentOptions& options)
      : env_(scene.env),
        bodies_(scene),
        starts_(scene.env, starts, options.start_known),
        from_(from),
        to_(to),
        options_(options) {}

  const Starts<D>& starts() const noexcept { return starts_; }
  size_t find_near(size_t begin, size_t end, size_t* near) const noexcept {
    return bodies_.find_near(from_, to_, begin, end, near);
  }
  /** @param flight what the environment has answered. */
  void ask(size_t i, dsw_flight* flight, dsw_contact_partner* partner) const noexcept {
    if (flight->outcome < DSW_OUTCOME_REACHED || flight->outcome > DSW_OUTCOME_WORK_LIMIT) return;
    const double* const from = from_[i];
    const double* const to = to_[i];
    if (!bodies_.may_meet(from, to)) return;
    const double limit = flight->outcome == DSW_OUTCOME_REACHED ? kNever : flight->time;
    SegmentTouch<D> first;
    first.time = limit;
    Box<D> box;
    box.add(from);
    box.add(flight->position);
    box = widened(box, kRoom * largest_coordinate<D>(from, to));
    const SegmentEnds ends = options_.open_ends ? SegmentEnds::kOpen : SegmentEnds::kClosed;
    bodies_.visit(box, [&](const Partner<D>& body) { meet_segment(body, from, to, ends, first); });
    if (!(first.time < limit)) return;
    const Cell start = options_.open_ends ? Cell{} : starts_.find(i, from);
    report_body(env_, from, to, start, first, flight);
    *partner = partner_of(first);
  }

 private:
  static constexpr double kRoom = 0x1p-45;  // for rounding

  const Environment<D>& env_;
  BodiesAbout<D> bodies_;
  Starts<D> starts_;
  PointArray from_, to_;
  SegmentOptions options_;
};

template <int D>
void report_place(const double* point, const BodyPlace<D>& place, dsw_nearest& answer,
                  dsw_contact_partner& partner) noexcept {
  const uint32_t visited = answer.volumes_visited;
  answer = {};
  answer.distance = place.distance;
  // Not by the distance: less the radius it says little of the way.
  store<D>(Vec::Zero() - unit(place.way), answer.normal);
  for (int k = 0; k < D; ++k) {
    answer.point[k] = point[k] + place.way[k] / place.scale + place.body.body->radius * answer.normal[k];
  }
  answer.volumes_visited = visited;
  partner = name_partner(place.body, place.part);
}

}  // namespace

template <int D>
void cast_among_bodies(Scene<D>& scene, size_t count, const dsw_volume_id* starts, PointArray from, PointArray to,
                       const SegmentOptions& options, dsw_flight* flights, dsw_contact_partner* partners) {
  SegmentOptions with_detail = options;
  with_detail.detail = true;
  if (options.open_ends) cast_segments(scene.env, scene.parallel, count, starts, from, to, with_detail, flights);
  const RayBatch<D> batch(scene, starts, from, to, options);
  constexpr size_t kAtHand = 4 * kPacket;
  const auto ask = [&](size_t begin, size_t end) noexcept {
    std::memset(partners + begin, 0, (end - begin) * sizeof *partners);
    size_t near[kAtHand];
    const size_t near_count = batch.find_near(begin, end, near);
    for (size_t k = 0; k < near_count; ++k) batch.ask(near[k], flights + near[k], partners + near[k]);
    for (size_t i = begin; i < end && !options.detail; ++i) leave_out_detail(flights + i);
  };
  // Threads are started once for both: that took longer than all questions about bodies that are far away.
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t next; begin < end; begin = next) {
      next = std::min(begin + kAtHand, end);
      if (!options.open_ends) cast_range(scene.env, batch.starts(), from, to, with_detail, begin, next, flights);
      ask(begin, next);
    }
  };
  share_out(scene.parallel, count, body);
}

template <int D>
void nearest_among_bodies(Scene<D>& scene, size_t count, PointArray points, const dsw_volume_id* hints, double radius,
                          const NearestAnswers<dsw_nearest>& answers, dsw_contact_partner* partners) {
  Array<dsw_location> own(scene.memory);
  NearestAnswers<dsw_nearest> with_locations = answers;
  if (answers.locations == nullptr) {
    own.resize(count);
    with_locations.locations = own.data();
  }
  nearest_to_points(scene.env, scene.parallel, count, points, hints, radius, with_locations);
  const BodiesAbout<D> bodies(scene);
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      partners[i] = {};
      if (with_locations.locations[i] != DSW_LOCATION_PASSABLE) continue;
      BodyPlace<D> place;
      const double limit = place.distance = std::min(answers.nearest[i].distance, radius);
      const bool reaches_limit = answers.nearest[i].cell.kind == DSW_CELL_NONE;
      place.scale = fitting_scale<D>(scene.env, {points[i]});
      bodies.visit(box_about<D>(points[i], limit),
                   [&](const Partner<D>& each) { find_nearest_place(each, points[i], place); });
      const bool is_nearer = place.distance < limit || (reaches_limit && place.distance <= limit);
      if (place.body.body != nullptr && is_nearer) report_place(points[i], place, answers.nearest[i], partners[i]);
    }
  };
  share_out(scene.parallel, count, body);
}

DSW_INSTANTIATE(cast_among_bodies);
DSW_INSTANTIATE(nearest_among_bodies);

}  // namespace dsw
