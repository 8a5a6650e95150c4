// Each path has a copy of the body, which is put at the first pose, looked at there and then moved as by dsw_body_move_rigid.

#include "scene/free_fractions.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "base/eigen.h"
#include "environment/marking.h"
#include "locate/locate.h"
#include "proximity/thick_sweep.h"
#include "response/turning_move.h"
#include "scene/meeting.h"
#include "scene/near_bodies.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

/** The motion to a pose from where the body is. */
template <int D>
RigidMotion<D> to_pose(const double* centre, const Pose& pose) noexcept {
  double about[3] = {};
  std::copy_n(centre, D, about);
  return RigidMove<D>(pose.rotation, about, pose.translation).part(1);
}

/** The motion from one pose to another: about the place of the centre, which goes straight. */
template <int D>
RigidMove<D> motion_between(const RigidMotion<D>& a, const RigidMotion<D>& b) noexcept {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(b.rotation) * Eigen::Quaterniond(a.rotation).conjugate();
  double centre[3] = {}, translation[3] = {};
  a.centre_now(centre);
  for (int k = 0; k < D; ++k) translation[k] = b.translation[k] - a.translation[k];
  return {turn.coeffs().data(), centre, translation};
}

/** A motion that ends exactly where a pose has the vertices. */
template <int D>
struct PosedMove {
  const RigidMove<D>& move;
  const RigidMotion<D>& end;
  const Body<D>& rest;

  static void place(const void* user, uint32_t vertex, const double* from, double fraction, double* to) noexcept {
    const PosedMove& m = *static_cast<const PosedMove*>(user);
    if (fraction == 1) {
      m.end.place(m.rest.position(vertex), to);
    } else {
      RigidMove<D>::place(&m.move, vertex, from, fraction, to);
    }
  }
};

/** The bodies of a scene, for several threads to read. A body whose boxes are out of date is copied, and the boxes of the copy are
 * made new. */
template <int D>
class StillBodies {
 public:
  explicit StillBodies(const Scene<D>& scene) : scene_(scene), copies_(scene.memory), place_(scene.memory) {
    if (!scene.features.contacts) return;
    place_.assign(scene.bodies.size(), kNone);
    for_each_body(scene, [&](uint32_t slot, const BodyRecord<D>& of) {
      if (of.body.boxes[0].stale_count == 0) return;
      place_[slot] = static_cast<uint32_t>(copies_.size());
      copies_.push_back(of.body);
      fresh_boxes(copies_.back());
    });
  }
  const Body<D>& of(uint32_t slot) const {
    return place_[slot] == kNone ? scene_.bodies[slot].body : copies_[place_[slot]];
  }

 private:
  const Scene<D>& scene_;
  Array<Body<D>> copies_;
  Array<uint32_t> place_;  // by slot, in copies_
};

/** Goes along paths; one for each thread. */
template <int D>
class PathWalk {
 public:
  /** `rest` remembers nothing of its moves. */
  PathWalk(const Scene<D>& scene, const StillBodies<D>& others, const Body<D>& rest, uint32_t slot)
      : scene_(scene),
        others_(others),
        rest_(rest),
        slot_(slot),
        body_(rest),
        mover_(scene.env),
        turning_(scene.env),
        probe_(scene.env, Obstacle::kCells),
        thick_(scene.env),
        partners_(scene.memory),
        blocked_(scene.memory),
        record_(scene.memory) {
    record_.keeps_partners = scene.features.contacts;
    mover_.set_partners(partners());
  }

  FreeFraction walk(const PosePaths& paths, size_t path) {
    const uint32_t begin = paths.begin(path), pieces = paths.begin(path + 1) - begin - 1;
    const auto pose = [&](uint32_t i) { return to_pose<D>(paths.centre, paths.poses[paths.indices[begin + i]]); };
    FreeFraction found;
    record_.clear();
    RigidMotion<D> from = pose(0);
    found.is_start_free = put(from) && is_free();
    if (!found.is_start_free) return found;
    for (; found.piece < pieces; ++found.piece) {
      const RigidMotion<D> to = pose(found.piece + 1);
      if (!go(from, to)) {
        found.piece_fraction = record_.fraction;
        found.fraction = std::min((found.piece + found.piece_fraction) / pieces, 1 - 0x1p-53);
        return found;
      }
      from = to;
    }
    found.fraction = 1;
    return found;
  }
  /** What stopped the last walk; null: nothing. */
  const dsw_body_contact* contact() const { return record_.contacts.empty() ? nullptr : &record_.contacts[0]; }

 private:
  const Partners<D>* partners() const { return scene_.features.contacts ? &partners_ : nullptr; }

