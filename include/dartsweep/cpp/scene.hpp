// A scene, with its particles and bodies. Each method is the C function of its name.
#pragma once

#include <algorithm>

#include "dartsweep/cpp/environment.hpp"

namespace dartsweep {

class Scene {
 public:
  explicit Scene(Environment &environment, const dsw_scene_desc *desc = nullptr)
      : Scene(Made(), environment, [desc](dsw_environment *in, dsw_scene **out) {
          return dsw_scene_create(in, desc, out);
        }) {}

  static Scene load(Environment &environment, View<const std::uint8_t> block) {
    return Scene(Made(), environment, [block](dsw_environment *in, dsw_scene **out) {
      return dsw_scene_load(in, block.data, block.count, out);
    });
  }

  Array<std::uint8_t> save() const {
    const SceneReading self(*state_);
    return filled<std::uint8_t>([&](void *block, std::size_t capacity, std::size_t *size) {
      return dsw_scene_save(self.handle, block, capacity, size);
    });
  }

  /** May be repeated. The bodies of the scene are closed with it. */
  void close() { state_->close(); }
  bool is_closed() const {
    const Reading hold(state_->environment->mutex);
    return state_->handle == nullptr;
  }
  const std::shared_ptr<SceneState> &state() const { return state_; }
#ifndef SWIG
  /** For C functions, such as those that lend results. It lives as long as this object, unless that
   * is closed. */
  dsw_scene *handle() const { return state_->handle; }
#endif
  // The dimension of the scene's environment.
  std::uint32_t dimension() const { return state_->environment->dimension; }

  dsw_statistics get_statistics() const {
    const SceneReading self(*state_);
    dsw_statistics out = {};
    out.struct_size = sizeof out;
    check(dsw_scene_get_statistics(self.handle, &out));
    return out;
  }
  void reset_statistics() {
    const SceneWriting self(*state_);
    check(dsw_scene_reset_statistics(self.handle));
  }
  std::uint64_t get_memory_bytes() const { return one<std::uint64_t>(dsw_scene_get_memory_bytes); }
  std::size_t get_particle_count() const { return one<std::size_t>(dsw_scene_get_particle_count); }
  std::size_t get_body_count() const { return one<std::size_t>(dsw_scene_get_body_count); }

  Array<dsw_particle_id> get_particle_ids() const {
    return ids<dsw_particle_id>(dsw_scene_get_particle_ids);
  }
  Array<dsw_body_id> get_body_ids() const { return ids<dsw_body_id>(dsw_scene_get_body_ids); }

  /** Into a file. DSW_RECORDING_LATEST and a null path keep the recording for write_bug_report. */
  void start_recording(const char *path, std::uint32_t flags = 0) {
    dsw_recording_desc desc;
    dsw_recording_desc_init(&desc, sizeof desc);
    desc.path = path;
    desc.flags = flags;
    const WholeWriting self(*state_);
    check(dsw_scene_start_recording(self.handle, &desc));
  }
  void stop_recording() {
    const WholeWriting self(*state_);
    check(dsw_scene_stop_recording(self.handle));
  }
  // A bug report of the last recorded call into a file.
  dsw_validation write_bug_report(const char *path, const char *note = nullptr) {
    dsw_bug_report_desc desc;
    dsw_bug_report_desc_init(&desc, sizeof desc);
    desc.path = path;
    desc.note = note;
    dsw_validation out = {};
    out.struct_size = sizeof out;
    const WholeWriting self(*state_);
    check(dsw_scene_write_bug_report(self.handle, &desc, &out));
    return out;
  }

