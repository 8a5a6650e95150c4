// In units in which every vertex counts alike, a small motion is a vector of 6 numbers, 3 of which are 0 in the plane, and the
// planes are half-spaces. The point of their intersection that is nearest to a given one is found by the dual active set
// method: planes that are violated enter in the order of their violation, those that pull leave. All is scalar, and in the same
// order everywhere.

#include "response/touched_planes.h"

#include <algorithm>
#include <cmath>

#include "base/search.h"

namespace dsw {
namespace {

constexpr int kSix = 6, kMostPlanes = 12, kMostSteps = 64;
constexpr double kSlack = 0x1p-40, kDependent = 0x1p-30, kLeastPart = 0x1p-16;

struct HalfSpace6 {
  double a[kSix];  // a y >= least
  double least;
};

double dot6(const double* a, const double* b) noexcept {
  double sum = 0;
  for (int k = 0; k < kSix; ++k) sum += a[k] * b[k];
  return sum;
}

/** Finds the nearest point of an intersection of half-spaces. */
class NearestPoint {
 public:
  /** @param scale the square of a length: what is far smaller does not count. */
  NearestPoint(const HalfSpace6* spaces, int count, const double* wanted, double scale) noexcept
      : spaces_(spaces), count_(count), wanted_(wanted) {
    std::copy_n(wanted, kSix, y_);
    slack_ = kSlack * std::sqrt(scale);
  }

  const double* find() noexcept {
    for (int step = 0; step < kMostSteps; ++step) {
      const int worst = find_worst();
      if (worst < 0) break;
      active_[active_count_++] = worst;
      if (!settle()) {
        left_out_[worst] = true;
        remove(worst);
      }
      move();
    }
    return y_;
  }

 private:
  /** The first of those that are violated most, beside those that depend on active ones. */
  int find_worst() const noexcept {
    int worst = -1;
    double most = slack_;
    for (int i = 0; i < count_; ++i) {
      if (left_out_[i] || active_count_ == kSix || is_active(i)) continue;
      const double missing = (spaces_[i].least - dot6(spaces_[i].a, y_)) / std::sqrt(dot6(spaces_[i].a, spaces_[i].a));
      if (missing > most) worst = i, most = missing;
    }
    return worst;
  }
  bool is_active(int i) const noexcept {
    return dsw::find(active_, active_ + active_count_, i) != active_ + active_count_;
  }
  void remove(int i) noexcept {
    int* const end = std::remove(active_, active_ + active_count_, i);
    active_count_ = static_cast<int>(end - active_);
    force_[i] = 0;
  }

  /** Finds forces of the active ones that put the point on all of them; takes away those that would pull. False: the last
   * one depends on the others. */
  bool settle() noexcept {
    while (active_count_ > 0) {
      double forces[kSix];
      if (!solve(forces)) return false;
      double part = 1;
      int first = -1;
      for (int i = 0; i < active_count_; ++i) {
        const double now = force_[active_[i]];
        if (forces[i] > 0 || !(now - forces[i] > 0)) continue;
        if (now / (now - forces[i]) < part) part = now / (now - forces[i]), first = i;
      }
      for (int i = 0; i < active_count_; ++i) {
        double& force = force_[active_[i]];
        force += part * (forces[i] - force);
      }
      if (first < 0) return true;
      remove(active_[first]);
    }
    return true;
  }

  /** By the Cholesky factor of the products of their normals. */
  bool solve(double* x) const noexcept {
    double factor[kSix][kSix];
    for (int i = 0; i < active_count_; ++i) {
      const HalfSpace6& of = spaces_[active_[i]];
      x[i] = of.least - dot6(of.a, wanted_);
      for (int j = 0; j <= i; ++j) {
        double sum = dot6(of.a, spaces_[active_[j]].a);
        const double whole = sum;
        for (int k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
        if (i == j) {
          if (!(sum > kDependent * whole)) return false;
          factor[i][i] = std::sqrt(sum);
        } else {
          factor[i][j] = sum / factor[j][j];
        }
      }
    }
    for (int i = 0; i < active_count_; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= factor[i][k] * x[k];
      x[i] /= factor[i][i];
    }
    for (int i = active_count_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < active_count_; ++k) x[i] -= factor[k][i] * x[k];
      x[i] /= factor[i][i];
    }
    return true;
  }

  void move() noexcept {
    std::copy_n(wanted_, kSix, y_);
    for (int i = 0; i < active_count_; ++i) {
      for (int k = 0; k < kSix; ++k) y_[k] += force_[active_[i]] * spaces_[active_[i]].a[k];
    }
  }

  const HalfSpace6* spaces_;
  int count_;
  const double* wanted_;
  double y_[kSix], slack_;
  double force_[kMostPlanes] = {};
  bool left_out_[kMostPlanes] = {};
  int active_[kSix + 1] = {};
  int active_count_ = 0;
};

}  // namespace

template <int D>
void find_inertia(const Body<D>& body, const Vec& centre, double size, double share, double ball,
                  double (&t)[3][3]) noexcept {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t[i][j] = i == j ? ball : 0;
  }
  for (const BodyVertex<D>& each : body.vertices) {
    if (!each.cell.valid()) continue;
    const Vec d = to_vec<D>(each.position) - centre;
    const double x = d.x() / size, y = d.y() / size, z = d.z() / size;
    t[0][0] += share * (y * y + z * z);
    t[1][1] += share * (z * z + x * x);
    t[2][2] += share * (x * x + y * y);
    t[1][0] -= share * (x * y);
    t[2][1] -= share * (y * z);
    t[2][0] -= share * (z * x);
  }
}

