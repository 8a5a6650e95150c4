// What has to hold after every change: looked at inside of the engine, and from outside in exact integers.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/points.h"
#include "body_check.h"
#include "environment/marking.h"
#include "environment/validity.h"
#include "locate/bounded_flood.h"
#include "locate/locate.h"
#include "locate/nearest_search.h"
#include "map/integrity.h"
#include "plane_truth.h"
#include "query/locations.h"
#include "random_edits.h"
#include "space_arena.h"
#include "sweep/body_probe.h"

namespace dsw::oracle {
namespace {

template <class T>
void append(std::string& out, const T* data, size_t count) {
  if (count != 0) out.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}
template <class T>
void append(std::string& out, const Array<T>& array) {
  append(out, array.data(), array.size());
}
/// Lists that have room for more sizes are the same lists.
void append_heads(std::string& out, const Array<uint32_t>& heads) {
  size_t count = heads.size();
  while (count != 0 && heads[count - 1] == kNoCell) --count;
  append(out, heads.data(), count);
}
void append_slots(std::string& out, const SlotPool& slots) {
  for (uint32_t i = 0; i < slots.slot_count(); ++i) {
    const uint32_t generation = slots.generation(i);
    append(out, &generation, 1);
  }
  for (size_t k = 0; k < slots.slot_count() - slots.alive_count(); ++k) {
    const uint32_t next = slots.upcoming(k);
    append(out, &next, 1);
  }
}

template <int D>
const char* fault_of(const Environment<D>& env, dsw::Cell c) {
  const CellState state = check_cell(env, c);
  if (state != CellState::kValid && state != CellState::kValidConvex) return "a volume is not valid";
  // Once points have moved, only of simplices.
  const bool can_be = !env.has_moved() || env.map.form(c) == Form::kSimplex;
  const bool convex = can_be && state == CellState::kValidConvex;
  return env.map.convex(c) == convex ? nullptr : "a volume is wrongly called convex, or not";
}

}  // namespace

/// Everything that a failed call must leave as it was, byte for byte.
template <int D>
std::string RandomEdits<D>::state() const {
  const Environment<D>& e = env();
  std::string out;
  append(out, e.map.words);
  append(out, e.map.shape_tables);
  append(out, e.map.shape_offsets);
  append(out, e.map.unit_of_cell);
  append(out, e.map.cell_of_unit);
  append(out, e.map.vertex_uses);
  append_heads(out, e.map.free_records);
  append_heads(out, e.map.free_shapes);
  append_slots(out, e.map.cell_slots);
  append_slots(out, e.map.vertex_slots);
  append(out, e.owned_points);
  append(out, e.vertex_marks);
  append(out, e.regions);
  append(out, e.tags);
  Array<uint64_t> edges;
  e.edge_marks.copy_sorted(edges);
  append(out, edges);
  const uint64_t counts[] = {e.map.cell_count, e.map.vertex_count, e.map.facet_count, e.map.boundary_facet_count,
                             e.marked_cells,   e.marked_facets,    e.marked_edges,    e.marked_vertices};
  append(out, counts, std::size(counts));
  append(out, e.lower, D);
  append(out, e.upper, D);
  append(out, scene().particles);
  for (const BodyRecord<D>& record : scene().bodies) {
    append(out, record.body.vertices);
    const Corridors<D>& sequences = record.body.corridors;
    for (size_t i = 0; i < sequences.size(); ++i) append(out, sequences[i].facets);
  }
  return out + saved();
}

template <int D>
double RandomEdits<D>::volume() const {
  double sum = 0;
  const double unit = D == 3 ? 1 : place_.size();  // whose square may be out of range
  for_each_cell(env().map, [&](dsw::Cell c) {
    const Shape shape = env().map.shape(c);
    double apex[D];
    centre(env(), c, apex);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* p[D];
      simplex_points(env(), c, shape, s, p);
      double d[3][3] = {{}, {}, {0, 0, 1}};
      for (int i = 0; i < D; ++i) {
        for (int k = 0; k < D; ++k) d[i][k] = (p[i][k] - apex[k]) / unit;
      }
      sum += d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    }
  });
  return std::fabs(sum) / (D == 3 ? 6 : 2);
}