  // --- particles
  dsw_particle_id create_particle(const Point &position, dsw_volume_id hint = {}) {
    const SceneWriting self(*state_);
    dsw_particle_id out = {};
    check(dsw_particle_create(self.handle, in_dimension(dimension(), position), hint, &out));
    return out;
  }
  void create_particles(Points positions, View<const dsw_volume_id> hints,
                        View<dsw_particle_id> particles) {
    count_points(dimension(), positions);
    optional_count("hints", hints, positions.count);
    same_count("particles", particles.count, positions.count);
    const SceneWriting self(*state_);
    check(dsw_scene_create_particles(self.handle, positions.data, positions.count,
                                     positions.stride_bytes, hints.data, particles.data, nullptr));
  }
  void destroy_particle(dsw_particle_id particle) {
    const SceneWriting self(*state_);
    check(dsw_particle_destroy(self.handle, particle));
  }
  Particle get_particle_position(dsw_particle_id particle) const {
    const SceneReading self(*state_);
    double xyz[3] = {};
    Particle out = {};
    check(dsw_particle_get_position(self.handle, particle, xyz, &out.volume));
    out.position = {xyz[0], xyz[1], xyz[2]};
    return out;
  }
  dsw_cell get_particle_cell(dsw_particle_id particle) const {
    const SceneReading self(*state_);
    dsw_cell out = {};
    check(dsw_particle_get_state(self.handle, particle, &out, nullptr));
    return out;
  }
  /** The face of its volume that stopped the particle last, or the null cell. */
  dsw_cell get_particle_aim(dsw_particle_id particle) const {
    const SceneReading self(*state_);
    dsw_cell out = {};
    check(dsw_particle_get_state(self.handle, particle, nullptr, &out));
    return out;
  }
  void get_particle_positions(View<const dsw_particle_id> particles, PointsOut positions,
                              View<dsw_volume_id> volumes = {}) const {
    count_points(dimension(), positions);
    optional_count("positions", positions, particles.count);
    optional_count("volumes", volumes, particles.count);
    const SceneReading self(*state_);
    check(dsw_scene_get_particle_positions(self.handle, particles.data, particles.count,
                                           positions.data, 0, volumes.data));
  }
  dsw_flight move_particle(dsw_particle_id particle, const Point &target,
                           const dsw_cast_options *options = nullptr) {
    const SceneWriting self(*state_);
    dsw_flight out;
    check(
        dsw_particle_move(self.handle, particle, in_dimension(dimension(), target), options, &out));
    return out;
  }
  // `flights` may be left out, here and below.
  void move_particles(View<const dsw_particle_id> particles, Points targets,
                      const dsw_cast_options *options, View<dsw_flight> flights) {
    count_points(dimension(), targets);
    same_count("targets", targets.count, particles.count);
    optional_count("flights", flights, particles.count);
    const SceneWriting self(*state_);
    check(dsw_scene_move_particles(self.handle, particles.data, particles.count, targets.data,
                                   targets.stride_bytes, options, flights.data));
  }
  void cast_from_particles(View<const dsw_particle_id> particles, Points to,
                           const dsw_cast_options *options, View<dsw_flight> flights) {
    count_points(dimension(), to);
    same_count("to", to.count, particles.count);
    same_count("flights", flights.count, particles.count);
    const SceneWriting self(*state_);
    check(dsw_scene_cast_from_particles(self.handle, particles.data, particles.count, to.data,
                                        to.stride_bytes, options, flights.data));
  }
  void cast(Points from, Points to, View<const dsw_volume_id> starts,
            const dsw_cast_options *options, View<dsw_flight> flights,
            View<dsw_contact_partner> partners) {
    count_points(dimension(), from, to);
    same_count("to", to.count, from.count);
    optional_count("starts", starts, from.count);
    same_count("flights", flights.count, from.count);
    same_count("partners", partners.count, from.count);
    const std::size_t stride = common_stride(from, to);
    const SceneWriting self(*state_);
    check(dsw_scene_cast(self.handle, from.count, starts.data, from.data, to.data, stride, options,
                         flights.data, partners.data));
  }
  void find_nearest(Points points, double radius, View<const dsw_volume_id> hints,
                    View<dsw_nearest> nearest, View<dsw_contact_partner> partners,
                    View<dsw_volume_id> volumes = {}, View<std::int32_t> locations = {}) {
    count_points(dimension(), points);
    check_nearest(points.count, hints, nearest.count, volumes, locations);
    same_count("partners", partners.count, points.count);
    const SceneWriting self(*state_);
    check(dsw_scene_find_nearest(self.handle, points.data, points.count, points.stride_bytes,
                                 hints.data, radius, nearest.data, partners.data, volumes.data,
                                 reinterpret_cast<dsw_location *>(locations.data)));
  }
  /** Crossings of the last move of particles. */
  Array<dsw_crossing> get_crossings() const {
    const SceneReading self(*state_);
    const dsw_crossing *crossings = nullptr;
    const std::size_t *first = nullptr;
    std::size_t count = 0;
    check(dsw_scene_get_crossings(self.handle, &crossings, &first, &count));
    return Array<dsw_crossing>(crossings, count ? first[count] : 0);
  }
  /** Where the crossings of each flight begin, and the end. */
  Array<std::size_t> get_crossing_offsets() const {
    const SceneReading self(*state_);
    const dsw_crossing *crossings = nullptr;
    const std::size_t *first = nullptr;
    std::size_t count = 0;
    check(dsw_scene_get_crossings(self.handle, &crossings, &first, &count));
    return count ? Array<std::size_t>(first, count + 1) : Array<std::size_t>();
  }

