#include "response/vertex_move.h"

#include <algorithm>

#include "base/points.h"
#include "base/search.h"
#include "contact/describe.h"
#include "contact/vertex_normal.h"
#include "response/insertion.h"
#include "walk/retreat.h"

namespace dsw {
namespace {

constexpr uint32_t kMostSlides = 8, kMostInsertions = 64;
// Slides in a row that lead nowhere are a corner.
constexpr uint32_t kMostInVain = 3;
constexpr double kStandOffShare = 1e-9;

template <int D>
double extent(const Environment<D>& env, Cell c) {
  Box<D> box;
  env.map.for_each_vertex(c, [&](uint32_t v) { box.add(env.point(v)); });
  double size = 0;
  for (int k = 0; k < D; ++k) size = std::max(size, box.upper[k] - box.lower[k]);
  return size;
}

}  // namespace

template <int D>
bool VertexMove<D>::move(uint32_t v, const double* target, const Cell* arrival) {
  Walls walls;
  TouchedWalls<D> touched;
  uint32_t slides = 0, in_vain = 0;
  first_edit_ = record_.edits.size();
  double to[D];
  std::copy_n(target, D, to);
  for (;;) {
    const size_t first_contact = record_.contacts.size();
    double before[D];
    std::copy_n(body_.position(v), D, before);
    if (advance(v, to, arrival)) return std::equal(to, to + D, target);
    arrival = nullptr;
    if (record_.contacts.size() == first_contact) {
      ++record_.limited;
      return false;
    }
    const double left = length(difference<D>(target, body_.position(v)));
    for (size_t i = first_contact; i < record_.contacts.size(); ++i) record_.contacts[i].distance_left = left;
    const dsw_body_contact& contact = record_.contacts[first_contact];
    const bool of_vertex = contact.edge.generation == 0 && contact.face.generation == 0;
    if (of_vertex && leave(v, contact)) return false;
    const Response response = of_vertex ? settings_.vertex : settings_.edge;
    if (!of_vertex && settings_.may_insert() && insert(v, contact)) {
      walls.count = 0;
      touched.clear();
      std::copy_n(target, D, to);
      continue;
    }
    if (!MoveSettings::slides(response) || ++slides > kMostSlides) return false;
    if (settings_.keeps_walls) {
      in_vain = std::equal(before, before + D, body_.position(v)) ? in_vain + 1 : 0;
      if (in_vain > kMostInVain || !slide_before(v, target, contact, touched, to)) return false;
    } else if (!slide(v, target, contact, walls, to)) {
      return false;
    }
  }
}

/** Notes that the vertex leaves where it met an exit; false: it met something else. */
template <int D>
bool VertexMove<D>::leave(uint32_t v, const dsw_body_contact& contact) {
  const dsw_face_id wall = body_.radius > 0 ? exit_ : contact.contact.wall;
  const uint32_t patch = settings_.leaves && wall.generation != 0 ? env_.exits.patch(wall.volume, wall.local) : 0;
  if (patch == 0) return false;
  dsw_exit exit{};
  std::copy_n(contact.point, 3, exit.point);
  exit.time = contact.time;
  exit.face = wall;
  exit.patch = patch;
  exit.vertex = vertex_id(body_, v);
  record_.exits.push_back(exit);
  return true;
}

/** The exit among all that a thick vertex comes to first. Which of them is told as the contact depends on how the
 * environment is numbered, so it does not say whether the vertex leaves. Of several exits the one with the lowest patch. */
template <int D>
void VertexMove<D>::find_exit(uint32_t v, const double* to, const TooNear<D>& first) {
  constexpr double kTie = 0x1p-40;  // equal but for rounding
  if (!settings_.leaves || first.partner != kNone || env_.exits.empty()) return;
  Array<TooNear<D>> all{env_.memory};
  sweeps_.thick.find_all(sweeps_.partners, body_, v, to, all);
  uint32_t lowest = 0;
  for (const TooNear<D>& near : all) {
    if (near.time > first.time + kTie) break;
    const dsw_body_contact contact = describe(env_, body_, v, to, near);
    const dsw_face_id wall = contact.contact.wall;
    if (wall.generation == 0 || contact.edge.generation != 0 || contact.face.generation != 0) continue;
    const uint32_t patch = env_.exits.patch(wall.volume, wall.local);
    if (patch == 0 || (lowest != 0 && patch >= lowest)) continue;
    lowest = patch;
    exit_ = wall;
  }
}

template <int D>
void VertexMove<D>::put(uint32_t v, const double* position, Cell cell) {
  put_vertex(body_, v, position, cell);
  if constexpr (D == 3) {
    if (sweeps_.near != nullptr) sweeps_.near->follow(body_, v);
  }
}

/** To `to`, or as far as it is free: then the contacts are in the record, the first of them first.
 * @param arrival the cell of `to`, if the way is known to meet no wall; else null. */
template <int D>
bool VertexMove<D>::advance(uint32_t v, const double* to, const Cell* arrival) {
  under_.clear();
  exit_ = {};
  if (settings_.halves()) return advance_by_halving(v, to);
  TooNear<D> near;
  const bool is_too_near = sweeps_.thick.find_first(sweeps_.partners, body_, v, to, &near);
  if (is_too_near && body_.radius > 0) {  // before it meets anything
    stop_before(v, to, record_too_near(v, to, near));
    return false;
  }
  SweepContact first;
  Cell cell = arrival != nullptr ? *arrival : Cell{};
  const SweepEnd end = arrival != nullptr ? SweepEnd::kFree : sweeps_.find_first(body_, v, to, &first, &cell);
  if (end == SweepEnd::kWorkLimit) return false;
  PairContact<D> pair;
  sweeps_.find_first_of_partners(body_, v, to, &pair);
  const bool is_met = end == SweepEnd::kContact || pair.time != kNever;
  if (!is_met && !is_too_near) {
    put(v, to, cell);
    return true;
  }
  const auto met_at = [&] {
    return end == SweepEnd::kContact ? std::min(describe(env_, body_, v, to, first).time, pair.time) : pair.time;
  };
  if (is_too_near && !(is_met && met_at() < near.time)) {
    stop_before(v, to, record_too_near(v, to, near));
    return false;
  }
  stop_before(v, to, record_contacts(v, to, end == SweepEnd::kContact ? &first : nullptr, pair));
  return false;
}

/** Goes to the last place on the way before a contact that is verified free. */
template <int D>
void VertexMove<D>::stop_before(uint32_t v, const double* to, const dsw_body_contact& contact) {
  const BodyVertex<D>& at = body_.vertices[v];
  Cell cell;
  const auto is_free = [&](const double* candidate) { return sweeps_.is_free(body_, v, candidate, &cell); };
  double target[D], time = contact.time;
  std::copy_n(to, D, target);
  shorten<D>(at.position, target, &time, is_free);
  const double lean = std::fabs(dot(to_vec<D>(contact.contact.normal), difference<D>(target, at.position)));
  off_ = stand_off(contact);
  const double back = off_ / lean;
  if (back > 0)
    time = std::max(0.0, time - back);  // not a number: the way is longer than doubles go, and nothing is kept off
  double position[D];
  if (retreat<D>(at.position, target, time, position, is_free)) put(v, position, cell);
}

/** What comes too near to a thick body first, and as record_contacts. */
template <int D>
dsw_body_contact VertexMove<D>::record_too_near(uint32_t v, const double* to, const TooNear<D>& first) {
  const dsw_body_contact contact = describe(env_, body_, v, to, first);
  find_exit(v, to, first);
  record_.add(contact, partner_of(sweeps_.partners, first));
  const bool records = settings_.search == Search::kAll;
  const bool inserts = settings_.edge == Response::kAdaptiveMany && contact.edge.generation != 0;
  if (!records && !inserts) return contact;
  Array<TooNear<D>> all{env_.memory};
  sweeps_.thick.find_all(sweeps_.partners, body_, v, to, all);
  for (size_t i = 1; i < all.size(); ++i) {
    const dsw_body_contact each = describe(env_, body_, v, to, all[i]);
    if (records) record_.add(each, partner_of(sweeps_.partners, all[i]));
    if (inserts && all[i].partner == kNone && each.edge.index == contact.edge.index && each.edge.generation != 0) {
      under_.push_back(each);
    }
  }
  return contact;
}

/** Records what a vertex meets of the environment (`first`, which may be null) and of other bodies. Returns the contact
 * that comes first. Notes what is under the touching edge, if the response wants that. */
template <int D>
dsw_body_contact VertexMove<D>::record_contacts(uint32_t v, const double* to, const SweepContact* first,
                                                const PairContact<D>& pair) {
  dsw_body_contact contact = first != nullptr ? describe(env_, body_, v, to, *first) : dsw_body_contact{};
  const bool pair_first = first == nullptr || pair.time < contact.time;
  if (pair_first) {
    contact = describe(env_, body_, v, to, pair);
    record_.add(contact, partner_of(pair));
  } else {
    record_.add(contact);
  }
  const bool records = settings_.search == Search::kAll;
  bool inserts = settings_.edge == Response::kAdaptiveMany && !pair_first && first->part.kind == Simplex::kEdge;
  if (first == nullptr || !(records || inserts)) return contact;
  Array<SweepContact> all{env_.memory};
  sweeps_.find_all(body_, v, to, *first, all);
  for (size_t i = pair_first ? 0 : 1; i < all.size(); ++i) {
    inserts = inserts && all[i].part.kind != Simplex::kVertex;  // from there on the vertex is stopped itself
    const bool is_under = inserts && all[i].part == first->part;
    if (!records && !is_under) continue;
    const dsw_body_contact each = describe(env_, body_, v, to, all[i]);
    if (records) record_.add(each);
    if (is_under) under_.push_back(each);
  }
  return contact;
}

/** The dichotomic search [JCD10] 4.2: tries of parts of the way, each by the tests that the level asks for, halve what
 * lies between one that is free and one that is not. The last that is not says what is touched. */
template <int D>
bool VertexMove<D>::advance_by_halving(uint32_t v, const double* to) {
  const BodyVertex<D> at = body_.vertices[v];
  double place[D], met_at[D], free_at[D];
  Cell cell, free_cell = at.cell;
  Simplex part, tried_part;
  WayEnd met = sweeps_.try_way(body_, v, to, &cell, &part);
  if (met == WayEnd::kFree) {
    put(v, to, cell);
    return true;
  }
  if (met == WayEnd::kWorkLimit) return false;
  std::copy_n(to, D, met_at);
  std::copy_n(at.position, D, free_at);
  double free = 0, step = 1;
  for (uint32_t k = 0; k < settings_.bisection_depth; ++k) {
    step /= 2;
    point_at<D>(at.position, to, free + step, place);
    const WayEnd tried = sweeps_.try_way(body_, v, place, &cell, &tried_part);
    if (tried == WayEnd::kWorkLimit) return false;
    if (tried == WayEnd::kFree) {
      free += step;
      std::copy_n(place, D, free_at);
      free_cell = cell;
    } else {
      met = tried;
      part = tried_part;
      std::copy_n(place, D, met_at);
    }
  }
  dsw_contact_partner partner{};
  dsw_body_contact contact = describe_try(v, to, met_at, met, part, &partner);
  contact.time = free;
  std::copy_n(free_at, D, contact.position);
  record_.add(contact, partner);
  // Off the wall by as much of the way: which way the wall looks is known too badly.
  off_ = stand_off(contact);
  const double back = off_ / length(difference<D>(to, at.position));
  if (back > 0 && free > 0) {
    point_at<D>(at.position, to, std::max(0.0, free - back), place);
    if (sweeps_.is_free(body_, v, place, &cell)) {
      std::copy_n(place, D, free_at);
      free_cell = cell;
    }
  }
  put(v, free_at, free_cell);
  return false;
}

/** What the part of the way that ends at `met` touches, as far as the way to `to` is told of it. */
template <int D>
dsw_body_contact VertexMove<D>::describe_try(uint32_t v, const double* to, const double* met, WayEnd end,
                                             const Simplex& part, dsw_contact_partner* partner) {
  dsw_body_contact contact;
  if (end == WayEnd::kTooNear) {
    TooNear<D> near;
    sweeps_.thick.find_first(sweeps_.partners, body_, v, met, &near);
    find_exit(v, met, near);
    contact = describe(env_, body_, v, met, near);
    *partner = partner_of(sweeps_.partners, near);
  } else if (end == WayEnd::kPartner) {
    PairContact<D> pair;
    sweeps_.find_first_of_partners(body_, v, met, &pair);
    contact = describe(env_, body_, v, met, pair);
    *partner = partner_of(pair);
  } else {
    CastResult hit;
    SweepContact inside;
    const bool by_cast = sweeps_.find_obstacle(body_, v, met, part, &hit, &inside);
    if (by_cast && part.kind == Simplex::kEdge) {
      contact = describe_cast(env_, body_, v, to, part.index, met, hit);
    } else {
      if (by_cast) inside = path_contact(env_, hit);
      contact = describe(env_, body_, v, met, inside);
    }
    if (settings_.search == Search::kBisectionVertex) turn_to_vertex(env_, contact.point, contact.contact);
  }
  std::copy_n(to, D, contact.to);
  return contact;
}

template <int D>
double VertexMove<D>::stand_off(const dsw_body_contact& contact) const {
  if (settings_.stand_off != 0) return std::max(0.0, settings_.stand_off);
  return kStandOffShare * extent(env_, env_.map.cell(contact.contact.front.index));
}

/** Whether the response puts vertices on this edge at all: HYBRID only once, as edges of new vertices are static. */
template <int D>
bool VertexMove<D>::may_split(uint32_t v, const dsw_body_contact& contact) const {
  if (contact.edge.generation == 0) return false;
  if (settings_.edge != Response::kHybrid) return true;
  const uint32_t fixed = body_.edges[contact.edge.index].other(v);
  return dsw::none_of(record_.edits.begin(), record_.edits.end(),
                      [fixed](const dsw_body_edit& edit) { return edit.vertex.index == fixed; });
}

/** Puts a vertex on the touching edge, as near to the contact as is free; with ADAPTIVE_MANY one at each obstacle under
 * that edge. Of these the one met first lies on the edge; for the others its parts are bent, in the order in which
 * obstacles are met. What that sweeps is free, or a vertex is left out. */
template <int D>
bool VertexMove<D>::insert(uint32_t v, const dsw_body_contact& contact) {
  if (!may_split(v, contact)) return false;
  const uint32_t fixed = body_.edges[contact.edge.index].other(v);
  const double size = length(difference<D>(body_.position(fixed), body_.position(v)));
  Array<Part> parts{env_.memory};
  parts.push_back({v, fixed, 0, 1});
  bool any = false;
  for (size_t i = 0; i <= under_.size(); ++i) {
    const dsw_body_contact& at = i == 0 ? contact : under_[i - 1];
    const auto holds = [&](const Part& part) {
      return part.from_share < at.edge_parameter && at.edge_parameter < part.to_share;
    };
    const auto part = dsw::find_if(parts.begin(), parts.end(), holds);
    if (part == parts.end()) continue;
    const uint32_t middle = put_on(*part, size, at, i == 0);
    if (middle == kNone) continue;
    any = true;
    const Part rest{middle, part->to, at.edge_parameter, part->to_share};
    part->to = middle;
    part->to_share = at.edge_parameter;
    parts.push_back(rest);
  }
  return any;
}

/** Puts a vertex on a part of an edge of that length, if what remains of it keeps its share. Returns it, or kNone. */
template <int D>
uint32_t VertexMove<D>::put_on(const Part& part, double size, const dsw_body_contact& contact, bool on_edge) {
  const double before = contact.edge_parameter - part.from_share, behind = part.to_share - contact.edge_parameter;
  if (record_.edits.size() - first_edit_ == kMostInsertions) return kNone;
  if (!(before >= settings_.min_part && behind >= settings_.min_part)) return kNone;
  if (!(size * std::min(before, behind) >= settings_.min_length)) return kNone;
  const uint32_t e = find_edge(body_, part.from, part.to);
  const double *p = body_.position(body_.edges[e].ends[0]), *q = body_.position(body_.edges[e].ends[1]);
  const double along = before / (part.to_share - part.from_share);
  const double share = body_.edges[e].ends[0] == part.from ? along : 1 - along;
  const Vec normal = to_vec<D>(contact.contact.normal);
  double point[D];
  if (on_edge) {
    point_at<D>(p, q, share, point);
  } else {
    std::copy_n(contact.point, D, point);
  }
  const Vec nearest = to_vec<D>(point);
  // Rounding may have put it on the wrong side: then further and further from the obstacle.
  double lift = std::max(stand_off(contact), largest_coordinate<D>(point) * std::numeric_limits<double>::epsilon());
  Cell cell;
  for (int tries = 0; tries < 8; ++tries) {
    if (tries != 0 || !on_edge) {
      store<D>(nearest + lift * normal, point);
      if (!is_finite<D>(point)) break;
      lift *= 4;
    }
    if (!can_bend(env_, sweeps_, body_, e, point, &cell)) continue;
    dsw_body_edit edit;
    reserve_more(record_.edits, 1);
    reserve_more(body_.inserted, 1);
    const uint32_t middle = insert_vertex(body_, e, point, cell, share, &edit);
    record_.edits.push_back(edit);
    body_.inserted.push_back(middle);
    if (sweeps_.near != nullptr) {
      for_each_edge(body_, middle, [&](uint32_t each) {
        sweeps_.near->make_stray(each);
        return true;
      });
    }
    return middle;
  }
  return kNone;
}

/** The rest of the move without its part into the walls that are touched; false if nothing remains. */
template <int D>
bool VertexMove<D>::slide(uint32_t v, const double* target, const dsw_body_contact& contact, Walls& walls,
                          double* to) const {
  const double* const at = body_.position(v);
  const Vec normal = to_vec<D>(contact.contact.normal);
  Vec rest = difference<D>(target, at);
  const double into = dot(rest, normal);
  if (into < 0) rest -= into * normal;
  // Along the crease with the latest wall that this would go into. The next sweep says if another is in the way.
  for (int k = walls.count - 1; k >= 0; --k) {
    const Vec crease = unit(walls.normals[k].cross(normal));
    if (dot(rest, walls.normals[k]) >= 0 || is_zero(crease)) continue;
    rest = dot(difference<D>(target, at), crease) * crease;
    break;
  }
  if (walls.count == 2) {
    walls.normals[0] = walls.normals[1];
    walls.count = 1;
  }
  walls.normals[walls.count++] = normal;
  if (is_zero(rest)) return false;
  // The gap is restored only where it has fallen below half.
  const double gap = dot(difference<D>(at, contact.position), normal);
  if (gap < off_ / 2) rest += (off_ - gap) * normal;
  store<D>(to_vec<D>(at) + rest, to);
  if (sweeps_.partners != nullptr && !sweeps_.partners->reach.contains(to)) return false;
  // Where the rest is longer than doubles go, the move ends here.
  return is_finite<D>(to) && !std::equal(to, to + D, at);
}

/** The nearest place to the target before the walls that were touched; false if the vertex is in a corner. */
template <int D>
bool VertexMove<D>::slide_before(uint32_t v, const double* target, const dsw_body_contact& contact,
                                 TouchedWalls<D>& walls, double* to) const {
  const double* const at = body_.position(v);
  walls.add(to_vec<D>(contact.contact.normal), to_vec<D>(contact.position), off_);
  Vec nearest;
  if (!walls.find_nearest(to_vec<D>(at), to_vec<D>(target), &nearest)) return false;
  store<D>(nearest, to);
  if (!is_finite<D>(to)) return false;
  cut_off(v, to);
  if (sweeps_.partners != nullptr && !sweeps_.partners->reach.contains(to)) return false;
  return !std::equal(to, to + D, at);
}

/** Brings the end of a slide nearer, to where it is a little behind the wall that the vertex runs into. What the edges
 * sweep beyond is nothing to be searched. */
template <int D>
void VertexMove<D>::cut_off(uint32_t v, double* to) const {
  constexpr double kBehind = 1.0 / 16, kLeastWay = 1e-6;  // of the way to the wall, of the whole way
  if (!covers_edges(body_.level)) return;
  const BodyVertex<D>& at = body_.vertices[v];
  const CastResult path = cast(env_, at.position, to, at.cell, settings_.max_volumes, sweeps_.simplices.counters);
  if (path.end != CastEnd::kHit) return;
  const double time = crossing_time(env_, path.cell, path.simplex, at.position, to);
  const double all = length(difference<D>(to, at.position));
  const double end = time + std::max({kBehind * time, kLeastWay, 8 * off_ / all});
  if (!(end < 1)) return;
  double whole[D];
  std::copy_n(to, D, whole);
  point_at<D>(at.position, whole, end, to);
}

template class VertexMove<2>;
template class VertexMove<3>;

}  // namespace dsw
