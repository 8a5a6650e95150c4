#include "random_edits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "body_state.h"
#include "remesh/mending.h"

namespace dsw::oracle {
namespace {

constexpr double kTolerance = 1e-9;  // of the sum of volumes, which is rounded

}  // namespace

const char* name_of(Operation operation) {
  const char* const names[] = {"sew",          "unsew",       "remove",     "add",        "merge volumes",
                               "split volume", "merge faces", "split face", "split edge", "merge edges",
                               "collapse",     "cut",         "carve",      "tie",        "open",
                               "detach",       "remesh"};
  return names[static_cast<size_t>(operation)];
}

ContextPtr FailingMemory::make_context() {
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.user = this;
  desc.allocate = [](void* user, size_t size, size_t alignment) -> void* {
    auto& self = *static_cast<FailingMemory*>(user);
    if (self.countdown != 0 && --self.countdown == 0) return nullptr;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  };
  desc.release = [](void*, void* block, size_t, size_t) { std::free(block); };
  dsw_context* context = nullptr;
  EXPECT_EQ(dsw_context_create(&desc, &context), DSW_STATUS_OK);
  return ContextPtr(context);
}

RandomEdits::RandomEdits(const std::string& scene, uint64_t seed, FailingMemory* memory, uint32_t features)
    : memory_(memory),
      context_(memory == nullptr ? nullptr : memory->make_context()),
      place_(make_place(scene, seed, 0, context_.get())),
      choices_{Rng(seed ^ 0x70c0), {}, {}} {
  if (place_.environment == nullptr) return;
  first_count_ = env().map.cell_count;
  volume_ = volume();
  mark_some();
  scene_ = make_scene(place_.get(), features | (seed % 2 == 0 ? 0u : uint32_t{DSW_FEATURE_DEFORMING}));
  add_particles();
  add_bodies();
  first_bodies_ = dsw::capi::space(*scene_).bodies.size();
}

void RandomEdits::mark_some() {
  for (int i = 0; i < 3; ++i) {
    const dsw_volume_id v = volume_id(env().map, some_cell());
    dsw_environment_mark_volumes(place_.get(), &v, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    const dsw_face_id f = some_face();
    dsw_environment_mark_faces(place_.get(), &f, 1, DSW_MARK_IMPASSABLE);
    const dsw_edge_id e = some_edge();
    dsw_environment_mark_edges(place_.get(), &e, 1, DSW_MARK_IMPASSABLE);
    const dsw_vertex_id end = vertex_of(some_edge());
    dsw_environment_mark_vertices(place_.get(), &end, 1, DSW_MARK_IMPASSABLE);
  }
}

void RandomEdits::add_particles() {
  Motions motions(*place_.world, rng_);
  for (int i = 0; i < 25; ++i) {
    const Vec p = motions.start();
    dsw_particle_id id;
    dsw_particle_create(scene_.get(), p.data(), {0, 0}, &id);
  }
}

/// Chains and surfaces, at every level; those that are not free are not made.
void RandomEdits::add_bodies() {
  Motions motions(*place_.world, rng_);
  for (int i = 0; i < 12; ++i) {
    BodyPlan plan;
    const double reach = place_.world->size * (i % 3 == 0 ? 0.5 : 0.15);
    plan.at.push_back(motions.start());
    for (int k = 0; k < 3; ++k) {
      Vec p = plan.at.back();
      for (double& x : p) x += rng_.range(-reach, reach);
      plan.at.push_back(p);
    }
    if (i % 2 == 0) {
      plan.edges = {{0, 1}, {1, 2}, {2, 3}};
    } else {
      plan.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
    }
    dsw_body_id body;
    const uint32_t flags = i % 2 == 0 ? DSW_BODY_SKIP_BY_CLEARANCE : 0;
    create_body(scene_.get(), plan, static_cast<dsw_level>(1 + i % 4), flags, {}, &body);
  }
}

dsw::Cell RandomEdits::some_cell() {
  for (;;) {
    const dsw::Cell c = env().map.cell(rng_.below(env().map.index_count()));
    if (c.valid()) return c;
  }
}

dsw_face_id RandomEdits::some_face() {
  const dsw::Cell c = some_cell();
  return {env().map.index(c), env().map.generation(c), rng_.below(env().map.facets_of(c))};
}

dsw_edge_id RandomEdits::some_edge() {
  const dsw::Cell c = some_cell();
  return {env().map.index(c), env().map.generation(c), rng_.below(env().map.shape(c).edge_count())};
}

dsw_vertex_id RandomEdits::vertex_of(dsw_edge_id edge) {
  dsw_vertex_id ends[2];
  size_t count;
  dsw_environment_copy_vertices(place_.get(), cell_of(edge), ends, 2, &count);
  return ends[rng_.below(2)];
}

/// More is taken apart where there are few volumes, more is put together where there are many.
Operation RandomEdits::choose() {
  const size_t count = volume_count();
  const bool few = count<first_count_ / 2 + 3, many = count> 2 * first_count_;
  for (;;) {
    const auto operation = static_cast<Operation>(rng_.below(static_cast<uint32_t>(Operation::kCount)));
    const bool takes = operation == Operation::kRemove || operation == Operation::kCollapse ||
                       operation == Operation::kMergeVolumes || operation == Operation::kRemesh;
    if (takes && few) continue;
    if (operation == Operation::kRemove && !rng_.chance(many ? 0.3 : 0.04)) continue;
    if (operation == Operation::kUnsew && !rng_.chance(0.3)) continue;
    if (operation == Operation::kSplitVolume && many) continue;
    if (operation == Operation::kSplitEdge && rng_.chance(0.6)) continue;
    const bool cuts = operation >= Operation::kCut && operation <= Operation::kOpen;
    if (cuts && (many || rng_.chance(0.5))) continue;
    return operation;
  }
}

dsw_status RandomEdits::sew() {
  if (unsewn_.empty() || rng_.chance(0.1)) {
    const dsw_face_id a = some_face(), b = some_face();
    return dsw_environment_sew_faces(place_.get(), &a, &b, 1);
  }
  const size_t i = rng_.below(unsewn_.size());
  const auto pair = unsewn_[i];
  const dsw_status status = dsw_environment_sew_faces(place_.get(), &pair[0], &pair[1], 1);
  if (status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_OUT_OF_MEMORY)
    unsewn_.erase(unsewn_.begin() + static_cast<ptrdiff_t>(i));
  return status;
}

dsw_status RandomEdits::remove() {
  const Map<3>& map = env().map;
  const dsw::Cell c = some_cell();
  const Shape shape = map.shape(c);
  Gone gone;
  gone.faces.resize(shape.facet_count());
  for (uint32_t d = 0; d < shape.dart_count(); ++d) gone.faces[shape.dart_facet(d)].push_back(shape.dart_vertex(d));
  for (uint32_t k = 0; k < shape.vertex_count(); ++k) {
    const uint32_t v = map.vertex(c, k);
    gone.vertices.push_back({v, map.vertex_generation(v)});
    gone.positions.push_back({env().point(v)[0], env().point(v)[1], env().point(v)[2]});
  }
  may_change_ = true;
  const dsw_volume_id id = volume_id(map, c);
  const dsw_status status = dsw_environment_remove_volumes(place_.get(), &id, 1);
  if (status == DSW_STATUS_OK) choices_.gone.push_back(std::move(gone));
  return status;
}

/// Puts a volume back as a polyhedron, on the vertices that are left, sewn to all that fits.
dsw_status RandomEdits::add() {
  if (choices_.gone.empty()) return DSW_STATUS_STALE_ID;
  const Gone gone = choices_.gone.back();
  const Map<3>& map = env().map;
  std::vector<dsw_vertex_id> vertices;
  std::vector<double> points;
  std::vector<int64_t> index(gone.vertices.size(), -1), stream{static_cast<int64_t>(gone.faces.size())};
  const auto alive = [&](const dsw_vertex_id& v) {
    return map.is_vertex_alive(v.index, v.generation) &&
           std::equal(env().point(v.index), env().point(v.index) + 3,
                      gone.positions[static_cast<size_t>(&v - gone.vertices.data())].begin());
  };
  for (size_t k = 0; k < index.size(); ++k) {
    if (!alive(gone.vertices[k])) continue;
    index[k] = static_cast<int64_t>(vertices.size());
    vertices.push_back(gone.vertices[k]);
  }
  for (size_t k = 0; k < index.size(); ++k) {
    if (index[k] >= 0) continue;
    index[k] = static_cast<int64_t>(vertices.size() + points.size() / 3);
    points.insert(points.end(), gone.positions[k].begin(), gone.positions[k].end());
  }
  std::set<std::vector<uint32_t>> wanted;
  for (const auto& face : gone.faces) {
    stream.push_back(static_cast<int64_t>(face.size()));
    std::vector<uint32_t> sorted;
    for (const size_t k : face) {
      stream.push_back(index[k]);
      sorted.push_back(gone.vertices[k].index);
    }
    std::sort(sorted.begin(), sorted.end());
    wanted.insert(sorted);
  }
  std::vector<dsw_face_id> sew_to;
  for_each_cell(map, [&](dsw::Cell c) {
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (map.opposite(h).valid()) continue;
      const Shape shape = map.shape(c);
      std::vector<uint32_t> sorted;
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d)
        sorted.push_back(dart_vertex(map, {c, d}));
      std::sort(sorted.begin(), sorted.end());
      if (wanted.erase(sorted) != 0) sew_to.push_back(face_id(map, h));
    }
  });
  const int64_t offsets[2] = {0, static_cast<int64_t>(stream.size())};
  const uint8_t type = DSW_CELL_TYPE_POLYHEDRON;
  dsw_volumes_desc desc;
  dsw_volumes_desc_init(&desc, sizeof desc);
  desc.vertices = vertices.data();
  desc.vertex_count = vertices.size();
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.cell_types = &type;
  desc.cell_count = 1;
  desc.offsets = offsets;
  desc.connectivity = stream.data();
  desc.connectivity_count = stream.size();
  desc.sew_to = sew_to.data();
  desc.sew_count = sew_to.size();
  may_change_ = true;
  const dsw_status status = dsw_environment_add_volumes(place_.get(), &desc, nullptr, nullptr);
  if (status != DSW_STATUS_OUT_OF_MEMORY) choices_.gone.pop_back();
  return status;
}