  /** Particles that came to an exit in the last move of particles. */
  Array<dsw_exit> get_exits() const { return list<dsw_exit>(dsw_scene_get_exits); }

  // --- what was in the way, or moved
  Array<dsw_particle_id> get_occupants() const {
    return list<dsw_particle_id>(dsw_scene_get_occupants);
  }
  Array<dsw_body_id> get_occupant_bodies() const {
    return list<dsw_body_id>(dsw_scene_get_occupant_bodies);
  }
  Array<std::uint32_t> get_offending_edges() const {  // Two indices for each.
    const SceneReading self(*state_);
    return copied<std::uint32_t>([&](const std::uint32_t **out, std::size_t *count) {
      const dsw_status status = dsw_scene_get_offending_edges(self.handle, out, count);
      *count *= 2;
      return status;
    });
  }

  // --- bodies; class Body has the calls on one
  dsw_body_id create_body(Points positions, View<const std::uint32_t> edges = {},
                          View<const std::uint32_t> face_offsets = {},
                          View<const std::uint32_t> face_corners = {},
                          View<const dsw_volume_id> hints = {},
                          const dsw_body_desc *desc = nullptr) {
    dsw_body_desc all = or_defaults(desc);
    same_count("indices of edges", edges.count, edges.count / 2 * 2);
    count_points(dimension(), positions);
    optional_count("hints", hints, positions.count);
    all.positions = positions.data;
    all.vertex_count = positions.count;
    all.stride_bytes = positions.stride_bytes;
    all.hints = hints.data;
    all.edges = edges.data;
    all.edge_count = edges.count / 2;
    all.face_offsets = face_offsets.data;
    all.face_corners = face_corners.data;
    all.face_count = face_offsets.count ? face_offsets.count - 1 : 0;
    all.face_corner_count = face_corners.count;
    const SceneWriting self(*state_);
    dsw_body_id out = {};
    check(dsw_body_create(self.handle, &all, &out));
    return out;
  }
  void move_bodies(View<const dsw_body_id> bodies, Points targets, const dsw_move_options *options,
                   View<dsw_move_report> reports) {
    count_points(dimension(), targets);
    optional_count("reports", reports, bodies.count);
    const SceneWriting self(*state_);
    check(dsw_scene_move_bodies(self.handle, bodies.data, bodies.count, targets.data, targets.count,
                                targets.stride_bytes, options, reports.data));
  }
  /** Cuts along a blade, all bodies unless some are named; returns how many cuts there are. */
  std::size_t cut_bodies(Points blade, std::uint32_t rows, std::uint32_t columns,
                         View<const dsw_body_id> bodies = {}) {
    dsw_cut_desc desc = defaults<dsw_cut_desc>();
    count_points(dimension(), blade);
    same_count("blade", blade.count, std::size_t{rows} * columns);
    desc.points = blade.data;
    desc.point_stride_bytes = blade.stride_bytes;
    desc.rows = rows;
    desc.columns = columns;
    const SceneWriting self(*state_);
    std::size_t cuts = 0;
    check(dsw_scene_cut_bodies(self.handle, &desc, bodies.count ? bodies.data : nullptr,
                               bodies.count, &cuts));
    return cuts;
  }
  /** Where the last cut of bodies has cut. */
  Array<dsw_body_cut> get_body_cuts() const { return list<dsw_body_cut>(dsw_scene_get_body_cuts); }
  void move_together(View<const dsw_body_id> bodies, Points targets,
                     const dsw_together_options *options, View<dsw_move_report> reports) {
    count_points(dimension(), targets);
    optional_count("reports", reports, bodies.count);
    const SceneWriting self(*state_);
    check(dsw_scene_move_together(self.handle, bodies.data, bodies.count, targets.data,
                                  targets.count, targets.stride_bytes, options, reports.data));
  }
  /** The largest free part of steps; `places` have a point for each step. The environment stands still
   * unless there are `environment_steps`, numbers without gaps. */
  double step_fraction(View<const dsw_body_id> bodies, Points steps,
                       const dsw_together_options *options, PointsOut places,
                       View<double> fractions = {}, View<const double> environment_steps = {},
                       View<double> environment_places = {}) {
    count_points(dimension(), steps, places);
    optional_count("places", places, steps.count);
    optional_count("fractions", fractions, bodies.count);
    optional_count("environment_places", environment_places, environment_steps.count);
    const std::size_t points = environment_steps.count / dimension();
    same_count("environment_steps", environment_steps.count, points * dimension());
    const SceneWriting self(*state_);
    double fraction = 0;
    check(dsw_scene_step_fraction(self.handle, bodies.data, bodies.count, steps.data, steps.count,
                                  steps.stride_bytes, environment_steps.data, points, options,
                                  &fraction, fractions.data, places.data, environment_places.data));
    return fraction;
  }
  /** Takes 10 numbers for each body in `motions`: rotation, centre and translation of
   * dsw_rigid_motion. */
  void move_rigid(View<const dsw_body_id> bodies, View<const double> motions,
                  const dsw_together_options *options, View<dsw_move_report> reports) {
    static_assert(sizeof(dsw_rigid_motion) == 10 * sizeof(double), "motions are read as numbers");
    same_count("motions", motions.count, 10 * bodies.count);
    optional_count("reports", reports, bodies.count);
    const SceneWriting self(*state_);
    check(dsw_scene_move_rigid(self.handle, bodies.data, bodies.count,
                               reinterpret_cast<const dsw_rigid_motion *>(motions.data), options,
                               reports.data));
  }
  /** The environment reads `next` as after Environment::deform; `bodies` and `reports` may be left
   * out. */
  dsw_deform_report deform(Lent next, View<const dsw_body_id> bodies = {}, Points targets = {},
                           const dsw_scene_deform_options *options = nullptr,
                           View<dsw_move_report> reports = {}) {
    dsw_scene_deform_options all = or_defaults(options);
    count_points(dimension(), next, targets);
    optional_count("reports", reports, bodies.count);
    const WholeWriting self(*state_);
    const std::size_t count = read_count(state_->environment->handle, next, all);
    dsw_deform_report report = {};
    check(dsw_scene_deform(self.handle, next.data, count, bodies.data, bodies.count, targets.data,
                           targets.count, targets.stride_bytes, &all, &report, reports.data));
    auto &environment = *state_->environment;
    if (is_read(environment.handle, next)) environment.lent = std::move(next.owner);
    return report;
  }
  /** `next` as in deform, and `motions` as in move_rigid. */
  dsw_deform_report deform_rigid(Lent next, View<const dsw_body_id> bodies,
                                 View<const double> motions,
                                 const dsw_scene_deform_options *options = nullptr,
                                 View<dsw_move_report> reports = {}) {
    dsw_scene_deform_options all = or_defaults(options);
    count_points(dimension(), next);
    same_count("motions", motions.count, 10 * bodies.count);
    optional_count("reports", reports, bodies.count);
    const WholeWriting self(*state_);
    const std::size_t count = read_count(state_->environment->handle, next, all);
    dsw_deform_report report = {};
    check(dsw_scene_deform_rigid(self.handle, next.data, count, bodies.data, bodies.count,
                                 reinterpret_cast<const dsw_rigid_motion *>(motions.data), &all,
                                 &report, reports.data));
    auto &environment = *state_->environment;
    if (is_read(environment.handle, next)) environment.lent = std::move(next.owner);
    return report;
  }

 private:
  struct Made {};
  // make(environment, &scene) creates or loads it.
  template <class Make>
  Scene(Made, Environment &environment, Make make) : state_(std::make_shared<SceneState>()) {
    state_->environment = environment.state();
    const EnvironmentWriting parent(*state_->environment);
    check(make(parent.handle, &state_->handle));
    ++state_->environment->scenes;
  }
  template <class T, class Call>
  T one(Call call) const {
    const SceneReading self(*state_);
    T result = {};
    check(call(self.handle, &result));
    return result;
  }
  template <class T, class Call>
  Array<T> ids(Call call) const {
    const SceneReading self(*state_);
    return filled<T>([&](T *out, std::size_t capacity, std::size_t *count) {
      return call(self.handle, out, capacity, count);
    });
  }
  template <class T, class Call>
  Array<T> list(Call call) const {
    const SceneReading self(*state_);
    return copied<T>(
        [&](const T **out, std::size_t *count) { return call(self.handle, out, count); });
  }

  std::shared_ptr<SceneState> state_;
};

}  // namespace dartsweep
