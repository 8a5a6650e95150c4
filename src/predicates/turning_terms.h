// What says whether a pair that turns touches, in numbers of any kind: doubles for filters, integers, polynomials in time.
// Private to this folder.
//
// One feature, A, turns. The other one, B, moves on straight ways, or turns as well: then all is seen from B, which stands.
// Seen so, a point x of A, counted from its centre, is at (R x + P) / n. For one turn R = R(q), n = |q|^2 and P = n c. For
// two turns R = R(r) with r = conj(q_B) q_A, n = |q_A|^2 |q_B|^2, and P = |q_A|^2 R(q_B)^T (c_A - c_B).
//
// The cross product of two turned vectors is |q|^2 times the turned cross product. So powers of n divide out wherever two
// points of A meet; what is written below is divided already. Edges are differences of points as they are given, since
// doubles lose digits where the centre is far. It is of degree 3 in time where A turns and B stands, and of
// degree 5 at most else. Areas and volumes are seen from one side or the other and have positive factors: only their signs,
// and for volumes their zeros, mean something.
#pragma once

#include "predicates/turning_pair.h"

namespace dsw {
namespace turning {

template <class T, int D>
struct Row {
  T at[D];
};

template <class T, int D>
struct Quaternion {
  T v[D == 3 ? 3 : 1];
  T w;
};

template <class A, class B, int D>
auto operator-(const Row<A, D>& a, const Row<B, D>& b) {
  Row<decltype(a.at[0] - b.at[0]), D> r;
  for (int k = 0; k < D; ++k) r.at[k] = a.at[k] - b.at[k];
  return r;
}
template <class A, class B, int D>
auto operator+(const Row<A, D>& a, const Row<B, D>& b) {
  Row<decltype(a.at[0] + b.at[0]), D> r;
  for (int k = 0; k < D; ++k) r.at[k] = a.at[k] + b.at[k];
  return r;
}
template <class A, class B, int D>
auto operator*(const A& a, const Row<B, D>& b) {
  Row<decltype(a * b.at[0]), D> r;
  for (int k = 0; k < D; ++k) r.at[k] = a * b.at[k];
  return r;
}

template <class A, class B, int D>
auto dot(const Row<A, D>& a, const Row<B, D>& b) {
  if constexpr (D == 3) {
    return (a.at[0] * b.at[0] + a.at[1] * b.at[1]) + a.at[2] * b.at[2];
  } else {
    return a.at[0] * b.at[0] + a.at[1] * b.at[1];
  }
}

// One component of a cross product; in the plane there is only one.
template <class A, class B, int D>
auto cross(int k, const Row<A, D>& a, const Row<B, D>& b) {
  const int x = D == 3 ? (k + 1) % 3 : 0, y = D == 3 ? (k + 2) % 3 : 1;
  return a.at[x] * b.at[y] - a.at[y] * b.at[x];
}
template <class A, class B>
auto cross(const Row<A, 3>& a, const Row<B, 3>& b) {
  return Row<decltype(cross(0, a, b)), 3>{{cross(0, a, b), cross(1, a, b), cross(2, a, b)}};
}

// |q|^2 times the rotation of q, and |q|^2.
template <class T, int D>
struct Turn {
  Row<T, D> row[D];
  T n;

  template <class A>
  auto of(const Row<A, D>& a) const {
    Row<decltype(dot(row[0], a)), D> r;
    for (int k = 0; k < D; ++k) r.at[k] = dot(row[k], a);
    return r;
  }
  Turn back() const {
    Turn r = *this;
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) r.row[i].at[k] = row[k].at[i];
    }
    return r;
  }
};

template <class Q, int D>
auto turn_of(const Quaternion<Q, D>& q) {
  using T = decltype(q.w * q.w);
  const T ww = q.w * q.w;
  if constexpr (D == 2) {
    const T zz = q.v[0] * q.v[0], zw = q.v[0] * q.w, sine = zw + zw, cosine = ww - zz;
    return Turn<T, 2>{{{{cosine, T{} - sine}}, {{sine, cosine}}}, ww + zz};
  } else {
    const T xx = q.v[0] * q.v[0], yy = q.v[1] * q.v[1], zz = q.v[2] * q.v[2];
    const T xy = q.v[0] * q.v[1], xz = q.v[0] * q.v[2], yz = q.v[1] * q.v[2];
    const T xw = q.v[0] * q.w, yw = q.v[1] * q.w, zw = q.v[2] * q.w;
    const auto twice = [](const T& a) { return a + a; };
    const T first = ww + xx, second = ww - xx, third = yy + zz, fourth = yy - zz;
    return Turn<T, 3>{{{{first - third, twice(xy - zw), twice(xz + yw)}},
                       {{twice(xy + zw), second + fourth, twice(yz - xw)}},
                       {{twice(xz - yw), twice(yz + xw), second - fourth}}},
                      first + third};
  }
}

// conj(b) a.
template <class Q, int D>
auto quotient(const Quaternion<Q, D>& a, const Quaternion<Q, D>& b) {
  using T = decltype(a.w * b.w);
  if constexpr (D == 2) {
    return Quaternion<T, 2>{{b.w * a.v[0] - b.v[0] * a.w}, b.w * a.w + b.v[0] * a.v[0]};
  } else {
    const auto part = [&](int x, int y, int z) {
      return (b.w * a.v[x] - b.v[x] * a.w) - (b.v[y] * a.v[z] - b.v[z] * a.v[y]);
    };
    return Quaternion<T, 3>{{part(0, 1, 2), part(1, 2, 0), part(2, 0, 1)},
                            (b.w * a.w + b.v[0] * a.v[0]) + (b.v[1] * a.v[1] + b.v[2] * a.v[2])};
  }
}

