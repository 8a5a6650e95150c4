#include "random_edits.h"
#include "../aligned_memory.h"
#include "snapshot_support.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

constexpr double kTolerance = 1e-9;  // of the sum of volumes, which is rounded

bool is_planar(Operation operation) {
  return operation <= Operation::kCollapse && operation != Operation::kMergeFaces && operation != Operation::kSplitFace;
}

}  // namespace

const char* name_of(Operation operation) {
  const char* const names[] = {"sew",          "unsew",       "remove",     "add",        "merge volumes",
                               "split volume", "merge faces", "split face", "split edge", "merge edges",
                               "collapse",     "cut",         "carve",      "tie",        "open",
                               "detach",       "remesh"};
  return names[static_cast<size_t>(operation)];
}

ContextPtr FailingMemory::make_context() {
  dsw_context_desc desc = defaults(dsw_context_desc_init);
  desc.user = this;
  desc.allocate = [](void* user, size_t size, size_t alignment) -> void* {
    auto& self = *static_cast<FailingMemory*>(user);
    if (self.countdown != 0 && --self.countdown == 0) return nullptr;
    return allocate_aligned(size, alignment);
  };
  desc.release = [](void*, void* block, size_t, size_t alignment) { release_aligned(block, alignment); };
  dsw_context* context = nullptr;
  EXPECT_EQ(dsw_context_create(&desc, &context), DSW_STATUS_OK);
  return ContextPtr(context);
}

template <int D>
RandomEdits<D>::RandomEdits(const std::string& scene, uint64_t seed, FailingMemory* memory, uint32_t features)
    : memory_(memory),
      context_(memory == nullptr ? nullptr : memory->make_context()),
      place_(scene, seed, context_.get()),
      choices_{Rng(seed ^ 0x70c0), {}, {}} {
  if (place_.get() == nullptr) return;
  first_count_ = env().map.cell_count;
  volume_ = volume();
  mark_some();
  const bool bends = seed % 2 != 0;
  scene_ = make_scene(place_.get(), features | (bends ? uint32_t{DSW_FEATURE_DEFORMING} : 0u));
  add_particles();
  add_bodies();
  first_bodies_ = this->scene().bodies.size();
}

