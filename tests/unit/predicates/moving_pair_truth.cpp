// Whether features touch at a time follows from the signs of some polynomials at this time. Between zeros of the
// polynomials nothing changes, and touching is closed: the first time is 0 or a zero. Zeros are isolated by Descartes'
// rule of signs [Collins, Akritas 1976]. A polynomial vanishes at a zero of another if their greatest common divisor
// does; else the interval around the zero shrinks until the polynomial has one sign there.

#include "moving_pair_truth.h"

#include "../../gmp_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace dsw {
namespace {

/** A polynomial on an interval: the sum of c[i] s^(n-i) t^i, where t goes from 0 to 1 over the interval and s = 1-t. */
using Form = std::vector<mpz_class>;

Form add(const Form& a, const Form& b) {
  Form r = a;
  for (size_t i = 0; i < r.size(); ++i) r[i] += b.at(i);
  return r;
}
Form subtract(const Form& a, const Form& b) {
  Form r = a;
  for (size_t i = 0; i < r.size(); ++i) r[i] -= b.at(i);
  return r;
}
Form multiply(const Form& a, const Form& b) {
  Form r(a.size() + b.size() - 1);
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  }
  return r;
}

bool is_zero(const Form& f) {
  return std::all_of(f.begin(), f.end(), [](const mpz_class& c) { return sgn(c) == 0; });
}

/** How often the sign changes along the coefficients. There are as many zeros strictly inside of the interval, or fewer
 * by an even number. */
int sign_changes(const Form& f) {
  int changes = 0, last = 0;
  for (const mpz_class& c : f) {
    if (sgn(c) == 0) continue;
    changes += last * sgn(c) < 0 ? 1 : 0;
    last = sgn(c);
  }
  return changes;
}
bool has_odd_count_of_zeros(const Form& f) { return sign_changes(f) % 2 == 1; }

/** The form on the first half of the interval, times a power of 2. */
Form first_half(Form f) {
  const size_t n = f.size() - 1;
  for (size_t k = n; k > 0; --k) {
    for (size_t i = 1; i <= k; ++i) f[i] += f[i - 1];
  }
  for (size_t i = 0; i <= n; ++i) f[i] <<= static_cast<unsigned long>(n - i);
  return f;
}
Form second_half(Form f) {
  std::reverse(f.begin(), f.end());
  f = first_half(f);
  std::reverse(f.begin(), f.end());
  return f;
}

/** Without common factors of the coefficients, and without zeros at the ends of the interval. */
Form reduced(const Form& f) {
  const auto occurs = [](const mpz_class& c) { return sgn(c) != 0; };
  Form r(std::find_if(f.begin(), f.end(), occurs), std::find_if(f.rbegin(), f.rend(), occurs).base());
  mpz_class common = 0;
  for (const mpz_class& c : r) common = gcd(common, c);
  for (mpz_class& c : r) c /= common;
  return r;
}

/** The greatest common divisor of two that are not 0, but for zeros at the ends of the interval. */
Form common_divisor(Form a, Form b) {
  a = reduced(a);
  b = reduced(b);
  while (true) {
    if (a.size() < b.size()) std::swap(a, b);
    if (b.size() == 1) return b;
    const mpz_class of_a = a.back(), of_b = b.back();
    const size_t ahead = a.size() - b.size();
    for (mpz_class& c : a) c *= of_b;
    for (size_t i = 0; i < b.size(); ++i) a[i + ahead] -= of_a * b[i];
    if (is_zero(a)) return b;
    a = reduced(a);
  }
}

/** a / b, which leaves nothing. Both are reduced. */
Form quotient(Form a, const Form& b) {
  Form r(a.size() - b.size() + 1);
  for (size_t k = r.size(); k-- > 0;) {
    r[k] = a[k + b.size() - 1] / b.back();
    for (size_t i = 0; i < b.size(); ++i) a[k + i] -= r[k] * b[i];
  }
  return r;
}

