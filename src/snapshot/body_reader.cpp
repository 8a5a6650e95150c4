// Bodies out of the arrays of a scene's snapshot, which are not trusted.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/dimensions.h"
#include "base/search.h"
#include "body/integrity.h"
#include "contact/geometry.h"
#include "contact/names.h"
#include "locate/locate.h"
#include "locate/nearest.h"
#include "scene/scene.h"
#include "snapshot/body_format.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

/** The parts that a previous contact and a touch have in common. */
template <class Touch>
void read_touch(const double* places, const uint32_t* words, Touch& t) {
  if (words[0] > DSW_CELL_VOLUME) fail_corrupt("what a vertex touched before");
  std::copy_n(places, 3, t.point);
  std::copy_n(places + 3, 3, t.normal);
  t.obstacle = {static_cast<dsw_cell_kind>(words[0]), words[1], words[2], words[3]};
  t.body = {words[4], words[5]};
}

/** The volume behind the wall of a contact, which the format leaves out; null if the wall has changed since. */
template <int D>
dsw_volume_id behind_wall(const Environment<D>& env, const dsw_contact& contact) {
  const Map<D>& map = env.map;
  const dsw_face_id id = contact.wall;
  if (!map.is_alive(id.volume, id.generation)) return {0, 0};
  const Cell owner = to_cell(map, id.volume);
  if (id.local >= map.facets_of(owner)) fail_corrupt("the wall of a contact");
  const Cell front = is_alive(map, contact.front) ? to_cell(map, contact.front.index) : Cell{};
  const HalfFacet beyond = map.opposite(seen_wall(env, front, map.half_facet(owner, id.local), contact.normal));
  return volume_id(map, beyond.valid() ? map.cell_of(beyond) : Cell{});
}

}  // namespace

template <int D>
bool can_be_at(const Environment<D>& env, Cell cell, const double* point) noexcept {
  const bool finite = dsw::all_of(point, point + D, [](double x) { return std::isfinite(x); });
  return finite && cell.valid() && !is_closed(env, cell) && contains(env, cell, point);
}

template <int D>
template <class T>
const T* BodyReader<D>::take(const Array<T>& from, size_t& at, uint64_t count) {
  if (count > from.size() - at) fail_corrupt("a body ends early");
  const T* const first = from.data() + at;
  at += static_cast<size_t>(count);
  return first;
}

template <int D>
SlotPool BodyReader<D>::read_slots(const Array<uint32_t>& words, size_t& at, uint64_t count,
                                   const Array<uint32_t>& free, size_t& free_at, uint64_t free_count) {
  const Allocator<uint32_t> allocator(env_.memory);
  const uint32_t *const first = take(words, at, count), *const first_free = take(free, free_at, free_count);
  SlotPool slots(env_.memory);
  if (!slots.restore(Array<uint32_t>(first, first + count, allocator),
                     Array<uint32_t>(first_free, first_free + free_count, allocator))) {
    fail_corrupt("generations of a body");
  }
  return slots;
}

template <int D>
void BodyReader<D>::read_parts(Body<D>& body, const uint64_t* n) {
  const uint64_t vertices = n[kVertices], edges = n[kEdges], faces = n[kFaces];
  if (std::max({vertices, edges, faces}) >= kNone) fail_corrupt("a body is too large");
  const double* place = take(image_.vertex_places, vertex_place_, D * vertices);
  const uint32_t* words = take(image_.vertices, vertex_, 2 * vertices);
  body.vertices.resize(static_cast<size_t>(vertices));
  for (BodyVertex<D>& vertex : body.vertices) {
    std::copy_n(place, D, vertex.position);
    vertex.cell = to_cell(env_.map, words[0]);
    if (words[0] != kNoIndex && !vertex.cell.valid()) fail_corrupt("the cell of a vertex");
    vertex.first_edge = words[1];
    place += D;
    words += 2;
  }
  words = take(image_.edges, edge_, 6 * edges);
  body.edges.resize(static_cast<size_t>(edges));
  for (BodyEdge& edge : body.edges) {
    std::copy_n(words, 2, edge.ends);
    std::copy_n(words + 2, 2, edge.next);
    std::copy_n(words + 4, 2, edge.faces);
    words += 6;
  }
  if (body.skipping.leaves_back_edges) {
    words = take(image_.edges, edge_, edges);
    body.untested.resize(static_cast<size_t>(edges));
    for (uint32_t e = 0; e < edges; ++e, ++words) {
      if (*words > 1 || (*words == 1 && !body.has_edge(e))) fail_corrupt("which edges are untested");
      body.untested[e] = static_cast<uint8_t>(*words);
    }
  }
  words = take(image_.faces, face_, 3 * faces);
  body.faces.resize(static_cast<size_t>(faces));
  for (BodyFace& face : body.faces) {
    std::copy_n(words, 3, face.corners);
    words += 3;
  }
  body.vertex_slots =
      read_slots(image_.vertex_slots, vertex_slot_, vertices, image_.free_vertices, free_vertex_, n[kFreeVertices]);
  body.edge_slots = read_slots(image_.edge_slots, edge_slot_, edges, image_.free_edges, free_edge_, n[kFreeEdges]);
  body.face_slots = read_slots(image_.face_slots, face_slot_, faces, image_.free_faces, free_face_, n[kFreeFaces]);
  words = take(image_.inserted, inserted_, n[kInserted]);
  body.inserted.assign(words, words + n[kInserted]);
}

