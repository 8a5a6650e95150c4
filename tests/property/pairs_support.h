// Bodies that meet each other, and what is true of their moves: all parts against all parts, over GMP.
#pragma once

#include "body_support.h"
#include "predicates/touch.h"
#include "touch_truth.h"

namespace dsw::oracle {

/// A vertex, edge or face.
struct Part {
  std::vector<uint32_t> vertices;
};

/// A body as the truth sees it.
struct Meeting {
  dsw_body_id id;
  dsw_level level = DSW_LEVEL_FACES;
  bool self = false;
  int dimension = 3;
  BodyState state;

  std::vector<Part> parts() const {
    std::vector<Part> all;
    for (uint32_t v = 0; v < state.at.size(); ++v) {
      if (state.vertices[v].generation != 0) all.push_back({{v}});
    }
    for (const auto& e : state.edges) {
      if (level >= DSW_LEVEL_EDGES) all.push_back({{e[0], e[1]}});
    }
    for (const auto& f : state.faces) {
      if (level == DSW_LEVEL_FACES) all.push_back({{f[0], f[1], f[2]}});
    }
    return all;
  }
  const double* at(uint32_t v) const { return state.at[v].data(); }
};

/// What a vertex's move first touches.
inline void keep_first(TouchTruth& first, const TouchTruth& other) {
  first.at_start = first.at_start || other.at_start;
  if (!other.touches || (first.touches && first.time <= other.time)) return;
  first.touches = true;
  first.time = other.time;
}

/// The first touch of one moving part, which has vertex v, and one part that stays.
inline TouchTruth truth_of_parts(const Meeting& mover, const Part& moving, uint32_t v, const Vec& to,
                                 const Meeting& other, const Part& still) {
  std::vector<const double*> others, fixed;
  for (uint32_t u : moving.vertices) {
    if (u != v) others.push_back(mover.at(u));
  }
  for (uint32_t u : still.vertices) fixed.push_back(other.at(u));
  std::vector<const double*> swept = others;
  swept.push_back(mover.at(v));
  swept.push_back(to.data());
  const auto least = [](const std::vector<const double*>& points, size_t k) {
    double x = points[0][k];
    for (const double* p : points) x = std::min(x, p[k]);
    return x;
  };
  const auto most = [](const std::vector<const double*>& points, size_t k) {
    double x = points[0][k];
    for (const double* p : points) x = std::max(x, p[k]);
    return x;
  };
  for (size_t k = 0; k < 3; ++k) {
    if (most(swept, k) < least(fixed, k) || most(fixed, k) < least(swept, k)) return {};
  }
  return (mover.dimension == 2 ? touch_truth<2> : touch_truth<3>)(mover.at(v), to.data(), others, fixed);
}

inline TouchTruth truth_of_move(const std::vector<Meeting>& bodies, size_t mover, uint32_t v, const Vec& to) {
  TouchTruth first;
  const Meeting& body = bodies[mover];
  const auto has = [](const Part& part, uint32_t u) {
    return std::find(part.vertices.begin(), part.vertices.end(), u) != part.vertices.end();
  };
  for (const Part& moving : body.parts()) {
    if (!has(moving, v)) continue;
    for (size_t j = 0; j < bodies.size(); ++j) {
      if (j == mover && !body.self) continue;
      for (const Part& still : bodies[j].parts()) {
        if (j == mover) {
          const bool adjacent =
              std::any_of(still.vertices.begin(), still.vertices.end(), [&](uint32_t u) { return has(moving, u); });
          if (adjacent) continue;
        }
        keep_first(first, truth_of_parts(body, moving, v, to, bodies[j], still));
      }
    }
  }
  return first;
}

/// Whether two bodies that stand still have no point in common, by what touch_test.cpp compares with rationals. Of one
/// body: parts without a common vertex.
inline bool are_apart(const Meeting& a, const Meeting& b) {
  const auto share_vertex = [](const Part& one, const Part& other) {
    return std::find_first_of(one.vertices.begin(), one.vertices.end(), other.vertices.begin(), other.vertices.end()) !=
           one.vertices.end();
  };
  const std::vector<Part> of_a = a.parts(), of_b = b.parts();
  for (const Part& one : of_a) {
    for (const Part& other : of_b) {
      if (&a == &b && share_vertex(one, other)) continue;
      const bool turned = one.vertices.size() == 3;
      if (turned && other.vertices.size() == 3) continue;  // an edge of one would be in the other
      const Part &edge = turned ? other : one, &face = turned ? one : other;
      const Meeting &of_edge = turned ? b : a, &of_face = turned ? a : b;
      const double* const triangle[3] = {of_face.at(face.vertices.front()),
                                         of_face.at(face.vertices[face.vertices.size() / 2]),
                                         of_face.at(face.vertices.back())};
      if (triangle_touches(triangle, of_edge.at(edge.vertices.front()), of_edge.at(edge.vertices.back()))) return false;
    }
  }
  return true;
}

inline bool is_time(double t, const mpq_class& exact) {
  return mpq_class(t) <= exact && (t == 1 || mpq_class(std::nextafter(t, 2.0)) > exact);
}

}  // namespace dsw::oracle
