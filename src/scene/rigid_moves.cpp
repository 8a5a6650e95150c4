// A body that slides makes several rigid motions, each followed exactly. After the first one what is left of the motion is
// projected on what the touched walls allow, and the projection is the next motion. It counts if the body comes nearer to its
// target by it; else the body is taken back.

#include "scene/rigid_moves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen.h"
#include "base/vec.h"
#include "response/allowed_motion.h"
#include "response/body_move.h"
#include "response/turning_move.h"
#include "scene/meeting.h"

namespace dsw {
namespace {

/** The rigid motions of one call. */
template <int D>
class RigidCall {
 public:
  RigidCall(Scene<D>& scene, BodyRecord<D>& of, const MoveOrder& order)
      : scene_(scene), of_(of), order_(order), mover_(mover_of(scene)), partners_(scene.memory) {
    mover_.set_counters(scene.features.statistics ? &casts_ : nullptr);
    follow_changes(scene, of);
    mover_.set_notes(&of.kept_near);
    of.touches.prepare(of.record);
    if (scene.turning.get() == nullptr) scene.turning.make(scene.env);
  }
  /** Makes a motion as far as it is free, by about `most_chords` at most; what was met goes to the record. Returns the
   * number of chords that were tried. */
  int go(const RigidMove<D>& motion, MoveRecord& record, int most_chords = TurningMove<D>::kMostTries) {
    scene_.turning.get()->set_most_tries(most_chords);
    go_on(motion, record);
    return scene_.turning.get()->tries();
  }
  void end() noexcept { end_move(scene_, of_, casts_); }

 private:
  void go_on(const RigidMove<D>& motion, MoveRecord& record) {
    Body<D>& body = of_.body;
    // Distances are widened by the bend of the way, at most by a radius.
    if (scene_.features.contacts) {
      find_partners(scene_, body, widened(motion.reach(body), body.radius), partners_);
    }
    mover_.set_partners(partners());
    if (!body.is_rigid()) return move(motion, RigidMove<D>::place, &motion, record);
    RigidShape<D> before = body.shape[0];
    keep_shape(body);
    const ShapeMove<D> kept{motion, body.shape[0]};
    try {
      move(motion, ShapeMove<D>::place, &kept, record);
    } catch (...) {
      std::swap(body.shape[0], before);
      throw;
    }
    if (record.fraction > 0) body.shape[0].moved = kept.moved(record.fraction);
  }
  const Partners<D>* partners() const { return scene_.features.contacts ? &partners_ : nullptr; }
  void move(const RigidMove<D>& motion, PlaceFn place, const void* user, MoveRecord& record) {
    scene_.turning.get()->move(mover_, of_.body, motion, place, user, order_, partners(), record);
  }

  Scene<D>& scene_;
  BodyRecord<D>& of_;
  const MoveOrder& order_;
  BodyMove<D>& mover_;
  Partners<D> partners_;
  CastCounters casts_;
};

/** What is left of a motion, and what touched walls allow of it. */
template <int D>
class RigidSlide {
 public:
  /** `slides`: false if only left() will be called. */
  RigidSlide(const Body<D>& body, const RigidMove<D>& whole, bool slides, const Memory* memory)
      : body_(body), end_(whole.part(1)), targets_(memory) {
    std::copy_n(end_.centre, D, made_.centre);
    if (!slides) return;
    targets_.resize(D * body.vertices.size());
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) end_.place(body.position(v), &targets_[D * size_t{v}]);
    }
  }

  /** The body has made a part of a motion, and then met something if there is a contact. */
  void follow(const RigidMove<D>& motion, double fraction, const MoveRecord& record) {
    const RigidMotion<D> part = motion.part(fraction);
    made_.add_about(part.rotation, part.centre, part.translation);
    planes_.follow(part);
    note(record);
  }
  /** It has met something, and is not where it came to. */
  void note(const MoveRecord& record) {
    if (record.contacts.empty()) return;
    const dsw_body_contact& contact = record.contacts[0];
    Vec normal = to_vec<3>(contact.contact.normal);
    // Against the way of what touched.
    if (dot(normal, to_vec<3>(contact.to) - to_vec<3>(contact.from)) > 0) normal = -normal;
    if (!is_zero(normal)) planes_.add(normal, to_vec<3>(contact.point));
  }
  void forget_walls() { planes_.clear(); }
  bool has_walls() const { return !planes_.empty(); }

  /** The motion from where the body is to where it should be. */
  PlainMotion left() const { return motion_left(end_, made_); }
  /** What the touched walls allow of a share of what is left. False: next to nothing. */
  bool propose(double share, PlainMotion* motion) const {
    *motion = left();
    if (planes_.empty()) return share == 1;
    const Inertia<D> inertia(body_);
    // Planes hold for small turns: others are made in several motions.
    for (int halvings = 0; halvings < kMostHalvings; ++halvings, share *= 0.5) {
      const Allowed allowed = find_allowed(body_, inertia, planes_, *motion, share, motion);
      if (allowed != Allowed::kTooFar) return allowed == Allowed::kFound;
    }
    return false;
  }

  /** How far the vertices are from their targets: the mean of the squares, or infinity. */
  double distance() const {
    double sum = 0;
    for (uint32_t v = 0; v < body_.vertices.size(); ++v) {
      if (!body_.has_vertex(v)) continue;
      const Vec missing = difference<D>(&targets_[D * size_t{v}], body_.position(v));
      sum += dot(missing, missing);
    }
    return sum;
  }
  uint32_t count_missing() const {
    uint32_t count = 0;
    for (uint32_t v = 0; v < body_.vertices.size(); ++v) {
      const double* const target = &targets_[D * size_t{v}];
      count += body_.has_vertex(v) && !std::equal(target, target + D, body_.position(v)) ? 1u : 0u;
    }
    return count;
  }

