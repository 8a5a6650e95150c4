#include "knot_type.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace knot {
namespace {

constexpr std::int64_t kPrime = 2147483647;

/// A place where the diagram crosses itself, on one of its two strands.
struct Passage {
  double place;  // along the curve
  std::size_t crossing;
  bool over;
};

std::int64_t inverse(std::int64_t x) {
  std::int64_t result = 1;
  for (std::int64_t power = kPrime - 2; power != 0; power /= 2) {
    if (power % 2 == 1) result = result * x % kPrime;
    x = x * x % kPrime;
  }
  return result;
}

std::int64_t determinant_of(std::vector<std::vector<std::int64_t>> rows) {
  std::int64_t product = 1;
  const std::size_t n = rows.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    while (pivot < n && rows[pivot][c] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != c) product = (kPrime - product) % kPrime;
    std::swap(rows[c], rows[pivot]);
    product = product * rows[c][c] % kPrime;
    const std::int64_t scale = inverse(rows[c][c]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const std::int64_t factor = rows[r][c] * scale % kPrime;
      for (std::size_t k = c; k < n && factor != 0; ++k) {
        rows[r][k] = (rows[r][k] + (kPrime - factor) * rows[c][k]) % kPrime;
      }
    }
  }
  return product;
}

std::vector<Passage> passages_of(const std::vector<Point>& at) {
  std::vector<Passage> passages;
  const std::size_t n = at.size();
  std::size_t crossings = 0;
  const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Point &a = at[i], &b = at[i + 1], &c = at[j], &d = at[(j + 1) % n];
      const double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
      const double area = cross(ux, uy, vx, vy);
      const double s = cross(c[0] - a[0], c[1] - a[1], vx, vy) / area;
      const double t = cross(c[0] - a[0], c[1] - a[1], ux, uy) / area;
      if (!(s >= 0 && s < 1 && t >= 0 && t < 1)) continue;
      const bool over = a[2] + s * (b[2] - a[2]) > c[2] + t * (d[2] - c[2]);
      passages.push_back({static_cast<double>(i) + s, crossings, over});
      passages.push_back({static_cast<double>(j) + t, crossings, !over});
      ++crossings;
    }
  }
  std::sort(passages.begin(), passages.end(), [](const Passage& x, const Passage& y) { return x.place < y.place; });
  return passages;
}

}  // namespace

long determinant(const std::vector<Point>& thread) {
  std::vector<Point> at;
  // Seen a little from the side, so that no two parts that lie above each other seem to be one.
  for (const Point& p : thread) at.push_back({p[0] + 0.0123 * p[2], p[1] + 0.0345 * p[2], p[2]});
  // Joined by a way round everything else.
  const double far = 1000;
  const Point first = at.front(), last = at.back();
  at.push_back({far, last[1], last[2]});
  at.push_back({far, far, 0});
  at.push_back({-far, far, 0});
  at.push_back({-far, first[1], first[2]});
  const std::vector<Passage> passages = passages_of(at);
  // Colours of arcs: twice that of the arc above is the sum of those of the two arcs below [Fox].
  const std::size_t n = passages.size() / 2;
  std::vector<std::vector<std::int64_t>> rows(n, std::vector<std::int64_t>(n, 0));
  std::size_t arc = 0;
  for (const Passage& each : passages) {
    std::vector<std::int64_t>& row = rows[each.crossing];
    if (each.over) {
      row[arc % n] += 2;
    } else {
      row[arc % n] += kPrime - 1;
      ++arc;
      row[arc % n] += kPrime - 1;
    }
  }
  if (n == 0) return 1;
  rows.pop_back();
  for (auto& row : rows) {
    row.pop_back();
    for (std::int64_t& each : row) each %= kPrime;
  }
  const std::int64_t found = determinant_of(rows);
  return static_cast<long>(std::min(found, kPrime - found));
}

double turns_round_axis(const std::vector<Point>& thread) {
  double angle = 0;
  for (std::size_t i = 0; i + 1 < thread.size(); ++i) {
    const Point &a = thread[i], &b = thread[i + 1];
    angle += std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
  }
  return angle / (8 * std::atan(1.0));
}

}  // namespace knot
