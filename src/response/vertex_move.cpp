#include "response/vertex_move.h"

#include <algorithm>

#include "base/points.h"
#include "contact/describe.h"
#include "contact/describe_pair.h"
#include "motion/retreat.h"
#include "response/insertion.h"

namespace dsw {
namespace {

constexpr uint32_t kMostSlides = 8, kMostInsertions = 64;
constexpr double kStandOffShare = 1e-9;

template <int D>
double extent(const Environment<D>& env, Cell c) {
  double size = 0;
  for (int k = 0; k < D; ++k) {
    double low = env.point(c, 0)[k], high = low;
    for (uint32_t i = 1; i < env.map.vertices_of(c); ++i) {
      low = std::min(low, env.point(c, i)[k]);
      high = std::max(high, env.point(c, i)[k]);
    }
    size = std::max(size, high - low);
  }
  return size;
}

}  // namespace

template <int D>
bool VertexMove<D>::move(uint32_t v, const double* target) {
  Walls walls;
  uint32_t slides = 0;
  first_edit_ = record_.edits.size();
  double to[D];
  std::copy_n(target, D, to);
  for (;;) {
    const size_t first_contact = record_.contacts.size();
    if (advance(v, to)) return std::equal(to, to + D, target);
    if (record_.contacts.size() == first_contact) {
      ++record_.limited;
      return false;
    }
    const double left = length(difference<D>(target, body_.position(v)));
    for (size_t i = first_contact; i < record_.contacts.size(); ++i) record_.contacts[i].distance_left = left;
    const dsw_contact contact = record_.contacts[first_contact];
    const bool of_vertex = contact.edge.generation == 0 && contact.face.generation == 0;
    const Response response = of_vertex ? settings_.vertex : settings_.edge;
    if (!of_vertex && settings_.may_insert() && insert(v, contact)) {
      walls.count = 0;
      std::copy_n(target, D, to);
      continue;
    }
    if (response != Response::kSlide && response != Response::kHybrid) return false;
    if (++slides > kMostSlides || !slide(v, target, contact, walls, to)) return false;
  }
}

/** To `to`, or as far as it is free: then the contacts are in the record, the first of them first. */
template <int D>
bool VertexMove<D>::advance(uint32_t v, const double* to) {
  const BodyVertex<D>& at = body_.vertices[v];
  StarContact first;
  Cell cell;
  const SweepEnd end = sweeps_.find_first(body_, v, to, &first, &cell);
  if (end == SweepEnd::kWorkLimit) return false;
  PairContact<D> pair;
  if (sweeps_.partners != nullptr) find_first_pair(*sweeps_.partners, body_, v, to, &pair);
  if (end == SweepEnd::kFree && pair.time == kNever) {
    put_vertex(body_, v, to, cell);
    return true;
  }
  const dsw_contact contact = record_contacts(v, to, end == SweepEnd::kContact ? &first : nullptr, pair);
  const auto is_free = [&](const double* candidate) { return sweeps_.is_free(body_, v, candidate, &cell); };
  double target[D], time = contact.time;
  std::copy_n(to, D, target);
  shorten<D>(at.position, target, &time, is_free);
  const double lean = std::fabs(dot(to_vec<D>(contact.normal), difference<D>(target, at.position)));
  const double back = stand_off(contact) / lean;
  if (back > 0)
    time = std::max(0.0, time - back);  // not a number: the way is longer than doubles go, and nothing is kept off
  double position[D];
  if (!retreat<D>(at.position, target, time, position, is_free)) return false;
  put_vertex(body_, v, position, cell);
  return false;
}

/** Of what is met of the environment, which may be null, and of other bodies. Returns the first. */
template <int D>
dsw_contact VertexMove<D>::record_contacts(uint32_t v, const double* to, const StarContact* first,
                                           const PairContact<D>& pair) {
  dsw_contact contact{}, of_pair{};
  if (first != nullptr) contact = describe(env_, body_, v, to, *first);
  const bool pair_first = first == nullptr || pair.time < contact.time;
  if (pair_first) {
    of_pair = describe(env_, body_, v, to, pair);
    if (settings_.search == Search::kBisection) bisect(v, of_pair);
    record_.add(of_pair, partner_of(pair));
  } else {
    if (settings_.search == Search::kBisection) bisect(v, contact);
    record_.add(contact);
  }
  if (settings_.search == Search::kAll && first != nullptr) {
    Array<StarContact> all{Allocator<StarContact>(env_.memory)};
    sweeps_.find_all(body_, v, to, *first, all);
    for (size_t i = pair_first ? 0 : 1; i < all.size(); ++i) record_.add(describe(env_, body_, v, to, all[i]));
  }
  return pair_first ? of_pair : contact;
}

/** Puts the time to the last of a halving at which the way is free. */
template <int D>
void VertexMove<D>::bisect(uint32_t v, dsw_contact& contact) {
  double free = 0, step = 1, position[D];
  Cell cell;
  for (uint32_t k = 0; k < settings_.bisection_depth; ++k) {
    step /= 2;
    point_at<D>(contact.from, contact.to, free + step, position);
    if (sweeps_.is_free(body_, v, position, &cell)) free += step;
  }
  contact.time = free;
  point_at<D>(contact.from, contact.to, free, contact.position);
}

template <int D>
double VertexMove<D>::stand_off(const dsw_contact& contact) const {
  if (settings_.stand_off != 0) return std::max(0.0, settings_.stand_off);
  return kStandOffShare * extent(env_, env_.map.cell(contact.front.index));
}

/** Puts a vertex on the touching edge, as near to the contact as is free. */
template <int D>
bool VertexMove<D>::insert(uint32_t v, const dsw_contact& contact) {
  const size_t inserted = record_.edits.size() - first_edit_;
  const uint32_t e = contact.edge.index;
  if (contact.edge.generation == 0 || inserted == kMostInsertions) return false;
  const uint32_t fixed = body_.edges[e].other(v);
  if (settings_.edge == Response::kAdaptiveOne) {
    for (size_t i = first_edit_; i < record_.edits.size(); ++i) {
      if (record_.edits[i].vertex.index == fixed) return false;
    }
  }
  if (!(contact.along >= settings_.min_part && contact.along <= 1 - settings_.min_part)) return false;
  const bool starts_here = body_.edges[e].ends[0] == v;
  const double share = starts_here ? contact.along : 1 - contact.along;
  const double *p = body_.position(body_.edges[e].ends[0]), *q = body_.position(body_.edges[e].ends[1]);
  const double least = length(difference<D>(q, p)) * std::min(share, 1 - share);
  if (!(least >= settings_.min_length)) return false;
  const Vec normal = to_vec<D>(contact.normal);
  double point[D], largest = 0;
  point_at<D>(p, q, share, point);
  for (int k = 0; k < D; ++k) largest = std::max(largest, std::fabs(point[k]));
  const Vec on_edge = to_vec<D>(point);
  // Rounding may have put it on the wrong side: then further and further from the obstacle.
  double lift = std::max(stand_off(contact), largest * std::numeric_limits<double>::epsilon());
  Cell cell;
  for (int tries = 0; tries < 8; ++tries, lift *= 4) {
    if (can_bend(env_, sweeps_, body_, e, point, &cell)) {
      dsw_body_edit edit;
      reserve_more(record_.edits, 1);
      reserve_more(body_.inserted, 1);
      const uint32_t middle = insert_vertex(body_, e, point, cell, share, &edit);
      record_.edits.push_back(edit);
      body_.inserted.push_back(middle);
      return true;
    }
    store<D>(on_edge + lift * normal, point);
    if (!is_finite<D>(point)) return false;
  }
  return false;
}

/** The rest of the move without its part into the walls that are touched; false if nothing remains. */
template <int D>
bool VertexMove<D>::slide(uint32_t v, const double* target, const dsw_contact& contact, Walls& walls,
                          double* to) const {
  const double* const at = body_.position(v);
  const Vec normal = to_vec<D>(contact.normal);
  Vec rest = difference<D>(target, at);
  const double into = dot(rest, normal);
  if (into < 0) rest = rest - into * normal;
  // Along the crease with the latest wall that this would go into. Whether another is in the way is the next sweep's to say.
  for (int k = walls.count - 1; k >= 0; --k) {
    const Vec crease = unit(cross(walls.normals[k], normal));
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
  const double off = stand_off(contact), gap = dot(difference<D>(at, contact.position), normal);
  if (gap < off / 2) rest = rest + (off - gap) * normal;
  store<D>(to_vec<D>(at) + rest, to);
  if (sweeps_.partners != nullptr && !sweeps_.partners->reach.contains(to)) return false;
  // Where the rest is longer than doubles go, the move ends here.
  return is_finite<D>(to) && !std::equal(to, to + D, at);
}

#define DSW_VERTEX_MOVE(D) template class VertexMove<D>
DSW_VERTEX_MOVE(2);
DSW_VERTEX_MOVE(3);
#undef DSW_VERTEX_MOVE

}  // namespace dsw
