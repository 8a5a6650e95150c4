#include "life.h"

#include "defaults.h"

#include <algorithm>
#include <cmath>

namespace dsw::portable {

using oracle::defaults;

Life::Life(const LifeKind& kind, uint64_t seed, dsw_context* context)
    : kind_(kind),
      rng_(seed),
      ground_(make_even_ground(kind.ground, kind.unit, seed, context)),
      places_(ground_, rng_),
      first_points_(ground_.positions()) {
  if (ground_.environment == nullptr) return;
  first_volumes_ = static_cast<uint32_t>(ground_.cells.size());
  mark_some(ground_, kind.marked, rng_);
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = kind.features;
  dsw_scene* scene = nullptr;
  dsw_scene_create(environment(), &desc, &scene);
  scene_.reset(scene);
  if (scene == nullptr) return;
  dsw_fuzz::World world = {{1, 1, 0}, DSW_CELL_TYPE_NONE};
  for (size_t k = 0; k < dimension(); ++k) {
    world.boxes[k] = std::max(1u, static_cast<uint32_t>(ground_.upper[k] / unit()));
  }
  calls_.emplace(scene, world, &bytes_);
}

dsw_status Life::act() {
  if (movers_.size() < kind_.bodies.count && rng_.chance(0.3)) return create_body();
  uint32_t all = 0;
  for (const Act& each : *kind_.acts) all += each.weight;
  uint32_t choice = rng_.below(all);
  for (const Act& each : *kind_.acts) {
    if (choice < each.weight) return (this->*each.make)();
    choice -= each.weight;
  }
  return DSW_STATUS_OK;
}

bool Life::is_over() const {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  dsw_environment_get_info(environment(), &info);
  return info.volume_count > 4 * first_volumes_ + 60 || 2 * info.volume_count < first_volumes_;
}

Vec Life::some_way(double length) {
  Vec way = {0, 0, 0};
  for (size_t k = 0; k < dimension(); ++k) way[k] = rng_.range(-length, length) * unit();
  return way;
}

dsw_volume_id Life::some_volume() {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  dsw_environment_get_info(environment(), &info);
  dsw_volume_id volume = {0, 0};
  for (int tries = 0; tries < 20 && volume.generation == 0; ++tries) {
    dsw_environment_get_volume_id(environment(), rng_.below(info.volume_index_count), &volume);
  }
  return volume;
}

bool Life::centre_of(dsw_volume_id volume, Vec& centre) {
  centre = {0, 0, 0};
  return dsw_environment_get_centre(environment(), volume, centre.data()) == DSW_STATUS_OK;
}

void Life::append(std::vector<double>& list, const Vec& p) const {
  list.insert(list.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(dimension()));
}

dsw_status Life::create_particles() {
  constexpr size_t kMost = 64;
  std::vector<double> positions;
  const size_t count = 1 + rng_.below(8);
  for (size_t i = 0; i < count; ++i) append(positions, places_.start());
  std::vector<dsw_particle_id> made(count);
  if (particles_.size() >= kMost) return destroy_particle();
  const dsw_status status =
      count == 1 ? dsw_particle_create(scene(), positions.data(), {0, 0}, made.data())
                 : dsw_scene_create_particles(scene(), positions.data(), count, 0, nullptr, made.data(), nullptr);
  if (status == DSW_STATUS_OK) particles_.insert(particles_.end(), made.begin(), made.end());
  return status;
}

dsw_status Life::move_particles() {
  std::vector<double> targets;
  for (const dsw_particle_id particle : particles_) {
    Vec from = {0, 0, 0};
    dsw_particle_get_position(scene(), particle, from.data(), nullptr);
    append(targets, rng_.chance(0.5) ? places_.near(from, 0.2) : places_.target(from));
  }
  return dsw_scene_move_particles(scene(), particles_.data(), particles_.size(), targets.data(), 0, nullptr, nullptr);
}

dsw_status Life::move_particle() {
  if (particles_.empty()) return create_particles();
  const dsw_particle_id particle = particles_[rng_.below(particles_.size())];
  Vec from = {0, 0, 0};
  dsw_particle_get_position(scene(), particle, from.data(), nullptr);
  const Vec target = places_.target(from);
  dsw_cast_options options = defaults(dsw_cast_options_init);
  options.max_volumes = rng_.chance(0.1) ? 1 + rng_.below(4) : 0;
  dsw_flight flight;
  return dsw_particle_move(scene(), particle, target.data(), &options, &flight);
}

dsw_status Life::cast_from_particles() {
  std::vector<double> to;
  for (size_t i = 0; i < particles_.size(); ++i) append(to, places_.site());
  std::vector<dsw_flight> flights(particles_.size());
  return dsw_scene_cast_from_particles(scene(), particles_.data(), particles_.size(), to.data(), 0, nullptr,
                                       flights.data());
}

dsw_status Life::destroy_particle() {
  if (particles_.empty()) return create_particles();
  const size_t i = rng_.below(particles_.size());
  const dsw_particle_id particle = particles_[i];
  particles_.erase(particles_.begin() + static_cast<std::ptrdiff_t>(i));
  return dsw_particle_destroy(scene(), particle);
}

size_t Life::bend_points(std::vector<double>*& to) {
  const double* now = nullptr;
  size_t count = 0;
  dsw_environment_get_points(environment(), &now, &count);
  std::vector<double>& next = lent_[now == lent_[0].data() ? 1 : 0];
  const size_t room = count + 200;
  next.assign(dimension() * room, 0);
  std::copy_n(now, dimension() * count, next.begin());
  // A wave without sines: what goes to and fro between -1 and 1.
  const double phase = 0.07 * ++bends_, height = (kind_.marked > 0.15 ? 0.4 : 0.2) * unit();
  const auto wave = [](double x) { return 4 * std::fabs(x - std::floor(x + 0.5)) - 1; };
  const bool whole = rng_.chance(0.7);
  for (size_t i = 0; i < next.size() && i < first_points_.size(); ++i) {
    const size_t axis = i % dimension(), other = i - axis + (axis + 1) % dimension();
    if (whole) next[i] = first_points_[i] + height * wave(first_points_[other] / (3 * unit()) + phase);
    if (rng_.chance(0.02)) next[i] += rng_.range(-0.6, 0.6) * unit();
  }
  to = &next;
  return count;
}

dsw_status Life::bend() {
  std::vector<double>* next = nullptr;
  const size_t count = bend_points(next);
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.method = rng_.chance(0.8) ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
  options.response = static_cast<dsw_wall_response>(rng_.below(4));
  options.invalid = static_cast<dsw_invalid_response>(rng_.below(3));
  options.most_halvings = 1 + rng_.below(4);
  options.point_room = next->size() / dimension();
  return dsw_environment_deform(environment(), next->data(), count, &options, nullptr);
}

dsw_status Life::bend_together() {
  if (some_mover() == nullptr) return create_body();
  std::vector<double>* next = nullptr;
  const size_t count = bend_points(next);
  std::vector<double> targets;
  const std::vector<dsw_body_id> bodies = all_movers(targets);
  dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
  options.point_room = next->size() / dimension();
  if (rng_.chance(0.6)) {
    options.stop = DSW_TOGETHER_STOP_FEATURE;
    options.response = static_cast<dsw_together_response>(rng_.below(3));
  }
  return dsw_scene_deform(scene(), next->data(), count, bodies.data(), bodies.size(), targets.data(),
                          targets.size() / dimension(), 0, &options, nullptr, nullptr);
}

dsw_status Life::mark() {
  const dsw_mark wanted = rng_.chance(0.45) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  std::vector<dsw_volume_id> volumes;
  for (uint32_t n = 1 + rng_.below(6); n > 0; --n) volumes.push_back(some_volume());
  const dsw_volume_id of = volumes[0];
  const uint32_t kind = rng_.below(6), local = rng_.below(6);
  const dsw_face_id face = {of.index, of.generation, local};
  const dsw_edge_id edge = {of.index, of.generation, local};
  dsw_vertex_id corners[64];
  size_t corner_count = 0;
  switch (kind) {
    case 0:
      return dsw_environment_mark_faces(environment(), &face, 1, wanted);
    case 1:
      if (dimension() == 3) return dsw_environment_mark_edges(environment(), &edge, 1, wanted);
      [[fallthrough]];
    case 2:
      dsw_environment_copy_vertices(environment(), {DSW_CELL_VOLUME, of.index, of.generation, 0}, corners, 64,
                                    &corner_count);
      return dsw_environment_mark_vertices(environment(), corners, std::min<size_t>(corner_count, 1), wanted);
    case 3:
      return dsw_environment_mark_region(environment(), rng_.between(0, 2), wanted, DSW_MARK_SKIP_OCCUPIED, nullptr,
                                         nullptr);
    case 4:
      return dsw_environment_mark_between(environment(), 0, rng_.between(1, 2), wanted, nullptr);
    default:
      return dsw_environment_mark_volumes(environment(), volumes.data(), volumes.size(), wanted,
                                          rng_.chance(0.5) ? uint32_t{DSW_MARK_SKIP_OCCUPIED} : 0, nullptr);
  }
}

dsw_status Life::call() {
  // The first byte chooses the call, see Calls::make.
  program_.assign(1, static_cast<uint8_t>(kind_.first_call + rng_.below(kind_.last_call - kind_.first_call)));
  while (program_.size() < 160) program_.push_back(static_cast<uint8_t>(rng_.below(256)));
  bytes_ = dsw_fuzz::Bytes(program_.data(), program_.size());
  return calls_->make();
}

}  // namespace dsw::portable
