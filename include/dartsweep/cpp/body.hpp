// A body: a scene and the id of a body in it. The scene owns the body.
#pragma once

#include "dartsweep/cpp/scene.hpp"

namespace dartsweep {

class Body {
 public:
  Body(Scene &scene, dsw_body_id id) : state_(scene.state()), id_(id) {}

  dsw_body_id id() const { return id_; }
  // The dimension of the scene's environment.
  std::uint32_t dimension() const { return state_->environment->dimension; }
  void destroy() { change(dsw_body_destroy); }

  dsw_body_counts get_counts() const {
    const SceneReading self(*state_);
    dsw_body_counts out = {};
    out.struct_size = sizeof out;
    check(dsw_body_get_counts(self.handle, id_, &out));
    return out;
  }
  dsw_level get_level() const { return one<dsw_level>(dsw_body_get_level); }
  void set_level(dsw_level level) { change(dsw_body_set_level, level); }
  BodyFilter get_filter() const {
    const SceneReading self(*state_);
    BodyFilter out = {};
    check(dsw_body_get_filter(self.handle, id_, &out.category, &out.mask));
    return out;
  }
  void set_filter(std::uint32_t category, std::uint32_t mask) {
    change(dsw_body_set_filter, category, mask);
  }
  double get_radius() const { return one<double>(dsw_body_get_radius); }
  void set_radius(double radius) { change(dsw_body_set_radius, radius); }
  // A lower bound of the least gap, at most `limit`.
  double find_least_gap(double limit) {
    double out = 0;
    change(dsw_body_find_least_gap, limit, &out);
    return out;
  }

  // --- penetrations of a body that was created with DSW_BODY_START_PENETRATING
  bool is_penetrating() const { return one<std::uint32_t>(dsw_body_is_penetrating) != 0; }
  Array<dsw_penetration> find_penetrations() {
    const SceneWriting self(*state_);
    return copied<dsw_penetration>([&](const dsw_penetration **out, std::size_t *count) {
      return dsw_body_find_penetrations(self.handle, id_, out, count);
    });
  }
  // Moves the body out, to the side of walls on which `inside` is, if that is given.
  Depenetration depenetrate(dsw_volume_id inside = {}, double max_distance = 0) {
    Depenetration out = {};
    std::uint32_t freed = 0;
    change(dsw_body_depenetrate, inside, max_distance, &freed, &out.distance);
    out.freed = freed != 0;
    return out;
  }

