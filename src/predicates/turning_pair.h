// When two features first touch while they turn: each on a rigid motion, on straight ways, or standing. Touching counts, as
// in moving_pair.h. Right for all finite doubles.
//
// On a rigid motion a point x is at R(q(s)) (x - centre) / |q(s)|^2 + c(s) at time s. The quaternion q and the place c of the
// centre go straight and steadily from their starts to their ends, and R(q) is |q|^2 times the rotation of q. So the motion
// is exactly rigid, whatever the lengths of the quaternions are.
#pragma once

#include "predicates/moving_pair.h"

namespace dsw {

// Quaternions are x y z w. In the plane x and y of them and the third coordinates are not read.
struct TurningWay {
  double turn[2][4];
  double centre[3];
  double place[2][3];
};

// Whether the quaternion of a way is never 0 in [0,1].
template <int D>
bool has_turn(const TurningWay& way);

// Features are those of moving_pair.h. Points of a feature with a way have their place in `start` and no `end`; the others
// go from `start` to `end`.
template <int D>
struct TurningPair {
  PairKind kind;
  const double* start[D + 1];
  const double* end[D + 1];
  const TurningWay* way[2];  // of the features, or null
};

// What a caller knows beforehand.
struct Asked {
  double until = 1;      // a touch after this time may be left out
  bool is_near = false;  // features are hardly ever apart along an axis on all of their ways, so this is not looked at
};

template <int D>
FirstTouch first_touch(const TurningPair<D>& pair, PairWork* work = nullptr, const Asked& asked = {});

// When a feature that turns first touches one that stands or goes straight, if the one that turns is shifted: there are no ties then.
// What the shift leaves open counts as a touch. At time 0 it does not count, and is_open is set.
struct FirstEntry {
  FirstTouch touch;
  bool is_open = false;
};
template <int D>
FirstEntry first_entry(const TurningPair<D>& pair, PairWork* work = nullptr, const Asked& asked = {});

template <int D>
int compare_first_touches(const TurningPair<D>& a, const FirstTouch& first_a, const TurningPair<D>& b,
                          const FirstTouch& first_b, PairWork* work = nullptr);

}  // namespace dsw