/** All zeros strictly between 0 and 1 once. */
Form with_simple_zeros(const Form& f) {
  const Form a = reduced(f);
  if (a.size() == 1) return a;
  Form derivative;
  for (size_t i = 1; i < a.size(); ++i) derivative.push_back(a[i] * static_cast<unsigned long>(i));
  return quotient(a, common_divisor(a, derivative));
}

mpq_class dyadic(const mpz_class& numerator, unsigned long depth) {
  mpq_class r(numerator, mpz_class(1) << depth);
  r.canonicalize();
  return r;
}

/** The largest double that is not above numerator / 2^depth in [0,1]. */
double double_below(const mpz_class& numerator, unsigned long depth) {
  if (sgn(numerator) == 0) return 0;
  const long bits = static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2));
  const long unit = std::max(bits - 53 - static_cast<long>(depth), -1074L);
  const long drop = unit + static_cast<long>(depth);
  const mpz_class kept = drop >= 0 ? mpz_class(numerator >> static_cast<unsigned long>(drop))
                                   : mpz_class(numerator << static_cast<unsigned long>(-drop));
  return std::ldexp(kept.get_d(), static_cast<int>(unit));
}

/** A time in [0,1]: low / 2^depth, or the one zero of a form strictly between low / 2^depth and (low + 1) / 2^depth. */
struct Time {
  mpz_class low;
  unsigned long depth = 0;
  Form form;   // on [0,1], without double zeros there; empty if the time is low / 2^depth
  Form local;  // the same on the interval

  bool is_known() const { return form.empty(); }
  mpq_class from() const { return dyadic(low, depth); }
  mpq_class to() const { return is_known() ? from() : dyadic(low + 1, depth); }

  void refine() {
    Form half = first_half(local);
    const bool is_known_now = sgn(half.back()) == 0;
    const bool is_first = !is_known_now && has_odd_count_of_zeros(half);
    low = 2 * low + (is_first ? 0 : 1);
    ++depth;
    if (is_known_now) {
      form.clear();
      local.clear();
    } else {
      local = is_first ? half : second_half(local);
    }
  }

  double double_below_it() const {
    Time time = *this;
    while (true) {
      const double below = double_below(time.low, time.depth);
      if (time.is_known() || mpq_class(std::nextafter(below, 2)) >= time.to()) return below;
      time.refine();
    }
  }
};

/** A form of [0,1] on the interval of a time. */
Form restricted(const Form& f, const Time& time) {
  const mpz_class one = mpz_class(1) << time.depth;
  const Form s{one - time.low, one - time.low - 1}, t{time.low, time.low + 1};
  Form power{1}, sum{f[0]};
  for (size_t i = 1; i < f.size(); ++i) {
    power = multiply(power, t);
    sum = add(multiply(sum, s), multiply(power, {f[i]}));
  }
  return sum;
}

int sign_at(const Form& f, Time time) {
  if (is_zero(f)) return 0;
  constexpr int kEasy = 12;  // most signs are known after so many halves
  Form local = restricted(f, time);
  for (int halves = 0; !time.is_known(); ++halves) {
    if (sign_changes(local) == 0) {
      return sgn(*std::find_if(local.begin(), local.end(), [](const mpz_class& c) { return sgn(c) != 0; }));
    }
    if (halves == kEasy && has_odd_count_of_zeros(restricted(common_divisor(f, time.form), time))) return 0;
    time.refine();
    if (time.is_known()) {
      local = restricted(f, time);
    } else {
      local = time.low % 2 == 0 ? first_half(local) : second_half(local);
    }
  }
  return sgn(local[0]);
}

int compare(Time a, Time b) {
  Form common;
  if (!a.is_known() && !b.is_known()) common = common_divisor(a.form, b.form);
  while (true) {
    if (a.is_known() && b.is_known()) return cmp(a.from(), b.from());
    if (a.to() <= b.from()) return -1;
    if (b.to() <= a.from()) return 1;
    const bool refine_a = !a.is_known() && (b.is_known() || a.depth <= b.depth);
    const bool refine_b = !b.is_known() && (a.is_known() || b.depth <= a.depth);
    if (refine_a && refine_b && has_odd_count_of_zeros(restricted(common, a))) return 0;
    if (refine_a) a.refine();
    if (refine_b) b.refine();
  }
}

