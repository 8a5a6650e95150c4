#include "contact_response.h"

#include <algorithm>

#include "library.h"

namespace physics {
namespace {

// Where in a triangle with corners a, b, c a point of it is.
void find_shares(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point, double* share) {
  const Vector3 u = b - a, v = c - a, w = point - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double determinant = uu * vv - uv * uv;
  const double s = determinant > 0 ? (wu * vv - wv * uv) / determinant : 0;
  const double t = determinant > 0 ? (wv * uu - wu * uv) / determinant : 0;
  share[1] = std::clamp(s, 0.0, 1.0);
  share[2] = std::clamp(t, 0.0, 1.0 - share[1]);
  share[0] = 1 - share[1] - share[2];
}

Vector3 velocity_of(const Touch& touch, const Points& points) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < touch.count; ++k) {
    sum += touch.share[k] * points.velocity[touch.point[k]];
  }
  return sum;
}

double inverse_mass_of(const Touch& touch, const Points& points) {
  double sum = 0;
  for (int k = 0; k < touch.count; ++k) {
    sum += touch.share[k] * touch.share[k] * points.inverse_mass(touch.point[k]);
  }
  return sum;
}

void push(const Touch& touch, const Vector3& impulse, Points* points) {
  for (int k = 0; k < touch.count; ++k) {
    points->velocity[touch.point[k]] += touch.share[k] * points->inverse_mass(touch.point[k]) * impulse;
  }
}

// The ends of what touched, the moving vertex first.
void read_ends(const dsw_scene* scene, dsw_body_id body, const dsw_body_contact& contact, const Points& points,
               Touch* touch) {
  dsw_body_vertex_id ends[3];
  if (contact.edge.generation != 0 && dsw_body_get_edge_ends(scene, body, contact.edge, ends) == DSW_STATUS_OK) {
    const bool first = ends[0].index == contact.vertex.index;
    if (first || ends[1].index == contact.vertex.index) {
      touch->count = 2;
      touch->point[1] = ends[first ? 1 : 0].index;
      touch->share[0] = 1 - contact.edge_parameter;
      touch->share[1] = contact.edge_parameter;
    }
  }
  if (contact.face.generation != 0 && dsw_body_get_face_corners(scene, body, contact.face, ends) == DSW_STATUS_OK) {
    const int moving = static_cast<int>(
        std::find_if(ends, ends + 3, [&](const dsw_body_vertex_id& end) { return end.index == contact.vertex.index; }) -
        ends);
    if (moving < 3) {
      touch->count = 3;
      touch->point[1] = ends[(moving + 1) % 3].index;
      touch->point[2] = ends[(moving + 2) % 3].index;
      find_shares(Eigen::Map<const Vector3>(contact.position), points.position[touch->point[1]],
                  points.position[touch->point[2]], touch->at, touch->share);
    }
  }
}

}  // namespace

std::vector<Touch> read_touches(const dsw_scene* scene, dsw_body_id body, const Points& points,
                                const Friction& friction) {
  const dsw_body_contact* contacts = nullptr;
  std::size_t count = 0;
  check(dsw_body_get_contacts(scene, body, &contacts, &count), "reading contacts");
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < count; ++i) {
    const dsw_body_contact& contact = contacts[i];
    dsw_body_vertex_id now;
    if (dsw_body_get_vertex_id(scene, body, contact.vertex.index, &now) != DSW_STATUS_OK ||
        now.generation != contact.vertex.generation) {
      continue;
    }
    Touch touch;
    touch.contact = i;
    touch.point[0] = contact.vertex.index;
    touch.normal = Eigen::Map<const Vector3>(contact.contact.normal);
    touch.at = Eigen::Map<const Vector3>(contact.point);
    touch.friction = friction.of(contact.contact.tag);
    touch.wall = contact.contact.wall;
    read_ends(scene, body, contact, points, &touch);
    touches.push_back(touch);
  }
  return touches;
}

void resolve(double restitution, int rounds, std::vector<Touch>* touches, Points* points) {
  std::vector<double> bounce, pushed(touches->size(), 0);
  std::vector<Vector3> rubbed(touches->size(), Vector3::Zero());
  for (const Touch& touch : *touches) {
    bounce.push_back(-restitution * std::min(0.0, velocity_of(touch, *points).dot(touch.normal)));
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < touches->size(); ++i) {
      const Touch& touch = (*touches)[i];
      const double w = inverse_mass_of(touch, *points);
      if (w == 0) {
        continue;  // all of it is held
      }
      const double speed = velocity_of(touch, *points).dot(touch.normal);
      const double sum = std::max(0.0, pushed[i] + (bounce[i] - speed) / w);
      push(touch, (sum - pushed[i]) * touch.normal, points);
      pushed[i] = sum;

      const Vector3 velocity = velocity_of(touch, *points);
      const Vector3 along = velocity - velocity.dot(touch.normal) * touch.normal;
      Vector3 wanted = rubbed[i] - along / w;
      const double most = touch.friction * pushed[i], length = wanted.norm();
      if (length > most) {
        wanted *= most / length;
      }
      push(touch, wanted - rubbed[i], points);
      rubbed[i] = wanted;
    }
  }
  for (std::size_t i = 0; i < touches->size(); ++i) {
    (*touches)[i].impulse = pushed[i] * (*touches)[i].normal + rubbed[i];
  }
}

}  // namespace physics