  // --- parts
  void get_positions(PointsOut positions, View<dsw_volume_id> volumes = {}) const {
    count_points(dimension(), positions);
    optional_count("volumes", volumes, positions.count);
    const SceneReading self(*state_);
    std::size_t count = 0;
    check(dsw_body_get_positions(self.handle, id_, positions.data, positions.count, 0, volumes.data,
                                 &count));
    same_count("positions", positions.count, count);
  }
  Array<dsw_body_vertex_id> get_vertex_ids() const {
    return fill<dsw_body_vertex_id>(dsw_body_get_vertex_ids);
  }
  Array<dsw_body_edge_id> get_edge_ids() const {
    return fill<dsw_body_edge_id>(dsw_body_get_edge_ids);
  }
  Array<dsw_body_edge_id> get_untested_edges() const {
    return fill<dsw_body_edge_id>(dsw_body_get_untested_edges);
  }
  Array<dsw_body_face_id> get_face_ids() const {
    return fill<dsw_body_face_id>(dsw_body_get_face_ids);
  }
  // Ends of one edge, corners of one triangle.
  Array<dsw_body_vertex_id> get_edge_ends(dsw_body_edge_id edge) const {
    return corners(2, dsw_body_get_edge_ends, edge);
  }
  Array<dsw_body_vertex_id> get_face_corners(dsw_body_face_id face) const {
    return corners(3, dsw_body_get_face_corners, face);
  }
  // These give 2 or 3 indices of vertices for each slot, for all edges or faces at once.
  Array<std::uint32_t> get_edge_indices() const {
    return all_corners(2, dsw_body_get_edge_indices);
  }
  Array<std::uint32_t> get_face_indices() const {
    return all_corners(3, dsw_body_get_face_indices);
  }
  dsw_body_vertex_id get_vertex_id(std::uint32_t index) const {
    const SceneReading self(*state_);
    dsw_body_vertex_id out = {};
    check(dsw_body_get_vertex_id(self.handle, id_, index, &out));
    return out;
  }
  dsw_body_vertex_id add_vertex(const Point &position, dsw_volume_id hint = {}) {
    dsw_body_vertex_id out = {};
    change(dsw_body_add_vertex, in_dimension(dimension(), position), hint, &out);
    return out;
  }
  dsw_body_edge_id add_edge(dsw_body_vertex_id a, dsw_body_vertex_id b) {
    dsw_body_edge_id out = {};
    change(dsw_body_add_edge, a, b, &out);
    return out;
  }
  dsw_body_face_id add_face(dsw_body_vertex_id a, dsw_body_vertex_id b, dsw_body_vertex_id c) {
    dsw_body_face_id out = {};
    change(dsw_body_add_face, a, b, c, &out);
    return out;
  }
  void remove_face(dsw_body_face_id face) { change(dsw_body_remove_face, face); }
  void remove_edge(dsw_body_edge_id edge) { change(dsw_body_remove_edge, edge); }
  void remove_vertex(dsw_body_vertex_id vertex) { change(dsw_body_remove_vertex, vertex); }
  dsw_body_edit split_edge(dsw_body_edge_id edge, double edge_parameter) {
    dsw_body_edit out = {};
    change(dsw_body_split_edge, edge, edge_parameter, &out);
    return out;
  }
  dsw_body_edit collapse_edge(dsw_body_edge_id edge, dsw_body_vertex_id vertex) {
    dsw_body_edit out = {};
    change(dsw_body_collapse_edge, edge, vertex, &out);
    return out;
  }

  // --- moves. Without `order` all vertices move, by index.
  dsw_move_report move(Points targets, const dsw_move_options *options = nullptr,
                       View<const std::uint32_t> order = {}) {
    dsw_move_report out = {};
    const Ordered ordered(options, order);
    count_points(dimension(), targets);
    change(dsw_body_move, targets.data, targets.count, targets.stride_bytes, ordered.get(), &out);
    return out;
  }
  dsw_move_report move_rigid(const dsw_rigid_motion &motion,
                             const dsw_move_options *options = nullptr,
                             View<const std::uint32_t> order = {}) {
    dsw_move_report out = {};
    const Ordered ordered(options, order);
    change(dsw_body_move_rigid, &motion, ordered.get(), &out);
    return out;
  }
  // The motion from where move_rigid has left the body to where it should be.
  dsw_rigid_motion get_motion_left() const {
    return one<dsw_rigid_motion>(dsw_body_get_motion_left);
  }
  // How far the body could go along paths through `poses`, which have 7 numbers each. Each path has
  // two of `indices`, or those from offsets[i] to offsets[i + 1].
  void find_free_fractions(const Point &centre, View<const double> poses,
                           View<const std::uint32_t> indices, View<const std::uint32_t> offsets,
                           View<dsw_free_fraction> fractions,
                           View<dsw_body_contact> contacts = {}) const {
    if (poses.count % 7 != 0)
      throw WrongSize("poses has " + std::to_string(poses.count) +
                      " numbers, must have 7 for each pose");
    const std::size_t paths = offsets.count ? offsets.count - 1 : indices.count / 2;
    same_count("fractions", fractions.count, paths);
    same_count("indices", indices.count, offsets.count ? offsets.data[paths] : 2 * paths);
    optional_count("contacts", contacts, paths);
    const SceneReading self(*state_);
    check(dsw_body_find_free_fractions(self.handle, id_, in_dimension(dimension(), centre),
                                       poses.data, poses.count / 7, indices.data,
                                       offsets.count ? offsets.data : nullptr, paths,
                                       fractions.data, contacts.data));
  }
  // By vertex slot, as positions; empty after other moves than those at once.
  Array<double> get_ways_left() const {
    const SceneReading self(*state_);
    const double *ways = nullptr;
    std::size_t count = 0;
    check(dsw_body_get_ways_left(self.handle, id_, &ways, &count));
    return Array<double>(ways, dimension() * count);
  }
  Array<dsw_body_contact> get_contacts() const {
    return list<dsw_body_contact>(dsw_body_get_contacts);
  }
  Array<dsw_contact_partner> get_contact_partners() const {
    return list<dsw_contact_partner>(dsw_body_get_contact_partners);
  }
  Array<dsw_previous_contact> get_previous_contacts() const {
    return list<dsw_previous_contact>(dsw_body_get_previous_contacts);
  }
  Array<dsw_exit> get_exits() const { return list<dsw_exit>(dsw_body_get_exits); }
  Array<dsw_body_edit> get_edits() const { return list<dsw_body_edit>(dsw_body_get_edits); }

