#include "soft_body.h"

#include <algorithm>
#include <chrono>

namespace physics {
namespace {

// The edges of a polyline.
std::vector<std::uint32_t> links_of(std::size_t points) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i + 1 < points; ++i) {
    edges.insert(edges.end(), {i, i + 1});
  }
  return edges;
}

}  // namespace

SoftBodyOptions::SoftBodyOptions() {
  dsw_move_options_init(&move, sizeof move);
  move.vertex_response = DSW_RESPONSE_SLIDE;
  move.edge_response = DSW_RESPONSE_ADAPTIVE_SLIDE;
  move.noise_share = 0.02;
}

SoftBody::SoftBody(dsw_scene* scene, const Positions& line, double mass_each, const SoftBodyOptions& body_options)
    : SoftBody(scene, BodyMesh{line, links_of(line.size()), {}}, mass_each, body_options) {}

SoftBody::SoftBody(dsw_scene* scene, const Positions& corners, const std::vector<std::uint32_t>& triangles,
                   double mass_each, const SoftBodyOptions& body_options)
    : SoftBody(scene, BodyMesh{corners, {}, triangles}, mass_each, body_options) {}

SoftBody::SoftBody(dsw_scene* scene, const BodyMesh& mesh, double mass_each, const SoftBodyOptions& body_options)
    : options(body_options), scene_(scene) {
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t i = 0; i <= mesh.triangles.size(); i += 3) {
    offsets.push_back(i);
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = mesh.triangles.empty() ? options.level : DSW_LEVEL_FACES;
  desc.edges = mesh.edges.data();
  desc.edge_count = mesh.edges.size() / 2;
  desc.face_offsets = offsets.data();
  desc.face_corners = mesh.triangles.data();
  desc.face_count = mesh.triangles.size() / 3;
  desc.face_corner_count = mesh.triangles.size();
  create(mesh.corners, mass_each, &desc);
}

void SoftBody::create(const Positions& corners, double mass_each, dsw_body_desc* desc) {
  desc->positions = corners.front().data();
  desc->stride_bytes = sizeof(Vector3);
  desc->vertex_count = corners.size();
  check(dsw_body_create(scene_, desc, &id_), "creating a body");
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.set(i, corners[i], mass_each);
  }
  read_positions();
}

void SoftBody::pull_into_shape(double dt, Points* next) {
  Positions goals;
  shape->find_goals(next->position, &goals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (next->inverse_mass(i) > 0) {
      next->position[i] += options.match * (goals[i] - next->position[i]);
      next->velocity[i] = (next->position[i] - points.position[i]) / dt;
    }
  }
}

void SoftBody::stay_off_known_walls(double dt, Points* next) {
  if (known_.empty()) {
    return;
  }
  resolve(0, options.contact_rounds, &known_, next);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (next->inverse_mass(i) > 0) {
      next->position[i] = points.position[i] + dt * next->velocity[i];
    }
  }
}

// Remembers the contacts that have pressed. Contacts whose vertices are gone, or that have been known for long, are
// forgotten.
void SoftBody::remember_contacts() {
  const auto is_over = [this](Touch& touch) {
    const auto is_gone = [this](std::size_t i) { return points.mass[i] == 0; };
    return ++touch.age > options.contact_memory || !(touch.impulse.squaredNorm() > 0) ||
           std::any_of(touch.point, touch.point + touch.count, is_gone);
  };
  known_.insert(known_.end(), touches_.begin(), touches_.end());
  known_.erase(std::remove_if(known_.begin(), known_.end(), is_over), known_.end());
}

std::size_t SoftBody::count() const {
  return static_cast<std::size_t>(
      std::count_if(points.mass.begin(), points.mass.end(), [](double m) { return m > 0; }));
}

StepReport SoftBody::step(double dt) {
  StepReport report;
  remove_negligible(&report);
  new_.clear();
  Points next;
  integrate(points, springs, load, dt, options.integrator, &next);
  if (shape) {
    pull_into_shape(dt, &next);
  }
  stay_off_known_walls(dt, &next);
  dsw_move_options move = options.move;
  if (count() >= options.most_vertices) {
    move.edge_response = DSW_RESPONSE_SLIDE;
  }
  const auto start = std::chrono::steady_clock::now();
  report.status =
      dsw_body_move(scene_, id_, next.position.front().data(), next.size(), sizeof(Vector3), &move, &report.move);
  report.library_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.was_finite = is_finite(next);
  targets.swap(next.position);
  if (report.status == DSW_STATUS_NON_FINITE) {
    report.message = dsw_last_error_message();
    report.move = dsw_move_report{};
    touches_.clear();
    known_.clear();
    points.rest();
    return report;
  }
  check(report.status, "moving a body");
  points.velocity = next.velocity;
  if (!report.was_finite) {  // the positions were numbers, their quotients are not
    points.rest();
  }
  follow_edits(&report);
  read_positions();
  touches_ = read_touches(scene_, id_, points, options.friction);
  resolve(options.restitution, options.contact_rounds, &touches_, &points);
  remember_contacts();
  return report;
}

