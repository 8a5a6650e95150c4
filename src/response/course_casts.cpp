#include "response/course_casts.h"

namespace dsw {

template <int D>
void CourseCasts<D>::start() {
  packet_.clear();  // of casts left by a move that ran out of memory
  if (!course_.motion.body->keeps_corridors()) return;
  writers_.reserve(kPacket);  // casts point at them
}

template <int D>
void CourseCasts<D>::run() {
  packet_.run(env_, sweeps_.counters);
  for (uint32_t i = 0; i < packet_.count(); ++i) {
    if (packet_.reached(i)) continue;
    ++doubts_;
    if (vertices_[i] != kNone) {
      course_.put_in_doubt(vertices_[i]);
    } else {
      for (const uint32_t v : course_.motion.body->edges[edges_[i]].ends) course_.put_in_doubt(v);
    }
  }
}

template <int D>
void CourseCasts<D>::cast_paths() {
  MovingBody<D>& motion = course_.motion;
  dsw::cast_paths(
      env_, packet_, sweeps_.counters, sweeps_.max_volumes,
      [&](auto add) {
        for (const uint32_t v : course_.order) {
          if (course_.moves(v)) add(motion, 0, v, motion.targets[v]);
        }
      },
      [&](uint32_t, uint32_t v, const CastResult&) { course_.vertices[v].doubtful = true; });
}

template <int D>
void CourseCasts<D>::add_edge(uint32_t e, uint32_t v, const End& from, const End& to) {
  const uint32_t at = packet_.count();
  vertices_[at] = v;
  edges_[at] = e;
  CastRequest& request = packet_.add(env_, from.cell, from.position, to.position);
  request.end = to.cell;
  request.max_volumes = sweeps_.max_volumes;
  if (course_.motion.body->keeps_corridors()) {
    if (writers_.size() == at) writers_.emplace_back(env_.memory);
    writers_[at].attach(env_, request);
  }
  if (packet_.full()) run_edges();
}

template <int D>
void CourseCasts<D>::run_edges() {
  run();
  if (course_.motion.body->keeps_corridors()) {
    for (uint32_t i = 0; i < packet_.count(); ++i) {
      if (!packet_.reached(i)) continue;
      Corridors<D>& corridors = course_.motion.body->corridors;
      if (writers_[i].passed_none() && corridors.is_plain(edges_[i])) continue;
      Corridor<D>& corridor = corridors.own(edges_[i], env_.obstacle_version);
      corridor.keep(course_.motion.body->call);
      writers_[i].finish(corridor);
    }
  }
  packet_.clear();
}

/** Casts these edges of a vertex. Calls visit(edge) for each that is not free, until it returns false. Returns whether it never did. */
template <int D>
template <class Visit>
bool CourseCasts<D>::visit_blocked(uint32_t v, const Array<uint32_t>& edges, Visit visit) {
  const Body<D>& body = *course_.motion.body;
  const BodyVertex<D>& at = body.vertices[v];
  bool go_on = true;
  const auto run_some = [&] {
    packet_.run(env_, sweeps_.counters);
    for (uint32_t i = 0; i < packet_.count() && go_on; ++i) go_on = packet_.reached(i) || visit(edges_[i]);
    packet_.clear();
  };
  for (size_t i = 0; i < edges.size() && go_on; ++i) {
    const BodyVertex<D>& other = body.vertices[body.edges[edges[i]].other(v)];
    edges_[packet_.count()] = edges[i];
    packet_.add_between(env_, at.cell, at.position, other.cell, other.position, 0);
    if (packet_.full()) run_some();
  }
  run_some();
  return go_on;
}

template <int D>
bool CourseCasts<D>::are_free(uint32_t v, const Array<uint32_t>& edges) {
  return visit_blocked(v, edges, [](uint32_t) { return false; });
}

template <int D>
void CourseCasts<D>::test_star(uint32_t v, const Array<uint32_t>& asked) {
  Array<uint8_t>& untested = course_.motion.body->untested;
  for_each_edge(*course_.motion.body, v, [&](uint32_t e) {
    untested[e] = 0;
    return true;
  });
  visit_blocked(v, asked, [&](uint32_t e) {
    untested[e] = 1;
    return true;
  });
}

template class CourseCasts<2>;
template class CourseCasts<3>;

}  // namespace dsw
