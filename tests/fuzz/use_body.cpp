// A body's short life: created, moved, edited; free at its level and of one piece after every call.

#include <cmath>

#include "use.h"

namespace dsw_fuzz {
namespace {

constexpr uint32_t kMostVertices = 7;

bool all_finite(const double* values, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

/** A body under test, and everything that can be read of it. */
struct Subject {
  dsw_scene* scene;
  dsw_body_id id;
  bool is_partition;
  size_t dimension;  // doubles of a point
  std::vector<double> positions;
  std::vector<dsw_volume_id> volumes;
  std::vector<dsw_body_vertex_id> vertices;
  std::vector<dsw_body_edge_id> edges;
  std::vector<dsw_body_face_id> faces;
  double radius;

  void read() {
    dsw_body_counts counts = {};
    counts.struct_size = sizeof counts;
    require(dsw_body_get_counts(scene, id, &counts) == DSW_STATUS_OK, "a body has counts");
    positions.resize(dimension * counts.vertex_slots);
    volumes.resize(counts.vertex_slots);
    vertices.resize(counts.vertex_count);
    edges.resize(counts.edge_count);
    faces.resize(counts.face_count);
    size_t n = 0;
    require(dsw_body_get_positions(scene, id, positions.data(), volumes.size(), 0, volumes.data(), &n) == DSW_STATUS_OK,
            "positions can be read");
    require(n == counts.vertex_slots, "one position a slot");
    require(dsw_body_get_vertex_ids(scene, id, vertices.data(), vertices.size(), &n) == DSW_STATUS_OK, "vertices");
    require(dsw_body_get_edge_ids(scene, id, edges.data(), edges.size(), &n) == DSW_STATUS_OK, "edges");
    require(dsw_body_get_face_ids(scene, id, faces.data(), faces.size(), &n) == DSW_STATUS_OK, "faces");
    require(dsw_body_get_radius(scene, id, &radius) == DSW_STATUS_OK, "a radius");
  }
  const double* at(uint32_t vertex) const { return positions.data() + dimension * vertex; }

  /** Ids of living things mostly; the one beyond the last is null. */
  template <class Id>
  static Id pick(const std::vector<Id>& ids, Bytes* bytes) {
    const uint32_t index = bytes->below(static_cast<uint32_t>(ids.size()) + 1);
    return index < ids.size() ? ids[index] : Id{0, 0};
  }
};

void check_edge_is_free(const Subject& s, uint32_t a, uint32_t b) {
  dsw_cast_options options;
  dsw_cast_options_init(&options, sizeof options);
  options.flags = DSW_CAST_START_KNOWN;
  dsw_flight flight = {};
  require(dsw_environment_cast(dsw_scene_get_environment(s.scene), s.volumes[a], s.at(a), s.at(b), &options, &flight) ==
              DSW_STATUS_OK,
          "an edge can be cast");
  require(flight.outcome == DSW_OUTCOME_REACHED, "every edge is free");
  require(flight.volume.index == s.volumes[b].index, "an edge ends in the volume of its end");
}

/** What holds of a body after every call. */
void check_body(Subject* s) {
  s->read();
  const dsw_environment* environment = dsw_scene_get_environment(s->scene);
  require(all_finite(s->positions.data(), s->positions.size()), "a body lies somewhere");
  dsw_level level;
  require(dsw_body_get_level(s->scene, s->id, &level) == DSW_STATUS_OK, "a body has a level");
  for (const dsw_body_edge_id edge : s->edges) {
    dsw_body_vertex_id ends[2];
    require(dsw_body_get_edge_ends(s->scene, s->id, edge, ends) == DSW_STATUS_OK, "an edge has ends");
    require(ends[0].index != ends[1].index && ends[0].generation != 0 && ends[1].generation != 0, "two living ends");
    if (level == DSW_LEVEL_POINTS || !s->is_partition) continue;
    check_edge_is_free(*s, ends[0].index, ends[1].index);
    check_edge_is_free(*s, ends[1].index, ends[0].index);
  }
  for (const dsw_body_face_id face : s->faces) {
    dsw_body_vertex_id corners[3];
    require(dsw_body_get_face_corners(s->scene, s->id, face, corners) == DSW_STATUS_OK, "a face has corners");
    require(corners[0].index != corners[1].index && corners[1].index != corners[2].index &&
                corners[2].index != corners[0].index,
            "three of them");
  }
  if (!s->is_partition) return;
  require(check_radius(s->scene, s->id) == s->radius, "a radius is what it is");
  for (const dsw_body_vertex_id vertex : s->vertices) {
    dsw_volume_id found;
    dsw_location location;
    require(dsw_environment_locate(environment, s->at(vertex.index), s->volumes[vertex.index], &found, &location) ==
                DSW_STATUS_OK,
            "locate a vertex");
    require(location == DSW_LOCATION_PASSABLE && found.index == s->volumes[vertex.index].index,
            "a vertex is where it says");
  }
  require(dsw_body_set_level(s->scene, s->id, DSW_LEVEL_POINTS) == DSW_STATUS_OK, "a level can be lowered");
  require(dsw_body_set_level(s->scene, s->id, level) == DSW_STATUS_OK, "a body is free at its level");
}

/** `on_arc`: the vertex went on an arc, and its time is the part of that. */
void check_contact(const Subject& s, const dsw_body_contact& c, dsw_search search, bool on_arc) {
  require(c.time >= 0 && c.time <= 1 && c.edge_parameter >= 0 && c.edge_parameter <= 1,
          "a contact has a time and a place on the edge");
  require(is_unit(c.contact.normal) && all_finite(c.point, 3) && all_finite(c.position, 3),
          "normal, point and position");
  require(c.contact.kind != DSW_CONTACT_NONE && c.contact.obstacle.kind != DSW_CELL_NONE &&
              c.contact.marked_kind != DSW_CELL_NONE,
          "with something");
  require(c.history == DSW_HISTORY_NEW || c.history == DSW_HISTORY_LASTING, "new or lasting");
  require(c.edge.generation == 0 || c.face.generation == 0, "an edge or a face");
  require(c.vertex.generation != 0 && c.contact.front.generation != 0 && c.distance_left >= 0, "a contact is whole");
  // Casts and sweeps are of thin ones.
  if (on_arc || !s.is_partition || s.radius != 0 || search >= DSW_SEARCH_BISECTION || c.face.generation != 0) return;
  const bool all = search == DSW_SEARCH_EXHAUSTIVE;  // obstacles behind the first come with their own times
  const dsw_environment* environment = dsw_scene_get_environment(s.scene);
  const dsw_volume_id none = {0, 0};
  if (c.edge.generation != 0) {
    dsw_sweep sweep = {};
    require(dsw_environment_sweep_edges(environment, 1, nullptr, c.from, c.to, c.fixed[0], 0, nullptr, &sweep) ==
                DSW_STATUS_OK,
            "a contact can be swept again");
    require(sweep.outcome == DSW_OUTCOME_CONTACT && (sweep.time == c.time || (all && sweep.time < c.time)),
            "the edge meets it at that time");
  } else {
    dsw_flight flight = {};
    require(dsw_environment_cast(environment, none, c.from, c.to, nullptr, &flight) == DSW_STATUS_OK, "a cast");
    require(flight.outcome == DSW_OUTCOME_CONTACT && (flight.time == c.time || (all && flight.time < c.time)),
            "the vertex meets it at that time");
  }
}

void check_results(const Subject& s, const dsw_move_report& report, dsw_search search, bool on_arc = false) {
  const dsw_body_contact* contacts = nullptr;
  const dsw_body_edit* edits = nullptr;
  size_t count = 0;
  require(dsw_body_get_contacts(s.scene, s.id, &contacts, &count) == DSW_STATUS_OK, "contacts");
  require(count == report.contact_count, "as many contacts as it says");
  for (size_t i = 0; i < count; ++i) check_contact(s, contacts[i], search, on_arc);
  require(dsw_body_get_edits(s.scene, s.id, &edits, &count) == DSW_STATUS_OK && count == report.edit_count, "edits");
  require(report.fraction >= 0 && report.fraction <= 1, "a fraction");
  require(report.vertices_stopped <= report.vertices_moved && report.edges_skipped <= report.edges_swept, "parts");
}

void move_body(Subject* s, Bytes* bytes) {
  std::vector<double> targets = s->positions;
  for (const dsw_body_vertex_id vertex : s->vertices) {
    if (bytes->below(4) == 0) continue;
    for (size_t k = 0; k < s->dimension; ++k) targets[s->dimension * vertex.index + k] = bytes->number();
  }
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.edge_response = static_cast<dsw_response>(bytes->below(6));
  const uint8_t choice = bytes->byte();
  options.vertex_response = (choice & 1) != 0 ? DSW_RESPONSE_SLIDE : DSW_RESPONSE_STOP;
  options.search = static_cast<dsw_search>((choice >> 1) % 4);
  options.bisection_depth = (choice & 8) != 0 ? 52 : 0;
  options.min_part = (choice & 16) != 0 ? 1e-6 : 0;
  options.stand_off = (choice & 32) != 0 ? -1 : (choice & 64) != 0 ? 0.125 : 0;
  options.noise_share = (choice & 128) != 0 ? 0.25 : 0;
  std::vector<uint32_t> order;
  const uint32_t course = bytes->below(16);
  options.flags = (course & 4) != 0 ? DSW_MOVE_KEEP_WALLS : 0;
  options.passes = (course & 8) != 0 ? 3 : 0;
  if (course % 4 == 1) options.flags |= DSW_MOVE_LEAVE;
  if (course % 4 == 3) {  // from the last to the first, one left out
    for (size_t i = s->vertices.size(); i-- > 1;) order.push_back(s->vertices[i].index);
    options.order = order.data();
    options.order_count = order.size();
  }
  bool finite = true;
  for (const dsw_body_vertex_id vertex : s->vertices) {
    const bool moves = options.order == nullptr || vertex.index != s->vertices[0].index;
    finite = finite && (!moves || all_finite(targets.data() + s->dimension * vertex.index, s->dimension));
  }
  if (order.empty()) options.order = nullptr, finite = all_finite(targets.data(), targets.size());
  dsw_move_report report = {};
  const dsw_status status = dsw_body_move(s->scene, s->id, targets.data(), s->volumes.size(), 0, &options, &report);
  require((status == DSW_STATUS_OK) == finite, "a move to all finite targets and no others");
  if (status != DSW_STATUS_OK) return;
  check_results(*s, report, options.search);
  if (report.vertices_stopped != 0 || report.edit_count != 0) return;
  Subject now = *s;
  now.read();
  for (const dsw_body_vertex_id vertex : s->vertices) {
    if (options.order != nullptr && vertex.index == s->vertices[0].index) continue;
    for (size_t k = 0; k < s->dimension; ++k) {
      require(now.at(vertex.index)[k] == targets[s->dimension * vertex.index + k], "who did not stop is there");
    }
  }
}

void move_rigid(Subject* s, Bytes* bytes) {
  dsw_rigid_motion motion;
  for (double& each : motion.rotation) each = bytes->number();
  bytes->point(motion.centre);
  bytes->point(motion.translation);
  if (s->dimension == 2) motion.rotation[0] = motion.rotation[1] = motion.centre[2] = motion.translation[2] = 0;
  dsw_move_report report = {};
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  const bool slides = motion.translation[0] > 0;
  options.flags = slides ? DSW_MOVE_SLIDE_WHOLE : 0;
  if (dsw_body_move_rigid(s->scene, s->id, &motion, &options, &report) != DSW_STATUS_OK) return;
  if (!slides) check_results(*s, report, DSW_SEARCH_EXACT, true);
  require(report.edit_count == 0 && report.contact_count <= (slides ? 33u : 1u),
          "a rigid body has no edits, and one first contact of each motion");
  require(dsw_body_get_motion_left(s->scene, s->id, &motion) == DSW_STATUS_OK, "something or nothing is left");
}

/** Any status, as long as a failure changes nothing; check_body sees to the rest. */
void edit_body(Subject* s, Bytes* bytes) {
  const dsw_body_vertex_id a = Subject::pick(s->vertices, bytes), b = Subject::pick(s->vertices, bytes);
  const dsw_body_edge_id edge = Subject::pick(s->edges, bytes);
  const dsw_body_face_id face = Subject::pick(s->faces, bytes);
  dsw_body_vertex_id vertex;
  dsw_body_edge_id new_edge;
  dsw_body_face_id new_face;
  double point[3];
  const Subject before = *s;
  dsw_status status = DSW_STATUS_OK;
  switch (bytes->below(10)) {
    case 0:
      bytes->point(point);
      status = dsw_body_add_vertex(s->scene, s->id, point, {0, 0}, &vertex);
      break;
    case 1:
      status = dsw_body_add_edge(s->scene, s->id, a, b, &new_edge);
      break;
    case 2:
      status = dsw_body_add_face(s->scene, s->id, a, b, Subject::pick(s->vertices, bytes), &new_face);
      break;
    case 3:
      status = dsw_body_remove_vertex(s->scene, s->id, a);
      break;
    case 4:
      status = dsw_body_remove_edge(s->scene, s->id, edge);
      break;
    case 5:
      status = dsw_body_remove_face(s->scene, s->id, face);
      break;
    case 6:
      status = dsw_body_split_edge(s->scene, s->id, edge, bytes->number() / 8, nullptr);
      break;
    case 7:
      status = dsw_body_collapse_edge(s->scene, s->id, edge, a, nullptr);
      break;
    case 8:  // what a body occupies stays passable
      mark_something(dsw_scene_get_environment(s->scene), bytes);
      break;
    default: {
      const uint8_t choice = bytes->byte();
      status = choice < 198 ? dsw_body_set_level(s->scene, s->id, static_cast<dsw_level>(choice % 6))
                            : dsw_body_set_radius(s->scene, s->id, bytes->number() / 64);
    }
  }
  require(status != DSW_STATUS_INTERNAL, "no defect shows");
  if (status == DSW_STATUS_OK) return;
  s->read();
  require(s->positions == before.positions && s->vertices.size() == before.vertices.size() &&
              s->edges.size() == before.edges.size() && s->faces.size() == before.faces.size() &&
              s->radius == before.radius,
          "what fails changes nothing");
}

bool is_crossed(dsw_status status) {
  return status == DSW_STATUS_OUTSIDE || status == DSW_STATUS_IMPASSABLE || status == DSW_STATUS_OCCUPIED;
}

/** A body that is not free begins crossed, unless something else is wrong with it; whether it can be freed. */
bool free_body(dsw_scene* scene, dsw_body_desc desc, dsw_body_id* body) {
  desc.flags |= DSW_BODY_START_PENETRATING;
  const dsw_status status = dsw_body_create(scene, &desc, body);
  require(!is_crossed(status) && status != DSW_STATUS_INTERNAL, "a body may penetrate something");
  if (status != DSW_STATUS_OK) return false;
  const dsw_penetration* found = nullptr;
  size_t count = 0;
  require(dsw_body_find_penetrations(scene, *body, &found, &count) == DSW_STATUS_OK && count != 0, "which it tells");
  uint32_t freed = 0, penetrates = 2;
  double distance = -1;
  require(dsw_body_depenetrate(scene, *body, {0, 0}, 0, &freed, &distance) == DSW_STATUS_OK && distance >= 0,
          "it goes");
  require(dsw_body_is_penetrating(scene, *body, &penetrates) == DSW_STATUS_OK && penetrates == 1 - freed, "or not");
  if (freed == 0) require(dsw_body_destroy(scene, *body) == DSW_STATUS_OK, "a body that penetrates goes");
  return freed != 0;
}

bool create_body(dsw_scene* scene, size_t dimension, Bytes* bytes, dsw_body_id* body) {
  const uint32_t vertex_count = 1 + bytes->below(kMostVertices), edge_count = bytes->below(7),
                 face_count = dimension == 3 ? bytes->below(7) : 0;
  std::vector<double> positions(dimension * vertex_count);
  for (double& each : positions) each = bytes->number();
  std::vector<uint32_t> edges(2 * size_t{edge_count}), offsets = {0}, corners;
  for (uint32_t& end : edges) end = bytes->below(vertex_count);
  for (uint32_t f = 0; f < face_count; ++f) {
    for (uint32_t k = bytes->below(8) == 7 ? 4 : 3; k > 0; --k) corners.push_back(bytes->below(vertex_count));
    offsets.push_back(static_cast<uint32_t>(corners.size()));
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  const uint8_t flags = bytes->byte();
  desc.flags = flags % 17;
  desc.radius = flags < 204 ? 0 : bytes->number() / 64;
  desc.level = static_cast<dsw_level>(1 + bytes->below(dimension == 3 ? 4 : 3));
  desc.positions = positions.data();
  desc.vertex_count = vertex_count;
  desc.edges = edges.data();
  desc.edge_count = edge_count;
  desc.face_offsets = offsets.data();
  desc.face_corners = corners.data();
  desc.face_count = face_count;
  desc.face_corner_count = corners.size();
  size_t before = 0, after = 0;
  require(dsw_scene_get_body_count(scene, &before) == DSW_STATUS_OK, "bodies are counted");
  const dsw_status status = dsw_body_create(scene, &desc, body);
  require(status != DSW_STATUS_INTERNAL, "no defect shows");
  require(dsw_scene_get_body_count(scene, &after) == DSW_STATUS_OK, "bodies are counted");
  require(after == before + (status == DSW_STATUS_OK ? 1 : 0), "a body that is refused is none");
  return status == DSW_STATUS_OK || (is_crossed(status) && free_body(scene, desc, body));
}

}  // namespace

void use_body(dsw_scene* scene, bool is_partition, Bytes* bytes) {
  const size_t dimension = dimension_of(dsw_scene_get_environment(scene));
  Subject subject = {scene, {0, 0}, is_partition, dimension, {}, {}, {}, {}, {}, 0};
  if (!create_body(scene, dimension, bytes, &subject.id)) return;
  check_body(&subject);
  for (int step = 0; step < 8 && !bytes->empty(); ++step) {
    switch (bytes->below(4)) {
      case 0:
        move_rigid(&subject, bytes);
        break;
      case 1:
        edit_body(&subject, bytes);
        break;
      default:
        move_body(&subject, bytes);
    }
    check_body(&subject);
  }
  require(dsw_body_destroy(scene, subject.id) == DSW_STATUS_OK, "a body goes");
}

}  // namespace dsw_fuzz
