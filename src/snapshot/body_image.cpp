// Bodies into the arrays of a scene's snapshot.

#include <initializer_list>

#include "base/dimensions.h"
#include "base/search.h"
#include "scene/live_register.h"
#include "scene/scene.h"
#include "snapshot/body_format.h"

namespace dsw {
namespace {

template <int D>
uint64_t flags_of(const Body<D>& body) {
  const Skipping& s = body.skipping;
  return (body.is_rigid() ? kRigidFlag : 0) | (body.filter.self ? kSelfFlag : 0) | (s.corridors ? kSequencesFlag : 0) |
         (s.by_environment ? kEnvironmentFlag : 0) | (s.by_clearance ? kClearanceFlag : 0) |
         (s.by_similar_motion ? kSimilarMotionFlag : 0) | (s.back_edges ? kBackEdgesFlag : 0) |
         (s.no_corridors ? kNoSequencesFlag : 0) | (s.leaves_back_edges ? kLeaveFlag : 0);
}

template <class T>
void append(Array<T>& to, const T* values, size_t count) {
  reserve_more(to, count);
  to.insert(to.end(), values, values + count);
}

template <class T>
void append(Array<T>& to, std::initializer_list<T> values) {
  append(to, values.begin(), values.size());
}

/** The parts that a previous contact and a touch have in common. */
template <class Touch>
void append_touch(const Touch& t, Array<double>& places, Array<uint32_t>& words) {
  append(places, t.point, 3);
  append(places, t.normal, 3);
  append(words, {static_cast<uint32_t>(t.obstacle.kind), t.obstacle.index, t.obstacle.generation, t.obstacle.local,
                 t.body.index, t.body.generation});
}

template <int D>
void append_sequence(const Map<D>& map, const Corridor<D>& sequence, Array<uint32_t>& out) {
  if (!sequence.known() || !is_whole(map, sequence.facets)) return append(out, {kUnknownSequence});
  // In the plane rows are of polygons that are known to be convex: none, once points have moved.
  const bool in_rows =
      sequence.in_rows && (D == 3 || dsw::all_of(sequence.facets.begin(), sequence.facets.end(),
                                                 [&](uint32_t facet) { return map.convex(map.cell_of({facet})); }));
  append(out, {2 * static_cast<uint32_t>(sequence.facets.size()) + (in_rows ? 1 : 0)});
  for (const uint32_t facet : sequence.facets) {
    const Cell c = map.cell_of({facet});
    append(out, {map.index(c), map.local_of({facet}, c)});
  }
}

/** Vertices, edges and faces, with their slots. */
template <int D>
void append_parts(const Map<D>& map, const Body<D>& body, SceneImage& image) {
  const auto append_all = [](Array<uint32_t>& to, const Array<uint32_t>& from) {
    append(to, from.data(), from.size());
  };
  for (const BodyVertex<D>& vertex : body.vertices) {
    append(image.vertex_places, vertex.position, D);
    append(image.vertices, {to_index(map, vertex.cell), vertex.first_edge});
  }
  append_all(image.vertex_slots, body.vertex_slots.words());
  append_all(image.free_vertices, body.vertex_slots.free_slots());
  for (const BodyEdge& e : body.edges) {
    append(image.edges, {e.ends[0], e.ends[1], e.next[0], e.next[1], e.faces[0], e.faces[1]});
  }
  for (const uint8_t untested : body.untested) append(image.edges, {uint32_t{untested}});
  append_all(image.edge_slots, body.edge_slots.words());
  append_all(image.free_edges, body.edge_slots.free_slots());
  for (const BodyFace& face : body.faces) append(image.faces, face.corners, 3);
  append_all(image.face_slots, body.face_slots.words());
  append_all(image.free_faces, body.face_slots.free_slots());
  append_all(image.inserted, body.inserted);
}

/** Corridors of edges, and balls of vertices. */
template <int D>
void append_forecasts(const Scene<D>& scene, const BodyRecord<D>& of, size_t sequences, size_t balls,
                      SceneImage& image) {
  const Environment<D>& env = scene.env;
  const Body<D>& body = of.told();
  for (size_t e = 0; e < sequences; ++e) {
    const Corridor<D>& sequence = body.corridors[e];
    const bool gone = scene.features.live && scene.live.get()->gone.are_in(sequence, of.followed);
    if (gone) {
      append(image.sequences, {kUnknownSequence});
    } else {
      append_sequence(env.map, sequence, image.sequences);
    }
  }
  for (size_t v = 0; v < balls; ++v) {
    const Clearance<D>& ball = body.clearances[v];
    append(image.balls, ball.centre, D);
    append(image.balls, {ball.radius, ball.wanted});
    append(image.ball_words, {ball.wait, ball.patience, ball.is_known(env) ? 1u : 0u});
  }
}

/** What the last move has left to read. */
void append_contacts(const MoveRecord& record, SceneImage& image) {
  for (const dsw_body_contact& contact : record.contacts) {
    for_each_place(contact, [&](const double* at, size_t count) { append(image.contact_places, at, count); });
    for_each_word(contact, [&](auto word) { append(image.contacts, {static_cast<uint32_t>(word)}); });
  }
  for (const dsw_contact_partner& p : record.partners) {
    append(image.partners, {p.body.index, p.body.generation, p.vertex.index, p.vertex.generation, p.edge.index,
                            p.edge.generation, p.face.index, p.face.generation});
  }
}

/** What stopped the vertices in earlier moves. */
template <int D>
void append_history(const BodyRecord<D>& of, SceneImage& image) {
  for (const dsw_previous_contact& previous : of.record.previous) {
    append_touch(previous, image.previous_places, image.previous);
    append(image.previous, {previous.since, previous.moves, previous.touching});
  }
  for (const LastTouch& touch : of.touches.earlier) {
    append_touch(touch, image.touch_places, image.touches);
    append(image.touches, {static_cast<uint32_t>(touch.move), static_cast<uint32_t>(touch.move >> 32),
                           touch.vertex.index, touch.vertex.generation});
  }
}

}  // namespace

template <int D>
void append(const Scene<D>& scene, const BodyRecord<D>& of, const SceneContent& content, SceneImage& image) {
  const Body<D>& body = of.told();
  const size_t edges = body.edges.size(), vertices = body.vertices.size();
  // There can be room for more, or they are no longer kept.
  const size_t sequences = content.forecasts ? std::min(body.corridors.size(), edges) : 0;
  const size_t touched = content.forecasts ? std::min(body.touched.size(), 2 * edges) : 0;
  const size_t balls = content.forecasts && body.skipping.by_clearance ? vertices : 0;
  uint64_t numbers[kNumbers] = {};
  numbers[kLevel] = static_cast<uint64_t>(body.level);
  numbers[kFlags] = flags_of(body) | (of.is_penetrating() ? kPenetratingFlag : 0);
  numbers[kMotionShare] = bits_as<uint64_t>(body.skipping.motion_share);
  numbers[kCredit] = content.forecasts ? bits_as<uint64_t>(body.clearance_credit) : 0;
  numbers[kVertices] = vertices;
  numbers[kFreeVertices] = body.vertex_slots.free_slots().size();
  numbers[kEdges] = edges;
  numbers[kFreeEdges] = body.edge_slots.free_slots().size();
  numbers[kFaces] = body.faces.size();
  numbers[kFreeFaces] = body.face_slots.free_slots().size();
  numbers[kInserted] = body.inserted.size();
  numbers[kSequences] = sequences;
  numbers[kBalls] = balls;
  numbers[kContacts] = of.record.contacts.size();
  numbers[kPartners] = of.record.partners.size();
  numbers[kCategory] = body.filter.category;
  numbers[kMask] = body.filter.mask;
  numbers[kMoves] = of.touches.moves;
  numbers[kTouches] = of.touches.earlier.size();
  // A vertex that was added since the shape was taken makes the shape worthless: the next move takes it anew.
  const bool has_rest = body.is_rigid() && body.shape[0].rest.size() == D * vertices;
  numbers[kRest] = has_rest ? D * vertices : 0;
  numbers[kTouched] = touched;
  numbers[kRadius] = bits_as<uint64_t>(body.radius);
  numbers[kLengths] = body.lengths.size();
  append(image.bodies, numbers, numbers_of(content.format));
  append_parts(scene.env.map, body, image);
  append_forecasts(scene, of, sequences, balls, image);
  append_contacts(of.record, image);
  if (content.format < kHistoryFormat) return;
  for (const RigidShape<D>& shape : body.shape) {
    append(image.shapes, shape.moved.rotation, 4);
    append(image.shapes, shape.moved.centre, D);
    append(image.shapes, shape.moved.translation, D);
    if (has_rest) append(image.shapes, shape.rest.data(), shape.rest.size());
  }
  append_history(of, image);
  if (content.format < kTouchedFormat) return;
  for (size_t i = 0; i < touched; ++i) {
    for (const RidgeName& line : body.touched[i].lines) append(image.touched, line.vertices, 2);
  }
  if (content.format < kRadiusFormat) return;
  append(image.lengths, body.lengths.data(), body.lengths.size());
}

DSW_INSTANTIATE(append);

}  // namespace dsw
