// Creation of bodies: topology first, then places, then the proof that they are free.

#include "scene/bodies.h"

#include <algorithm>
#include <utility>

#include "base/dimensions.h"
#include "scene/distances.h"
#include "scene/live_register.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

void check_corner(const BodyDescription& d, uint32_t vertex, const char* name, size_t index) {
  if (vertex < d.vertex_count) return;
  fail(DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->%s[%zu] is %u, there are %zu vertices", name, index, vertex,
       d.vertex_count);
}

template <int D>
void add_edges(Body<D>& body, const BodyDescription& d) {
  for (size_t i = 0; i < d.edge_count; ++i) {
    const uint32_t a = d.edges[2 * i], b = d.edges[2 * i + 1];
    check_corner(d, a, "edges", 2 * i);
    check_corner(d, b, "edges", 2 * i + 1);
    if (a == b) fail(DSW_STATUS_REPEATED_VERTEX, "edge %zu joins vertex %u with itself", i, a);
    if (find_edge(body, a, b) != kNone) {
      fail(DSW_STATUS_DUPLICATE_PART, "edge %zu between vertices %u and %u occurs twice", i, a, b);
    }
    add_edge(body, a, b);
  }
}

template <int D>
void add_triangle(Body<D>& body, size_t face, uint32_t a, uint32_t b, uint32_t c) {
  if (a == b || b == c || c == a) {
    fail(DSW_STATUS_REPEATED_VERTEX, "face %zu has the triangle (%u, %u, %u), which names a vertex twice", face, a, b,
         c);
  }
  check_face(body, face, a, b, c);
  add_face(body, a, b, c);
}

/** What back-edge elimination asks of a body. */
void check_closed(const Body<3>& body) {
  if (!is_closed_surface(body)) {
    fail(DSW_STATUS_NOT_CLOSED,
         "DSW_BODY_SKIP_BACK_EDGES is for closed surfaces: an edge does not have two faces, or a vertex has none");
  }
  if (!is_turned_outwards(body)) {
    fail(DSW_STATUS_NOT_ORIENTED,
         "DSW_BODY_SKIP_BACK_EDGES: the volume that the faces hold is not positive; corners must be counter-clockwise "
         "seen from outside");
  }
}

size_t triangle_count(const BodyDescription& d) {
  size_t count = 0;
  for (size_t f = 0; f < d.face_count; ++f) {
    const uint32_t begin = d.face_offsets[f], end = d.face_offsets[f + 1];
    if (end < begin || end - begin < 3 || end > d.face_corner_count) {
      fail(DSW_STATUS_WRONG_SIZE, "face %zu has corners %u to %u of %zu, at least 3 are needed", f, begin, end,
           d.face_corner_count);
    }
    for (uint32_t k = begin; k < end; ++k) check_corner(d, d.face_corners[k], "face_corners", k);
    count += end - begin - 2;
  }
  return count;
}

template <int D>
void add_faces(Body<D>& body, const BodyDescription& d) {
  for (size_t f = 0; f < d.face_count; ++f) {
    const uint32_t* const corners = d.face_corners + d.face_offsets[f];
    const uint32_t count = d.face_offsets[f + 1] - d.face_offsets[f];
    for (uint32_t k = 1; k + 1 < count; ++k) add_triangle(body, f, corners[0], corners[k], corners[k + 1]);
  }
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (is_one_fan(body, v)) continue;
    fail(DSW_STATUS_NOT_MANIFOLD, "the triangles at vertex %u form more than one fan", v);
  }
}

}  // namespace

