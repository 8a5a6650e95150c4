#include "walls/end_repair.h"

#include "base/points.h"
#include "contact/names.h"
#include "environment/moving.h"
#include "predicates/plane_hit.h"
#include "response/insertion.h"
#include "walk/move.h"
#include "walk/standard_facets.h"
#include "walls/describe.h"

namespace dsw {
namespace {

constexpr int kMostRounds = 8, kMostLifts = 14, kMoreLifts = 5;
constexpr uint32_t kMostBends = 64;  // of one body
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/** A little more than a way, for what rounding and turning take of it. */
template <int D>
Vec with_room(const Vec& way, const Vec& normal, const double* at) noexcept {
  return way + (length(way) * 0x1p-10 + 8 * kEpsilon * largest_coordinate<D>(at)) * normal;
}

/** The part of a vector across a line of unit direction. */
Vec across(const Vec& a, const Vec& line) noexcept { return a - dot(a, line) * line; }

}  // namespace

template <int D>
EndRepair<D>::EndRepair(const Environment<D>& env, Occupants<D>& all)
    : env_(env), all_(all), probe_(env, Obstacle::kCells) {}

template <int D>
bool EndRepair<D>::move(uint32_t owner, const Feature* struck, size_t count, WallRecord& record) {
  Body<D>& body = *all_.bodies[owner].body;
  keep_shape(body);
  const size_t vertices = body.vertices.size();
  starts_.resize(D * vertices);
  cells_.resize(vertices);
  for (uint32_t v = 0; v < vertices; ++v) {
    std::copy_n(body.position(v), D, &starts_[D * size_t{v}]);
    cells_[v] = body.vertices[v].cell;
  }
  for (size_t i = 0; i < count; ++i) {
    admits_with_centre(env_, cells_[struck[i].index], &starts_[D * size_t{struck[i].index}]);
  }
  for (int round = 0; round < kMostRounds; ++round) {
    Way way;
    const Look found = look(owner, &way);
    if (found != Look::kStruck) return found == Look::kFree;
    if (edge_ != kNone && round == 0) add_contact(owner, edge_, way, DSW_WALL_PUSH, record);
    const RigidPushes<D> pushes(body, way.at, way.normal, with_room<D>(way.way, way.normal, way.at), false);
    bool moved = false;
    for (int k = 0; k < RigidPushes<D>::kCount; ++k) {
      RigidMotion<D> motion;
      if (!pushes.get(k, motion) || !find_places(body, motion, places_)) continue;
      put(body, motion);
      moved = true;
      Way next;
      if (look(owner, &next) != Look::kFree) continue;
      record.pushed += static_cast<uint32_t>(body.vertex_slots.alive_count());
      return true;
    }
    if (!moved) return false;
  }
  return false;
}

template <int D>
void EndRepair<D>::put(Body<D>& body, const RigidMotion<D>& moved) noexcept {
  body.shape[0].moved = moved;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) put_vertex(body, v, &places_[D * size_t{v}], body.vertices[v].cell);
  }
}

/** Finds the cells of a body's vertices; or of those that lie beyond a wall the one that has farthest to go, or the
 * first edge that is not free. */
template <int D>
typename EndRepair<D>::Look EndRepair<D>::look(uint32_t owner, Way* way) {
  Body<D>& body = *all_.bodies[owner].body;
  edge_ = kNone;
  double farthest = -1;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    const CastRequest request{&starts_[D * size_t{v}], body.position(v), cells_[v]};
    const CastResult flight = cast(env_, request, nullptr);
    if (flight.end == CastEnd::kReached) {
      put_vertex(body, v, body.position(v), flight.cell);
      continue;
    }
    const MoveResult<D> before = finish_move(env_, request, flight, true, nullptr);
    const Vec back = difference<D>(before.position, body.position(v));
    if (!(length(back) > farthest)) continue;
    farthest = length(back);
    std::copy_n(body.position(v), D, way->at);
    // Out of the wall: no further than to its plane.
    const Vec normal = to_vec<D>(before.normal);
    way->normal = normal;
    way->way = dot(back, normal) * normal;
    if (is_zero(normal)) way->normal = unit(back), way->way = back;
  }
  if (farthest >= 0) return Look::kStruck;
  for (uint32_t e = 0; covers_edges(body.level) && e < body.edges.size(); ++e) {
    if (!body.has_edge(e) || !find_way(body, e, way)) continue;
    edge_ = e;
    return way->wall.valid() ? Look::kStruck : Look::kStuck;
  }
  const auto stop = [](uint32_t, uint32_t) { return false; };
  const bool free =
      probe_.is_free(body, {}) && (all_.partners == nullptr || is_body_apart(*all_.partners, body, body.level, stop));
  return free ? Look::kFree : Look::kStuck;
}

/** Adds up the normals of two walls, and how their corners have gone from `start`. False: there are not two. */
template <int D>
static bool add_walls(const Environment<D>& env, const double* start, const CastResult (&met)[2], Vec& normal,
                      Vec& motion) noexcept {
  for (const CastResult& each : met) {
    if (each.end != CastEnd::kHit) return false;
    const double* wall[D];
    boundary_points(env, each.cell, each.simplex, wall);
    double n[D];
    unit_normal<D>(wall, n);
    normal = normal - to_vec<D>(n);
    for (const double* const corner : wall) motion = motion + difference<D>(corner, start + (corner - env.points));
  }
  return true;
}

/** Whether an edge is not free; then how far which of its points has to move to pass what it meets: in the sense of the
 * normals of the walls that are met from both ends, or if these are opposite in that of the wall's motion. No wall:
 * that is not known. */