  /** Puts the body somewhere. False: a vertex is in no passable cell. */
  bool put(const RigidMotion<D>& pose) {
    body_ = rest_;
    Cell cell;  // most walks from the vertex before are short
    for (uint32_t v = 0; v < rest_.vertices.size(); ++v) {
      if (!rest_.has_vertex(v)) continue;
      double at[D];
      pose.place(rest_.position(v), at);
      cell = locate(scene_.env, at, cell, nullptr).cell;
      if (!cell.valid() || is_closed(scene_.env, cell)) return false;
      put_vertex(body_, v, at, cell);
    }
    if (scene_.keeps_boxes()) tighten_bounds(body_);
    return true;
  }

  /** Whether the body is free where it is, as dsw_body_create has it. */
  bool is_free() {
    blocked_.clear();
    probe_.find_blocked(body_, body_.level, blocked_);
    if (!blocked_.empty()) return false;
    if (scene_.features.contacts) {
      find_partners(reach_of(body_));
      if (!is_body_apart(partners_, body_, body_.level, [](uint32_t, uint32_t) { return false; })) return false;
    }
    return !ThickSweep<D>::is_thick(partners(), body_) || thick_.keep_at_rest(partners(), body_);
  }

  void find_partners(const Box<D>& reach) {
    partners_.clear();
    partners_.reach = reach;
    const auto add = [&](const Body<D>& body, uint32_t slot) {
      partners_.add({&body, slot, scene_.body_slots.generation(slot)});
    };
    scene_.body_boxes.visit(widened(reach, body_.radius), [&](uint32_t slot) {
      if (slot != slot_ && body_.filter.sees(others_.of(slot).filter)) add(others_.of(slot), slot);
      return true;
    });
    if (body_.filter.self) add(body_, slot_);
  }

  /** Moves the body from a pose to another. Whether it comes there. */
  bool go(const RigidMotion<D>& from, const RigidMotion<D>& to) {
    const RigidMove<D> motion = motion_between(from, to);
    const PosedMove<D> posed{motion, to, rest_};
    // Distances are widened by the bend of the way, at most by a radius.
    if (scene_.features.contacts) find_partners(widened(motion.reach(body_), body_.radius));
    turning_.move(mover_, body_, motion, PosedMove<D>::place, &posed, {}, partners(), record_);
    return record_.fraction == 1;
  }

  const Scene<D>& scene_;
  const StillBodies<D>& others_;
  const Body<D>& rest_;
  uint32_t slot_;
  Body<D> body_;
  BodyMove<D> mover_;
  TurningMove<D> turning_;
  BodyProbe<D> probe_;
  ThickSweep<D> thick_;
  Partners<D> partners_;
  Array<uint32_t> blocked_;
  MoveRecord record_;
};

/** A copy of a body that remembers nothing of its moves. */
template <int D>
Body<D> without_forecasts(const Body<D>& body) {
  Body<D> copy(body);
  for (size_t e = 0; e < copy.corridors.size(); ++e) copy.corridors.forget(e);
  copy.touched.clear();
  std::fill(copy.untested.begin(), copy.untested.end(), uint8_t{0});  // all edges are looked at
  std::fill(copy.clearances.begin(), copy.clearances.end(), Clearance<D>{});
  if (!copy.boxes.empty()) fresh_boxes(copy);
  return copy;
}

}  // namespace

template <int D>
bool is_pose_finite(const Body<D>& body, const double* centre, const Pose& pose) noexcept {
  const RigidMotion<D> motion = to_pose<D>(centre, pose);
  double at[D];
  motion.centre_now(at);
  // A path goes from one pose to another: differences of translations must be finite, too.
  for (int k = 0; k < D; ++k) {
    if (!std::isfinite(2 * at[k]) || !std::isfinite(2 * motion.translation[k])) return false;
  }
  for (const BodyVertex<D>& each : body.vertices) {
    if (!each.cell.valid()) continue;
    motion.place(each.position, at);
    if (!is_finite<D>(at)) return false;
  }
  return true;
}

template <int D>
void find_free_fractions(const Scene<D>& scene, const BodyRecord<D>& of, const PosePaths& paths,
                         FreeFraction* fractions, dsw_body_contact* contacts) {
  if (paths.count == 0) return;
  const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
  const StillBodies<D> others(scene);
  const Body<D> rest = without_forecasts(of.body);
  parallel_few_chunks(scene.parallel, paths.count, [&](size_t begin, size_t end) {
    PathWalk<D> walk(scene, others, rest, slot);
    for (size_t i = begin; i < end; ++i) {
      fractions[i] = walk.walk(paths, i);
      if (contacts == nullptr) continue;
      contacts[i] = walk.contact() != nullptr ? *walk.contact() : dsw_body_contact{};
    }
  });
}

#define DSW_FREE_FRACTIONS(D)                                                                               \
  template bool is_pose_finite(const Body<D>&, const double*, const Pose&) noexcept;                        \
  template void find_free_fractions(const Scene<D>&, const BodyRecord<D>&, const PosePaths&, FreeFraction*, \
                                    dsw_body_contact*)
DSW_FREE_FRACTIONS(2);
DSW_FREE_FRACTIONS(3);
#undef DSW_FREE_FRACTIONS

}  // namespace dsw
