// Walls are found by casts of edges and by floods over faces, bodies by the exact tests of pairs that creation uses.

#include "scene/penetrations.h"

#include <algorithm>
#include <tuple>

#include "base/dimensions.h"
#include "base/sort.h"
#include "body/simplices.h"
#include "contact/describe.h"
#include "locate/locate.h"
#include "predicates/touch.h"
#include "scene/meeting.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

template <int D>
class PenetrationSearch {
 public:
  PenetrationSearch(Scene<D>& scene, const Body<D>& body, const Array<bool>& inside, Array<CrossedPart<D>>& found)
      : scene_(scene), env_(scene.env), body_(body), inside_(inside), found_(found) {}

  void run() {
    found_.clear();
    find_vertices();
    if (covers_edges(body_.level)) find_edges();
    if constexpr (D == 3) {
      if (covers_faces(body_.level) && found_.empty()) find_faces();
    }
    if (scene_.features.contacts && !body_.boxes.empty()) find_pairs();
    if (found_.empty()) find_others();
  }

 private:
  void add(const Simplex& part, HalfFacet wall, const double* point) {
    CrossedPart<D> made;
    made.part = part;
    made.wall = wall;
    std::copy_n(point, D, made.point);
    found_.push_back(made);
  }

  void find_vertices() {
    for (uint32_t v = 0; v < body_.vertices.size(); ++v) {
      const bool alone = !covers_edges(body_.level) || body_.vertices[v].first_edge == kNone;
      if (alone && body_.vertex_slots.alive(v, body_.vertex_slots.generation(v)) && !inside_[v])
        add({Simplex::kVertex, v}, {}, body_.position(v));
    }
  }

  void find_edges() {
    for (uint32_t e = 0; e < body_.edges.size(); ++e) {
      if (!body_.has_edge(e)) continue;
      uint32_t a = body_.edges[e].ends[0], b = body_.edges[e].ends[1];
      if (!inside_[a]) std::swap(a, b);
      const double *const from = body_.position(a), *const to = body_.position(b);
      if (!inside_[a]) {
        add({Simplex::kEdge, e}, {}, from);
        continue;
      }
      const CastResult way = cast(env_, from, to, body_.vertices[a].cell);
      if (way.end == CastEnd::kReached && inside_[b] && way.cell == body_.vertices[b].cell) continue;
      double point[D];
      const bool hits = way.end == CastEnd::kHit;
      point_at<D>(from, to, hits ? crossing_time(env_, way.cell, way.simplex, from, to) : 1, point);
      add({Simplex::kEdge, e}, hits ? way.facet : HalfFacet{}, point);
    }
  }

  /** All edges are free. */
  void find_faces() {
    SweepFlood<3> flood(env_);
    for (uint32_t f = 0; f < body_.faces.size(); ++f) {
      if (!body_.has_face(f) || is_face_free(env_, flood, body_, f)) continue;
      const uint32_t* const c = body_.faces[f].corners;
      if (flood.all().empty()) {
        add({Simplex::kFace, f}, {}, body_.position(c[0]));
        continue;
      }
      const SweepContact& met = flood.all()[0];
      add({Simplex::kFace, f}, met.facet, touch_of<3>(env_, body_.position(c[0]), body_.position(c[1]), met).point);
    }
  }

  void find_pairs() {
    const size_t first = found_.size();
    Partners<D> partners(scene_.memory);
    find_partners_at_rest(scene_, body_, 0, partners);
    for_each_simplex(body_, [&](const Simplex& part) {
      if (part.kind == Simplex::kVertex && covers_edges(body_.level) &&
          body_.vertices[part.index].first_edge != kNone) {
        return true;  // its edges stand for it
      }
      for (const Partner<D>& other : partners.all) meet(part, other);
      return true;
    });
    const auto key = [](const CrossedPart<D>& p) {
      return std::make_tuple(p.part.kind, p.part.index, p.other.index, p.other_part.kind, p.other_part.index);
    };
    dsw::sort(found_.begin() + first, found_.end(),
              [&](const CrossedPart<D>& a, const CrossedPart<D>& b) { return key(a) < key(b); });
  }

  /** Two faces meet where an edge of one meets the other, so they need no test. */
  void meet(const Simplex& part, const Partner<D>& other) {
    const Body<D>& b = *other.body;
    Box<D> box;
    for (const uint32_t v : SimplexCorners<D>(body_, part)) box.add(body_.position(v));
    const auto look = [&](Simplex::Kind kind) {
      return [this, &part, &other, kind](uint32_t i) {
        compare(part, other, {kind, i});
        return true;
      };
    };
    single_vertices(b, b.level).visit(box, look(Simplex::kVertex));
    if (covers_edges(b.level)) fresh_boxes(b).edges.visit(box, look(Simplex::kEdge));
    if (D == 3 && covers_faces(b.level) && part.kind != Simplex::kFace)
      fresh_boxes(b).faces.visit(box, look(Simplex::kFace));
  }

