#include "cases.h"

#include <cfloat>
#include <cmath>

namespace dsw {

namespace {

template <int D>
void fill_integers(Random& random, int range, int count, PointSet<D>& points) {
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < D; ++k) points.x[i][k] = random.between(-range, range);
  }
}

// Puts points into the plane (line) of the first D, by small integer combinations; exact for integers.
template <int D>
void flatten(Random& random, int first, int count, PointSet<D>& points) {
  for (int i = first; i < count; ++i) {
    double moved[D];
    for (int k = 0; k < D; ++k) moved[k] = points.x[0][k];
    for (int j = 1; j < D; ++j) {
      const int factor = random.between(-2, 3);
      for (int k = 0; k < D; ++k) moved[k] += factor * (points.x[j][k] - points.x[0][k]);
    }
    for (int k = 0; k < D; ++k) points.x[i][k] = moved[k];
  }
}

template <int D>
void nudge(Random& random, int count, PointSet<D>& points) {
  double& x = points.x[random.below(count)][random.below(D)];
  x = std::nextafter(x, random.below(2) != 0 ? DBL_MAX : -DBL_MAX);
}

double any_double(Random& random) {
  if (random.below(16) == 0) return 0;
  if (random.below(64) == 0) return random.below(2) != 0 ? DBL_MAX : -DBL_TRUE_MIN;
  return std::ldexp(random.uniform(), random.between(-1074, 1023));
}

template <int D>
void draw_shape(Random& random, Shape shape, int count, PointSet<D>& points) {
  switch (shape) {
    case Shape::kLattice:
      fill_integers(random, random.below(2) != 0 ? 1 : 3, count, points);
      break;
    case Shape::kCoplanar:
    case Shape::kNudged:
      fill_integers(random, 1 << random.between(2, 20), count, points);
      flatten(random, random.between(D, count - 1), count, points);
      if (shape == Shape::kNudged) nudge(random, count, points);
      break;
    case Shape::kShared:
      for (int i = 0; i < count; ++i) {
        for (int k = 0; k < D; ++k) points.x[i][k] = random.uniform();
      }
      for (int i = 0; i < 2; ++i) {
        const int from = random.below(count);
        const int to = random.below(count);
        for (int k = 0; k < D; ++k) points.x[to][k] = points.x[from][k];
      }
      break;
    case Shape::kMixed: {
      const int spread = random.between(1, 120);
      for (int i = 0; i < count; ++i) {
        for (int k = 0; k < D; ++k) points.x[i][k] = std::ldexp(random.uniform(), random.between(-spread, 0));
      }
      break;
    }
    case Shape::kConcurrent:
      // Points 0 and 1 are a flight; the simplices that start at 2 and 2 + D have a corner on it.
      fill_integers(random, 1 << random.between(1, 12), count, points);
      for (int i = 2; i < count; i += D) {
        const int factor = random.below(3);
        for (int k = 0; k < D; ++k) points.x[i][k] = points.x[0][k] + factor * (points.x[1][k] - points.x[0][k]);
      }
      if (random.below(4) == 0) nudge(random, count, points);
      break;
    case Shape::kSliver:
      for (int i = 0; i < count; ++i) {
        const double along = random.uniform();
        for (int k = 0; k < D; ++k) points.x[i][k] = along * (k + 1) + 1e-12 * random.uniform();
      }
      break;
    case Shape::kUniform:
    case Shape::kCount:
      for (int i = 0; i < count; ++i) {
        for (int k = 0; k < D; ++k) points.x[i][k] = random.uniform();
      }
      break;
  }
}

}  // namespace

template <int D>
void draw(Random& random, Shape shape, Scale scale, int count, PointSet<D>& points) {
  draw_shape(random, shape, count, points);
  // Powers of two keep what was exactly flat flat; tenths do not.
  int exponent[D];
  double offset = 0;
  int flat = -1;
  for (int k = 0; k < D; ++k) exponent[k] = 0;
  switch (scale) {
    case Scale::kHundred:
      for (int k = 0; k < D; ++k) exponent[k] = random.below(2) != 0 ? 332 : -332;
      if (random.below(2) != 0) {
        for (int k = 1; k < D; ++k) exponent[k] = exponent[0];
      }
      break;
    case Scale::kThreeHundred: {
      const int e = random.below(2) != 0 ? 997 : -997;
      for (int k = 0; k < D; ++k) exponent[k] = e;
      break;
    }
    case Scale::kDenormal:
      for (int k = 0; k < D; ++k) exponent[k] = -1074 + random.below(3);
      break;
    case Scale::kOffset:
      offset = 0x1p27;
      for (int k = 0; k < D; ++k) exponent[k] = -random.between(5, 24);
      break;
    case Scale::kFlatAxis:
      flat = random.below(D);
      break;
    case Scale::kPerAxis:
      for (int k = 0; k < D; ++k) exponent[k] = random.between(-1000, 1000);
      break;
    case Scale::kOne:
    case Scale::kTenths:
    case Scale::kCount:
      break;
  }
  const double tenth = scale == Scale::kTenths ? 0.1 : 1;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < D; ++k) {
      double x = std::ldexp(points.x[i][k] * tenth, exponent[k]) + offset;
      if (k == flat) x = 0.3;
      points.x[i][k] = x;
    }
  }
}

template <int D>
void draw(Random& random, int count, PointSet<D>& points) {
  if (random.below(16) == 0) {
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < D; ++k) points.x[i][k] = any_double(random);
    }
    return;
  }
  const Shape shape = static_cast<Shape>(random.below(static_cast<int>(Shape::kCount)));
  const Scale scale = static_cast<Scale>(random.below(static_cast<int>(Scale::kCount)));
  draw(random, shape, scale, count, points);
}

template void draw<2>(Random&, Shape, Scale, int, PointSet<2>&);
template void draw<3>(Random&, Shape, Scale, int, PointSet<3>&);
template void draw<2>(Random&, int, PointSet<2>&);
template void draw<3>(Random&, int, PointSet<3>&);

}  // namespace dsw