/// Along the boundary of some faces that hang together, when that is one loop.
dsw_status RandomEdits::split_volume() {
  const Map<3>& map = env().map;
  for (;;) {
    const dsw::Cell c = some_cell();
    const Shape shape = map.shape(c);
    std::set<uint32_t> faces{rng_.below(shape.facet_count())};
    const uint32_t wanted = 1 + rng_.below(shape.facet_count() - 1);
    for (int tries = 0; faces.size() < wanted && tries < 50; ++tries) {
      const uint32_t d = rng_.below(shape.dart_count());
      if (faces.count(shape.dart_facet(d)) != 0) faces.insert(shape.dart_facet(shape.dart_beta2(d)));
    }
    std::map<uint32_t, uint32_t> next;
    size_t darts = 0;
    for (const uint32_t f : faces) {
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        if (faces.count(shape.dart_facet(shape.dart_beta2(d))) != 0) continue;
        next[map.vertex(c, shape.dart_vertex(d))] = map.vertex(c, shape.dart_vertex(shape.beta1(d)));
        ++darts;
      }
    }
    if (next.size() != darts || next.empty()) continue;
    std::vector<dsw_vertex_id> loop;
    for (uint32_t v = next.begin()->first; loop.size() <= darts;) {
      loop.push_back({v, map.vertex_generation(v)});
      v = next[v];
      if (v == next.begin()->first) break;
    }
    if (loop.size() != darts) continue;
    return dsw_environment_split_volume(place_.get(), volume_id(map, c), loop.data(), loop.size(), nullptr, nullptr);
  }
}