template <int D>
void BodyReader<D>::read_sequences(Body<D>& body, uint64_t count) {
  const Map<D>& map = env_.map;
  const bool fits = body.keeps_corridors() ? count == body.edges.size() : count <= body.edges.size();
  if (!fits) fail_corrupt("the number of sequences");
  keep_corridors(body, static_cast<size_t>(count));
  Array<uint32_t> facets{env_.memory};
  for (size_t e = 0; e < body.corridors.size(); ++e) {
    const uint32_t word = *take(image_.sequences, sequence_, 1);
    if (word == kUnknownSequence) body.corridors.forget(e);
    if (word == kUnknownSequence || word == 1) continue;  // one that is empty is in rows
    // Whether its facets are passable is asked before it is used.
    Corridor<D>& sequence = body.corridors.own(e, Portal<D>::kNever);
    facets.clear();
    for (const uint32_t* at = take(image_.sequences, sequence_, word / 2 * 2); facets.size() < word / 2; at += 2) {
      const Cell c = to_cell(map, at[0]);
      if (!c.valid() || at[1] >= map.facets_of(c)) fail_corrupt("a facet of a sequence");
      facets.push_back(map.half_facet(c, at[1]).word);
    }
    if (!is_whole(map, facets)) fail_corrupt("a sequence is broken");
    sequence.assign(env_, facets);
    // Polygons are no longer known to be convex once points have moved.
    if (D == 3 && (word & 1) != 0 && !sequence.in_rows) fail_corrupt("a sequence of other cells");
    if ((word & 1) != 0) continue;
    sequence.in_rows = false;
    sequence.rows.clear();
  }
}

/** Any vertices will do: they are forecasts. */
template <int D>
void BodyReader<D>::read_touched(Body<D>& body, uint64_t count) {
  if (count > 2 * body.edges.size()) fail_corrupt("the number of what edges have touched");
  body.touched.resize(static_cast<size_t>(count));
  for (TouchedLines& each : body.touched) {
    for (RidgeName& line : each.lines) std::copy_n(take(image_.touched, touched_, 2), 2, line.vertices);
  }
}

/** A ball that is said to be free has to be. */
template <int D>
void BodyReader<D>::read_balls(Body<D>& body, uint64_t count) {
  if (count != (body.skipping.by_clearance ? body.vertices.size() : 0)) fail_corrupt("the number of clearances");
  const double* place = take(image_.balls, ball_, (D + 2) * count);
  const uint32_t* words = take(image_.ball_words, ball_word_, 3 * count);
  body.clearances.resize(static_cast<size_t>(count));
  for (size_t v = 0; v < count; ++v, place += D + 2, words += 3) {
    Clearance<D>& ball = body.clearances[v];
    std::copy_n(place, D, ball.centre);
    ball.radius = place[D];
    ball.wanted = place[D + 1];
    ball.wait = words[0];
    ball.patience = words[1];
    ball.version = words[2] == 1 ? env_.obstacle_version : Portal<D>::kNever;
    const bool finite = dsw::all_of(place, place + D + 1, [](double x) { return std::isfinite(x); });
    if (!finite || std::isnan(ball.wanted) || words[2] > 1 || !(ball.radius > 0 || (ball.radius == 0 && words[2] == 0)))
      fail_corrupt("a clearance");
    if (words[2] == 0) continue;
    const Cell at = locate(env_, ball.centre, body.vertices[v].cell, nullptr).cell;
    NearestResult nearest;
    if (!at.valid() || is_closed(env_, at) || find_nearest(env_, ball.centre, at, ball.radius, nearest)) {
      fail_corrupt("a clearance that is none");
    }
  }
}