template <int D>
bool EndRepair<D>::find_way(const Body<D>& body, uint32_t edge, Way* way) const {
  const uint32_t(&ends)[2] = body.edges[edge].ends;
  const BodyVertex<D>*const p = &body.vertices[ends[0]], *const q = &body.vertices[ends[1]];
  way->wall = {};
  const CastResult met[2] = {cast(env_, p->position, q->position, p->cell),
                             cast(env_, q->position, p->position, q->cell)};
  if (met[0].end == CastEnd::kReached && met[0].cell == q->cell) return false;
  Vec normal, motion;
  if (!add_walls(env_, start_, met, normal, motion)) return true;
  const Vec line = unit(difference<D>(q->position, p->position));
  normal = across(normal, line);
  // If the normals are opposite but for rounding, nothing meaningful is left of their sum.
  if (!(length(normal) > 0x1p-20)) normal = across(unit(motion), line);
  normal = unit(normal);
  if (is_zero(normal)) return true;
  const Vec side_normal = line.cross(normal);
  const double size = length(difference<D>(q->position, p->position));
  double height = 0, along = -1;
  const auto consider = [&](const Vec& at) {  // from p
    const double share = dot(at, line) / size, h = dot(at, normal);
    if (!(share > 0 && share < 1) || !(h > height)) return;
    height = h;
    along = share;
  };
  for (const CastResult& each : met) {
    const Shape shape = env_.map.shape(each.cell);
    const double *first = nullptr, *last = nullptr;
    const auto pass = [&](const double* from, const double* to) {
      // Where a side of the wall passes the plane in which the edge moves.
      const Vec a = difference<D>(from, p->position), b = difference<D>(to, p->position);
      const double at_a = dot(a, side_normal), at_b = dot(b, side_normal);
      if (((at_a <= 0 && at_b >= 0) || (at_a >= 0 && at_b <= 0)) && at_a != at_b) {
        consider(a + at_a / (at_a - at_b) * (b - a));
      }
    };
    for_each_facet_vertex<D>(shape, env_.map.local_of(each.facet, each.cell), [&](uint32_t local) {
      const double* const at = env_.point(each.cell, local);
      if (D == 2) consider(difference<D>(at, p->position));
      if (D == 3 && last != nullptr) pass(last, at);
      if (first == nullptr) first = at;
      last = at;
    });
    if (D == 3 && first != last) pass(last, first);
  }
  if (!(along > 0)) return true;
  point_at<D>(p->position, q->position, along, way->at);
  way->normal = normal;
  way->way = height * normal;
  way->along = along;
  way->wall = met[0].facet;
  return true;
}

template <int D>
void EndRepair<D>::bend(uint32_t owner, double min_part, WallRecord& record) {
  Body<D>& body = *all_.bodies[owner].body;
  if (!covers_edges(body.level)) return;
  uint32_t bends = 0, before = 0;
  // The new edges may have numbers that were looked at already: once more then.
  for (uint32_t e = 0; e < body.edges.size() || bends != before; ++e) {
    if (e == body.edges.size()) {
      e = 0;
      before = bends;
    }
    Way way;
    while (bends < kMostBends && body.has_edge(e) && find_way(body, e, &way) && way.wall.valid()) {
      if (!(way.along >= min_part && way.along <= 1 - min_part)) break;
      const uint32_t(&ends)[2] = body.edges[e].ends;
      double lift = kEpsilon * largest_coordinate<D>(way.at), point[D];
      Cell cell;
      const double height = length(way.way);
      // First for what was rounded off, then for walls that rise farther than those that were met.
      for (int tries = 0; tries < kMostLifts + kMoreLifts && !cell.valid(); ++tries) {
        lift = tries < kMostLifts ? 4 * lift : height / (1 << (kMostLifts + kMoreLifts - tries));
        store<D>(to_vec<D>(way.at) + way.way + lift * way.normal, point);
        if (!is_finite<D>(point)) break;
        // One of the parts is free then; the other is looked at like any edge.
        for (const uint32_t end : ends) {
          const CastResult there = cast(env_, body.position(end), point, body.vertices[end].cell);
          if (there.end == CastEnd::kReached) cell = there.cell;
        }
      }
      if (!cell.valid()) break;
      MoveRecord& edits = *all_.bodies[owner].record;
      reserve_more(edits.edits, 1);
      reserve_more(body.inserted, 1);
      reserve_more(record.contacts, 1);
      add_contact(owner, e, way, DSW_WALL_INSERT, record);
      dsw_body_edit edit;
      body.inserted.push_back(insert_vertex(body, e, point, cell, way.along, &edit));
      edits.edits.push_back(edit);
      ++record.pushed;
      ++bends;
    }
  }
}

template <int D>
void EndRepair<D>::add_contact(uint32_t owner, uint32_t edge, const Way& way, dsw_wall_response done,
                               WallRecord& record) const {
  const Body<D>& body = *all_.bodies[owner].body;
  dsw_wall_contact contact{};
  std::copy_n(body.position(body.edges[edge].ends[0]), D, contact.from);
  std::copy_n(body.position(body.edges[edge].ends[1]), D, contact.to);
  contact.time = contact.edge_parameter = way.along;
  std::copy_n(way.at, D, contact.point);
  store<D>(way.normal, contact.contact.normal);
  contact.response = done;
  if (way.wall.valid()) name_wall(env_, way.wall, contact.contact);
  name_feature(all_, {Feature::kEdge, owner, edge}, contact);
  record.contacts.push_back(contact);
}

template class EndRepair<2>;
template class EndRepair<3>;

}  // namespace dsw