template <int D>
void RandomEdits<D>::mark_some() {
  for (int i = 0; i < 3; ++i) {
    const dsw_volume_id v = volume_id(env().map, some_cell());
    dsw_environment_mark_volumes(place_.get(), &v, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    const dsw_face_id f = some_face();
    dsw_environment_mark_faces(place_.get(), &f, 1, DSW_MARK_IMPASSABLE);
    mark_exit(f);
    const dsw_edge_id e = some_edge();
    if (D == 3) dsw_environment_mark_edges(place_.get(), &e, 1, DSW_MARK_IMPASSABLE);
    const dsw_vertex_id end = vertex_of(some_edge());
    dsw_environment_mark_vertices(place_.get(), &end, 1, DSW_MARK_IMPASSABLE);
  }
}

/// A face of the outer boundary becomes an exit, any other is refused.
template <int D>
void RandomEdits<D>::mark_exit(dsw_face_id face) {
  const bool is_outer = !env().map.opposite(env().map.half_facet(env().map.cell(face.volume), face.local)).valid();
  const dsw_status status = dsw_environment_mark_exits(place_.get(), &face, 1, 1 + face.volume % 3);
  EXPECT_EQ(status == DSW_STATUS_BAD_TOPOLOGY, !is_outer);
}

template <int D>
void RandomEdits<D>::add_particles() {
  for (int i = 0; i < 25; ++i) {
    const Point p = place_.start(rng_);
    dsw_particle_id id;
    dsw_particle_create(scene_.get(), p.data(), {0, 0}, &id);
  }
}

/// Chains and surfaces, in the plane chains and closed lines, at every level; those that are not free are not made.
template <int D>
void RandomEdits<D>::add_bodies() {
  for (uint32_t i = 0; i < 12; ++i) {
    std::vector<Point> at;
    const double reach = place_.size() * (i % 3 == 0 ? 0.5 : 0.15);
    at.push_back(place_.start(rng_));
    for (int k = 0; k < 3; ++k) {
      Point p = at.back();
      for (double& x : p) x += rng_.range(-reach, reach);
      at.push_back(p);
    }
    create_some_body(scene_.get(), at, i);
  }
}

template <int D>
dsw::Cell RandomEdits<D>::some_cell() {
  for (;;) {
    const dsw::Cell c = env().map.cell(rng_.below(env().map.index_count()));
    if (c.valid()) return c;
  }
}

template <int D>
dsw_face_id RandomEdits<D>::some_face() {
  const dsw::Cell c = some_cell();
  return {env().map.index(c), env().map.generation(c), rng_.below(env().map.facets_of(c))};
}

template <int D>
dsw_edge_id RandomEdits<D>::some_edge() {
  const dsw::Cell c = some_cell();
  return {env().map.index(c), env().map.generation(c), rng_.below(env().map.shape(c).edge_count())};
}

template <int D>
dsw_vertex_id RandomEdits<D>::vertex_of(dsw_edge_id edge) {
  dsw_vertex_id ends[2];
  size_t count;
  dsw_cell named = cell_of(edge);
  if (D == 2) named.kind = DSW_CELL_FACE;
  dsw_environment_copy_vertices(place_.get(), named, ends, 2, &count);
  return ends[rng_.below(2)];
}

/// More is taken apart where there are few volumes, more is put together where there are many.
template <int D>
Operation RandomEdits<D>::choose() {
  const size_t count = volume_count();
  const bool few = count<first_count_ / 2 + 3, many = count> 2 * first_count_;
  for (;;) {
    const auto operation = static_cast<Operation>(rng_.below(static_cast<uint32_t>(Operation::kCount)));
    if (D == 2 && !is_planar(operation)) continue;
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

/// Makes a call with its first allocation refused, then with its second, and so on until it needs no more. A call with
/// many allocations leaves some out.
template <int D>
dsw_status RandomEdits<D>::call_without_memory(Operation operation, const std::string& before, std::string& wrong) {
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

template <int D>
std::string RandomEdits<D>::step() {
  const Operation operation = choose();
  EditTally& tally = tallies[static_cast<size_t>(operation)];
  // A call that succeeds and has nothing to change may still make the tables for changes, once.
  const std::string before = env().map.is_as_created ? "" : state();
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

template <int D>
std::string RandomEdits<D>::mark() {
  const dsw_mark mark = rng_.chance(0.5) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  const int count = rng_.chance(0.3) ? rng_.between(5, 30) : rng_.between(1, 3), kind = rng_.between(0, 2);
  const uint32_t flags = rng_.chance(0.5) ? DSW_MARK_SKIP_OCCUPIED : 0;
  std::vector<dsw_volume_id> volumes;
  std::vector<dsw_face_id> faces;
  std::vector<dsw_edge_id> edges;
  std::vector<dsw_vertex_id> vertices;
  for (int i = 0; i < count; ++i) {
    volumes.push_back(volume_id(env().map, some_cell()));
    faces.push_back(some_face());
    edges.push_back(some_edge());
    vertices.push_back(D == 2 ? vertex_of(edges.back()) : dsw_vertex_id{0, 0});
  }
  mark_exit(faces[0]);
  size_t skipped = 0;
  const dsw_status status =
      kind == 0   ? dsw_environment_mark_volumes(place_.get(), volumes.data(), volumes.size(), mark, flags, &skipped)
      : kind == 1 ? dsw_environment_mark_faces(place_.get(), faces.data(), faces.size(), mark)
      : D == 2    ? dsw_environment_mark_vertices(place_.get(), vertices.data(), vertices.size(), mark)
                  : dsw_environment_mark_edges(place_.get(), edges.data(), edges.size(), mark);
  return std::to_string(status) + " " + std::to_string(skipped) +
         (status == DSW_STATUS_OK ? "" : dsw_last_error_message());
}

template <int D>
std::string RandomEdits<D>::occupants() const {
  std::string out;
  for (const dsw_particle_id id : scene().occupants) out += " p" + std::to_string(id.index);
  for (const dsw_body_id id : scene().occupant_bodies) out += " b" + std::to_string(id.index);
  return out;
}

template <int D>
std::string RandomEdits<D>::saved() const {
  return saved_both(scene_.get());
}

template <int D>
std::string RandomEdits<D>::reload() {
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
template <int D>
std::string RandomEdits<D>::bend_to(const double* from, uint32_t vertex, double by) {
  const uint32_t count = env().map.vertex_count;
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.method = DSW_DEFORM_END_STATE;
  options.point_room = 4 * size_t{count} + 200;
  std::vector<double>& next = lent_[env().points == lent_[0].data() ? 1 : 0];
  std::vector<double> points(from, from + size_t{D} * count);
  points[size_t{D} * vertex] += by;
  next = points;
  next.resize(D * options.point_room, 1);
  if (dsw_environment_deform(dsw_scene_get_environment(scene_.get()), next.data(), count, &options, nullptr) ==
      DSW_STATUS_OK)
    return "";
  return std::string("bending: ") + dsw_last_error_message();
}

/// One vertex goes a little way, if all volumes stay valid. From then on changes write to the host's array.
template <int D>
std::string RandomEdits<D>::bend() {
  const std::vector<double> before(env().points, env().points + size_t{D} * env().map.vertex_count);
  const uint32_t vertex = rng_.below(env().map.vertex_count);
  std::string wrong = bend_to(before.data(), vertex, rng_.range(-0.05, 0.05) * place_.size());
  if (wrong.empty() && dsw_environment_check(place_.get(), nullptr) != DSW_STATUS_OK)
    wrong = bend_to(before.data(), vertex, 0);
  volume_ = volume();
  return wrong;
}

template <int D>
std::string RandomEdits<D>::move_all() {
  // Cuts leave many cracks, and openings move the outer boundary. Where later changes move one lip of one, the outer
  // boundary passes through itself: then edges can be free over one sheet and blocked over the other, which bodies of
  // DSW_LEVEL_EDGES do not tell apart.
  const bool was_cut = tallies[static_cast<size_t>(Operation::kCut)].done != 0 ||
                       tallies[static_cast<size_t>(Operation::kOpen)].done != 0;
  if (was_cut && dsw_environment_check(place_.get(), nullptr) != DSW_STATUS_OK) return "";
  if (scene().deformation.get() != nullptr) {
    const std::string wrong = bend();
    if (!wrong.empty()) return wrong;
  }
  const double reach = 0.2 * place_.size();
  const auto near = [&](const double* at, double* to) {
    for (int k = 0; k < D; ++k) to[k] = at[k] + rng_.range(-reach, reach);
  };
  for (uint32_t i = 0; i < scene().particles.size(); ++i) {
    double to[D];
    near(scene().particles[i].position, to);
    if (dsw_particle_move(scene_.get(), {i, scene().slots.generation(i)}, to, nullptr, nullptr) != DSW_STATUS_OK) {
      return dsw_last_error_message();
    }
  }
  for (uint32_t b = 0; b < scene().bodies.size(); ++b) {
    const dsw_body_id id = {b, scene().body_slots.generation(b)};
    if (!scene().body_slots.alive(id.index, id.generation)) continue;
    std::vector<double> targets;
    double shift[D];
    const double origin[D] = {};
    near(origin, shift);
    for (const BodyVertex<D>& v : scene().bodies[b].body.vertices) {
      for (int k = 0; k < D; ++k) targets.push_back(v.position[k] + shift[k]);
    }
    if (dsw_body_move(scene_.get(), id, targets.data(), targets.size() / D, 0, nullptr, nullptr) != DSW_STATUS_OK) {
      return dsw_last_error_message();
    }
  }
  const std::string wrong = check();
  if constexpr (D == 3) drop_pieces();
  return wrong.empty() ? wrong : "moves: " + wrong;
}

template class RandomEdits<3>;
template class RandomEdits<2>;

}  // namespace dsw::oracle
