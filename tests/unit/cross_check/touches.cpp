#include "touches.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsw::test {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kParallel = 1e-3;  // sine between two edges, as in src/cross_check

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec scaled(const Vec& a, double by) { return {by * a[0], by * a[1], by * a[2]}; }
Vec plus(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec unit(const Vec& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }

double reach_of(const Points& points) {
  double reach = 0;
  for (const Vec& p : points) reach = std::max(reach, std::sqrt(dot(p, p)));
  return reach;
}

/// Points behind an obstacle of reach 1, so that it is solid and has no other face near the touch.
Points behind(const Points& obstacle, const Vec& normal) {
  const Vec away = scaled(normal, -1);
  Vec centre{};
  for (const Vec& p : obstacle) centre = plus(centre, scaled(p, 1 / static_cast<double>(obstacle.size())));
  if (obstacle.size() >= 3) return {plus(centre, away)};
  const Vec side = obstacle.size() == 2 ? unit(cross(normal, minus(obstacle[1], obstacle[0])))
                                        : unit(cross(normal, std::fabs(normal[0]) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
  Points points = {plus(plus(centre, away), scaled(side, 0.5)), plus(plus(centre, away), scaled(side, -0.5))};
  if (obstacle.size() == 1) points.push_back(plus(plus(centre, away), scaled(cross(normal, side), 0.5)));
  return points;
}

void put(Hull& hull, const Points& points) {
  for (const Vec& p : points) hull.points.insert(hull.points.end(), {p[0], p[1], p[2]});
}

}  // namespace

Vec to_vec(const double* x) { return {x[0], x[1], x[2]}; }
Vec along(const Vec& from, const double* direction, double distance) {
  return plus(from, scaled(to_vec(direction), distance));
}

void Figures::ask(const Points& body, const Points& obstacle, const Vec& point, const double* normal) {
  ++count_;
  Points ours, theirs;
  for (const Vec& p : body) ours.push_back(minus(p, point));
  for (const Vec& p : obstacle) theirs.push_back(minus(p, point));
  // Both as large as the smaller one, where both are more than a point: seen from the touch.
  const double first = reach_of(ours), second = reach_of(theirs);
  const double size = body.size() == 1 ? second : obstacle.size() == 1 ? first : std::min(first, second);
  for (Vec& p : ours) p = scaled(p, 1 / (body.size() == 1 ? size : first));
  for (Vec& p : theirs) p = scaled(p, 1 / (obstacle.size() == 1 ? size : second));
  if (body.size() == 2 && obstacle.size() == 2) {
    const Vec across = cross(unit(minus(ours[1], ours[0])), unit(minus(theirs[1], theirs[0])));
    if (dot(across, across) < kParallel * kParallel) {
      ++parallel_;
      return;
    }
  }
  Features features(nullptr);
  put(features.body, ours);
  put(features.obstacle, theirs);
  put(features.obstacle, behind(theirs, to_vec(normal)));
  features.unit = size;
  const SecondNormal answer = second_normal(features, normal);
  not_converged_ += answer.answer == Answer::kNotConverged ? 1u : 0u;
  not_unique_ += answer.answer == Answer::kNotUnique ? 1u : 0u;
  if (answer.answer == Answer::kGiven) degrees_.push_back(answer.angle * kDegrees);
}

double Figures::quantile(double part) const {
  if (degrees_.empty()) return 0;
  std::vector<double> sorted = degrees_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<size_t>(part * static_cast<double>(sorted.size() - 1))];
}

std::string Figures::text() const {
  char line[256];
  std::snprintf(line, sizeof line,
                "%6zu contacts, normal of %8.4f %%, angle p50 %.1e p99 %.1e most %.1e degrees; none: parallel %zu, not "
                "converged %zu, "
                "not unique %zu; corners, not asked %zu",
                count_, 100 * share(), quantile(0.5), quantile(0.99), quantile(1), parallel_, not_converged_,
                not_unique_, not_asked_);
  return line;
}

}  // namespace dsw::test
