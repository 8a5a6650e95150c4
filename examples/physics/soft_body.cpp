#include "soft_body.h"

#include <algorithm>
#include <chrono>

namespace physics {

SoftBodyOptions::SoftBodyOptions() {
  dsw_move_options_init(&move, sizeof move);
  move.vertex_response = DSW_RESPONSE_SLIDE;
  move.edge_response = DSW_RESPONSE_HYBRID;
  move.noise_share = 0.02;
}

SoftBody::SoftBody(dsw_scene* scene, const Positions& line, double mass_each, const SoftBodyOptions& body_options)
    : options(body_options), scene_(scene) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
    edges.insert(edges.end(), {i, i + 1});
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = options.level;
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  create(line, mass_each, &desc);
}

SoftBody::SoftBody(dsw_scene* scene, const Positions& corners, const std::vector<std::uint32_t>& triangles,
                   double mass_each, const SoftBodyOptions& body_options)
    : options(body_options), scene_(scene) {
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t i = 0; i <= triangles.size(); i += 3) {
    offsets.push_back(i);
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_FACES;
  desc.face_offsets = offsets.data();
  desc.face_corners = triangles.data();
  desc.face_count = triangles.size() / 3;
  desc.face_corner_count = triangles.size();
  create(corners, mass_each, &desc);
}

void SoftBody::create(const Positions& corners, double mass_each, dsw_body_desc* desc) {
  desc->positions = corners.front().data();
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

// Those that have pressed go on; those whose vertices are gone, or that have been known for long, do not.
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
  report.status = dsw_body_move(scene_, id_, next.position.front().data(), next.size(), 0, &move, &report.move);
  report.library_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.was_finite = is_finite(next);
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
  check(dsw_body_get_positions(scene_, id_, points.position.front().data(), points.size(), 0, volumes.data(), &slots),
        "reading positions");
}

void SoftBody::follow_edits(StepReport* report) {
  const dsw_body_edit* edits = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_edits(scene_, id_, &edits, &count), "reading edits");
  for (std::size_t i = 0; i < count; ++i) {
    const dsw_body_edit& edit = edits[i];
    std::size_t a = edit.ends[0].index, b = edit.ends[1].index, vertex = edit.vertex.index;
    double share = edit.share;
    // A contact of a vertex that was here before says nothing of this one.
    known_.erase(std::remove_if(known_.begin(), known_.end(),
                                [vertex](const Touch& touch) {
                                  return std::find(touch.point, touch.point + touch.count, vertex) !=
                                         touch.point + touch.count;
                                }),
                 known_.end());
    if (edit.inserted != 0) {
      points.split(a, b, vertex, share, options.omega);
      springs.split(a, b, vertex, share);
      if (shape) {
        shape->split(a, b, vertex, share);
      }
      inserted_.resize(points.size(), 0);
      inserted_[vertex] = 1;
      ++report->inserted;
      continue;
    }
    if (springs.merge(vertex, &a, &b, &share)) {
      points.merge(vertex, a, b, share);
    } else {
      points.merge(vertex, a, a, 0);
    }
    if (shape) {
      shape->merge(vertex);
    }
    inserted_[vertex] = 0;
    ++report->removed;
  }
}

bool SoftBody::add_vertex(const Vector3& at, std::size_t next, double mass, double stretching, double bending,
                          std::size_t* added) {
  const dsw_volume_id anywhere = {0, 0};
  dsw_body_vertex_id vertex, end;
  dsw_body_edge_id edge;
  check(dsw_body_get_vertex(scene_, id_, static_cast<std::uint32_t>(next), &end), "reading a vertex");
  check(dsw_body_add_vertex(scene_, id_, at.data(), anywhere, &vertex), "adding a vertex");
  const dsw_status status = dsw_body_add_edge(scene_, id_, vertex, end, &edge);
  if (status == DSW_STATUS_OCCUPIED) {
    check(dsw_body_remove_vertex(scene_, id_, vertex), "removing a vertex");
    points.clear(vertex.index);  // a free slot of the body from now on
    return false;
  }
  check(status, "adding an edge");
  points.set(vertex.index, at, mass);
  inserted_.resize(points.size(), 0);
  const double length = (points.position[next] - at).norm();
  for (const DistanceSpring& spring : springs.distances) {
    if (spring.a == next || spring.b == next) {
      const std::size_t far = spring.a == next ? spring.b : spring.a;
      springs.angles.push_back({vertex.index, next, far, 2 * bending / (length + spring.rest)});
      break;
    }
  }
  springs.distances.push_back({vertex.index, next, length, stretching / length});
  *added = vertex.index;
  return true;
}

}  // namespace physics