/** Appends the zeros strictly inside of an interval in ascending order. */
void isolate(const Form& form, const Form& local, const mpz_class& low, unsigned long depth, std::vector<Time>& zeros) {
  const int most = sign_changes(local);
  if (most == 0) return;
  if (most == 1) {
    zeros.push_back({low, depth, form, local});
    return;
  }
  const Form half = first_half(local);
  isolate(form, half, 2 * low, depth + 1, zeros);
  if (sgn(half.back()) == 0) zeros.push_back({2 * low + 1, depth + 1, {}, {}});
  isolate(form, second_half(local), 2 * low + 1, depth + 1, zeros);
}

/** The zeros in (0,1] of a form that is not 0, in ascending order. */
std::vector<Time> zeros_of(const Form& f) {
  std::vector<Time> zeros;
  const Form simple = with_simple_zeros(f);
  isolate(simple, simple, 0, 0, zeros);
  if (sgn(f.back()) == 0) zeros.push_back({1, 0, {}, {}});
  return zeros;
}

/** A point or vector whose coordinates are forms of one degree. */
using Vector = std::array<Form, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {subtract(a[0], b[0]), subtract(a[1], b[1]), subtract(a[2], b[2])};
}
Form dot(const Vector& a, const Vector& b) {
  return add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]));
}
Vector cross(const Vector& a, const Vector& b) {
  const auto component = [&](size_t i, size_t j) { return subtract(multiply(a[i], b[j]), multiply(a[j], b[i])); };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

/** A point is on a segment if `off` is 0 and `beyond` is not positive. */
struct OnSegment {
  Form off, beyond;
};
OnSegment on_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector turn = cross(p - a, p - b);
  return {dot(turn, turn), dot(p - a, p - b)};
}

/** Features touch if a point of one is on an edge of the other, or if normal_square > 0, flat = 0 and inside >= 0. */
struct Conditions {
  Form flat;  // 0 at every touch
  Form normal_square{0};
  std::vector<Form> inside;
  std::vector<OnSegment> on_edges;

  bool hold_at(const Time& time) const {
    if (sign_at(flat, time) != 0) return false;
    for (const OnSegment& each : on_edges) {
      if (sign_at(each.beyond, time) <= 0 && sign_at(each.off, time) == 0) return true;
    }
    return sign_at(normal_square, time) > 0 &&
           std::all_of(inside.begin(), inside.end(), [&](const Form& f) { return sign_at(f, time) >= 0; });
  }

  std::vector<Form> all_that_decide() const {
    if (!is_zero(flat)) return {flat};
    std::vector<Form> r{normal_square};
    r.insert(r.end(), inside.begin(), inside.end());
    for (const OnSegment& each : on_edges) {
      r.push_back(each.off);
      r.push_back(each.beyond);
    }
    return r;
  }
};

Conditions of_vertex_and_face(const std::vector<Vector>& x) {
  const Vector &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const Vector normal = cross(b - a, c - a);
  Conditions r;
  r.flat = dot(normal, p - a);
  r.normal_square = dot(normal, normal);
  for (size_t i = 1; i < 4; ++i) {
    const Vector &from = x[i], &to = x[i % 3 + 1];
    r.inside.push_back(dot(normal, cross(to - from, p - from)));
    r.on_edges.push_back(on_segment(p, from, to));
  }
  return r;
}

/** The lines meet at a + (b - a) first / normal_square = c + (d - c) second / normal_square. */
Conditions of_edges(const std::vector<Vector>& x) {
  const Vector &a = x[0], &b = x[1], &c = x[2], &d = x[3];
  const Vector normal = cross(b - a, d - c);
  const Form first = dot(cross(c - a, d - c), normal), second = dot(cross(c - a, b - a), normal);
  Conditions r;
  r.flat = dot(normal, c - a);
  r.normal_square = dot(normal, normal);
  r.inside = {first, subtract(r.normal_square, first), second, subtract(r.normal_square, second)};
  r.on_edges = {on_segment(a, c, d), on_segment(b, c, d), on_segment(c, a, b), on_segment(d, a, b)};
  return r;
}

