#include "walls/neighbourhood.h"

#include <cmath>

#include "base/slot_pool.h"
#include "base/sort.h"
#include "sweep/body_probe.h"

namespace dsw {

template <int D>
Neighbourhood<D>::Neighbourhood(Environment<D>& env, Occupants<D>& all)
    : env_(env), all_(all), points_(env), features_(env.memory), flood_(env), reach_(env.memory) {}

template <int D>
void Neighbourhood<D>::find_occupants() {
  begun_ = false;
  features_.start(env_.map.index_count());
  occupied_.clear();
  for (uint32_t i = 0; i < all_.particle_count; ++i) {
    if (all_.particles[i].cell.valid()) note_point({Feature::kParticle, 0, i});
  }
  for (uint32_t owner = 0; owner < all_.bodies.size(); ++owner) {
    if (all_.bodies[owner].body == nullptr) continue;
    for_each_simplex(*all_.bodies[owner].body, [&](const Simplex& each) {
      follow({owner, each});
      return true;
    });
  }
}

template <int D>
void Neighbourhood<D>::begin(double* next) {
  near_.clear();
  cells_.clear();
  open_.clear();
  near_count_ = 0;
  step_ = 0;
  fraction_ = 0;
  points_.begin(next);
  begun_ = true;
  for (const Cell c : occupied_) add_cell(c);
  for (uint32_t owner = 0; owner < all_.bodies.size(); ++owner) {
    const Body<D>* const body = all_.bodies[owner].body;
    if (body == nullptr || !(body->radius > 0)) continue;
    for_each_outer(*body, [&](const Simplex& each) {
      note_reach({owner, each});
      return true;
    });
  }
}

template <int D>
void Neighbourhood<D>::begin_step(double fraction) {
  ++step_;
  fraction_ = fraction;
  env_.checked.close_all();
  for (const Cell c : open_) env_.checked.open(env_.map.index(c));
  features_.tidy();
}

template <int D>
bool Neighbourhood<D>::find_turns(Array<uint32_t>& turns) {
  turns.clear();
  for (size_t i = 0; i < near_.size(); ++i) {
    if (!near_[i].is_near || near_[i].step == step_) continue;
    turns.push_back(points_.touched()[i]);
    near_[i].step = step_;
  }
  dsw::sort(turns.begin(), turns.end());
  return !turns.empty();
}

template <int D>
void Neighbourhood<D>::end_step(double fraction) noexcept {
  for (size_t i = 0; i < near_.size(); ++i) {
    if (near_[i].is_near) continue;
    double position[D];
    points_.at(points_.touched()[i], fraction, position);
    points_.put(points_.touched()[i], position);
  }
}

template <int D>
const Array<Cell>& Neighbourhood<D>::find_star(uint32_t v) {
  const Near& near = near_[points_.place(v)];
  star_.clear();
  is_star_passable_ = !near.has_walls;
  for (uint32_t n = near.first_cell; n != kNone; n = cells_[n].next) {
    star_.push_back(cells_[n].cell);
    is_star_passable_ = is_star_passable_ && (near.is_explored || cells_[n].explored);
  }
  return star_;
}

template <int D>
void Neighbourhood<D>::find_features(Array<Feature>& features) {
  features.clear();
  for (const Cell c : star_) {
    features_.for_each(env_.map.index(c), [&](const Feature& feature) { features.push_back(feature); });
  }
  dsw::sort(features.begin(), features.end());
  features.erase(std::unique(features.begin(), features.end()), features.end());
}

template <int D>
void Neighbourhood<D>::forget_cells_at(uint32_t v) noexcept {
  for (uint32_t n = near_[points_.place(v)].first_cell; n != kNone; n = cells_[n].next) {
    env_.checked.open(env_.map.index(cells_[n].cell));
  }
}

template <int D>
void Neighbourhood<D>::enter(void* user, Cell, uint32_t, Cell to) noexcept {
  Neighbourhood<D>& self = *static_cast<Neighbourhood<D>*>(user);
  if (self.traced_.size() < self.traced_.capacity()) self.traced_.push_back(to);
  ++self.traced_count_;
}

template <int D>
bool Neighbourhood<D>::trace(const Feature& feature) {
  const Body<D>& body = *all_.bodies[feature.owner].body;
  if constexpr (D == 3) {
    if (feature.kind == Feature::kFace) {
      const bool free = is_face_free(env_, flood_, body, feature.index);
      traced_.clear();
      for (size_t i = 0; i < flood_.cells().size(); ++i) traced_.push_back(flood_.cells()[i]);
      return free;
    }
  }
  const BodyVertex<D>&p = body.vertices[body.edges[feature.index].ends[0]],
        &q = body.vertices[body.edges[feature.index].ends[1]];
  CastRequest request{p.position, q.position, p.cell};
  request.crossing = enter;
  request.crossing_user = this;
  for (;;) {
    traced_.clear();
    traced_.reserve(16);
    traced_.push_back(p.cell);
    traced_count_ = 1;
    const CastResult result = cast(env_, request, nullptr);
    if (traced_count_ == traced_.size()) return result.end == CastEnd::kReached && result.cell == q.cell;
    traced_.reserve(traced_count_);  // a cast allocates nothing
  }
}

template <int D>
void Neighbourhood<D>::note_traced(const Feature& feature) {
  for (const Cell c : traced_) note(c, feature);
}

template <int D>
bool Neighbourhood<D>::follow(const Feature& feature) {
  const bool free = feature.is_point() || trace(feature);
  if (feature.is_point()) {
    note_point(feature);
  } else {
    note_traced(feature);
  }
  if (begun_ && is_thick(feature)) note_reach(feature);
  return free;
}

/** The cells that a feature lies in. */
template <int D>
void Neighbourhood<D>::start_reach(const Feature& feature) {
  reach_.clear();
  if (feature.is_point()) {
    reach_.insert(cell_of(all_, feature));
  } else {
    trace(feature);
    for (const Cell c : traced_) reach_.insert(c);
  }
}

/** The box of all that is within the radius of a body's feature. */
template <int D>
Box<D> Neighbourhood<D>::box_round(const Feature& feature) const noexcept {
  const Body<D>& body = *all_.bodies[feature.owner].body;
  Box<D> box;
  for (const uint32_t v : SimplexCorners<D>(body, simplex_of(feature))) box.add(body.position(v));
  return widened(box, body.radius);
}

template <int D>
void Neighbourhood<D>::open_ways(uint32_t owner, uint32_t v, const double* target) {
  const Body<D>& body = *all_.bodies[owner].body;
  Box<D> end;
  end.add(target);
  end = widened(end, body.radius);
  for_each_simplex_at(body, v, [&](const Simplex& each) {
    Box<D> box = box_round({owner, each});
    box.add(end);
    open_reach({owner, each}, box);
    return true;
  });
}

/** Notes a thick feature in all cells that can come within its radius. When a wall comes so near, the cells between it
 * and the feature are there, too. So it is enough to go from cell to cell where what a cell sweeps on its whole way is
 * near enough. */
template <int D>
void Neighbourhood<D>::note_reach(const Feature& feature) {
  const Map<D>& map = env_.map;
  const Box<D> box = box_round(feature);
  start_reach(feature);
  for (size_t i = 0; i < reach_.size(); ++i) {
    const Cell at = reach_[i];
    note(at, feature);
    for (uint32_t facet = 0, count = map.facets_of(at); facet < count; ++facet) {
      const HalfFacet h = map.half_facet(at, facet);
      if (is_impassable(map, h)) continue;
      const Cell next = map.cell_of(map.opposite(h));
      if (reach_.contains(next)) continue;
      Box<D> swept;
      map.for_each_vertex(next, [&](uint32_t v) {
        swept.add(points_.start(v));
        swept.add(points_.target(v));
      });
      if (swept.overlaps(box)) reach_.insert(next);
    }
  }
}

template <int D>
bool Neighbourhood<D>::note_vertex(uint32_t owner, uint32_t v) {
  bool free = true;
  for_each_simplex_at(*all_.bodies[owner].body, v, [&](const Simplex& each) {
    free = follow({owner, each}) && free;
    return true;
  });
  return free;
}

template <int D>
bool Neighbourhood<D>::note_body(uint32_t owner) {
  bool free = true;
  for_each_simplex(*all_.bodies[owner].body, [&](const Simplex& each) {
    free = follow({owner, each}) && free;
    return true;
  });
  features_.tidy();
  return free;
}

template <int D>
bool Neighbourhood<D>::open_reach(const Feature& feature, const Box<D>& box) {
  const Map<D>& map = env_.map;
  bool any = false;
  start_reach(feature);
  for (size_t i = 0; i < reach_.size(); ++i) {
    const Cell at = reach_[i];
    for (uint32_t facet = 0, count = map.facets_of(at); facet < count; ++facet) {
      const HalfFacet h = map.half_facet(at, facet);
      if (is_impassable(map, h)) continue;
      const Cell next = map.cell_of(map.opposite(h));
      if (reach_.contains(next)) continue;
      any = open(next) || any;
      Box<D> room;
      for (uint32_t k = 0, corners = map.vertices_of(next); k < corners; ++k) room.add(env_.point(next, k));
      if (room.overlaps(box)) reach_.insert(next);
    }
  }
  return any;
}

template <int D>
void Neighbourhood<D>::note(Cell c, const Feature& feature) {
  if (!features_.add(env_.map.index(c), feature)) return;
  if (begun_) {
    add_cell(c);
  } else {
    occupied_.push_back(c);
  }
}

/** Makes the vertices of a cell near. */
template <int D>
void Neighbourhood<D>::add_cell(Cell c) {
  open(c);
  for (uint32_t i = 0, count = env_.map.vertices_of(c); i < count; ++i) {
    const uint32_t v = env_.map.vertex(c, i);
    Near& near = near_[points_.place(v)];
    near_count_ += near.is_near ? 0 : 1;
    near.is_near = true;
    if (near.is_explored) continue;
    uint32_t n = near.first_cell;
    while (cells_[n].cell != c) n = cells_[n].next;
    if (!cells_[n].explored) explore(v, c);
  }
}

/** Lets a cell be entered, from now on all of it where it is in this step; false if it could be. */
template <int D>
bool Neighbourhood<D>::open(Cell c) {
  const uint32_t index = env_.map.index(c);
  if (env_.checked.is_open(index)) return false;
  open_.push_back(c);
  reserve_more(cells_, env_.map.vertices_of(c));
  env_.map.for_each_vertex(c, [&](uint32_t v) {
    if (!points_.is_touched(v)) {
      reserve_more(near_, 1);
      points_.touch(v, fraction_);
      near_.push_back({});
    }
    Near& near = near_[points_.place(v)];
    near.is_explored = false;
    ++near.open_count;
    cells_.push_back({c, near.first_cell, false});
    near.first_cell = static_cast<uint32_t>(cells_.size() - 1);
  });
  env_.checked.open(index);
  return true;
}

/** Opens the cells that can be reached from one round a vertex. At a pinched boundary there can be others. */
template <int D>
void Neighbourhood<D>::explore(uint32_t v, Cell c) {
  around_.clear();
  around_.insert(c);
  const bool passable = for_each_cell_at_vertex(env_.map, v, around_, [&](Cell at) { open(at); });
  Near& near = near_[points_.place(v)];
  near.has_walls = near.has_walls || !passable;
  near.is_explored = near.open_count == around_.size();
  if (near.is_explored) return;
  for (uint32_t n = near.first_cell; n != kNone; n = cells_[n].next) {
    cells_[n].explored = cells_[n].explored || around_.contains(cells_[n].cell);
  }
}

template <int D>
uint64_t Neighbourhood<D>::memory_bytes() const noexcept {
  return points_.memory_bytes() + features_.memory_bytes() + array_bytes(near_) + array_bytes(cells_) +
         array_bytes(occupied_) + array_bytes(open_) + array_bytes(star_) + array_bytes(traced_);
}

template class Neighbourhood<2>;
template class Neighbourhood<3>;

}  // namespace dsw