template <int D>
void BodyReader<D>::read_contacts(BodyRecord<D>& of, uint64_t count) {
  if (count > image_.contacts.size()) fail_corrupt("the number of contacts");
  const double* place = take(image_.contact_places, contact_place_, kContactPlaces * count);
  const uint32_t* words = take(image_.contacts, contact_, kContactWords * count);
  of.record.contacts.resize(static_cast<size_t>(count));
  for (dsw_body_contact& contact : of.record.contacts) {
    if (words[kAtObstacleKind] > DSW_CELL_VOLUME || words[kAtKind] > DSW_CONTACT_VERTEX ||
        words[kAtKind + 1] > DSW_CELL_VOLUME || words[kAtKind + 3] > DSW_HISTORY_LASTING) {
      fail_corrupt("a contact");
    }
    for_each_place(contact, [&](double* to, size_t n) {
      std::copy_n(place, n, to);
      place += n;
    });
    for_each_word(contact, [&](auto& word) { word = static_cast<std::decay_t<decltype(word)>>(*words++); });
    contact.contact.behind = behind_wall(env_, contact.contact);
  }
}

template <int D>
void BodyReader<D>::read_partners(BodyRecord<D>& of, uint64_t count) {
  if (count > image_.partners.size() || (count != 0 && count != of.record.contacts.size())) {
    fail_corrupt("the number of partners");
  }
  const uint32_t* words = take(image_.partners, partner_, kPartnerWords * count);
  of.record.partners.reserve(static_cast<size_t>(count));
  for (uint64_t i = 0; i < count; ++i, words += kPartnerWords) {
    of.record.partners.push_back(
        {{words[0], words[1]}, {words[2], words[3]}, {words[4], words[5]}, {words[6], words[7]}});
  }
}

template <int D>
void BodyReader<D>::read_history(BodyRecord<D>& of, const uint64_t* n) {
  of.record.previous.resize(of.record.contacts.size());
  for (size_t i = 0; i < of.record.previous.size() && format_ < kHistoryFormat; ++i) {
    const dsw_body_contact& contact = of.record.contacts[i];
    dsw_previous_contact& previous = of.record.previous[i];
    previous.moves = previous.touching = 1;
    if (contact.history != DSW_HISTORY_LASTING) continue;
    std::copy_n(contact.point, 3, previous.point);
    std::copy_n(contact.contact.normal, 3, previous.normal);
    previous.obstacle = contact.contact.obstacle;
    if (!of.record.partners.empty()) previous.body = of.record.partners[i].body;
    previous.since = 1;
    previous.moves = previous.touching = 2;
  }
  if (format_ < kHistoryFormat) return;
  const double* place = take(image_.previous_places, previous_place_, kTouchPlaces * of.record.previous.size());
  const uint32_t* words = take(image_.previous, previous_, kPreviousWords * of.record.previous.size());
  for (dsw_previous_contact& previous : of.record.previous) {
    read_touch(place, words, previous);
    previous.since = words[6];
    previous.moves = words[7];
    previous.touching = words[8];
    if (previous.moves == 0 || previous.touching < previous.moves)
      fail_corrupt("for how long a vertex has touched something");
    place += kTouchPlaces;
    words += kPreviousWords;
  }
  of.touches.moves = n[kMoves];
  if (n[kTouches] > of.body.vertices.size()) fail_corrupt("the number of touches");
  place = take(image_.touch_places, touch_place_, kTouchPlaces * n[kTouches]);
  words = take(image_.touches, touch_, kTouchWords * n[kTouches]);
  of.touches.earlier.resize(static_cast<size_t>(n[kTouches]));
  uint64_t after = 0;  // the last one's vertex
  for (LastTouch& touch : of.touches.earlier) {
    read_touch(place, words, touch);
    touch.move = words[6] | uint64_t{words[7]} << 32;
    touch.vertex = {words[8], words[9]};
    if (touch.move >= of.touches.moves || touch.vertex.index < after || touch.vertex.index >= of.body.vertices.size()) {
      fail_corrupt("a touch before the last move");
    }
    after = uint64_t{touch.vertex.index} + 1;
    place += kTouchPlaces;
    words += kTouchWords;
  }
}

