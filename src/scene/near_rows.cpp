#include "scene/near_rows.h"

#include <algorithm>
#include <utility>

#include "base/dimensions.h"
#include "base/sort.h"
#include "base/vec.h"
#include "contact/geometry.h"
#include "contact/names.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {
namespace {

constexpr uint32_t kKindShift = 30, kObstacleShift = 28, kLocalShift = 16, kDiagonal = 0x8000;

/** Which obstacle of the environment it is, and the last two numbers of its key. */
struct ObstacleName {
  dsw_cell cell;
  uint32_t key[2];
};

ObstacleName name_cell(const dsw_cell& cell, uint32_t place) noexcept {
  return {cell, {static_cast<uint32_t>(cell.kind) << kObstacleShift | cell.index, cell.local << kLocalShift | place}};
}

/** The number of a simplex of a facet, or of a diagonal between simplices: of the first that has all vertices. */
template <int D>
uint32_t place_in_facet(const Map<D>& map, HalfFacet facet, const NearPair<D>& pair) noexcept {
  const uint32_t* const vertices = pair.obstacle_vertices;
  const Cell c = map.cell_of(facet);
  const Shape shape = map.shape(c);
  const uint32_t local = map.local_of(facet, c), first = shape.simplex_first(local);
  for (uint32_t s = first; s < shape.simplex_first(local + 1); ++s) {
    uint32_t shared = 0, others = 0;
    for (uint32_t i = 0; i < D; ++i) {
      const uint32_t v = map.vertex(c, shape.simplices()[size_t{s} * D + i]);
      const bool is_one = v == vertices[0] || v == vertices[1] || v == vertices[2];
      shared += is_one;
      if (!is_one) others = i;
    }
    if (shared == pair.feature.count) return shared == D ? s - first : kDiagonal | (D * (s - first) + others);
  }
  return 0;
}

template <int D>
ObstacleName name_obstacle(const Environment<D>& env, const NearPair<D>& pair) noexcept {
  const Map<D>& map = env.map;
  const uint32_t count = pair.feature.count;
  if (count == 1) {
    const uint32_t v = pair.obstacle_vertices[0];
    return name_cell({DSW_CELL_VERTEX, v, map.vertex_generation(v), 0}, 0);
  }
  if constexpr (D == 3) {
    const Cell c = pair.wall.valid() ? map.cell_of(pair.wall) : pair.cell;
    const Dart d = count == 2 ? dart_between(map, c, pair.obstacle_vertices) : Dart{};
    if (d.cell.valid()) {
      const dsw_edge_id id = edge_id(map, d);
      return name_cell({DSW_CELL_EDGE, id.volume, id.generation, id.local}, 0);
    }
  }
  const HalfFacet facet = canonical(map, pair.wall);
  const dsw_face_id id = face_id(map, facet);
  return name_cell({DSW_CELL_FACE, id.volume, id.generation, id.local}, place_in_facet(map, facet, pair));
}

/** The number of a part of a body, with its kind. */
template <int D>
uint32_t number_of(const Body<D>& body, const uint32_t* vertices, uint32_t count) noexcept {
  uint32_t index = vertices[0];
  if (count == 2) index = find_edge(body, vertices[0], vertices[1]);
  if constexpr (D == 3) {  // in the plane bodies have no faces
    if (count == 3) index = find_face(body, vertices[0], vertices[1], vertices[2]);
  }
  return (count - 1) << kKindShift | index;
}

/** Rows of the call before, in the order of their keys, as long as the environment is as it was then. */
class RowsBefore {
 public:
  RowsBefore(const Array<dsw_near_row>& rows, bool are_current) noexcept : rows_(rows), are_current_(are_current) {}

  /** A row of a part with an edge of the environment, at the same wall: it has the name of the edge. Null: there is none. */
  const dsw_near_row* find(uint32_t part, const uint32_t* vertices, const dsw_face_id& wall) noexcept {
    if (!are_current_) return nullptr;
    size_t& at = next_[part >> kKindShift];  // parts of a kind mostly come one after the other
    if (at == rows_.size() || rows_[at].key[0] > part || (at != 0 && rows_[at - 1].key[0] >= part)) {
      at =
          static_cast<size_t>(std::lower_bound(rows_.begin(), rows_.end(), part,
                                               [](const dsw_near_row& row, uint32_t key) { return row.key[0] < key; }) -
                              rows_.begin());
    }
    while (at < rows_.size() && rows_[at].key[0] < part) ++at;
    for (size_t i = at; i < rows_.size() && rows_[i].key[0] == part; ++i) {
      const dsw_near_row& row = rows_[i];
      const bool is_same_wall = row.wall.volume == wall.volume && row.wall.local == wall.local;
      if (row.key[1] == 0 && is_same_wall && std::equal(vertices, vertices + 3, row.obstacle_vertices)) return &row;
    }
    return nullptr;
  }

