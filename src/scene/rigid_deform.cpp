#include "scene/rigid_deform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dimensions.h"
#include "motion/place_on_way.h"
#include "scene/deform_call.h"
#include "scene/motions_left.h"
#include "scene/rigid_island.h"

namespace dsw {
namespace {

/** One call. */
template <int D>
class RigidDeformCall : DeformCall<D> {
  using Base = DeformCall<D>;
  using Base::env, Base::points, Base::record, Base::scene;

 public:
  RigidDeformCall(Scene<D>& of, double* next, BodyRecord<D>* const* bodies, const RigidMove<D>* motions, size_t count)
      : Base(of, next), bodies_(bodies), motions_(motions), count_(count), before_(bodies, count, of.memory) {}

  void gather();
  void run(const TogetherSettings& settings);
  void keep_results(size_t point_room);

 private:
  void add_bodies(const RigidMove<D>* motions);
  double go(const RigidMove<D>* motions, const double* to, const TogetherSettings& settings);
  void go_on(const TogetherSettings& settings);
  void add_contacts(double begin, double share);
  void finish_contacts(const MotionsLeft<D>& pushes);
  void arrive(double fraction);
  void take_back_all();
  void stay();

  BodyRecord<D>* const* bodies_;
  const RigidMove<D>* motions_;
  size_t count_;
  BodiesBefore<D> before_;
  Array<ShapeMove<D>> shapes_{scene.memory};
  Array<Array<double>> targets_{scene.memory};
  RigidIsland<D> moved_{scene.memory};
  Islands<D> islands_{scene.memory};
  RoomSteps<D> room_{env};
  // These hold what all motions have met, in a call in which bodies go on.
  Array<MoveRecord> all_{scene.memory};
  Array<dsw_wall_contact> walls_{scene.memory};
};

template <int D>
void RigidDeformCall<D>::gather() {
  shapes_.reserve(count_);
  for (size_t i = 0; i < count_; ++i) targets_.emplace_back(D * bodies_[i]->body.vertices.size(), 0.0, scene.memory);
  this->add_still(bodies_, count_, room_.standing);
  for (size_t i = 0; i < count_; ++i) {
    begin_move(scene, *bodies_[i]);
    bodies_[i]->next.clear();
  }
  add_bodies(motions_);
}

/** What stands has trajectories of its own, which follow those of the bodies in a motion, and wait in the room between two. */
template <int D>
void RigidDeformCall<D>::add_bodies(const RigidMove<D>* motions) {
  for (size_t i = count_; i < moved_.trajectories.size(); ++i) {
    room_.standing.push_back(std::move(moved_.trajectories[i]));
  }
  moved_.clear();
  shapes_.clear();
  if (count_ == 0) return;
  Array<Box<D>> reaches(scene.memory);
  for (size_t i = 0; i < count_; ++i) reaches.push_back(motions[i].reach(bodies_[i]->body));
  islands_ = Islands<D>(scene.memory);
  find_islands(scene, bodies_, count_, reaches.data(), islands_);
  leave_still_ones(scene, bodies_, count_, islands_);
  for (uint32_t i = 0; i < count_; ++i) {
    const Partners<D>* const standing = scene.features.contacts ? &islands_.partners[i] : nullptr;
    moved_.add(scene, *bodies_[i], motions[i], standing, targets_[i].data(), i, shapes_);
    moved_.trajectories.back().still = nullptr;
  }
}

/** Takes all along, from where they are to where `to` has the environment's points. Returns how far they come. */
template <int D>
double RigidDeformCall<D>::go(const RigidMove<D>* motions, const double* to, const TogetherSettings& settings) {
  room_.begin(to, record.invalid);
  if (scene.turning_together.get() == nullptr) scene.turning_together.make(scene.env);
  const double fraction = scene.turning_together.get()->move(moved_.turning, moved_.trajectories,
                                                             scene.features.contacts, settings, &room_);
  for (size_t i = 0; i < count_; ++i) keep_motion(*bodies_[i], motions[i]);
  return fraction;
}

template <int D>
void RigidDeformCall<D>::run(const TogetherSettings& settings) {
  record.clear();
  try {
    if (settings.response == TogetherResponse::kSlide) {
      go_on(settings);
    } else {
      record.fraction = go(motions_, points.nexts(), settings);
      this->keep_contacts(room_.contacts);
    }
    if (record.fraction > 0) arrive(record.fraction);
  } catch (const WorkOver&) {
    take_back_all();
    record.clear();
    record.fraction = 0;
    record.outcome = DSW_DEFORM_LIMITED;
    stay();
    return;
  } catch (...) {
    take_back_all();
    throw;
  }
  this->keep_outcome();
}

/** Goes on after touches, in motions that touched walls allow. Each makes a share of what is left of the environment's way. */
template <int D>
void RigidDeformCall<D>::go_on(const TogetherSettings& settings) {
  constexpr double kAtOnce = 0x1p-20;
  constexpr int kMostInVain = 12;
  MotionsLeft<D> pushes(scene, env, bodies_, motions_, count_);
  Array<RigidMove<D>> motions(motions_, motions_ + count_, scene.memory);
  const size_t numbers = size_t{D} * env.map.vertex_count;
  Array<double> to(points.nexts(), points.nexts() + numbers, scene.memory);
  for (size_t i = 0; i < count_; ++i) {
    all_.emplace_back(scene.memory);
    all_[i].keeps_partners = bodies_[i]->next.keeps_partners;
  }
  double gone = 0, share = 1;
  int in_vain = 0;
  for (uint32_t round = 0;; ++round) {
    const double aim = share == 1 ? 1 : gone + (1 - gone) * share;
    const double fraction = go(motions.data(), to.data(), settings), begin = gone;
    if (round == 0) {
      for (size_t i = 0; i < count_; ++i) all_[i].fraction = fraction;
    }
    gone = fraction == 1 ? aim : gone + (aim - gone) * fraction;
    pushes.follow(motions.data(), fraction);
    add_contacts(begin, aim - begin);
    if (gone == 1 || round == settings.rounds || !record.invalid.empty() || !pushes.note(room_.contacts)) break;
    in_vain = fraction > kAtOnce ? 0 : in_vain + 1;
    if (in_vain == kMostInVain) break;
    share = in_vain > 1 ? share / 4 : in_vain == 0 ? std::min(1.0, 2 * share) : share;
    share = pushes.propose(share, points.nexts(), motions);
    if (share == 0) break;
    const double next = share == 1 ? 1 : gone + (1 - gone) * share;
    for (size_t i = 0; i < numbers; i += D) {
      place_on_way<D>(points.starts() + i, points.nexts() + i, next, to.data() + i);
    }
    add_bodies(motions.data());
  }
  record.fraction = gone;
  finish_contacts(pushes);
}

/** Adds what the last motion has met. Times become those of the call. */
template <int D>
void RigidDeformCall<D>::add_contacts(double begin, double share) {
  const auto add = [&](double& time) { time = share == 1 ? time : begin + share * time; };
  for (dsw_wall_contact& contact : room_.contacts) {
    const size_t at = size_t{D} * contact.moving.index;
    std::copy_n(points.starts() + at, D, contact.from);
    std::copy_n(points.nexts() + at, D, contact.to);
    add(contact.time);
    walls_.push_back(contact);
  }
  for (size_t i = 0; i < count_; ++i) {
    MoveRecord& made = bodies_[i]->next;
    for (size_t k = 0; k < made.contacts.size(); ++k) {
      add(made.contacts[k].time);
      all_[i].add(made.contacts[k], made.keeps_partners ? made.partners[k] : dsw_contact_partner{});
    }
    all_[i].sweeps.swept += made.sweeps.swept;
    all_[i].sweeps.skipped += made.sweeps.skipped;
  }
}

/** The records of the bodies become those of all motions. */
template <int D>
void RigidDeformCall<D>::finish_contacts(const MotionsLeft<D>& pushes) {
  constexpr double kUnits = 32;  // what several motions may lose by rounding
  this->keep_contacts(walls_);
  for (size_t i = 0; i < count_; ++i) {
    const Body<D>& body = bodies_[i]->body;
    MoveRecord& all = all_[i];
    const auto left_of = [&](uint32_t v) { return difference<D>(pushes.target(i, v), body.position(v)); };
    double size = 0;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) size = std::max(size, largest_coordinate<D>(pushes.target(i, v)));
    }
    const double units = kUnits * (std::nextafter(size, 2 * size + 1) - size);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      ++all.moved;
      all.stopped += largest(left_of(v)) > units ? 1 : 0;
    }
    for (dsw_body_contact& contact : all.contacts) contact.distance_left = length(left_of(contact.vertex.index));
    if (all.stopped != 0) all.left = pushes.left(i);
    bodies_[i]->next.swap(all);
  }
}