/** Whatever the shape is: it is taken anew where it does not give the body's places. */
template <int D>
void BodyReader<D>::read_shape(Body<D>& body, uint64_t rest) {
  if (!body.is_rigid()) {
    if (rest != 0) fail_corrupt("a shape of a body that has none");
    return;
  }
  if (rest != 0 && rest != D * uint64_t{body.vertices.size()}) fail_corrupt("the size of a shape");
  RigidShape<D>& shape = body.shape[0];
  const double* const place = take(image_.shapes, shape_, 4 + 2 * D + rest);
  if (!dsw::all_of(place, place + 4 + 2 * D + rest, [](double x) { return std::isfinite(x); })) fail_corrupt("a shape");
  std::copy_n(place, 4, shape.moved.rotation);
  std::copy_n(place + 4, D, shape.moved.centre);
  std::copy_n(place + 4 + D, D, shape.moved.translation);
  shape.rest.assign(place + 4 + 2 * D, place + 4 + 2 * D + rest);
}

template <int D>
void BodyReader<D>::read_radius(Body<D>& body, const uint64_t* n) {
  const auto is_length = [](double x) { return x >= 0 && std::isfinite(x); };
  body.radius = bits_as<double>(n[kRadius]);
  if (!is_length(body.radius) || (body.radius > 0 && body.skipping.leaves_back_edges)) fail_corrupt("a radius");
  const bool keeps_lengths = body.keeps_lengths();
  if (n[kLengths] != (keeps_lengths ? body.edges.size() : 0)) fail_corrupt("the number of lengths");
  const double* const lengths = take(image_.lengths, length_, n[kLengths]);
  if (!dsw::all_of(lengths, lengths + n[kLengths], is_length)) fail_corrupt("the length of an edge");
  body.lengths.assign(lengths, lengths + n[kLengths]);
}

template <int D>
void BodyReader<D>::take_numbers(uint64_t* numbers) {
  const size_t count = numbers_of(format_);
  std::fill_n(std::copy_n(take(image_.bodies, body_, count), count, numbers), kNumbers - count, uint64_t{0});
}

template <int D>
void BodyReader<D>::check(const Body<D>& body) {
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v) && !can_be_at(env_, body.vertices[v].cell, body.position(v))) {
      fail_corrupt("a vertex is not where it is said to be, or that was in another environment");
    }
  }
  Array<uint32_t> blocked{env_.memory};
  BodyProbe<D>(env_, Obstacle::kCells).find_blocked(body, body.level, blocked);
  for (size_t i = 0; i < blocked.size(); i += 2) {
    const uint32_t e = find_edge(body, blocked[i], blocked[i + 1]);
    if (e == kNone || !body.is_untested(e)) fail_corrupt("a body is not free, or that was in another environment");
  }
}

/** A body that penetrates something is in no cells, and has not moved yet. While it is read its vertices get any cell,
 * as a sign that they live. */
template <int D>
void BodyReader<D>::let_penetrate(Body<D>& body, const uint64_t* n) const {
  if (body.skipping.leaves_back_edges || n[kContacts] != 0 || n[kInserted] != 0 || n[kMoves] != 0)
    fail_corrupt("a body that penetrates something");
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    BodyVertex<D>& vertex = body.vertices[v];
    const bool finite = dsw::all_of(vertex.position, vertex.position + D, [](double x) { return std::isfinite(x); });
    if (vertex.cell.valid() || !finite) fail_corrupt("a vertex of a body that penetrates something");
    if (body.vertex_slots.alive(v, body.vertex_slots.generation(v))) vertex.cell = Cell{0};
  }
}