template <int D>
std::string RandomEdits<D>::check_counts() const {
  const Environment<D>& e = env();
  uint64_t cells = 0, sides = 0;
  for_each_cell(e.map, [&](dsw::Cell c) {
    cells += e.map.marked(c) ? 1u : 0u;
    for (uint32_t f = 0; f < e.map.facets_of(c); ++f) {
      const HalfFacet h = e.map.half_facet(c, f);
      if (e.map.facet_marked(h)) sides += e.map.opposite(h).valid() ? 1u : 2u;
    }
  });
  if (cells != e.marked_cells) return "marked volumes are counted wrongly";
  if (sides != 2 * e.marked_facets) return "marked faces are counted wrongly";
  for (const Exit& exit : e.exits.all()) {
    const dsw::Cell c = exit.cell < e.map.index_count() ? e.map.cell(exit.cell) : dsw::Cell{};
    if (!c.valid() || exit.local >= e.map.facets_of(c)) return "an exit is no face";
    if (e.map.opposite(e.map.half_facet(c, exit.local)).valid()) return "an exit has two volumes";
    if (e.exits.patch(exit.cell, exit.local) != exit.patch) return "an exit is not found";
  }
  Array<uint64_t> keys;
  e.edge_marks.copy_sorted(keys);
  if (keys.size() != e.marked_edges) return "marked edges are counted wrongly";
  for_each_cell(e.map, [&](dsw::Cell c) {
    for (uint32_t d = 0; d < e.map.shape(c).dart_count(); ++d) {
      const uint64_t a = dart_vertex(e.map, {c, d}), b = dart_target(e.map, {c, d});
      keys.erase(std::remove(keys.begin(), keys.end(), std::min(a, b) << 32 | std::max(a, b)), keys.end());
    }
  });
  return keys.empty() ? "" : "an edge that is none is marked";
}

/// Whether locate names the first of all volumes, in the order of indices, that contains a point: at vertices,
/// beside them, and outside.
template <int D>
std::string wrong_locate(const dsw_environment* environment, const Environment<D>& e) {
  for (uint32_t v = 0; v < e.map.vertex_count; v += 1 + e.map.vertex_count / 16) {
    const double *const a = e.point(v), *const b = e.point(e.map.vertex_count - 1 - v);
    for (const double share : {0.0, 0.25, -2.0}) {
      double p[D];
      for (int k = 0; k < D; ++k) p[k] = a[k] + share * (b[k] - a[k]);
      if (!is_finite<D>(p)) continue;
      dsw::Cell expected;
      for (uint32_t i = 0; i < e.map.index_count() && !expected.valid(); ++i) {
        const dsw::Cell c = e.map.cell(i);
        if (c.valid() && admits(e, c) && contains(e, c, p)) expected = c;
      }
      dsw_volume_id found{};
      if (dsw_environment_locate(environment, p, {0, 0}, &found, nullptr) != DSW_STATUS_OK) return "locate fails";
      if (found.generation == 0 ? expected.valid() : e.map.cell(found.index) != expected) {
        return "locate does not name the first volume that contains a point";
      }
    }
  }
  return "";
}

/// Whether the tree of obstacles, made once and kept right since, finds the bits that a flood finds. Points are halfway
/// between vertices and elsewhere on the way between them.
template <int D>
std::string wrong_nearest(Environment<D>& e) {
  if (e.obstacles.find(e) == nullptr) e.obstacles.build(e);
  const CellTree<D>* const tree = e.obstacles.find(e);
  if (tree == nullptr) return "there is no tree of obstacles";
  for (uint32_t v = 0; v < e.map.vertex_count; v += 1 + e.map.vertex_count / 12) {
    const double *const a = e.point(v), *const b = e.point((v * 7 + 3) % e.map.vertex_count);
    for (const double share : {0.5, 0.171875}) {
      double p[D];
      for (int k = 0; k < D; ++k) p[k] = a[k] + share * (b[k] - a[k]);
      if (!is_finite<D>(p)) continue;
      const dsw::Cell c = locate(e, p, dsw::Cell{}, nullptr).cell;
      if (!c.valid() || is_closed(e, c)) continue;
      for (const double radius : {HUGE_VAL, std::fabs(b[0] - a[0]) / 4}) {
        NearestResult flooded, searched, either;
        BoundedNotes notes(e.memory);
        const bool found = find_nearest(e, p, c, radius, flooded);
        const Distances<D> distances(e, p);
        if (distances.scale() != 1) return "";
        const auto differ = [&](const NearestResult& r) {
          if (!found) return r.feature.cell.valid();
          const dsw_cell here = name_feature(e, flooded.feature), there = name_feature(e, r.feature);
          return std::memcmp(&r.distance, &flooded.distance, 7 * sizeof(double)) != 0 ||
                 std::memcmp(&here, &there, sizeof here) != 0;
        };
        const SearchEnd end = NearestSearch<D>(distances, *tree, p, c, radius).run(searched);
        if (end != SearchEnd::kUnknown && ((end == SearchEnd::kFound) != found || differ(searched))) {
          return "the tree of obstacles does not find what the flood finds";
        }
        if (find_nearest_far(e, p, c, radius, notes, either) != found || differ(either))
          return "the nearest is another one";
      }
    }
  }
  return "";
}