dsw_status RandomEdits::split_face() {
  const Map<3>& map = env().map;
  dsw_face_id face = some_face();
  for (int tries = 0; tries < 30 && map.shape(map.cell(face.volume)).facet_size(face.local) == 3; ++tries)
    face = some_face();
  std::vector<dsw_vertex_id> vertices(100);
  size_t count = 0;
  if (dsw_environment_copy_vertices(place_.get(), cell_of(face), vertices.data(), vertices.size(), &count) != 0) {
    return DSW_STATUS_BUFFER_TOO_SMALL;
  }
  const dsw::Cell c = map.cell(face.volume);
  may_change_ = !map.opposite(map.half_facet(c, face.local)).valid();
  return dsw_environment_split_face(place_.get(), face, vertices[rng_.below(count)], vertices[rng_.below(count)],
                                    nullptr, nullptr);
}

/// For a deformation that some vertices of a cell will not come through.
dsw_status RandomEdits::remesh() {
  const Map<3>& map = env().map;
  std::vector<double> next(env().points, env().points + 3 * size_t{map.vertex_count});
  const dsw::Cell c = some_cell();
  const double reach = rng_.range(0.1, 0.8) * place_.world->size;
  for (uint32_t k = 0; k < map.vertices_of(c); ++k) {
    const bool moves = rng_.chance(0.4);
    for (size_t axis = 0; axis < 3; ++axis) {
      const double by = rng_.range(-reach, reach);
      if (moves) next[3 * size_t{map.vertex(c, k)} + axis] += by;
    }
  }
  dsw_remesh_desc desc;
  dsw_remesh_desc_init(&desc, sizeof desc);
  desc.next = next.data();
  desc.point_count = map.vertex_count;
  desc.radius = 1 + rng_.below(2);
  dsw_remesh_report report{};
  const dsw_status status = dsw_environment_remesh(place_.get(), &desc, &report);
  if (status != DSW_STATUS_OK) return status;
  if (report.volumes_removed == 0) return DSW_STATUS_NOT_FOUND;
  const dsw_volume_change* changes = nullptr;
  size_t count = 0;
  dsw_environment_get_volume_changes(place_.get(), &changes, &count);
  for (size_t i = 0; i < count; ++i) {
    if (changes[i].after.generation == 0) continue;
    if (!is_valid_with(dsw::capi::space(*place_.get()), next.data(), map.cell(changes[i].after.index)))
      return DSW_STATUS_INTERNAL;
  }
  return report.volumes_added <= report.volumes_removed ? DSW_STATUS_OK : DSW_STATUS_INTERNAL;
}