Conditions of_vertex_and_edge(const std::vector<Vector>& x) {
  Conditions r;
  r.flat = cross(x[0] - x[1], x[0] - x[2])[2];
  r.on_edges = {on_segment(x[0], x[1], x[2])};
  return r;
}

/** Doubles times a power of 2 that makes all of them integers. */
class Integers {
 public:
  void add(double x) {
    int exponent = 0;
    if (sgn(units(x, exponent)) != 0) lowest_ = std::min(lowest_, exponent);
  }
  mpz_class of(double x) const {
    int exponent = 0;
    mpz_class r = units(x, exponent);
    if (sgn(r) != 0) r <<= static_cast<unsigned long>(exponent - lowest_);
    return r;
  }

 private:
  static mpz_class units(double x, int& exponent) {
    const double share = std::frexp(x, &exponent);
    exponent -= 53;
    return mpz_class(std::ldexp(share, 53));
  }

  int lowest_ = std::numeric_limits<int>::max();
};

Vector nowhere() { return {Form{0, 0}, Form{0, 0}, Form{0, 0}}; }

/** The points, scaled so that all coordinates are integers. In the plane the third coordinate is 0. */
template <int D>
std::vector<Vector> moving_points(const MovingPair<D>& pair) {
  Integers integers;
  for (int i = 0; i <= D; ++i) {
    for (int k = 0; k < D; ++k) {
      integers.add(pair.start[i][k]);
      integers.add(pair.end[i][k]);
    }
  }
  std::vector<Vector> points(D + 1, nowhere());
  for (size_t i = 0; i <= D; ++i) {
    for (size_t k = 0; k < D; ++k) points[i][k] = {integers.of(pair.start[i][k]), integers.of(pair.end[i][k])};
  }
  return points;
}

Vector multiply(const Form& f, const Vector& a) { return {multiply(f, a[0]), multiply(f, a[1]), multiply(f, a[2])}; }
Vector operator+(const Vector& a, const Vector& b) { return {add(a[0], b[0]), add(a[1], b[1]), add(a[2], b[2])}; }

/** A quaternion v + w. */
struct Turn {
  Vector v;
  Form w;

  Turn(const TurningWay& way, bool in_plane) : v(nowhere()) {
    const size_t first = in_plane ? 2 : 0;
    Integers integers;
    for (const auto& turn : way.turn) {
      for (size_t k = first; k < 4; ++k) integers.add(turn[k]);
    }
    const auto form = [&](size_t k) { return Form{integers.of(way.turn[0][k]), integers.of(way.turn[1][k])}; };
    for (size_t k = first; k < 3; ++k) v[k] = form(k);
    w = form(3);
  }

  Form square() const { return add(dot(v, v), multiply(w, w)); }
  /** The square times the turned x: (w w - v v) x + 2 (v x) v + 2 w (v cross x). */
  Vector turn(const Vector& x) const {
    const Form two{2};
    return multiply(subtract(multiply(w, w), dot(v, v)), x) + multiply(multiply(two, dot(v, x)), v) +
           multiply(multiply(two, w), cross(v, x));
  }
};

/** By how much a feature that turns is displaced along each axis to see what it enters. */
constexpr double kNoShift[3] = {0, 0, 0}, kShift[3] = {0x1p-300, 0x1p-600, 0x1p-1000};

