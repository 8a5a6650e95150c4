// The edit sews cracks and drops marks; with it applied and the cells unmarked the body is tried, so that walks see
// space as it is going to be. No cell is replaced, so all ids stay.

#include "scene/detachment.h"

#include <utility>

#include "base/key_table.h"
#include "base/sort.h"
#include "base/vec.h"
#include "contact/names.h"
#include "environment/marking.h"
#include "scene/edits.h"

namespace dsw {

Detachment::Detachment(Environment<3>& env, Scene<3>& scene, Cell start, size_t most)
    : env_(env),
      scene_(scene),
      edit_(env),
      piece_(env, start, most),
      surface_(env, piece_),
      inset_(env, piece_, surface_),
      tried_(surface_.vertices.size(), 0, env.memory),
      positions_(surface_.vertices.size() * 3, 0, env.memory),
      cells_(surface_.vertices.size(), Cell{}, env.memory),
      made_(env.memory) {}

dsw_body_id Detachment::carry_out(const BodyDescription& like, double share, uint32_t attempts,
                                  ChangeResults& results) {
  ChangeResults next(env_.memory);
  next.detached.reserve(piece_.size());
  next.body_vertices.reserve(surface_.vertices.size());
  next.body_faces.reserve(surface_.triangles.size());
  share_ = share;
  attempts_ = attempts;
  scene_.offending.clear();
  place_all(like);
  write_edit();
  edit_.prepare();
  const auto enter = [](void* self) {
    static_cast<Detachment*>(self)->enter();
    return true;
  };
  const Meanwhile meanwhile{enter, this};
  carry_out_prepared(edit_, scene_, &meanwhile);
  tell(next);
  results = std::move(next);
  return id_;
}

/** There is room. */
void Detachment::tell(ChangeResults& results) const {
  const Map<3>& map = env_.map;
  results.numbers.distance = measure();
  results.numbers.faces_sewn = static_cast<uint32_t>(piece_.cracks().size());
  results.numbers.faces_unsewn = count_unsewn();
  const auto id_of = [&](uint32_t vertex) { return dsw_vertex_id{vertex, map.vertex_generation(vertex)}; };
  for (size_t i = 0; i < piece_.size(); ++i) results.detached.push_back(volume_id(map, piece_[i]));
  for (const SurfaceVertex& v : surface_.vertices) {
    const double first = v.from[0] == v.from[1] ? 1 : 0.5;
    results.body_vertices.push_back({{}, {id_of(v.from[0]), id_of(v.from[1])}, {first, 1 - first}});
  }
  for (const SurfaceTriangle& t : surface_.triangles) {
    results.body_faces.push_back({face_id(map, canonical(map, t.facet)), volume_id(map, map.cell_of(t.facet))});
  }
}

/** Facets of the piece on the outer boundary, after the cracks were sewn. */
uint32_t Detachment::count_unsewn() const noexcept {
  const Map<3>& map = env_.map;
  uint32_t count = 0;
  for (size_t i = 0; i < piece_.size(); ++i) {
    for (uint32_t f = 0, facets = map.facets_of(piece_[i]); f < facets; ++f) {
      count += map.opposite(map.half_facet(piece_[i], f)).valid() ? 0u : 1u;
    }
  }
  return count;
}

/** Cracks are sewn; of marks, those of all facets of the piece go, and of edges and vertices that lie inside. */
void Detachment::write_edit() {
  const Map<3>& map = env_.map;
  for (const FacetPair& crack : piece_.cracks()) {
    edit_.set_link(crack.a, crack.b, false);
    edit_.set_link(crack.b, crack.a, false);
  }
  for (size_t i = 0; i < piece_.size(); ++i) {
    for (uint32_t f = 0, facets = map.facets_of(piece_[i]); f < facets; ++f) {
      const HalfFacet h = map.half_facet(piece_[i], f), o = map.opposite(h);
      if (!map.facet_marked(h) || (!o.valid() && piece_.behind(h).valid())) continue;
      if (o.valid() && piece_.contains(map.cell_of(o)) && o.word < h.word) continue;  // was its turn
      edit_.set_link(h, o, false);
      if (o.valid()) edit_.set_link(o, h, false);
    }
  }
  drop_marks_inside();
}

void Detachment::drop_marks_inside() {
  if (env_.edge_marks.size() == 0 && env_.vertex_marks.empty()) return;
  const Map<3>& map = env_.map;
  KeyTable vertices(env_.memory), edges(env_.memory);
  const auto for_each_dart = [&](bool on_surface, auto visit) {
    for (size_t i = 0; i < piece_.size(); ++i) {
      const Shape shape = map.shape(piece_[i]);
      for (uint32_t d = 0; d < shape.dart_count(); ++d) {
        const Dart dart{piece_[i], d};
        if (!on_surface || piece_.is_surface(half_facet(map, dart)))
          visit(dart_vertex(map, dart), dart_target(map, dart));
      }
    }
  };
  for_each_dart(true, [&](uint32_t a, uint32_t b) {
    vertices.insert(a);
    edges.insert(pair_key(a, b));
  });
  for_each_dart(false, [&](uint32_t a, uint32_t b) {
    if (vertex_marked(env_, a) && vertices.find(a) == KeyTable::kNone) edit_.set_mark(a, false);
    if (edge_marked(env_, a, b) && edges.find(pair_key(a, b)) == KeyTable::kNone) edit_.set_mark(a, b, false);
  });
}

void Detachment::set_marks(bool marked) noexcept {
  for (size_t i = 0; i < piece_.size(); ++i) set_cell_mark(env_, piece_[i], marked);
}

void Detachment::give_up(uint32_t a, uint32_t b) const {
  const uint32_t of_a = surface_.vertices[a].from[0], of_b = surface_.vertices[b].from[0];
  fail(DSW_STATUS_OCCUPIED,
       "no free position was found for the piece's surface near vertices %u and %u of the environment", of_a, of_b);
}

/** The next place of a vertex. */
void Detachment::place(uint32_t vertex) {
  while (tried_[vertex] < attempts_) {
    if (inset_.place(vertex, tried_[vertex]++, share_, &positions_[size_t{vertex} * 3], &cells_[vertex])) return;
  }
  give_up(vertex, vertex);
}

void Detachment::place_all(const BodyDescription& like) {
  for (uint32_t v = 0; v < surface_.vertices.size(); ++v) place(v);
  const auto faces = static_cast<uint32_t>(surface_.triangles.size());
  Array<uint32_t> offsets{env_.memory}, corners(offsets);
  for (uint32_t t = 0; t < faces; ++t) {
    offsets.push_back(3 * t);
    for (const uint32_t v : surface_.triangles[t].corners) corners.push_back(v);
  }
  offsets.push_back(3 * faces);
  BodyDescription d = like;
  d.positions = {positions_.data(), 3};
  d.vertex_count = surface_.vertices.size();
  d.face_offsets = offsets.data();
  d.face_corners = corners.data();
  d.face_count = faces;
  d.face_corner_count = corners.size();
  made_ = make_body(scene_, d, cells_.data());
}

/** Ends: every round uses up a place of some vertex. */
void Detachment::draw_in(Body<3>& body) {
  for (;;) {
    try {
      return check_free(scene_, body, body.level);
    } catch (const Error& error) {
      if (error.status() != DSW_STATUS_OCCUPIED) throw;
    }
    Array<uint32_t> moving(scene_.offending);
    dsw::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
    for (const uint32_t v : moving) {
      if (tried_[v] == attempts_) give_up(scene_.offending[0], scene_.offending[1]);
      place(v);
      put_vertex(body, v, &positions_[size_t{v} * 3], cells_[v]);
    }
  }
}

void Detachment::enter() {
  set_marks(false);
  try {
    draw_in(made_.body);
    id_ = enter_body(scene_, std::move(made_));
  } catch (...) {
    set_marks(true);
    throw;
  }
  scene_.offending.clear();
}

double Detachment::measure() const noexcept {
  double distance = 0;
  for (uint32_t v = 0; v < surface_.vertices.size(); ++v) {
    double origin[3];
    inset_.origin(v, origin);
    distance = std::max(distance, length(difference<3>(&positions_[size_t{v} * 3], origin)));
  }
  return distance;
}

}  // namespace dsw