template <int D>
void BodyReader<D>::read(BodyRecord<D>& of) {
  Body<D>& body = of.body;
  uint64_t n[kNumbers];
  take_numbers(n);
  constexpr SweepLevel kHighest = D == 3 ? SweepLevel::kFaces : SweepLevel::kEdgesSwept;
  if (n[kLevel] > static_cast<uint64_t>(kHighest) || (n[kFlags] & ~kAllFlags) != 0) fail_corrupt("a body's level");
  body.level = static_cast<SweepLevel>(n[kLevel]);
  body.skipping.corridors = (n[kFlags] & kSequencesFlag) != 0;
  body.skipping.no_corridors = (n[kFlags] & kNoSequencesFlag) != 0;
  body.skipping.by_environment = (n[kFlags] & kEnvironmentFlag) != 0;
  body.skipping.by_clearance = (n[kFlags] & kClearanceFlag) != 0;
  body.skipping.by_similar_motion = (n[kFlags] & kSimilarMotionFlag) != 0;
  body.skipping.back_edges = (n[kFlags] & kBackEdgesFlag) != 0;
  body.skipping.leaves_back_edges = (n[kFlags] & kLeaveFlag) != 0;
  constexpr uint64_t kNotLeft = kSimilarMotionFlag | kRigidFlag;
  if (body.skipping.leaves_back_edges && (!body.skipping.back_edges || (n[kFlags] & kNotLeft) != 0 || D == 2))
    fail_corrupt("flags of a body");
  body.skipping.motion_share = bits_as<double>(n[kMotionShare]);
  body.clearance_credit = bits_as<int64_t>(n[kCredit]);
  body.filter = {static_cast<uint32_t>(n[kCategory]), static_cast<uint32_t>(n[kMask]), (n[kFlags] & kSelfFlag) != 0};
  if (n[kCategory] != body.filter.category || n[kMask] != body.filter.mask) fail_corrupt("a filter");
  if (!(body.skipping.motion_share >= 0) || !std::isfinite(body.skipping.motion_share)) fail_corrupt("a motion share");
  read_parts(body, n);
  const bool penetrates = (n[kFlags] & kPenetratingFlag) != 0;
  if (penetrates) let_penetrate(body, n);
  if (const char* const broken = check_integrity(body)) fail_corrupt(broken);
  if (penetrates) {
    for (BodyVertex<D>& each : body.vertices) each.cell = Cell{};
  }
  read_radius(body, n);
  if (!penetrates) check(body);
  read_sequences(body, n[kSequences]);
  read_touched(body, n[kTouched]);
  read_balls(body, n[kBalls]);
  read_contacts(of, n[kContacts]);
  read_partners(of, n[kPartners]);
  read_history(of, n);
  if ((n[kFlags] & kRigidFlag) != 0) body.shape.emplace_back(env_.memory);
  read_shape(body, n[kRest]);
  reserve(body, 0, 0, 0);
  if (!penetrates) return;
  of.penetrating.push_back(std::move(body));
  of.body = Body<D>(env_.memory);
}

template <int D>
void BodyReader<D>::skip() {
  uint64_t n[kNumbers];
  take_numbers(n);
  uint64_t numbers[kNumbers] = {};
  const Skipping none;
  numbers[kLevel] = static_cast<uint64_t>(SweepLevel::kEdgesSwept);
  numbers[kMotionShare] = bits_as<uint64_t>(none.motion_share);
  const ContactFilter any;
  numbers[kCategory] = any.category;
  numbers[kMask] = any.mask;
  if (!std::equal(n, n + kNumbers, numbers)) fail_corrupt("a slot without a body");
}

template <int D>
void BodyReader<D>::finish() const {
  const SceneImage& i = image_;
  const bool all =
      body_ == i.bodies.size() && vertex_place_ == i.vertex_places.size() && vertex_ == i.vertices.size() &&
      vertex_slot_ == i.vertex_slots.size() && free_vertex_ == i.free_vertices.size() && edge_ == i.edges.size() &&
      edge_slot_ == i.edge_slots.size() && free_edge_ == i.free_edges.size() && face_ == i.faces.size() &&
      face_slot_ == i.face_slots.size() && free_face_ == i.free_faces.size() && inserted_ == i.inserted.size() &&
      sequence_ == i.sequences.size() && ball_ == i.balls.size() && ball_word_ == i.ball_words.size() &&
      contact_place_ == i.contact_places.size() && contact_ == i.contacts.size() && partner_ == i.partners.size() &&
      previous_place_ == i.previous_places.size() && previous_ == i.previous.size() &&
      touch_place_ == i.touch_places.size() && touch_ == i.touches.size() && shape_ == i.shapes.size() &&
      touched_ == i.touched.size() && length_ == i.lengths.size();
  if (!all) fail_corrupt("more of bodies than there are");
}

DSW_INSTANTIATE(can_be_at);
template class BodyReader<2>;
template class BodyReader<3>;

}  // namespace dsw