template <int D>
std::string RandomEdits<D>::check() const {
  const Environment<D>& e = env();
  if (const char* const broken = check_integrity(e.map)) return broken;
  std::string wrong = check_counts();
  const auto test = [&](dsw::Cell c, const double* at, const char* what, uint32_t i) {
    // Before the first change all cells are alive, and the map does not list them.
    const auto& cells = e.map.cell_of_unit;
    const bool alive = cells.empty() || (c.unit < cells.size() && cells[c.unit] != kNoCell);
    if (!alive || e.map.marked(c) || !contains(e, c, at)) wrong = what + std::to_string(i) + " is not in its volume";
  };
  for (uint32_t i = 0; i < scene().particles.size(); ++i) {
    const ParticleState<D>& p = scene().particles[i];
    if (p.cell.valid()) test(p.cell, p.position, "particle ", i);
  }
  BodyProbe<D> probe(e, Obstacle::kCells);
  for (uint32_t b = 0; b < scene().bodies.size(); ++b) {
    const Body<D>& body = scene().bodies[b].body;
    for (const BodyVertex<D>& v : body.vertices) {
      if (v.cell.valid()) test(v.cell, v.position, "a vertex of body ", b);
    }
    if (wrong.empty() && !probe.is_free(body, {})) wrong = "body " + std::to_string(b) + " is not free";
  }
  if (wrong.empty()) wrong = wrong_locate(place_.get(), e);
  return wrong.empty() ? wrong_nearest(std::get<Environment<D>>(place_.get()->engine)) : wrong;
}

template <>
std::string RandomEdits<3>::check_exactly() {
  const Environment<3>& e = env();
  Mesh mesh;
  mesh.points.resize(e.map.vertex_count);
  for (uint32_t v = 0; v < e.map.vertex_count; ++v) std::copy_n(e.point(v), 3, mesh.points[v].begin());
  World::Changed changed;
  std::vector<dsw_volume_id>& ids = changed.volumes;
  std::map<uint32_t, size_t> place;  // unit -> cell of the mesh
  std::string wrong;
  for_each_cell(e.map, [&](dsw::Cell c) {
    if (const char* const what = fault_of(e, c)) wrong = what;
    const Shape shape = e.map.shape(c);
    std::vector<Loop> loops(shape.facet_count());
    changed.outer.emplace_back();
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      changed.outer.back().push_back(e.map.opposite(e.map.half_facet(c, f)).valid() ? 0 : 1);
    }
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      loops[shape.dart_facet(d)].push_back(static_cast<int>(e.map.vertex(c, shape.dart_vertex(d))));
    }
    place[c.unit] = ids.size();
    ids.push_back(volume_id(e.map, c));
    mesh.add_polyhedron(std::move(loops));
  });
  if (!wrong.empty()) return wrong;
  World world(mesh, place_.get(), changed);
  if (!world.fault().empty()) return world.fault();
  for (size_t i = 0; i < ids.size(); ++i) world.cell_marked[i] = e.map.marked(e.map.cell(ids[i].index)) ? 1 : 0;
  for (Face& face : world.faces) {
    const dsw::Cell c = e.map.cell(ids[static_cast<size_t>(face.cell[0])].index);
    face.marked = e.map.facet_marked(e.map.half_facet(c, static_cast<uint32_t>(face.local[0])));
  }
  Array<uint64_t> keys;
  e.edge_marks.copy_sorted(keys);
  std::vector<std::array<int, 2>> marked_edges;
  for (const uint64_t key : keys)
    marked_edges.push_back({static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)});
  SweepReport report(0);
  SpaceArena arena(world, marked_edges);
  BodyChecker checker(arena, report);
  for (const ParticleState<3>& p : scene().particles) {
    if (p.cell.valid() && !world.contains(static_cast<int>(place.at(p.cell.unit)), world.body(p.position))) {
      return "a particle is not in its volume";
    }
  }
  // Where the outer boundary has been moved through itself, the oracle sees walls that are not in the way.
  const dsw_status partition = dsw_environment_check(place_.get(), nullptr);
  if (partition == DSW_STATUS_BOUNDARY_CROSSES) return "";
  if (partition != DSW_STATUS_OK) return dsw_last_error_message();
  ++exact_checks;
  Big sum = 0;
  for (size_t i = 0; i < ids.size(); ++i) sum += world.volume6(static_cast<int>(i));
  if (sum != world.outer_volume6()) return "the volumes do not fill what the outer boundary encloses";
  for (uint32_t b = 0; b < scene().bodies.size(); ++b) {
    const uint32_t generation = scene().body_slots.generation(b);
    if (!scene().body_slots.alive(b, generation)) continue;
    BodyState state;
    wrong = read_body(scene_.get(), {b, generation}, state);
    if (wrong.empty())
      wrong = checker.not_free(state, static_cast<dsw_level>(1 + static_cast<int>(scene().bodies[b].body.level)));
    if (!wrong.empty()) return wrong;
  }
  return "";
}

