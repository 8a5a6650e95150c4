// Points in common are sums a p + b p' + ... = ... with shares that are not negative and add up to 1 on both sides; a p
// + b p' is (a + b) p(b / (a + b)). The least of such a ratio is at a corner of all such shares.

#include "touch_truth.h"

#include <array>

namespace dsw {
namespace {

/** The one solution of sum x_i column_i = (0, ..., 0, 1, 1) over the columns of `chosen`, if there is just one. */
template <size_t N>
bool solve(const std::vector<std::array<mpq_class, N>>& columns, unsigned chosen, std::vector<mpq_class>& x) {
  std::vector<size_t> names;
  for (size_t i = 0; i < columns.size(); ++i) {
    if ((chosen >> i & 1u) != 0) names.push_back(i);
  }
  std::vector<std::vector<mpq_class>> rows(N, std::vector<mpq_class>(names.size() + 1));
  for (size_t r = 0; r < N; ++r) {
    for (size_t c = 0; c < names.size(); ++c) rows[r][c] = columns[names[c]][r];
    rows[r][names.size()] = r >= N - 2 ? 1 : 0;
  }
  for (size_t c = 0; c < names.size(); ++c) {
    size_t pivot = c;
    while (pivot < N && sgn(rows[pivot][c]) == 0) ++pivot;
    if (pivot == N) return false;
    std::swap(rows[c], rows[pivot]);
    for (size_t r = 0; r < N; ++r) {
      if (r == c || sgn(rows[r][c]) == 0) continue;
      const mpq_class factor = rows[r][c] / rows[c][c];
      for (size_t k = c; k <= names.size(); ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  for (size_t r = names.size(); r < N; ++r) {
    if (sgn(rows[r][names.size()]) != 0) return false;
  }
  x.assign(columns.size(), 0);
  for (size_t c = 0; c < names.size(); ++c) x[names[c]] = rows[c][names.size()] / rows[c][c];
  return true;
}

}  // namespace

template <int D>
TouchTruth touch_truth(const double* p, const double* to, const std::vector<const double*>& others,
                       const std::vector<const double*>& still) {
  std::vector<std::array<mpq_class, D + 2>> columns;
  const auto add = [&](const double* x, bool moving) {
    std::array<mpq_class, D + 2> column;
    for (size_t k = 0; k < D; ++k) column[k] = moving ? x[k] : -x[k];
    column[moving ? D : D + 1] = 1;
    columns.push_back(column);
  };
  add(p, true);
  add(to, true);
  for (const double* x : others) add(x, true);
  for (const double* x : still) add(x, false);
  TouchTruth truth;
  std::vector<mpq_class> x;
  for (unsigned chosen = 1; chosen < 1u << columns.size(); ++chosen) {
    if (!solve(columns, chosen, x)) continue;
    bool inside = true;
    for (const mpq_class& each : x) inside = inside && sgn(each) >= 0;
    if (!inside) continue;
    truth.at_start = truth.at_start || sgn(x[1]) == 0;
    if (sgn(x[1]) == 0) continue;
    const mpq_class time = x[1] / (x[0] + x[1]);
    if (!truth.touches || time < truth.time) truth.time = time;
    truth.touches = true;
  }
  return truth;
}

template TouchTruth touch_truth<2>(const double*, const double*, const std::vector<const double*>&,
                                   const std::vector<const double*>&);
template TouchTruth touch_truth<3>(const double*, const double*, const std::vector<const double*>&,
                                   const std::vector<const double*>&);

}  // namespace dsw
