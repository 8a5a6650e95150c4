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
  move.to = beside(step);
  bool inside = place.holds(move.to);
  for (const Vec& p : at) inside = inside && place.holds(p);
  if (!inside || !place.is_free(at)) return std::nullopt;
  oracle::VertexMove flight = {at[0], move.to, {at.begin() + 1, at.end()}, {}};
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

Movers::Movers(Place& place, const std::vector<Move>& moves, dsw_level level, const dsw_move_options& options,
               std::uint32_t flags)
    : moves_(moves), level_(level), options_(options), flags_(flags), scene_(place.scene()) {
  for (const Move& move : moves) {
    targets_.insert(targets_.end(), move.to.begin(), move.to.end());
    for (std::size_t i = 1; i < move.body.at.size(); ++i) {
      targets_.insert(targets_.end(), move.body.at[i].begin(), move.body.at[i].end());
    }
  }
}

void Movers::clear() {
  for (const dsw_body_id body : bodies_) dsw_body_destroy(scene_.get(), body);
  bodies_.clear();
}

void Movers::prepare() {
  clear();
  for (const Move& move : moves_) {
    dsw_body_id body;
    check(create_body(scene_.get(), move.body, level_, flags_, {}, &body));
    bodies_.push_back(body);
  }
}

void Movers::run() {
  check(dsw_scene_move_bodies(scene_.get(), bodies_.data(), bodies_.size(), targets_.data(), targets_.size() / 3, 0,
                              &options_, nullptr));
}

const dsw_contact* Movers::contact(std::size_t i) const {
  const dsw_contact* contacts = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_contacts(scene_.get(), bodies_[i], &contacts, &count));
  return count == 0 ? nullptr : contacts;
}

}  // namespace dsw::curves