dsw_status RandomEdits::call(Operation operation) {
  dsw_environment* const environment = place_.get();
  const Map<3>& map = env().map;
  may_change_ = false;
  switch (operation) {
    case Operation::kSew:
      return sew();
    case Operation::kUnsew: {
      const dsw_face_id face = some_face();
      const HalfFacet h = map.half_facet(map.cell(face.volume), face.local), o = map.opposite(h);
      const dsw_status status = dsw_environment_unsew_face(environment, face);
      if (status == DSW_STATUS_OK) unsewn_.push_back({face_id(map, h), face_id(map, o)});
      return status;
    }
    case Operation::kRemove:
      return remove();
    case Operation::kAdd:
      return add();
    case Operation::kMergeVolumes:
      return dsw_environment_merge_volumes(environment, some_face(), nullptr);
    case Operation::kSplitVolume:
      return split_volume();
    case Operation::kMergeFaces:
      return dsw_environment_merge_faces(environment, some_edge(), nullptr);
    case Operation::kSplitFace:
      return split_face();
    case Operation::kSplitEdge:
      return dsw_environment_split_edge(environment, some_edge(), rng_.chance(0.5) ? 0.5 : rng_.range(0.1, 0.9),
                                        nullptr, nullptr);
    case Operation::kMergeEdges: {
      // A vertex with two edges, if one is found soon.
      dsw_edge_id edge = some_edge();
      dsw_vertex_id vertex = vertex_of(edge);
      for (int tries = 0; tries < 200 && map.vertex_uses.size() > vertex.index; ++tries) {
        const dsw::Cell c = map.cell(edge.volume);
        const Shape shape = map.shape(c);
        uint32_t darts = 0;
        for (uint32_t d = 0; d < shape.dart_count(); ++d) {
          darts += map.vertex(c, shape.dart_vertex(d)) == vertex.index ? 1u : 0u;
        }
        if (darts == 2) break;
        edge = some_edge();
        vertex = vertex_of(edge);
      }
      may_change_ = true;
      return dsw_environment_merge_edges(environment, edge, vertex, nullptr);
    }
    case Operation::kCut:
      return cut();
    case Operation::kCarve:
      return carve();
    case Operation::kTie:
      return tie();
    case Operation::kOpen:
      return open();
    case Operation::kDetach:
      return detach();
    case Operation::kRemesh:
      return remesh();
    default: {
      const dsw_edge_id edge = some_edge();
      return dsw_environment_collapse_edge(environment, edge, vertex_of(edge));
    }
  }
}

