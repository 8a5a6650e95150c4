// What has to hold after every change: looked at inside of the engine, and from outside in exact integers.
#include <algorithm>
#include <cmath>

#include "body_check.h"
#include "environment/marking.h"
#include "environment/validity.h"
#include "map/integrity.h"
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

}  // namespace

/// Everything that a failed call must leave as it was, byte for byte.
std::string RandomEdits::state() const {
  const Environment<3>& e = env();
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
  append(out, e.lower, 3);
  append(out, e.upper, 3);
  append(out, scene().particles);
  for (const BodyRecord<3>& record : scene().bodies) {
    append(out, record.body.vertices);
    for (const EdgeSequence<3>& sequence : record.body.sequences) append(out, sequence.facets);
  }
  return out + saved();
}

double RandomEdits::volume() const {
  double sum = 0;
  for_each_cell(env().map, [&](dsw::Cell c) {
    const Shape shape = env().map.shape(c);
    double apex[3];
    centre(env(), c, apex);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* p[3];
      simplex_points(env(), c, shape, s, p);
      double d[3][3];
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) d[i][k] = p[i][k] - apex[k];
      }
      sum += d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    }
  });
  return std::fabs(sum) / 6;
}

std::string RandomEdits::check_counts() const {
  const Environment<3>& e = env();
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

std::string RandomEdits::check() const {
  const Environment<3>& e = env();
  if (const char* const broken = check_integrity(e.map)) return broken;
  std::string wrong = check_counts();
  const auto test = [&](dsw::Cell c, const double* at, const char* what, uint32_t i) {
    const bool alive = c.unit < e.map.cell_of_unit.size() && e.map.cell_of_unit[c.unit] != kNoCell;
    if (!alive || e.map.marked(c) || !contains(e, c, at)) wrong = what + std::to_string(i) + " is not in its volume";
  };
  for (uint32_t i = 0; i < scene().particles.size(); ++i) {
    const ParticleState<3>& p = scene().particles[i];
    if (p.cell.valid()) test(p.cell, p.position, "particle ", i);
  }
  BodyProbe<3> probe(e, Obstacle::kCells);
  for (uint32_t b = 0; b < scene().bodies.size(); ++b) {
    const Body<3>& body = scene().bodies[b].body;
    for (const BodyVertex<3>& v : body.vertices) {
      if (v.cell.valid()) test(v.cell, v.position, "a vertex of body ", b);
    }
    if (wrong.empty() && !probe.is_free(body, {})) wrong = "body " + std::to_string(b) + " is not free";
  }
  return wrong;
}

std::string RandomEdits::check_exactly() {
  const Environment<3>& e = env();
  Mesh mesh;
  mesh.points.resize(e.map.vertex_count);
  for (uint32_t v = 0; v < e.map.vertex_count; ++v) std::copy_n(e.point(v), 3, mesh.points[v].begin());
  World::Changed changed;
  std::vector<dsw_volume_id>& ids = changed.volumes;
  std::map<uint32_t, size_t> place;  // unit -> cell of the mesh
  std::string wrong;
  for_each_cell(e.map, [&](dsw::Cell c) {
    const CellState state = check_cell(e, c);
    if (state != CellState::kValid && state != CellState::kValidConvex) wrong = "a volume is not valid";
    // Of points that may move it is not said.
    const bool convex = state == CellState::kValidConvex && (!e.checked.active() || e.map.form(c) == Form::kSimplex);
    if (e.map.convex(c) != convex) wrong = "a volume is wrongly called convex, or not";
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
  std::vector<std::array<int, 2>> wires;
  for (const uint64_t key : keys) wires.push_back({static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)});
  SweepReport report(0);
  SpaceArena arena(world, wires);
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

}  // namespace dsw::oracle
