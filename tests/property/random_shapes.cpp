#include "random_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dsw::oracle {
namespace {

dsw::Cell some_cell(const Environment<3>& env, Rng& rng) {
  for (;;) {
    const dsw::Cell c = env.map.cell(rng.below(env.map.index_count()));
    if (c.valid()) return c;
  }
}

const double* some_vertex(const Environment<3>& env, Rng& rng) {
  const dsw::Cell c = some_cell(env, rng);
  return env.point(c, rng.below(env.map.vertices_of(c)));
}

/// An octahedron, refined; `noise` moves points towards the middle and away from it.
ClosedSurface ball(const double* middle, double radius, double noise, int levels, Rng& rng) {
  std::vector<Vec> at = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ClosedSurface ball;
  ball.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (; levels > 0; --levels) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    std::vector<uint32_t> finer;
    for (size_t t = 0; t < ball.triangles.size(); t += 3) {
      uint32_t corner[3], half[3];
      for (size_t k = 0; k < 3; ++k) {
        corner[k] = ball.triangles[t + k];
        const uint32_t next = ball.triangles[t + (k + 1) % 3];
        const auto key = std::make_pair(std::min(corner[k], next), std::max(corner[k], next));
        const auto found = middles.emplace(key, static_cast<uint32_t>(at.size()));
        half[k] = found.first->second;
        if (!found.second) continue;
        Vec v;
        double length = 0;
        for (size_t i = 0; i < 3; ++i) {
          v[i] = at[corner[k]][i] + at[next][i];
          length += v[i] * v[i];
        }
        for (double& x : v) x /= std::sqrt(length);
        at.push_back(v);
      }
      for (size_t k = 0; k < 3; ++k) finer.insert(finer.end(), {corner[k], half[k], half[(k + 2) % 3]});
      finer.insert(finer.end(), half, half + 3);
    }
    ball.triangles = finer;
  }
  for (const Vec& v : at) {
    const double r = radius * (1 + rng.range(-noise, noise));
    for (size_t k = 0; k < 3; ++k) ball.points.push_back(middle[k] + r * v[k]);
  }
  return ball;
}

ClosedSurface box(const double* p, const double* q) {
  ClosedSurface box;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) box.points.push_back((i >> k & 1) != 0 ? std::max(p[k], q[k]) : std::min(p[k], q[k]));
  }
  box.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return box;
}

void turn_inside_out(ClosedSurface& surface) {
  for (size_t t = 0; t < surface.triangles.size(); t += 3) std::swap(surface.triangles[t], surface.triangles[t + 1]);
}

void add(ClosedSurface& surface, const ClosedSurface& other) {
  const auto first = static_cast<uint32_t>(surface.points.size() / 3);
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  for (const uint32_t i : other.triangles) surface.triangles.push_back(first + i);
}

void some_place(const Environment<3>& env, double reach, Rng& rng, double* out) {
  centre(env, some_cell(env, rng), out);
  for (int k = 0; k < 3; ++k) out[k] += rng.range(-reach, reach);
}

}  // namespace

ClosedSurface some_surface(const Environment<3>& env, double size, Rng& rng) {
  const double radii[] = {0.02, 0.1, 0.2, 0.3, 0.5, 4};
  const double radius = size * radii[rng.below(6)];
  double at[3], next[3];
  some_place(env, rng.chance(0.5) ? 0 : radius, rng, at);
  ClosedSurface surface;
  switch (rng.below(6)) {
    case 0:
      surface = ball(at, radius, 0, 2, rng);
      break;
    case 1:
      surface = ball(at, radius, 0.7, rng.between(0, 2), rng);
      break;
    case 2:
      surface = box(some_vertex(env, rng), some_vertex(env, rng));
      break;
    case 3:
      some_place(env, radius, rng, next);
      surface = box(at, next);
      break;
    case 4:
      surface.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
      for (int i = 0; i < 4; ++i) {
        const double* const p = some_vertex(env, rng);
        surface.points.insert(surface.points.end(), p, p + 3);
      }
      break;
    default:
      // Two that overlap: the surface turns twice round what both hold, or not at all.
      surface = ball(at, radius, 0.2, 1, rng);
      some_place(env, radius, rng, next);
      if (rng.chance(0.5)) turn_inside_out(surface);
      add(surface, ball(next, radius, 0, 1, rng));
  }
  return surface;
}

std::vector<double> some_loop(const Environment<3>& env, double size, Rng& rng) {
  const double radii[] = {0.02, 0.1, 0.2, 0.3, 0.6, 5};
  const double radius = size * radii[rng.below(6)], noise = rng.chance(0.5) ? 0 : 0.4;
  const int count = rng.between(3, 9);
  double middle[3], u[3], v[3];
  some_place(env, 0, rng, middle);
  for (int k = 0; k < 3; ++k) {
    u[k] = rng.range(-1, 1);
    v[k] = rng.range(-1, 1);
  }
  std::vector<double> loop;
  if (rng.chance(0.3)) {  // in a plane of the axes through a vertex
    std::copy_n(some_vertex(env, rng), 3, middle);
    const int axis = rng.between(0, 2);
    for (int k = 0; k < 3; ++k) {
      u[k] = k == (axis + 1) % 3 ? 1 : 0;
      v[k] = k == (axis + 2) % 3 ? 1 : 0;
    }
  }
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count, r = radius * (1 + rng.range(-noise, noise));
    for (int k = 0; k < 3; ++k) {
      loop.push_back(middle[k] + r * (std::cos(angle) * u[k] + std::sin(angle) * v[k]) +
                     rng.range(-noise, noise) * 0.3 * radius);
    }
  }
  if (rng.chance(0.2)) {
    for (size_t i = 0; i < 3; ++i) std::copy_n(some_vertex(env, rng), 3, &loop[3 * i]);
  }
  return loop;
}

}  // namespace dsw::oracle