/// The same call with its first allocation refused, then the second, and so on until it needs no more.
dsw_status RandomEdits::call_without_memory(Operation operation, const std::string& before, std::string& wrong) {
  const Choices choices = choices_;
  for (size_t n = 1;; n += 1 + n / 64) {  // large changes make thousands
    memory_->countdown = n;
    const dsw_status status = call(operation);
    memory_->countdown = 0;
    if (status != DSW_STATUS_OUT_OF_MEMORY) return status;
    ++refusals;
    if (state() != before) wrong = "a call that ran out of memory has changed something";
    choices_.rng = choices.rng;
    choices_.unsewn = choices.unsewn;
    choices_.gone = choices.gone;
  }
}

std::string RandomEdits::step() {
  const Operation operation = choose();
  EditTally& tally = tallies[static_cast<size_t>(operation)];
  const std::string before = env().map.has_changed() ? state() : "";
  std::string wrong;
  const bool refuse = memory_ != nullptr && !before.empty();
  const dsw_status status = refuse ? call_without_memory(operation, before, wrong) : call(operation);
  ++tally.tried;
  if (!wrong.empty()) return std::string(name_of(operation)) + ": " + wrong;
  if (status != DSW_STATUS_OK) {
    tally.occupied += status == DSW_STATUS_OCCUPIED ? 1u : 0u;
    if (status != DSW_STATUS_OCCUPIED && status != DSW_STATUS_BAD_TOPOLOGY && status != DSW_STATUS_BAD_CELL &&
        status != DSW_STATUS_INVALID_CELL && status != DSW_STATUS_STALE_ID && status != DSW_STATUS_NOT_FOUND) {
      wrong = std::string("unexpected: ") + dsw_last_error_message();
    }
    if (!before.empty() && state() != before) wrong = "a call that failed has changed something";
  } else {
    ++tally.done;
    wrong = check();
    const double now = volume();
    // Parts of the outer boundary that lie in one plane can move by the rounding of a vertex.
    if (!may_change_ && std::fabs(now - volume_) > kTolerance * volume_) wrong = "the volumes fill another space";
    volume_ = now;
  }
  return wrong.empty() ? wrong : std::string(name_of(operation)) + ": " + wrong;
}

std::string RandomEdits::mark() {
  const dsw_mark mark = rng_.chance(0.5) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  const int count = rng_.chance(0.3) ? rng_.between(5, 30) : rng_.between(1, 3), kind = rng_.between(0, 2);
  const uint32_t flags = rng_.chance(0.5) ? DSW_MARK_SKIP_OCCUPIED : 0;
  std::vector<dsw_volume_id> volumes;
  std::vector<dsw_face_id> faces;
  std::vector<dsw_edge_id> edges;
  for (int i = 0; i < count; ++i) {
    volumes.push_back(volume_id(env().map, some_cell()));
    faces.push_back(some_face());
    edges.push_back(some_edge());
  }
  size_t skipped = 0;
  const dsw_status status =
      kind == 0   ? dsw_environment_mark_volumes(place_.get(), volumes.data(), volumes.size(), mark, flags, &skipped)
      : kind == 1 ? dsw_environment_mark_faces(place_.get(), faces.data(), faces.size(), mark)
                  : dsw_environment_mark_edges(place_.get(), edges.data(), edges.size(), mark);
  return std::to_string(status) + " " + std::to_string(skipped) +
         (status == DSW_STATUS_OK ? "" : dsw_last_error_message());
}

std::string RandomEdits::occupants() const {
  std::string out;
  for (const dsw_particle_id id : scene().occupants) out += " p" + std::to_string(id.index);
  for (const dsw_body_id id : scene().occupant_bodies) out += " b" + std::to_string(id.index);
  return out;
}

std::string RandomEdits::saved() const {
  size_t sizes[2] = {};
  dsw_environment_save(place_.get(), nullptr, 0, &sizes[0]);
  dsw_scene_save(scene_.get(), nullptr, 0, &sizes[1]);
  std::string blocks(sizes[0] + sizes[1], '\0');
  EXPECT_EQ(dsw_environment_save(place_.get(), &blocks[0], sizes[0], &sizes[0]), DSW_STATUS_OK);
  EXPECT_EQ(dsw_scene_save(scene_.get(), &blocks[sizes[0]], sizes[1], &sizes[1]), DSW_STATUS_OK);
  return blocks;
}