 private:
  const Array<dsw_near_row>& rows_;
  bool are_current_;
  size_t next_[3] = {};  // by kinds of parts
};

template <int D>
dsw_near_row to_row(const Environment<D>& env, const Partners<D>& partners, const FoundPair<D>& pair,
                    RowsBefore& before) noexcept {
  dsw_near_row row{};
  std::copy_n(pair.point, 3, row.point);
  std::copy_n(pair.obstacle_point, 3, row.obstacle_point);
  std::copy_n(pair.normal, 3, row.normal);
  row.distance = pair.distance;
  std::copy_n(pair.weights, pair.part.kind + 1, row.weights);
  std::copy_n(pair.obstacle_weights, pair.feature.count, row.obstacle_weights);
  std::copy_n(pair.vertices, 3, row.vertices);
  std::copy_n(pair.obstacle_vertices, 3, row.obstacle_vertices);
  row.key[0] = pair.part.kind << kKindShift | pair.part.index;
  row.previous = kNone;
  if (pair.partner != kNone) {
    const Partner<D>& partner = partners.all[pair.partner];
    row.body = {partner.index, partner.generation};
    row.key[1] = partner.index + 1;
    row.key[2] = number_of(*partner.body, pair.obstacle_vertices, pair.feature.count);
    return row;
  }
  if (pair.wall.valid()) row.wall = face_id(env.map, canonical(env.map, pair.wall));
  const bool is_edge = D == 3 && pair.feature.count == 2 && pair.wall.valid();
  if (const auto* known = is_edge ? before.find(row.key[0], row.obstacle_vertices, row.wall) : nullptr) {
    row.obstacle = known->obstacle;
    std::copy_n(known->key + 2, 2, row.key + 2);
  } else {
    const ObstacleName name = name_obstacle(env, pair);
    row.obstacle = name.cell;
    std::copy_n(name.key, 2, row.key + 2);
  }
  if (pair.wall.valid()) {
    const HalfFacet seen = pair.is_wall_seen ? pair.wall : facing(env, pair.wall, row.normal);
    row.tag = obstacle_tag(env, seen, env.map.cell_of(seen));
  }
  return row;
}

/** No two rows have the same keys: a part and an obstacle are paired once. */
bool precedes(const dsw_near_row& a, const dsw_near_row& b) noexcept {
  return std::lexicographical_compare(a.key, a.key + 4, b.key, b.key + 4);
}
bool has_same_key(const dsw_near_row& a, const dsw_near_row& b) noexcept {
  return std::equal(a.key, a.key + 4, b.key) && a.body.generation == b.body.generation &&
         a.obstacle.generation == b.obstacle.generation;
}

/** Sorts rows by their keys. A row is moved once. Throws std::bad_alloc. */
void sort_rows(Array<dsw_near_row>& rows) {
  struct Place {
    uint32_t key[4];
    uint32_t from;
  };
  Array<Place> places(rows.size(), rows.get_allocator());
  for (uint32_t i = 0; i < rows.size(); ++i) {
    std::copy_n(rows[i].key, 4, places[i].key);
    places[i].from = i;
  }
  dsw::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::lexicographical_compare(a.key, a.key + 4, b.key, b.key + 4);
  });
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (places[i].from == i) continue;
    const dsw_near_row moved = rows[i];  // a cycle begins
    uint32_t to = i;
    for (uint32_t from; (from = places[to].from) != i; to = from) {
      rows[to] = rows[from];
      places[to].from = to;
    }
    rows[to] = moved;
    places[to].from = to;
  }
}

double squared_way(const dsw_near_row& a, const dsw_near_row& b) noexcept {
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += (a.obstacle_point[k] - b.obstacle_point[k]) * (a.obstacle_point[k] - b.obstacle_point[k]);
  return sum;
}
double cosine(const dsw_near_row& a, const dsw_near_row& b) noexcept {
  return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
}

/** Finds for the rows of one part those of the call before. Both are sorted. Each row of before is given once. */
void follow_part(dsw_near_row* begin, dsw_near_row* end, dsw_near_row* last, dsw_near_row* last_end,
                 uint32_t first) noexcept {
  constexpr uint32_t kTaken = 1;
  const auto take = [&](dsw_near_row& row, dsw_near_row* at) {
    at->reserved = kTaken;
    row.previous = first + static_cast<uint32_t>(at - last);
  };
  for (dsw_near_row* row = begin; row != end; ++row) {
    dsw_near_row* const at = std::lower_bound(last, last_end, *row, precedes);
    if (at != last_end && has_same_key(*at, *row)) take(*row, at);
  }
  for (dsw_near_row* row = begin; row != end; ++row) {
    if (row->previous != kNone) continue;
    dsw_near_row* nearest = nullptr;
    for (dsw_near_row* each = last; each != last_end; ++each) {
      const bool is_same_body = each->key[1] == row->key[1] && each->body.generation == row->body.generation;
      if (each->reserved == kTaken || !is_same_body || cosine(*each, *row) < 0.5) continue;
      if (nearest == nullptr || squared_way(*each, *row) < squared_way(*nearest, *row)) nearest = each;
    }
    if (nearest != nullptr) take(*row, nearest);
  }
}