 private:
  static constexpr int kMostHalvings = 24;

  const Body<D>& body_;
  const RigidMotion<D> end_;
  RigidMotion<D> made_;
  Array<double> targets_;
  TouchedPlanes<D> planes_;
};

/** Adds what one of several motions has met. */
void add_contacts(MoveRecord& all, const MoveRecord& more) {
  for (size_t i = 0; i < more.contacts.size(); ++i) {
    all.add(more.contacts[i], all.keeps_partners ? more.partners[i] : dsw_contact_partner{});
  }
}

/** Slides on after a first motion. */
template <int D>
void slide_on(Scene<D>& scene, RigidCall<D>& call, BodyRecord<D>& of, RigidSlide<D>& slide, uint32_t rounds) {
  constexpr int kMostInVain = 12, kMostChords = 1000;
  constexpr double kGain = 1 - 0x1p-30, kAtOnce = 0x1p-20;
  Body<D>& body = of.body;
  Array<BodyVertex<D>> before(scene.memory);
  Array<RigidShape<D>> shape(scene.memory);
  MoveRecord record(scene.memory);
  record.keeps_partners = of.next.keeps_partners;
  double distance = slide.distance(), share = 1;
  int in_vain = 0, chords = 0;
  bool has_gained = true;  // since walls were forgotten
  for (uint32_t round = 0; round < rounds && distance > 0 && chords < kMostChords; ++round) {
    PlainMotion next;
    if (!slide.propose(share, &next)) {
      // In a corner of walls of which it may have left some.
      if (!has_gained || !slide.has_walls()) return;
      slide.forget_walls();
      has_gained = false;
      share = 1;
      if (!slide.propose(share, &next)) return;
    }
    const RigidMove<D> motion(next.rotation, next.centre, next.translation);
    before.assign(body.vertices.begin(), body.vertices.end());
    shape = body.shape;
    chords += call.go(motion, record, kMostChords - chords);
    const double now = slide.distance();
    of.next.sweeps.swept += record.sweeps.swept;
    of.next.sweeps.skipped += record.sweeps.skipped;
    // A motion that stops at once tells of one more wall, one that leads away is too long for what the planes say.
    const bool is_stopped = record.fraction < kAtOnce;
    if (now < distance) {
      slide.follow(motion, record.fraction, record);
      add_contacts(of.next, record);
    } else {
      put_vertices(body, before.data());
      body.shape = shape;
      if (is_stopped) {
        slide.note(record);
        add_contacts(of.next, record);  // it touches where it stays
      }
    }
    const bool gains = now < kGain * distance;
    distance = std::min(distance, now);
    has_gained = has_gained || gains;
    in_vain = gains ? 0 : in_vain + 1;
    if (in_vain == kMostInVain) return;
    if (gains) {
      share = std::min(1.0, 2 * share);
    } else if (!is_stopped || record.contacts.empty()) {
      share *= 0.25;
    }
  }
}

}  // namespace

template <int D>
PlainMotion motion_left(const RigidMotion<D>& end, const RigidMotion<D>& made) noexcept {
  PlainMotion left;
  double to[3] = {};
  const Eigen::Quaterniond turn =
      (Eigen::Quaterniond(end.rotation) * Eigen::Quaterniond(made.rotation).conjugate()).normalized();
  std::copy_n(turn.coeffs().data(), 4, left.rotation);
  made.centre_now(left.centre);
  end.centre_now(to);
  for (int k = 0; k < D; ++k) left.translation[k] = to[k] - left.centre[k];
  return left;
}

template <int D>
bool stays_finite(const Body<D>& body, const RigidMove<D>& motion) noexcept {
  if (!is_finite<3>(motion.way().place[1])) return false;
  for (const BodyVertex<D>& each : body.vertices) {
    double to[D];
    if (!each.cell.valid()) continue;
    RigidMove<D>::place(&motion, 0, each.position, 1, to);
    if (!is_finite<D>(to)) return false;
  }
  return true;
}

template <int D>
void move_rigid(Scene<D>& scene, BodyRecord<D>& of, const RigidMove<D>& motion, const MoveOrder& order,
                uint32_t rounds) {
  RigidSlide<D> slide(of.body, motion, rounds != 0, scene.memory);
  RigidCall<D> call(scene, of, order);
  Body<D> whole(scene.memory);
  if (rounds != 0) whole = of.body;
  call.go(motion, of.next);
  slide.follow(motion, of.next.fraction, of.next);
  if (rounds != 0 && of.next.fraction < 1) {
    try {
      slide_on(scene, call, of, slide, rounds);
    } catch (...) {
      std::swap(of.body, whole);
      throw;
    }
    of.next.stopped = slide.count_missing();
  }
  if (of.next.fraction < 1) of.next.left = slide.left();
  call.end();
}

#define DSW_RIGID_MOVES(D)                                                                 \
  template PlainMotion motion_left(const RigidMotion<D>&, const RigidMotion<D>&) noexcept; \
  template bool stays_finite(const Body<D>&, const RigidMove<D>&) noexcept;                \
  template void move_rigid(Scene<D>&, BodyRecord<D>&, const RigidMove<D>&, const MoveOrder&, uint32_t)
DSW_RIGID_MOVES(2);
DSW_RIGID_MOVES(3);
#undef DSW_RIGID_MOVES

}  // namespace dsw