std::string RandomEdits::reload() {
  const std::string blocks = saved();
  size_t size = 0;
  dsw_environment_save(place_.get(), nullptr, 0, &size);
  dsw_environment* environment = nullptr;
  dsw_scene* scene = nullptr;
  scene_.reset();
  if (dsw_environment_load(context_.get(), blocks.data(), size, &environment) != DSW_STATUS_OK) {
    return dsw_last_error_message();
  }
  place_.environment.reset(environment);
  const dsw_status status = dsw_scene_load(environment, blocks.data() + size, blocks.size() - size, &scene);
  scene_.reset(scene);
  return status == DSW_STATUS_OK ? "" : dsw_last_error_message();
}

/// Every position to the other array of two, which has room for more; one of them `by` from where it was in `from`.
std::string RandomEdits::bend_to(const double* from, uint32_t vertex, double by) {
  const uint32_t count = env().map.vertex_count;
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.method = DSW_DEFORM_END_STATE;
  options.point_room = 4 * size_t{count} + 200;
  std::vector<double>& next = lent_[env().points == lent_[0].data() ? 1 : 0];
  std::vector<double> points(from, from + size_t{3} * count);
  points[size_t{3} * vertex] += by;
  next = points;
  next.resize(3 * options.point_room, 1);
  if (dsw_scene_deform(scene_.get(), next.data(), count, &options, nullptr) == DSW_STATUS_OK) return "";
  return std::string("bending: ") + dsw_last_error_message();
}

/// One vertex goes a little way, if all volumes stay valid. From then on changes write to the host's array.
std::string RandomEdits::bend() {
  const std::vector<double> before(env().points, env().points + size_t{3} * env().map.vertex_count);
  const uint32_t vertex = rng_.below(env().map.vertex_count);
  std::string wrong = bend_to(before.data(), vertex, rng_.range(-0.05, 0.05) * place_.world->size);
  if (wrong.empty() && dsw_environment_check(place_.get(), nullptr) != DSW_STATUS_OK)
    wrong = bend_to(before.data(), vertex, 0);
  volume_ = volume();
  return wrong;
}

std::string RandomEdits::move_all() {
  // Cuts leave many cracks, and openings move the outer boundary. Where later changes move one lip of one, the outer boundary passes through itself: then edges can be free over
  // one sheet and blocked over the other, which bodies of DSW_LEVEL_EDGES do not tell apart.
  const bool was_cut = tallies[static_cast<size_t>(Operation::kCut)].done != 0 ||
                       tallies[static_cast<size_t>(Operation::kOpen)].done != 0;
  if (was_cut && dsw_environment_check(place_.get(), nullptr) != DSW_STATUS_OK) return "";
  if (scene().deformation.get() != nullptr) {
    const std::string wrong = bend();
    if (!wrong.empty()) return wrong;
  }
  const double reach = 0.2 * place_.world->size;
  const auto near = [&](const double* at, double* to) {
    for (int k = 0; k < 3; ++k) to[k] = at[k] + rng_.range(-reach, reach);
  };
  for (uint32_t i = 0; i < scene().particles.size(); ++i) {
    double to[3];
    near(scene().particles[i].position, to);
    if (dsw_particle_move(scene_.get(), {i, scene().slots.generation(i)}, to, nullptr, nullptr) != DSW_STATUS_OK) {
      return dsw_last_error_message();
    }
  }
  for (uint32_t b = 0; b < scene().bodies.size(); ++b) {
    const dsw_body_id id = {b, scene().body_slots.generation(b)};
    if (!scene().body_slots.alive(id.index, id.generation)) continue;
    std::vector<double> targets;
    double shift[3];
    const double origin[3] = {};
    near(origin, shift);
    for (const BodyVertex<3>& v : scene().bodies[b].body.vertices) {
      for (int k = 0; k < 3; ++k) targets.push_back(v.position[k] + shift[k]);
    }
    if (dsw_body_move(scene_.get(), id, targets.data(), targets.size() / 3, 0, nullptr, nullptr) != DSW_STATUS_OK) {
      return dsw_last_error_message();
    }
  }
  const std::string wrong = check();
  drop_pieces();
  return wrong.empty() ? wrong : "moves: " + wrong;
}

}  // namespace dsw::oracle
