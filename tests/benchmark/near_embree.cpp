#include "near_peers.h"

#include "vector.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dsw::bench {

namespace {

Vector along(const Vector& a, double t, const Vector& u) { return {a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2]}; }
double square(const Vector& a) { return dot(a, a); }
double clamped(double t) { return std::min(1.0, std::max(0.0, t)); }

/** Squared distance of segments p + s u and a + t v [Ericson, Real-Time Collision Detection, 5.1.9]. */
double between(const double* p, const Vector& u, const double* a, const Vector& v) {
  const Vector r = minus(p, a);
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const double area = uu * vv - uv * uv;
  double s = area > 0 ? clamped((uv * vr - ur * vv) / area) : 0, t = (uv * s + vr) / vv;
  if (t < 0 || t > 1) {
    t = clamped(t);
    s = uu > 0 ? clamped((uv * t - ur) / uu) : 0;
  }
  return square(along(along(r, s, u), -t, v));
}

/** Squared distance of a segment and a triangle. */
double to_triangle(const double* p, const double* q, const double* a, const double* b, const double* c) {
  const Vector u = minus(q, p), ab = minus(b, a), bc = minus(c, b), ca = minus(a, c), ap = minus(p, a);
  double best = std::min({between(p, u, a, ab), between(p, u, b, bc), between(p, u, c, ca)});
  const Vector n = cross(ab, bc);
  const double nn = dot(n, n), above = dot(n, ap), below = above + dot(n, u);
  const auto is_inside = [&](const Vector& x) {  // as seen from a
    const Vector from_b = {x[0] - ab[0], x[1] - ab[1], x[2] - ab[2]},
                 from_c = {x[0] + ca[0], x[1] + ca[1], x[2] + ca[2]};
    return dot(n, cross(ab, x)) >= 0 && dot(n, cross(bc, from_b)) >= 0 && dot(n, cross(ca, from_c)) >= 0;
  };
  if ((above > 0) != (below > 0)) {
    if (is_inside(along(ap, above / (above - below), u))) return 0;
    return best;
  }
  const double nearer = std::min(above * above, below * below) / nn;
  if (nearer < best && is_inside(above * above < below * below ? ap : along(ap, 1, u))) best = nearer;
  return best;
}

class NearEmbree final : public NearPeer {
 public:
  explicit NearEmbree(const WallMesh& walls) : walls_(walls), device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) throw std::runtime_error("no Embree device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), walls.points->size() / 3));
    std::transform(walls.points->begin(), walls.points->end(), points, [](double x) { return static_cast<float>(x); });
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), walls.triangles.size()));
    for (const auto& triangle : walls.triangles) indices = std::copy(triangle.begin(), triangle.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~NearEmbree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  std::string name() const override { return "embree"; }
  double distance(const double* from, const double* to, double radius) override {
    Question question{&walls_, from, to, 0, radius * radius};
    question.half = 0.5 * std::sqrt(square(minus(to, from)));
    RTCPointQuery query;
    query.x = static_cast<float>(0.5 * (from[0] + to[0]));
    query.y = static_cast<float>(0.5 * (from[1] + to[1]));
    query.z = static_cast<float>(0.5 * (from[2] + to[2]));
    query.time = 0;
    query.radius = static_cast<float>(question.half + radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, measure, &question);
    return question.best < radius * radius ? std::sqrt(question.best) : std::numeric_limits<double>::infinity();
  }

 private:
  struct Question {
    const WallMesh* walls;
    const double *from, *to;
    double half, best;
  };

  static bool measure(RTCPointQueryFunctionArguments* args) {
    Question& question = *static_cast<Question*>(args->userPtr);
    const auto& corner = question.walls->triangles[args->primID];
    const double found = to_triangle(question.from, question.to, question.walls->point(corner[0]),
                                     question.walls->point(corner[1]), question.walls->point(corner[2]));
    if (!(found < question.best)) return false;
    question.best = found;
    args->query->radius = static_cast<float>(question.half + std::sqrt(found));
    return true;
  }

  const WallMesh& walls_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<NearPeer> make_near_embree(const WallMesh& walls) { return std::make_unique<NearEmbree>(walls); }

}  // namespace dsw::bench