/** The host's points are where the environment has gone, and it reads them. */
template <int D>
void RigidDeformCall<D>::arrive(double fraction) {
  if (fraction < 1) {
    points.keep_targets();
    std::copy_n(env.points, size_t{D} * env.map.vertex_count, points.nexts());
  }
  points.read_next();
}

template <int D>
void RigidDeformCall<D>::take_back_all() {
  this->take_back(room_.standing);
  this->take_back(moved_.trajectories);
  before_.put_all_back();
}

/** All bodies are where they were, at the work limit. */
template <int D>
void RigidDeformCall<D>::stay() {
  for (size_t i = 0; i < count_; ++i) {
    const RigidMotion<D> end = motions_[i].part(1);
    stay_at_limit(*bodies_[i], [&](uint32_t v, double* to) { end.place(bodies_[i]->body.position(v), to); });
    bodies_[i]->next.left = motion_left(end, motions_[i].part(0));
  }
}

template <int D>
void RigidDeformCall<D>::keep_results(size_t point_room) {
  this->keep_points(point_room);
  this->finish(bodies_, count_, moved_.trajectories);
}

}  // namespace

template <int D>
void deform_rigid(Scene<D>& scene, double* next, size_t point_room, BodyRecord<D>* const* bodies,
                  const RigidMove<D>* motions, size_t count, const TogetherSettings& settings) {
  RigidDeformCall<D> call(scene, next, bodies, motions, count);
  call.gather();
  call.run(settings);
  call.keep_results(point_room);
}

template void deform_rigid(Scene<2>&, double*, size_t, BodyRecord<2>* const*, const RigidMove<2>*, size_t,
                           const TogetherSettings&);
template void deform_rigid(Scene<3>&, double*, size_t, BodyRecord<3>* const*, const RigidMove<3>*, size_t,
                           const TogetherSettings&);

}  // namespace dsw
