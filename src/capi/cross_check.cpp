#include "dartsweep/cross_check.h"

#include <algorithm>

#include "capi/convert.h"
#include "cross_check/penetration.h"
#include "cross_check/report.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr double kUnit = 1e-9;  // of the square of a unit normal: more than rounding makes

void check_numbers(const dsw_body_contact& contact) {
  dsw::check_finite({contact.position, 3}, 1, 3, "contact->position");
  dsw::check_finite({contact.fixed[0], 3}, 1, 3, "contact->fixed[0]");
  dsw::check_finite({contact.fixed[1], 3}, 1, 3, "contact->fixed[1]");
  dsw::check_finite({contact.point, 3}, 1, 3, "contact->point");
  dsw::check_finite({contact.contact.normal, 3}, 1, 3, "contact->contact.normal");
  const double* const n = contact.contact.normal;
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  if (!(square > 1 - kUnit && square < 1 + kUnit)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "contact->contact.normal (%g, %g, %g) is not of length 1", n[0], n[1], n[2]);
  }
}

/** The wall as it is seen from in front. */
dsw::HalfFacet to_wall(const dsw::Map<3>& map, const dsw_body_contact& contact) {
  const dsw::HalfFacet given = capi::to_engine(map, contact.contact.wall, "contact->contact.wall");
  const dsw::Cell front = capi::to_engine(map, contact.contact.front, "contact->contact.front");
  if (map.cell_of(given) == front) return given;
  const dsw::HalfFacet other = map.opposite(given);
  if (other.valid() && map.cell_of(other) == front) return other;
  fail(DSW_STATUS_NOT_FOUND,
       "contact->contact.front (volume %u) is not at contact->contact.wall (face %u of volume %u)",
       contact.contact.front.index, contact.contact.wall.local, contact.contact.wall.volume);
}

/** The wall of a touched vertex, which is one of several there: `front` may be at another. Seen from a passable side.
 * */
dsw::HalfFacet to_wall_at_vertex(const dsw::Map<3>& map, const dsw_body_contact& contact) {
  const dsw::HalfFacet given = capi::to_engine(map, contact.contact.wall, "contact->contact.wall");
  const dsw::Cell front = capi::to_engine(map, contact.contact.front, "contact->contact.front");
  const dsw::HalfFacet other = map.opposite(given);
  if (!other.valid() || map.cell_of(given) == front) return given;
  return map.cell_of(other) == front || map.marked(map.cell_of(given)) ? other : given;
}

void require_obstacle(const dsw_body_contact& contact, dsw_cell_kind kind) {
  if (contact.contact.obstacle.kind != kind)
    capi::fail_kind("contact->contact.obstacle.kind", contact.contact.obstacle.kind, 3);
}

bool has_wall(const dsw_body_contact& contact) {
  return (contact.contact.wall.volume | contact.contact.wall.generation | contact.contact.wall.local) != 0;
}

dsw::ReportedTouch to_touch(const dsw::Map<3>& map, const dsw_body_contact& contact) {
  if (!has_wall(contact) && contact.contact.obstacle.kind == DSW_CELL_NONE) {
    fail(DSW_STATUS_UNSUPPORTED, "contact->contact.obstacle is null: two bodies touch");
  }
  dsw::ReportedTouch touch{};
  touch.position = contact.position;
  touch.fixed = contact.fixed[0];
  touch.point = contact.point;
  touch.normal = contact.contact.normal;
  const dsw_cell& cell = contact.contact.obstacle;
  switch (contact.contact.kind) {
    case DSW_CONTACT_PLANE:
      touch.kind =
          (contact.edge.index | contact.edge.generation) != 0 ? dsw::TouchKind::kDiagonal : dsw::TouchKind::kPoint;
      touch.wall = to_wall(map, contact);
      break;
    case DSW_CONTACT_EDGE:
      require_obstacle(contact, DSW_CELL_EDGE);
      touch.kind = dsw::TouchKind::kEdge;
      touch.edge =
          capi::to_engine(map, dsw_edge_id{cell.index, cell.generation, cell.local}, "contact->contact.obstacle");
      break;
    case DSW_CONTACT_VERTEX:
      require_obstacle(contact, DSW_CELL_VERTEX);
      touch.kind = dsw::TouchKind::kCorner;
      touch.vertex = capi::to_engine(map, dsw_vertex_id{cell.index, cell.generation}, "contact->contact.obstacle");
      if (has_wall(contact)) touch.wall = to_wall_at_vertex(map, contact);
      break;
    default:
      fail(DSW_STATUS_UNSUPPORTED, "contact->contact.kind is %d, must be a plane, an edge or a vertex",
           static_cast<int>(contact.contact.kind));
  }
  return touch;
}

}  // namespace

dsw_status dsw_environment_cross_check(const dsw_environment* environment, const dsw_body_contact* contact,
                                       dsw_cross_check* result) {
  return capi::guard(__func__, [&] {
    const dsw::Environment<3>& env = capi::space(capi::check_handle(environment));
    dsw::require(contact, "contact");
    dsw::require(result, "result");
    check_numbers(*contact);
    const dsw::ReportedTouch touch = to_touch(env.map, *contact);
    dsw::require_libccd();
    *result = cross_check_of(env, touch, has_wall(*contact));
  });
}