// Numbers: Q of quaternions, X of points of features that turn, Y of the others, C of the places of centres, Value for
// areas and volumes.

// B goes straight.
template <int D, class Numbers>
struct OneTurn {
  static constexpr bool kTwo = false;
  using Value = typename Numbers::Value;
  using Q = typename Numbers::Q;
  using T = decltype(Q{} * Q{});

  Row<typename Numbers::X, D> a[3], given_a[3];  // points of A less its centre, and as they are given
  Row<typename Numbers::Y, D> given_b[3];        // points of B
  Row<typename Numbers::C, D> offset[3];         // the place of A's centre less the points of B
  Turn<T, D> turn;

  void set_turn(const Quaternion<Q, D>& q) { turn = turn_of(q); }

  // From point j of B to point i of A.
  auto way(int i, int j) const { return turn.of(a[i]) + turn.n * offset[j]; }

  // Twice the area on the edge u of A, which begins at x, and point j of B. `k` is the view.
  template <class U>
  auto area(int k, const U& u, const U& x, int j) const {
    const auto moved = cross(k, turn.of(u), offset[j]);
    if constexpr (D == 3) {
      return dot(turn.row[k], cross(u, x)) + moved;
    } else {
      return turn.n * cross(0, u, x) + moved;
    }
  }
};

// B turns, and all is seen from it.
template <int D, class Numbers>
struct TwoTurns {
  static constexpr bool kTwo = true;
  using Value = typename Numbers::Value;
  using Q = typename Numbers::Q;
  using X = typename Numbers::X;
  using C = typename Numbers::C;
  using T = decltype(Q{} * Q{});
  using R = decltype(T{} * T{});

  Row<X, D> a[3], given_a[3], b[3], given_b[3];  // points less their centre, and as they are given
  Row<C, D> between;                             // the place of A's centre less that of B's
  Turn<T, D> of_a, back_of_b;
  Turn<R, D> turn;
  Row<decltype(T{} * (T{} * C{})), D> place;  // P

  void set_turns(const Quaternion<Q, D>& q_a, const Quaternion<Q, D>& q_b) {
    of_a = turn_of(q_a);
    back_of_b = turn_of(q_b).back();
    turn = turn_of(quotient(q_a, q_b));
    turn.n = of_a.n * back_of_b.n;
    place = of_a.n * back_of_b.of(between);
  }

  auto way(int i, int j) const { return (turn.of(a[i]) + place) - turn.n * b[j]; }

  // In space only.
  template <class U>
  auto area(int k, const U& u, const U& x, int j) const {
    static_assert(D == 3, "in the plane B has the edge");
    const auto moved = dot(back_of_b.row[k], cross(of_a.of(u), between));
    return (dot(turn.row[k], cross(u, x)) + moved) - cross(k, turn.of(u), b[j]);
  }
};

// A pair in such terms. A is the first feature, or the second.
template <int D, class Terms>
struct Pair : Terms {
  using Value = typename Terms::Value;

  PairKind kind;
  bool a_is_first;

  int first_count() const noexcept { return kind == PairKind::kEdgeEdge ? 2 : 1; }
  bool is_of_a(int point) const noexcept { return (point < first_count()) == a_is_first; }
  int at(int point) const noexcept { return point < first_count() ? point : point - first_count(); }

  // Along one axis, from point i to point j, or from j to i, but always from B to A.
  auto way_between(int i, int j) const { return is_of_a(i) ? this->way(at(i), at(j)) : this->way(at(j), at(i)); }

  // Twice the area of three points, seen along axis k; in the plane k is 0.
  Value area_of(int k, int i, int j, int l) const {
    // The first two become those of one feature.
    if (is_of_a(i) != is_of_a(j)) {
      const int first = i;
      if (is_of_a(j) == is_of_a(l)) {
        i = j;
        j = l;
        l = first;
      } else {
        i = l;
        l = j;
        j = first;
      }
    }
    const bool mixed = is_of_a(i) != is_of_a(l);
    const int p = at(i), q = at(j), r = at(l);
    if (is_of_a(i)) {
      const auto u = this->given_a[q] - this->given_a[p];
      if constexpr (D == 3 || !Terms::kTwo) {
        if (mixed) return Value{} - Value(this->area(k, u, this->a[p], r));
      }
      if constexpr (D == 3 && !Terms::kTwo)
        return Value(dot(this->turn.row[k], cross(u, this->given_a[r] - this->given_a[p])));
      return Value{};  // never asked for: with two turns, B has the face or the edge of the plane
    }
    const auto v = this->given_b[q] - this->given_b[p];
    if (mixed) return Value(cross(k, v, this->way(r, p)));
    return Value(cross(k, v, this->given_b[r] - this->given_b[p]));
  }

  // Six times the volume of all points of a pair in space, or its negative.
  Value volume() const {
    if (kind == PairKind::kEdgeEdge) {
      const auto u = this->given_a[1] - this->given_a[0];
      const auto part = [&](int k) { return this->area(k, u, this->a[0], 0); };
      const Row<decltype(part(0)), 3> normal{{part(0), part(1), part(2)}};
      return Value(dot(this->given_b[1] - this->given_b[0], normal));
    }
    if (a_is_first)
      return Value(
          dot(cross(this->given_b[1] - this->given_b[0], this->given_b[2] - this->given_b[0]), this->way(0, 0)));
    if constexpr (!Terms::kTwo) {
      const auto normal = cross(this->given_a[1] - this->given_a[0], this->given_a[2] - this->given_a[0]);
      return Value(this->turn.n * dot(normal, this->a[0]) + dot(this->turn.of(normal), this->offset[0]));
    }
    return Value{};  // never asked for: with two turns, B has the face
  }
};

}  // namespace turning
}  // namespace dsw