template <int D>
void check_face(const Body<D>& body, size_t face, uint32_t a, uint32_t b, uint32_t c) {
  switch (face_defect(body, a, b, c)) {
    case FaceDefect::kFine:
      return;
    case FaceDefect::kRepeated:
      fail(DSW_STATUS_DUPLICATE_PART, "face %zu: the triangle (%u, %u, %u) occurs twice", face, a, b, c);
    case FaceDefect::kThirdFace:
      fail(DSW_STATUS_NOT_MANIFOLD, "face %zu: an edge of triangle (%u, %u, %u) has two triangles already", face, a, b,
           c);
    case FaceDefect::kTurned:
      fail(DSW_STATUS_NOT_ORIENTED, "face %zu: triangle (%u, %u, %u) is turned against a neighbour", face, a, b, c);
  }
}

template <int D>
void check_free(Scene<D>& scene, const Body<D>& body, SweepLevel level) {
  scene.offending.clear();
  BodyProbe<D>(scene.env, Obstacle::kCells).find_blocked(body, level, scene.offending);
  if (scene.offending.empty()) {
    check_apart(scene, body, level);
    return check_distances(scene, body);
  }
  fail(DSW_STATUS_OCCUPIED, "%zu edges meet something impassable; the first joins vertices %u and %u",
       scene.offending.size() / 2, scene.offending[0], scene.offending[1]);
}

template <int D>
void prepare_body(const Scene<D>& scene, BodyRecord<D>& of) {
  if (scene.keeps_boxes()) keep_boxes(of.body);
  of.record.keeps_partners = of.next.keeps_partners = scene.features.contacts;
  if (scene.features.live) of.followed = scene.live.get()->gone.number();
}

template <int D>
void follow_changes(const Scene<D>& scene, BodyRecord<D>& of) noexcept {
  if (!scene.features.live) return;
  const GoneFacets<D>& gone = scene.live.get()->gone;
  if (of.followed == gone.number()) return;
  for (size_t e = 0; e < of.body.corridors.size(); ++e) {
    if (gone.are_in(of.body.corridors[e], of.followed)) of.body.corridors.forget(e);
  }
  of.followed = gone.number();
}

template <int D>
BodyRecord<D> make_body(const Scene<D>& scene, const BodyDescription& d, const Cell* cells) {
  BodyRecord<D> made(scene.memory);
  Body<D>& body = made.body;
  body.level = d.level;
  body.skipping = d.skipping;
  body.filter = d.filter;
  body.radius = d.radius;
  if (d.rigid) body.shape.emplace_back(scene.memory);
  const size_t triangles = triangle_count(d);
  reserve(body, d.vertex_count, d.edge_count + 3 * triangles, triangles);
  for (size_t i = 0; i < d.vertex_count; ++i) add_vertex(body, d.positions[i], cells[i]);
  add_edges(body, d);
  if constexpr (D == 3) {
    add_faces(body, d);
    if (body.skipping.back_edges) check_closed(body);
  }
  shrink_to_fit(body);
  prepare_body(scene, made);
  return made;
}

template <int D>
dsw_body_id enter_body(Scene<D>& scene, BodyRecord<D>&& made) {
  if (scene.keeps_boxes()) scene.body_boxes.reserve(scene.bodies.size() + 1);
  scene.body_slots.reserve(1);
  reserve_more(scene.bodies, 1);
  const SlotPool::Slot slot = scene.body_slots.acquire();
  if (slot.index == scene.bodies.size()) {
    scene.bodies.push_back(std::move(made));
  } else {
    scene.bodies[slot.index] = std::move(made);
  }
  scene.leaving += scene.bodies[slot.index].body.skipping.leaves_back_edges ? 1 : 0;
  note_body(scene, slot.index);
  return {slot.index, slot.generation};
}

namespace {

/** Whether a call that proves something of a body is made; what says that the body is not free is no failure. */
template <class Call>
bool succeeds(const Call& call) {
  try {
    call();
    return true;
  } catch (const Error& error) {
    const dsw_status status = error.status();
    if (status != DSW_STATUS_OUTSIDE && status != DSW_STATUS_IMPASSABLE && status != DSW_STATUS_OCCUPIED) throw;
    return false;
  }
}

/** Sets a body aside until it is free. */
template <int D>
void set_aside(const Scene<D>& scene, BodyRecord<D>& made) {
  made.penetrating.push_back(std::move(made.body));
  made.body = Body<D>(scene.memory);
  made.penetrating[0].boxes.clear();
  for (BodyVertex<D>& each : made.penetrating[0].vertices) each.cell = Cell{};
  prepare_body(scene, made);
}

}  // namespace