void SoftBody::read_positions() {
  std::size_t slots = 0;
  volumes.resize(points.size());
  check(dsw_body_get_positions(scene_, id_, points.position.front().data(), points.size(), sizeof(Vector3),
                               volumes.data(), &slots),
        "reading positions");
}

void SoftBody::follow_edits(StepReport* report) {
  const dsw_body_edit* edits = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_edits(scene_, id_, &edits, &count), "reading edits");
  for (std::size_t i = 0; i < count; ++i) {
    follow_edit(edits[i], report);
  }
}

void SoftBody::follow_edit(const dsw_body_edit& edit, StepReport* report) {
  std::size_t a = edit.ends[0].index, b = edit.ends[1].index, vertex = edit.vertex.index;
  double share = edit.edge_parameter;
  // A contact of a vertex that was here before says nothing of this one.
  known_.erase(std::remove_if(known_.begin(), known_.end(),
                              [vertex](const Touch& touch) {
                                return std::find(touch.point, touch.point + touch.count, vertex) !=
                                       touch.point + touch.count;
                              }),
               known_.end());
  if (edit.inserted != 0) {
    if (inserted_.empty()) {
      whole_ = points.mass;
    }
    points.split(a, b, vertex, share, options.omega);
    springs.split(a, b, vertex, share);
    if (shape) {
      shape->split(a, b, vertex, share);
    }
    inserted_.split(a, b, vertex);
    new_.push_back(vertex);
    ++report->inserted;
    return;
  }
  const bool has_line = shape && inserted_.contains(vertex);
  const std::size_t line[2] = {has_line ? inserted_.ends(vertex)[0] : a, has_line ? inserted_.ends(vertex)[1] : a};
  inserted_.merge(vertex, a);
  if (springs.merge(vertex, &a, &b, &share)) {
    points.merge(vertex, a, b, share);
  } else if (has_line) {
    points.merge(vertex, line[0], line[1], shape->share_between(line[0], line[1], vertex));
  } else {
    points.merge(vertex, a, a, 0);
  }
  if (shape) {
    shape->merge(vertex);
  }
  ++report->removed;
}

std::vector<double> SoftBody::pulls() {
  Positions goals;
  shape->find_goals(points.position, &goals);
  std::vector<double> pulls(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    pulls[i] = points.mass[i] > 0 ? (goals[i] - points.position[i]).norm() : 0;
  }
  return pulls;
}

void SoftBody::remove_negligible(StepReport* report) {
  if (!shape || !(options.negligible > 0) || inserted_.empty()) {
    return;
  }
  std::vector<char> colliding(points.size(), 0);
  for (const std::vector<Touch>* touches : {&touches_, &known_}) {
    for (const Touch& touch : *touches) {
      std::for_each(touch.point, touch.point + touch.count, [&colliding](std::size_t i) { colliding[i] = 1; });
    }
  }
  std::for_each(new_.begin(), new_.end(), [&colliding](std::size_t i) { colliding[i] = 1; });
  dsw_body_edit edit;
  while (remove_one(scene_, id_, inserted_, pulls(), options.negligible * shape->radius(), colliding, &edit)) {
    follow_edit(edit, report);
  }
  if (inserted_.empty()) {
    points.share_out(whole_);
  }
}

bool SoftBody::add_vertex(const Vector3& at, std::size_t next, double mass, double stretching, double bending,
                          std::size_t* added) {
  const dsw_volume_id anywhere = {0, 0};
  dsw_body_vertex_id vertex, end;
  dsw_body_edge_id edge;
  check(dsw_body_get_vertex_id(scene_, id_, static_cast<std::uint32_t>(next), &end), "reading a vertex");
  check(dsw_body_add_vertex(scene_, id_, at.data(), anywhere, &vertex), "adding a vertex");
  const dsw_status status = dsw_body_add_edge(scene_, id_, vertex, end, &edge);
  if (status == DSW_STATUS_OCCUPIED) {
    check(dsw_body_remove_vertex(scene_, id_, vertex), "removing a vertex");
    points.clear(vertex.index);  // a free slot of the body from now on
    return false;
  }
  check(status, "adding an edge");
  points.set(vertex.index, at, mass);
  whole_.resize(points.size(), 0);
  whole_[vertex.index] = mass;
  const double length = (points.position[next] - at).norm();
  for (const DistanceSpring& spring : springs.distances) {
    if (spring.a == next || spring.b == next) {
      const std::size_t far = spring.a == next ? spring.b : spring.a;
      springs.angles.push_back({vertex.index, next, far, 2 * bending / (length + spring.rest),
                                kPressedShare * std::min(length, spring.rest)});
      break;
    }
  }
  springs.distances.push_back({vertex.index, next, length, stretching / length});
  *added = vertex.index;
  return true;
}

}  // namespace physics