  // --- near rows: finds them, and returns how many there are
  std::size_t find_near_rows(const dsw_near_options *options = nullptr) {
    std::size_t count = 0;
    change(dsw_body_find_near_rows, options, &count);
    return count;
  }
  Array<dsw_near_row> get_near_rows() const { return list<dsw_near_row>(dsw_body_get_near_rows); }
  // Their Jacobian as compressed sparse rows.
  Array<std::uint32_t> get_near_offsets() const {
    return list<std::uint32_t>(dsw_body_get_near_offsets);
  }
  Array<std::uint32_t> get_near_columns() const {
    return list<std::uint32_t>(dsw_body_get_near_columns);
  }
  Array<double> get_near_values() const { return list<double>(dsw_body_get_near_values); }

 private:
  // Options with the order of vertices, or as they came where there is none.
  class Ordered {
   public:
    Ordered(const dsw_move_options *options, View<const std::uint32_t> order) : given_(options) {
      if (!order.data) return;
      own_ = or_defaults(options);
      own_.order = order.data;
      own_.order_count = order.count;
      given_ = &own_;
    }
    const dsw_move_options *get() const { return given_; }

   private:
    dsw_move_options own_;
    const dsw_move_options *given_;
  };

  template <class T, class Call>
  T one(Call call) const {
    const SceneReading self(*state_);
    T result = {};
    check(call(self.handle, id_, &result));
    return result;
  }
  template <class T, class Call>
  Array<T> list(Call call) const {
    const SceneReading self(*state_);
    return copied<T>(
        [&](const T **out, std::size_t *count) { return call(self.handle, id_, out, count); });
  }
  template <class T, class Call>
  Array<T> fill(Call call) const {
    const SceneReading self(*state_);
    return filled<T>([&](T *out, std::size_t capacity, std::size_t *count) {
      return call(self.handle, id_, out, capacity, count);
    });
  }
  template <class Call, class Id>
  Array<dsw_body_vertex_id> corners(std::size_t count, Call call, Id id) const {
    const SceneReading self(*state_);
    Array<dsw_body_vertex_id> out(count);
    check(call(self.handle, id_, id, out.data()));
    return out;
  }
  template <class Call>
  Array<std::uint32_t> all_corners(std::size_t width, Call call) const {
    const SceneReading self(*state_);
    std::size_t slots = 0;
    const dsw_status status = call(self.handle, id_, nullptr, 0, &slots);
    if (status != DSW_STATUS_BUFFER_TOO_SMALL) check(status);
    Array<std::uint32_t> out(width * slots);
    if (slots) check(call(self.handle, id_, out.data(), slots, &slots));
    return out;
  }
  template <class Call, class... Arguments>
  void change(Call call, Arguments... arguments) {
    const SceneWriting self(*state_);
    check(call(self.handle, id_, arguments...));
  }

  std::shared_ptr<SceneState> state_;
  dsw_body_id id_;
};

}  // namespace dartsweep