template <>
std::string RandomEdits<2>::check_exactly() {
  const Environment<2>& e = env();
  const Map<2>& map = e.map;
  plane::World world;
  for (uint32_t v = 0; v < map.vertex_count; ++v) world.points.push_back({e.point(v)[0], e.point(v)[1]});
  std::map<uint32_t, int> place;  // unit -> cell of the world
  for_each_cell(map, [&](dsw::Cell c) {
    place[c.unit] = static_cast<int>(world.cells.size());
    world.cells.emplace_back();
    for (uint32_t k = 0; k < map.vertices_of(c); ++k) world.cells.back().push_back(static_cast<int>(map.vertex(c, k)));
    world.cell_marked.push_back(map.marked(c) ? 1 : 0);
  });
  std::string wrong;
  for_each_cell(map, [&](dsw::Cell c) {
    plane::Vec middle;
    centre(e, c, middle.data());
    const int here = place.at(c.unit);
    if (!plane::is_star_of(world, here, middle)) wrong = "a polygon is not valid";
    if (const char* const what = fault_of(e, c)) wrong = what;
    const std::vector<int>& loop = world.cells[static_cast<size_t>(here)];
    for (uint32_t f = 0; f < loop.size(); ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      const dsw::Cell other = o.valid() ? map.cell_of(o) : dsw::Cell{};
      if (o.valid() && place.at(other.unit) < here) continue;
      const int local = o.valid() ? static_cast<int>(map.local_of(o, other)) : -1;
      world.sides.push_back({loop[f],
                             loop[(f + 1) % loop.size()],
                             {here, o.valid() ? place.at(other.unit) : -1},
                             {static_cast<int>(f), local},
                             map.facet_marked(h)});
    }
  });
  if (!wrong.empty()) return wrong;
  const auto cell_at = [&](dsw::Cell c) { return place.at(c.unit); };
  for (const ParticleState<2>& p : scene().particles) {
    if (!p.cell.valid()) continue;
    if (map.marked(p.cell) || !plane::contains(world, cell_at(p.cell), {p.position[0], p.position[1]})) {
      return "a particle is not in its volume";
    }
  }
  // Where the outer boundary has been moved through itself, the oracle sees walls that are not in the way.
  const dsw_status partition = dsw_environment_check(place_.get(), nullptr);
  if (partition == DSW_STATUS_BOUNDARY_CROSSES) return "";
  if (partition != DSW_STATUS_OK) return dsw_last_error_message();
  ++exact_checks;
  Big sum, enclosed;
  plane::double_areas(world, &sum, &enclosed);
  if (sum != enclosed) return "the polygons do not fill what the outer boundary encloses";
  for (const BodyRecord<2>& record : scene().bodies) {
    const Body<2>& body = record.body;
    const auto at = [&](uint32_t v) { return plane::Vec{body.position(v)[0], body.position(v)[1]}; };
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      const dsw::Cell c = body.vertices[v].cell;
      if (map.marked(c) || !plane::contains(world, cell_at(c), at(v))) return "a vertex is not in its volume";
    }
    for (uint32_t edge = 0; edge < body.edges.size() && body.level >= SweepLevel::kEdges; ++edge) {
      if (!body.has_edge(edge)) continue;
      const uint32_t p = body.edges[edge].ends[0], q = body.edges[edge].ends[1];
      const plane::Flight flight = plane::cast(world, cell_at(body.vertices[p].cell), at(p), at(q));
      if (flight.outcome != plane::Flight::kReached || flight.cells.back() != cell_at(body.vertices[q].cell)) {
        return "an edge is not free";
      }
    }
  }
  for (int i = 0; i < 20; ++i) {
    const plane::Vec p = place_.start(rng_);
    dsw_volume_id volume;
    const int found = plane::locate(world, p);
    dsw_environment_locate(place_.get(), p.data(), {0, 0}, &volume, nullptr);
    const int answer = volume.generation == 0 ? -1 : cell_at(map.cell(volume.index));
    if (found != answer) return "a point is in another polygon than said, or in two";
  }
  return "";
}

template std::string RandomEdits<3>::check() const;
template std::string RandomEdits<2>::check() const;
template std::string RandomEdits<3>::state() const;
template std::string RandomEdits<2>::state() const;
template double RandomEdits<3>::volume() const;
template double RandomEdits<2>::volume() const;

}  // namespace dsw::oracle