  void compare(const Simplex& part, const Partner<D>& other, const Simplex& other_part) {
    const SimplexCorners<D> own(body_, part), its(*other.body, other_part);
    if (other.body == &body_) {
      for (const uint32_t v : own) {
        if (std::count(its.begin(), its.end(), v) != 0) return;
      }
      // A pair of the body's own parts is met from both sides.
      if (std::make_tuple(part.kind, part.index) > std::make_tuple(other_part.kind, other_part.index)) return;
    }
    const double *p[3], *q[3];
    for (uint32_t k = 0; k < 3; ++k) p[k] = body_.position(own.vertices[std::min(k, own.count - 1)]);
    for (uint32_t k = 0; k < 3; ++k) q[k] = other.body->position(its.vertices[std::min(k, its.count - 1)]);
    bool touches = false;
    if constexpr (D == 3) {
      touches = own.count == 3   ? triangle_touches(p, q[0], q[1])
                : its.count == 3 ? triangle_touches(q, p[0], p[1])
                                 : segments_touch<3>(p[0], p[1], q[0], q[1]);
    } else {
      touches = segments_touch<2>(p[0], p[1], q[0], q[1]);
    }
    if (!touches) return;
    CrossedPart<D> made;
    made.part = part;
    made.other = other;
    made.other_part = other_part;
    common_point(own.count == 3 ? q : p, own.count == 3 ? p : q, made.point);
    found_.push_back(made);
  }

  /** Where a segment is nearest to the plane of a triangle, in the plane to the line of another segment; in space to
   * that of an edge, in the direction across both. */
  static void common_point(const double* const* segment, const double* const* plane, double* point) {
    const Vec along = unit(difference<D>(segment[1], segment[0])), side = difference<D>(plane[1], plane[0]);
    Vec normal = D == 2 ? turned(side) : side.cross(difference<D>(plane[2], plane[0]));
    if (D == 3 && is_zero(normal)) normal = side.cross(along.cross(side));
    const double h0 = dot(unit(normal), difference<D>(segment[0], plane[0])),
                 h1 = dot(unit(normal), difference<D>(segment[1], plane[0]));
    const double share = h0 != h1 ? h0 / (h0 - h1) : 0;
    point_at<D>(segment[0], segment[1], std::clamp(share, 0.0, 1.0), point);
  }

  /** What creation refuses besides: parts that are too near to something, or touch where they are joined. */
  void find_others() {
    try {
      check_free(scene_, body_, body_.level);
    } catch (const Error& error) {
      if (error.status() != DSW_STATUS_OCCUPIED) throw;
    }
    for (size_t i = 0; i < scene_.offending.size(); i += 2) {
      const uint32_t a = scene_.offending[i], b = scene_.offending[i + 1];
      const uint32_t e = a == b ? kNone : find_edge(body_, a, b);
      add(e == kNone ? Simplex{Simplex::kVertex, a} : Simplex{Simplex::kEdge, e}, {}, body_.position(a));
    }
  }

  Scene<D>& scene_;
  const Environment<D>& env_;
  const Body<D>& body_;
  const Array<bool>& inside_;
  Array<CrossedPart<D>>& found_;
};

}  // namespace

template <int D>
void find_cells(const Scene<D>& scene, Body<D>& body, Array<bool>& inside) {
  const Environment<D>& env = scene.env;
  inside.assign(body.vertices.size(), false);
  Cell any, last;
  for (uint32_t i = 0; i < env.map.index_count() && !any.valid(); ++i) any = env.map.cell(i);
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.vertex_slots.alive(v, body.vertex_slots.generation(v))) continue;
    const Cell cell = locate(env, body.position(v), last, nullptr).cell;
    inside[v] = cell.valid() && !is_closed(env, cell);
    body.vertices[v].cell = cell.valid() ? cell : any;
    if (cell.valid()) last = cell;
  }
}

template <int D>
void find_penetrations(Scene<D>& scene, const Body<D>& body, const Array<bool>& inside, Array<CrossedPart<D>>& found) {
  PenetrationSearch<D>(scene, body, inside, found).run();
}

template <int D>
void list_penetrations(Scene<D>& scene, const BodyRecord<D>& of) {
  Array<dsw_penetration> list(scene.memory);
  if (of.is_penetrating()) {
    Body<D> body(of.penetrating[0]);
    Array<bool> inside(scene.memory);
    find_cells(scene, body, inside);
    if (scene.keeps_boxes()) keep_boxes(body);
    Array<CrossedPart<D>> found(scene.memory);
    find_penetrations(scene, body, inside, found);
    const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
    const Partner<D> self{&body, slot, scene.body_slots.generation(slot)};
    for (const CrossedPart<D>& each : found) {
      dsw_penetration p{};
      std::copy_n(each.point, 3, p.point);
      p.part = name_partner(self, each.part);
      if (each.other.body != nullptr)
        p.other = name_partner(each.other.body == &body ? self : each.other, each.other_part);
      if (each.wall.valid()) p.wall = face_id(scene.env.map, canonical(scene.env.map, each.wall));
      list.push_back(p);
    }
  }
  std::swap(scene.penetrations, list);
}

DSW_INSTANTIATE(find_cells);
DSW_INSTANTIATE(find_penetrations);
DSW_INSTANTIATE(list_penetrations);

}  // namespace dsw
