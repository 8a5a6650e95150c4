#include "moves.h"

#include <cmath>

namespace dsw::curves {

mpq_class time_of(const oracle::MoveTruth& truth) {
  const oracle::SweepEvent& e = truth.events.front();
  mpq_class time(e.numerator.c[e.order], e.denominator.c[e.order]);
  time.canonicalize();
  return time;
}

double distance_at(const Vec& from, const Vec& to, const mpq_class& time, const double* point) {
  mpq_class square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class p(from[k]);
    const mpq_class d = p + time * (mpq_class(to[k]) - p) - mpq_class(point[k]);
    square += d * d;
  }
  return std::sqrt(square.get_d());
}

std::optional<Move> move_from(Place& place, Rng& rng, const Vec& start, int vertices, double length, double step,
                              dsw_level level) {
  Move move;
  std::vector<Vec>& at = move.body.at;
  at.push_back(start);
  const auto beside = [&](double distance) {
    const Vec d = Place::direction(rng, distance);
    return Vec{start[0] + d[0], start[1] + d[1], start[2] + d[2]};
  };
  for (int i = 1; i < vertices; ++i) at.push_back(beside(length));
  const Vec to = beside(step);
  move.targets = at;
  move.targets[0] = to;
  bool inside = place.holds(to);
  for (const Vec& p : at) inside = inside && place.holds(p);
  if (!inside || !place.is_free(at)) return std::nullopt;
  oracle::VertexMove flight = {at[0], to, {at.begin() + 1, at.end()}, {}};
  if (vertices == 2) move.body.edges = {{0, 1}};
  if (vertices == 3) {
    move.body.faces = {{0, 1, 2}};
    flight.faces = {{0, 1}};
    if (!place.is_free({at[0], at[2]}) || place.exact().blocked(at[0], at[1], at[2])) return std::nullopt;
  }
  move.truth = place.exact().move(flight, level);
  return move;
}

Move random_move(Place& place, Rng& rng, int vertices, double length, double step, dsw_level level) {
  for (;;) {
    auto move = move_from(place, rng, place.point(rng), vertices, length, step, level);
    if (move) return std::move(*move);
  }
}

dsw_move_options move_options() {
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.stand_off = -1;
  return options;
}

dsw_body_id create_body(dsw_scene* scene, const oracle::BodyPlan& plan, const Setting& setting) {
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  std::vector<std::uint32_t> offsets = {0}, corners;
  for (const auto& face : plan.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  desc.flags = setting.flags;
  desc.level = setting.level;
  desc.motion_share = setting.motion_share;
  desc.positions = plan.at[0].data();
  desc.vertex_count = plan.at.size();
  desc.edges = plan.edges.empty() ? nullptr : plan.edges[0].data();
  desc.edge_count = plan.edges.size();
  if (!plan.faces.empty()) {
    desc.face_offsets = offsets.data();
    desc.face_corners = corners.data();
    desc.face_count = plan.faces.size();
    desc.face_corner_count = corners.size();
  }
  dsw_body_id body;
  check(dsw_body_create(scene, &desc, &body));
  return body;
}

std::vector<Vec> positions_of(const dsw_scene* scene, dsw_body_id body, std::size_t vertices) {
  std::vector<Vec> at(vertices);
  std::size_t count = 0;
  check(dsw_body_get_positions(scene, body, at[0].data(), vertices, 0, nullptr, &count));
  return at;
}

void Movers::add(const Trip& trip) {
  trips_.push_back(&trip);
  for (const Vec& target : trip.targets) targets_.insert(targets_.end(), target.begin(), target.end());
}

void Movers::prepare() {
  for (const dsw_body_id body : bodies_) check(dsw_body_destroy(scene_.get(), body));
  bodies_.clear();
  for (const Trip* trip : trips_) bodies_.push_back(create_body(scene_.get(), trip->body, setting_));
}

void Movers::run() {
  check(dsw_scene_move_bodies(scene_.get(), bodies_.data(), bodies_.size(), targets_.data(), targets_.size() / 3, 0,
                              &setting_.options, nullptr));
}

std::vector<dsw_body_contact> Movers::contacts(std::size_t i) const {
  const dsw_body_contact* contacts = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_contacts(scene_.get(), bodies_[i], &contacts, &count));
  return {contacts, contacts + count};
}

}  // namespace dsw::curves