void follow(Array<dsw_near_row>& rows, Array<dsw_near_row>& last) noexcept {
  size_t from = 0;
  for (size_t i = 0; i < rows.size();) {
    size_t end = i;
    while (end < rows.size() && rows[end].key[0] == rows[i].key[0]) ++end;
    while (from < last.size() && last[from].key[0] < rows[i].key[0]) ++from;
    size_t to = from;
    while (to < last.size() && last[to].key[0] == rows[i].key[0]) ++to;
    follow_part(rows.data() + i, rows.data() + end, last.data() + from, last.data() + to, static_cast<uint32_t>(from));
    i = end;
  }
}

/** @param own_key of the body itself in keys. */
template <int D>
void make_jacobian(const Array<dsw_near_row>& rows, uint32_t own_key, NearJacobian& j) {
  j.offsets.push_back(0);
  for (const dsw_near_row& row : rows) {
    struct Entry {
      uint32_t vertex;
      double weight;
    } entries[6];
    int count = 0;
    for (int i = 0; i < 3 && row.vertices[i] != kNone; ++i) entries[count++] = {row.vertices[i], row.weights[i]};
    for (int i = 0; row.key[1] == own_key && i < 3 && row.obstacle_vertices[i] != kNone; ++i) {
      entries[count++] = {row.obstacle_vertices[i], -row.obstacle_weights[i]};
    }
    // A vertex of both parts has its own weight first.
    dsw::sort(entries, entries + count, [](const Entry& a, const Entry& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.weight > b.weight;
    });
    for (int i = 0; i < count; ++i) {
      for (uint32_t k = 0; k < D; ++k) {
        j.columns.push_back(D * entries[i].vertex + k);
        j.values.push_back(entries[i].weight * row.normal[k] + 0.0);  // never -0
      }
    }
    j.offsets.push_back(static_cast<uint32_t>(j.columns.size()));
  }
}

template <int D>
void find_rows(Scene<D>& scene, BodyRecord<D>& of, const NearSettings& settings, NearRecord<D>& near) {
  const double margin = settings.margin, radius = settings.radius + of.body.radius;
  Array<FoundPair<D>> pairs(scene.memory);
  pairs.reserve(near.last.size() + near.last.size() / 8);
  Partners<D> partners(scene.memory);
  NearSearch<D> search(scene.env, of.body, near.notes);
  search.find_walls(margin + radius, pairs);
  const auto radii_with = [&](const Partner<D>& each) {
    return radius + (each.body == &of.body ? radius : each.body->radius);
  };
  if (scene.features.contacts) {
    // The bodies' own radii are added where partners are found.
    const Box<D> reach = widened(reach_of(of.body), margin + 2 * settings.radius);
    find_partners(scene, of.body, reach, partners);
    for (uint32_t i = 0; i < partners.all.size(); ++i) {
      search.find_partner(partners, i, margin + radii_with(partners.all[i]), pairs);
    }
  }
  near.rows.reserve(pairs.size());
  const uint32_t own_key = static_cast<uint32_t>(&of - scene.bodies.data()) + 1;
  RowsBefore before(near.last, near.last_version == scene.env.change_version);
  for (const FoundPair<D>& pair : pairs) {
    near.rows.push_back(to_row(scene.env, partners, pair, before));
    dsw_near_row& row = near.rows.back();
    row.gap = row.distance - (pair.partner == kNone ? radius : radii_with(partners.all[pair.partner]));
  }
  near.last_version = scene.env.change_version;
  sort_rows(near.rows);
  follow(near.rows, near.last);
  if (settings.jacobian) make_jacobian<D>(near.rows, own_key, near.jacobian);
}

}  // namespace

template <int D>
void find_near_rows(Scene<D>& scene, BodyRecord<D>& of, const NearSettings& settings) {
  if (of.near.empty()) of.near.emplace_back(scene.memory);
  NearRecord<D>& near = of.near[0];
  std::swap(near.rows, near.last);
  near.rows.clear();
  near.jacobian.clear();
  try {
    find_rows(scene, of, settings, near);
  } catch (...) {
    near.rows.clear();
    near.jacobian.clear();
    throw;
  }
}

DSW_INSTANTIATE(find_near_rows);

}  // namespace dsw