template <int D>
Inertia<D>::Inertia(const Body<D>& body) noexcept : middle(Vec::Zero()), size(0) {
  const double share = 1.0 / static_cast<double>(std::max<size_t>(body.vertex_slots.alive_count(), 1));
  for (const BodyVertex<D>& each : body.vertices) {
    if (each.cell.valid()) middle = middle + share * to_vec<D>(each.position);
  }
  for (const BodyVertex<D>& each : body.vertices) {
    if (each.cell.valid()) size = std::max(size, largest(to_vec<D>(each.position) - middle));
  }
  if (!(size > 0)) size = 1;
  double t[3][3];
  find_inertia(body, middle, size, share, 0x1p-10, t);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) factor[i][j] = 0;
    for (int j = 0; j <= i; ++j) {
      double sum = t[i][j];
      for (int k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
      factor[i][j] = i == j ? std::sqrt(std::max(sum, 0x1p-40)) : sum / factor[j][j];
    }
  }
}

template <int D>
void TouchedPlanes<D>::make_room() noexcept {
  if (count_ < kMost) return;
  std::move(planes_ + 1, planes_ + kMost, planes_);
  --count_;
}

template <int D>
void TouchedPlanes<D>::add(const Vec& normal, const Vec& point) noexcept {
  make_room();
  planes_[count_++] = {normal, point, point};
}

template <int D>
void TouchedPlanes<D>::add_moving(const Vec& normal, const Vec& at, const Vec& point, const Vec& way, double tilt,
                                  double missing) noexcept {
  make_room();
  planes_[count_++] = {normal, at, point, way, tilt, missing, !is_zero(way) || tilt > 0};
}

template <int D>
void TouchedPlanes<D>::follow(const RigidMotion<D>& made) noexcept {
  for (int i = 0; i < count_; ++i) {
    double at[3] = {};
    store<D>(planes_[i].point, at);
    made.place(at, at);
    planes_[i].point = to_vec<D>(at);
  }
}

template <int D>
bool TouchedPlanes<D>::allow(const Inertia<D>& inertia, const Twist& wanted, double off,
                             Twist* allowed) const noexcept {
  const auto& L = inertia.factor;
  double from[kSix];
  for (int k = 0; k < 3; ++k) {
    from[k] = wanted.shift[k] / inertia.size;
    from[3 + k] = 0;
    for (int i = k; i < 3; ++i) from[3 + k] += L[i][k] * wanted.turn[i];
  }
  double whole = dot6(from, from);
  bool any_moves = false;
  for (int i = 0; i < count_; ++i) {
    const double push = dot(planes_[i].normal, planes_[i].way) / inertia.size;
    if (push > 0) whole = std::max(whole, push * push);
    any_moves = any_moves || planes_[i].moves;
  }
  if (!(whole > 0) || !std::isfinite(whole)) return false;
  HalfSpace6 spaces[kMostPlanes];
  double bend = 0;  // of a point at distance 1 from the axis
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < count_; ++i) {
      const Plane& plane = planes_[i];
      const Vec arm = (plane.point - inertia.middle) / inertia.size, moment = arm.cross(plane.normal);
      const double gap = std::max(0.0, dot(plane.normal, plane.point - plane.at));
      HalfSpace6& space = spaces[i];
      for (int k = 0; k < 3; ++k) {
        space.a[k] = plane.normal[k];
        double sum = moment[k];
        for (int j = 0; j < k; ++j) sum -= L[k][j] * space.a[3 + j];
        space.a[3 + k] = sum / L[k][k];
      }
      space.least = (off + plane.missing - gap) / inertia.size + bend * length(arm);
      if (plane.moves) {
        // A point that slides along what turns needs as much more room.
        const Vec shift = round == 0 ? plane.way : allowed->shift + inertia.size * allowed->turn.cross(arm);
        const double turns = plane.tilt + std::sqrt(2 * bend);
        space.least += (dot(plane.normal, plane.way) + turns * length(shift - plane.way)) / inertia.size;
      }
    }
    NearestPoint nearest(spaces, count_, from, whole);
    const double* const y = nearest.find();
    double turn[3];
    for (int k = 2; k >= 0; --k) {
      double sum = y[3 + k];
      for (int i = k + 1; i < 3; ++i) sum -= L[i][k] * turn[i];
      turn[k] = sum / L[k][k];
    }
    if (D == 2) turn[0] = turn[1] = 0;
    allowed->turn = Vec(turn[0], turn[1], turn[2]);
    allowed->shift = Vec(y[0], y[1], y[2]) * inertia.size;
    if (D == 2) allowed->shift[2] = 0;
    bend = 0.5 * dot(allowed->turn, allowed->turn);
    if (round == 1 || (bend == 0 && !any_moves)) return dot6(y, y) > kLeastPart * kLeastPart * whole;
  }
  return false;
}

template void find_inertia(const Body<2>&, const Vec&, double, double, double, double (&)[3][3]) noexcept;
template void find_inertia(const Body<3>&, const Vec&, double, double, double, double (&)[3][3]) noexcept;
template struct Inertia<2>;
template struct Inertia<3>;
template class TouchedPlanes<2>;
template class TouchedPlanes<3>;

}  // namespace dsw