/** All points in space, times the squares of both quaternions: forms of one degree. A way that is none has the square 1. */
template <int D>
std::vector<Vector> moving_points(const TurningPair<D>& pair, const double* shift = kNoShift) {
  const size_t of_first = pair.kind == PairKind::kEdgeEdge ? 2 : 1;
  Integers integers;
  for (size_t k = 0; k < D; ++k) integers.add(shift[k]);
  for (size_t i = 0; i <= D; ++i) {
    const TurningWay* way = pair.way[i < of_first ? 0 : 1];
    for (size_t k = 0; k < D; ++k) {
      integers.add(pair.start[i][k]);
      if (way == nullptr) {
        integers.add(pair.end[i][k]);
      } else {
        for (const double x : {way->centre[k], way->place[0][k], way->place[1][k]}) integers.add(x);
      }
    }
  }
  std::vector<Vector> points;
  for (size_t i = 0; i <= D; ++i) {
    const size_t side = i < of_first ? 0 : 1;
    const TurningWay *const way = pair.way[side], *const other = pair.way[1 - side];
    Vector from = nowhere(), to = nowhere();
    for (size_t k = 0; k < D; ++k) {
      const mpz_class start = integers.of(pair.start[i][k]);
      if (way == nullptr) {
        to[k] = {start, integers.of(pair.end[i][k])};
      } else {
        from[k] = {start - integers.of(way->centre[k])};
        const mpz_class by = integers.of(shift[k]);
        to[k] = {integers.of(way->place[0][k]) + by, integers.of(way->place[1][k]) + by};
      }
    }
    Vector at = to;
    if (way != nullptr) {
      const Turn turn(*way, D == 2);
      for (Form& x : from) x.resize(1);
      at = multiply(Form{1, 1}, turn.turn(from)) + multiply(turn.square(), to);
    }
    if (other != nullptr) at = multiply(Turn(*other, D == 2).square(), at);
    points.push_back(at);
  }
  return points;
}

std::optional<Time> first_time(PairKind kind, const std::vector<Vector>& points) {
  const Conditions conditions = kind == PairKind::kVertexFace ? of_vertex_and_face(points)
                                : kind == PairKind::kEdgeEdge ? of_edges(points)
                                                              : of_vertex_and_edge(points);
  const Time start{};
  if (conditions.hold_at(start)) return start;
  std::optional<Time> first;
  for (const Form& f : conditions.all_that_decide()) {
    if (is_zero(f)) continue;
    for (const Time& time : zeros_of(f)) {
      if (first && compare(*first, time) <= 0) break;
      if (!conditions.hold_at(time)) continue;
      first = time;
      break;
    }
  }
  return first;
}
template <class Pair>
std::optional<Time> first_time(const Pair& pair) {
  return first_time(pair.kind, moving_points(pair));
}

FirstTouch touch_at(const std::optional<Time>& time) { return {time.has_value(), time ? time->double_below_it() : 0}; }

}  // namespace

template <class Pair>
FirstTouch true_first_touch(const Pair& pair) {
  return touch_at(first_time(pair));
}

template <int D>
FirstTouch true_first_entry(const TurningPair<D>& pair) {
  return touch_at(first_time(pair.kind, moving_points(pair, kShift)));
}

template <class Pair>
int true_compare(const Pair& a, const Pair& b) {
  return compare(first_time(a).value(), first_time(b).value());
}

template <int D>
int true_kept_side(const MovingPair<D>& points) {
  const std::vector<Vector> x = moving_points(points);
  const Vector turn = cross(x[1] - x[0], x[2] - x[0]);
  const Form side = D == 3 ? dot(turn, x[D] - x[0]) : turn[2];
  return sgn(side[0]) == 0 || !zeros_of(side).empty() ? 0 : sgn(side[0]);
}

template FirstTouch true_first_touch(const MovingPair<2>&);
template FirstTouch true_first_touch(const MovingPair<3>&);
template FirstTouch true_first_touch(const TurningPair<2>&);
template FirstTouch true_first_touch(const TurningPair<3>&);
template FirstTouch true_first_entry(const TurningPair<2>&);
template FirstTouch true_first_entry(const TurningPair<3>&);
template int true_compare(const MovingPair<2>&, const MovingPair<2>&);
template int true_compare(const MovingPair<3>&, const MovingPair<3>&);
template int true_compare(const TurningPair<2>&, const TurningPair<2>&);
template int true_compare(const TurningPair<3>&, const TurningPair<3>&);
template int true_kept_side<2>(const MovingPair<2>&);
template int true_kept_side<3>(const MovingPair<3>&);

}  // namespace dsw