template <int D>
dsw_body_id create_body(Scene<D>& scene, const BodyDescription& d) {
  if (d.vertex_count >= kNone) fail(DSW_STATUS_TOO_LARGE, "desc->vertex_count is %zu", d.vertex_count);
  Array<Cell> cells(d.vertex_count, Cell{}, scene.memory);
  const auto place = [&] { place_points(scene, d.positions, d.vertex_count, d.hints, true, cells.data(), nullptr); };
  const bool is_placed = d.may_penetrate ? succeeds(place) : (place(), true);
  BodyRecord<D> made = make_body(scene, d, cells.data());
  scene.offending.clear();
  const auto check = [&] { check_free(scene, made.body, made.body.level); };
  if (!d.may_penetrate) {
    check();
  } else if (!is_placed || !succeeds(check)) {
    set_aside(scene, made);
  }
  return enter_body(scene, std::move(made));
}

template <int D>
void destroy_body(Scene<D>& scene, uint32_t slot) noexcept {
  scene.leaving -= scene.bodies[slot].body.skipping.leaves_back_edges ? 1 : 0;
  scene.body_slots.release(slot);
  scene.body_boxes.remove(slot);
  scene.bodies[slot] = BodyRecord<D>(scene.memory);
}

template <int D>
BodyRecord<D>& check_body_id(Scene<D>& scene, dsw_body_id id, ArgumentName argument, size_t index) {
  if (!scene.body_slots.alive(id.index, id.generation)) {
    fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no body", ElementName(argument, index).text, id.index,
         id.generation);
  }
  return scene.bodies[id.index];
}

template <int D>
BodyRecord<D>& check_body(Scene<D>& scene, dsw_body_id id, ArgumentName argument, size_t index) {
  BodyRecord<D>& of = check_body_id(scene, id, argument, index);
  if (of.is_penetrating()) {
    fail(DSW_STATUS_OCCUPIED, "%s {index %u, generation %u} penetrates something: see dsw_body_depenetrate",
         ElementName(argument, index).text, id.index, id.generation);
  }
  return of;
}

template <int D>
void set_level(Scene<D>& scene, Body<D>& body, SweepLevel level) {
  scene.offending.clear();
  // One that meets itself looks at its own parts, which are those of the new level.
  const SweepLevel before = std::exchange(body.level, level);
  try {
    if (level > before) check_free(scene, body, level);
    if (body.keeps_corridors()) keep_corridors(body, body.edges.size());
    if (level != before) std::fill(body.untested.begin(), body.untested.end(), uint8_t{0});
  } catch (...) {
    body.level = before;
    throw;
  }
}

template <int D>
void set_filter(Scene<D>& scene, Body<D>& body, const ContactFilter& filter) {
  scene.offending.clear();
  const ContactFilter before = std::exchange(body.filter, filter);
  try {
    check_apart(scene, body, body.level);
    check_distances(scene, body);
  } catch (...) {
    body.filter = before;
    throw;
  }
}

DSW_INSTANTIATE(create_body);
DSW_INSTANTIATE(make_body);
DSW_INSTANTIATE(enter_body);
DSW_INSTANTIATE(prepare_body);
DSW_INSTANTIATE(follow_changes);
DSW_INSTANTIATE(destroy_body);
DSW_INSTANTIATE(check_body_id);
DSW_INSTANTIATE(check_body);
DSW_INSTANTIATE(set_level);
DSW_INSTANTIATE(set_filter);
DSW_INSTANTIATE(check_free);
template void check_face(const Body<3>& body, size_t face, uint32_t a, uint32_t b, uint32_t c);

}  // namespace dsw
