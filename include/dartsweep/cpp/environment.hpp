// An environment. Each method is the C function of its name, whose comment says what it does.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <set>

#include "dartsweep/cpp/handles.hpp"
#include "dartsweep/cpp/results.hpp"

namespace dartsweep {

class Environment {
 public:
  /** The scalars of `desc` count; its arrays are the arguments. Empty arrays are left out. */
  Environment(Points points, Indices connectivity, Indices offsets = {},
              View<const std::uint8_t> cell_types = {}, View<const std::int32_t> regions = {},
              View<const std::uint32_t> tags = {}, Indices faces = {}, Indices face_locations = {},
              const dsw_environment_desc *desc = nullptr, const Context *context = nullptr)
      : Environment() {
    dsw_environment_desc all = or_defaults(desc);
    if (all.flags & DSW_ENVIRONMENT_BORROW_POINTS)
      throw Unsupported("points can be lent by Environment.deform only");
    state_->dimension = all.dimension == 2 ? 2 : 3;
    same_width(connectivity, {&offsets, &faces, &face_locations});
    set_cells(all, points, connectivity, offsets, cell_types, regions, tags);
    leave_out_empty(faces, face_locations);
    if (faces.count) same_count("face_locations", face_locations.count, all.volume_count);
    all.faces = faces.data;
    all.faces_count = faces.count;
    all.face_locations = face_locations.data;
    if (context) state_->context = context->state();
    report_.struct_size = sizeof report_;
    check(dsw_environment_create(state_->context.get(), &all, &state_->handle, &report_));
  }

#ifndef SWIG
  /** Cells of one type. Triangles and quads make an environment of the plane. */
  static Environment of(dsw_cell_type type, Points points, Indices connectivity) {
    dsw_environment_desc desc = defaults<dsw_environment_desc>();
    desc.uniform_cell_type = type;
    if (type == DSW_CELL_TYPE_TRIANGLE || type == DSW_CELL_TYPE_QUAD) desc.dimension = 2;
    return Environment(points, connectivity, {}, {}, {}, {}, {}, {}, &desc);
  }
#endif

  static Environment load(View<const std::uint8_t> block, const Context *context = nullptr) {
    Environment loaded;
    if (context) loaded.state_->context = context->state();
    check(dsw_environment_load(loaded.state_->context.get(), block.data, block.count,
                               &loaded.state_->handle));
    loaded.state_->dimension = loaded.info().dimension;
    return loaded;
  }

  Array<std::uint8_t> save() const {
    const EnvironmentReading self(*state_);
    return filled<std::uint8_t>([&](void *block, std::size_t capacity, std::size_t *size) {
      return dsw_environment_save(self.handle, block, capacity, size);
    });
  }

  /** `volume_map`: for each volume index of this environment, the volume of the result. */
  Environment coarsen(const dsw_coarsen_options *options = nullptr,
                      View<std::uint32_t> volume_map = {}) const {
    const EnvironmentReading self(*state_);
    Environment result;
    result.state_->context = state_->context;
    result.state_->dimension = state_->dimension;
    check(dsw_environment_coarsen(self.handle, options, &result.state_->handle, volume_map.data,
                                  volume_map.count, nullptr));
    return result;
  }

  /** May be repeated. Scenes of the environment go on. */
  void close() {
    const Writing hold(state_->mutex);
    state_->closed = true;
    state_->destroy_if_unused();
  }
  bool is_closed() const {
    const Reading hold(state_->mutex);
    return state_->closed;
  }
  const std::shared_ptr<EnvironmentState> &state() const { return state_; }
#ifndef SWIG
  /** For C functions. It lives as long as this object, unless that is closed. */
  dsw_environment *handle() const { return state_->handle; }
#endif

  /** 2 in the plane, else 3. */
  std::uint32_t dimension() const { return state_->dimension; }
  /** What creation found; zeros if the environment was loaded. */
  dsw_build_report build_report() const { return report_; }

  dsw_environment_info info() const {
    const EnvironmentReading self(*state_);
    dsw_environment_info info = {};
    info.struct_size = sizeof info;
    check(dsw_environment_get_info(self.handle, &info));
    return info;
  }
  void check_all() const {
    const EnvironmentReading self(*state_);
    check(dsw_environment_check(self.handle, nullptr));
  }

  // --- cells
  dsw_volume_id get_volume_id(std::uint32_t index) const {
    return one<dsw_volume_id>(dsw_environment_get_volume_id, index);
  }
  dsw_vertex_id get_vertex_id(std::uint32_t index) const {
    return one<dsw_vertex_id>(dsw_environment_get_vertex_id, index);
  }
  Point get_vertex_position(dsw_vertex_id vertex) const {
    return point(dsw_environment_get_vertex_position, vertex);
  }
  Point get_centre(dsw_volume_id volume) const { return point(dsw_environment_get_centre, volume); }
  VolumeCounts get_volume_counts(dsw_volume_id volume) const {
    const EnvironmentReading self(*state_);
    VolumeCounts out = {};
    check(dsw_environment_get_volume_counts(self.handle, volume, &out.type, &out.vertices,
                                            &out.edges, &out.faces));
    return out;
  }
  dsw_face_id get_face_id(dsw_volume_id volume, std::uint32_t local) const {
    return one<dsw_face_id>(dsw_environment_get_face_id, volume, local);
  }
  dsw_edge_id get_edge_id(dsw_volume_id volume, std::uint32_t local) const {
    return one<dsw_edge_id>(dsw_environment_get_edge_id, volume, local);
  }
  Array<dsw_vertex_id> copy_vertices(dsw_cell cell) const {
    const EnvironmentReading self(*state_);
    return filled<dsw_vertex_id>([&](dsw_vertex_id *out, std::size_t capacity, std::size_t *count) {
      return dsw_environment_copy_vertices(self.handle, cell, out, capacity, count);
    });
  }
  FaceVolumes get_face_volumes(dsw_face_id face) const {
    const EnvironmentReading self(*state_);
    FaceVolumes out = {};
    check(dsw_environment_get_face_volumes(self.handle, face, &out.near_side, &out.far_side));
    return out;
  }
  Neighbour get_neighbour(dsw_volume_id volume, std::uint32_t local) const {
    const EnvironmentReading self(*state_);
    Neighbour out = {};
    int impassable = 0;
    check(dsw_environment_get_neighbour(self.handle, volume, local, &out.volume, &impassable));
    out.impassable = impassable != 0;
    return out;
  }
  Array<dsw_face_id> find_faces(View<const std::size_t> offsets,
                                View<const std::uint32_t> indices) const {
    if (offsets.count == 0 || offsets.data[offsets.count - 1] > indices.count)
      throw WrongSize("offsets end beyond the indices");
    const EnvironmentReading self(*state_);
    Array<dsw_face_id> out(offsets.count - 1);
    check(dsw_environment_find_faces(self.handle, out.size(), offsets.data, indices.data,
                                     out.data(), nullptr));
    return out;
  }
  Array<dsw_edge_id> find_edges(View<const std::uint32_t> indices) const {
    const EnvironmentReading self(*state_);
    same_count("indices of pairs", indices.count, indices.count / 2 * 2);
    Array<dsw_edge_id> out(indices.count / 2);
    check(dsw_environment_find_edges(self.handle, out.size(), indices.data, out.data(), nullptr));
    return out;
  }
  std::int32_t get_region(dsw_volume_id volume) const {
    return one<std::int32_t>(dsw_environment_get_region, volume);
  }
#ifndef SWIG
  /** The labels of the regions that have volumes, in order. */
  Array<std::int32_t> get_region_labels() const {
    const EnvironmentReading self(*state_);
    dsw_environment_info counts = {};
    counts.struct_size = sizeof counts;
    check(dsw_environment_get_info(self.handle, &counts));
    std::set<std::int32_t> labels;
    for (std::uint32_t index = 0; index < counts.volume_index_count; ++index) {
      dsw_volume_id volume = {};
      std::int32_t label = 0;
      if (dsw_environment_get_volume_id(self.handle, index, &volume) != DSW_STATUS_OK) continue;
      check(dsw_environment_get_region(self.handle, volume, &label));
      labels.insert(label);
    }
    Array<std::int32_t> out(labels.size());
    std::copy(labels.begin(), labels.end(), out.data());
    return out;
  }
#endif
  std::uint32_t get_parent(dsw_volume_id volume) const {
    return one<std::uint32_t>(dsw_environment_get_parent, volume);
  }
  std::uint32_t get_tag(dsw_volume_id volume) const {
    return one<std::uint32_t>(dsw_environment_get_tag, volume);
  }
  void set_tag(dsw_volume_id volume, std::uint32_t tag) {
    change(dsw_environment_set_tag, volume, tag);
  }
  bool is_valid(dsw_volume_id volume) const {
    return one<int>(dsw_environment_is_valid, volume) != 0;
  }
  Array<double> get_points() const {
    const EnvironmentReading self(*state_);
    const double *points = nullptr;
    std::size_t count = 0;
    check(dsw_environment_get_points(self.handle, &points, &count));
    return Array<double>(points, dimension() * count);
  }

  // --- queries
  Located locate(const Point &point, dsw_volume_id hint = {}) const {
    const EnvironmentReading self(*state_);
    Located out = {};
    check(dsw_environment_locate(self.handle, in(point), hint, &out.volume, &out.location));
    return out;
  }
  void locate_points(Points points, View<const dsw_volume_id> hints, View<dsw_volume_id> volumes,
                     View<std::int32_t> locations = {}) const {
    static_assert(sizeof(dsw_location) == sizeof(std::int32_t),
                  "locations are written as integers");
    count_points(dimension(), points);
    optional_count("hints", hints, points.count);
    same_count("volumes", volumes.count, points.count);
    optional_count("locations", locations, points.count);
    const EnvironmentReading self(*state_);
    check(dsw_environment_locate_points(self.handle, points.data, points.count, points.stride_bytes,
                                        hints.data, volumes.data,
                                        reinterpret_cast<dsw_location *>(locations.data)));
  }
  dsw_cell classify(const Point &point, dsw_volume_id volume) const {
    return one<dsw_cell>(dsw_environment_classify, in(point), volume);
  }
  dsw_flight cast(const Point &from, const Point &to, dsw_volume_id start = {},
                  const dsw_cast_options *options = nullptr) const {
    return one<dsw_flight>(dsw_environment_cast, start, in(from), in(to), options);
  }
  void cast_segments(Points from, Points to, View<const dsw_volume_id> starts,
                     const dsw_cast_options *options, View<dsw_flight> flights) const {
    count_points(dimension(), from, to);
    same_count("to", to.count, from.count);
    optional_count("starts", starts, from.count);
    same_count("flights", flights.count, from.count);
    const std::size_t stride = common_stride(from, to);
    const EnvironmentReading self(*state_);
    check(dsw_environment_cast_segments(self.handle, from.count, starts.data, from.data, to.data,
                                        stride, options, flights.data));
  }
  Array<dsw_crossing> cast_path(const Point &from, const Point &to, dsw_volume_id start = {},
                                const dsw_cast_options *options = nullptr) const {
    const EnvironmentReading self(*state_);
    return filled<dsw_crossing>([&](dsw_crossing *out, std::size_t capacity, std::size_t *count) {
      return dsw_environment_cast_path(self.handle, start, in(from), in(to), options, out, capacity,
                                       count, nullptr);
    });
  }
  dsw_nearest find_nearest(const Point &point, double radius, dsw_volume_id volume = {}) const {
    return one<dsw_nearest>(dsw_environment_find_nearest, in(point), volume, radius);
  }
  void find_nearest_to_points(Points points, double radius, View<const dsw_volume_id> hints,
                              View<dsw_nearest> nearest, View<dsw_volume_id> volumes = {},
                              View<std::int32_t> locations = {}) const {
    count_points(dimension(), points);
    check_nearest(points.count, hints, nearest.count, volumes, locations);
    const EnvironmentReading self(*state_);
    check(dsw_environment_find_nearest_to_points(
        self.handle, points.data, points.count, points.stride_bytes, hints.data, radius,
        nearest.data, volumes.data, reinterpret_cast<dsw_location *>(locations.data)));
  }
  void find_nearest_to_segments(Points from, Points to, double radius,
                                View<const dsw_volume_id> hints, View<dsw_segment_nearest> nearest,
                                View<dsw_volume_id> volumes = {},
                                View<std::int32_t> locations = {}) const {
    count_points(dimension(), from, to);
    same_count("to", to.count, from.count);
    check_nearest(from.count, hints, nearest.count, volumes, locations);
    const std::size_t stride = common_stride(from, to);
    const EnvironmentReading self(*state_);
    check(dsw_environment_find_nearest_to_segments(
        self.handle, from.count, hints.data, from.data, to.data, stride, radius, nearest.data,
        volumes.data, reinterpret_cast<dsw_location *>(locations.data)));
  }
  void find_signed_distances(Points points, View<double> distances,
                             View<dsw_nearest> nearest = {}) const {
    count_points(dimension(), points);
    same_count("distances", distances.count, points.count);
    optional_count("nearest", nearest, points.count);
    const EnvironmentReading self(*state_);
    check(dsw_environment_find_signed_distances(self.handle, points.data, points.count,
                                                points.stride_bytes, distances.data, nearest.data));
  }
  void find_inside(Points points, double by, View<const dsw_volume_id> hints, PointsOut inside,
                   View<dsw_volume_id> volumes = {}) const {
    count_points(dimension(), points);
    count_points(dimension(), inside);
    optional_count("hints", hints, points.count);
    same_count("inside", inside.count, points.count);
    optional_count("volumes", volumes, points.count);
    const EnvironmentReading self(*state_);
    check(dsw_environment_find_inside(self.handle, points.data, points.count, points.stride_bytes,
                                      hints.data, by, inside.data, volumes.data));
  }
  void sweep_edges(Points from, Points to, Points fixed, View<const dsw_volume_id> starts,
                   const dsw_sweep_options *options, View<dsw_sweep> sweeps) const {
    count_points(dimension(), from, to, fixed);
    same_count("to", to.count, from.count);
    same_count("fixed", fixed.count, from.count);
    optional_count("starts", starts, from.count);
    same_count("sweeps", sweeps.count, from.count);
    common_stride(from, to);
    const std::size_t stride = common_stride(from, fixed);
    const EnvironmentReading self(*state_);
    check(dsw_environment_sweep_edges(self.handle, from.count, starts.data, from.data, to.data,
                                      fixed.data, stride, options, sweeps.data));
  }
  dsw_cross_check cross_check(const dsw_body_contact &contact) const {
    return one<dsw_cross_check>(dsw_environment_cross_check, &contact);
  }

  // --- marks
  std::size_t mark_volumes(View<const dsw_volume_id> volumes, dsw_mark mark,
                           std::uint32_t flags = 0) {
    std::size_t skipped = 0;
    change(dsw_environment_mark_volumes, volumes.data, volumes.count, mark, flags, &skipped);
    return skipped;
  }
  void mark_faces(View<const dsw_face_id> faces, dsw_mark mark) {
    change(dsw_environment_mark_faces, faces.data, faces.count, mark);
  }
  void mark_edges(View<const dsw_edge_id> edges, dsw_mark mark) {
    change(dsw_environment_mark_edges, edges.data, edges.count, mark);
  }
  void mark_vertices(View<const dsw_vertex_id> vertices, dsw_mark mark) {
    change(dsw_environment_mark_vertices, vertices.data, vertices.count, mark);
  }
  Marked mark_region(std::int32_t region, dsw_mark mark, std::uint32_t flags = 0) {
    Marked out = {};
    change(dsw_environment_mark_region, region, mark, flags, &out.marked, &out.skipped);
    return out;
  }
  std::size_t mark_between(std::int32_t a, std::int32_t b, dsw_mark mark) {
    std::size_t marked = 0;
    change(dsw_environment_mark_between, a, b, mark, &marked);
    return marked;
  }
  void mark_exits(View<const dsw_face_id> faces, std::uint32_t patch) {
    change(dsw_environment_mark_exits, faces.data, faces.count, patch);
  }
  std::uint32_t get_exit(dsw_face_id face) const {
    return one<std::uint32_t>(dsw_environment_get_exit, face);
  }
  Array<dsw_face_id> get_exit_faces() const {
    const EnvironmentReading self(*state_);
    return filled<dsw_face_id>([&](dsw_face_id *faces, std::size_t capacity, std::size_t *count) {
      return dsw_environment_get_exit_faces(self.handle, faces, capacity, count);
    });
  }
  bool is_marked(dsw_cell cell) const { return one<int>(dsw_environment_is_marked, cell) != 0; }
  bool is_impassable(dsw_cell cell) const {
    return one<int>(dsw_environment_is_impassable, cell) != 0;
  }
  std::size_t get_mark_count(dsw_cell_kind kind) const {
    return one<std::size_t>(dsw_environment_get_mark_count, kind);
  }

  // --- changes of the topology (topology.h, surgery.h, carve.h, remesh.h)
  void sew_faces(View<const dsw_face_id> a, View<const dsw_face_id> b) {
    same_count("b", b.count, a.count);
    change(dsw_environment_sew_faces, a.data, b.data, a.count);
  }
  void unsew_face(dsw_face_id face) { change(dsw_environment_unsew_face, face); }
  // New vertices and volumes are those of get_volume_changes, and of the indices that follow.
  Array<dsw_volume_id> add_volumes(View<const dsw_vertex_id> vertices, Points points,
                                   Indices connectivity, Indices offsets = {},
                                   View<const std::uint8_t> cell_types = {},
                                   View<const std::int32_t> regions = {},
                                   View<const std::uint32_t> tags = {},
                                   View<const dsw_face_id> sew_to = {},
                                   const dsw_volumes_desc *desc = nullptr) {
    dsw_volumes_desc all = or_defaults(desc);
    same_width(connectivity, {&offsets});
    set_cells(all, points, connectivity, offsets, cell_types, regions, tags);
    all.vertices = vertices.data;
    all.vertex_count = vertices.count;
    all.sew_to = sew_to.data;
    all.sew_count = sew_to.count;
    Array<dsw_volume_id> volumes(all.volume_count);
    change(dsw_environment_add_volumes, &all, volumes.data(),
           static_cast<dsw_vertex_id *>(nullptr));
    return volumes;
  }
  void remove_volumes(View<const dsw_volume_id> volumes) {
    change(dsw_environment_remove_volumes, volumes.data, volumes.count);
  }
  dsw_volume_id merge_volumes(dsw_face_id face) {
    dsw_volume_id volume = {};
    change(dsw_environment_merge_volumes, face, &volume);
    return volume;
  }
  VolumeSplit split_volume(dsw_volume_id volume, View<const dsw_vertex_id> loop) {
    dsw_volume_id parts[2] = {};
    VolumeSplit out = {};
    change(dsw_environment_split_volume, volume, loop.data, loop.count, &parts[0], &out.face);
    out.left = parts[0];
    out.right = parts[1];
    return out;
  }
  dsw_face_id merge_faces(dsw_edge_id edge) {
    dsw_face_id face = {};
    change(dsw_environment_merge_faces, edge, &face);
    return face;
  }
  FaceSplit split_face(dsw_face_id face, dsw_vertex_id a, dsw_vertex_id b) {
    dsw_face_id parts[2] = {};
    FaceSplit out = {};
    change(dsw_environment_split_face, face, a, b, &parts[0], &out.edge);
    out.left = parts[0];
    out.right = parts[1];
    return out;
  }
  EdgeSplit split_edge(dsw_edge_id edge, double edge_parameter) {
    dsw_edge_id parts[2] = {};
    EdgeSplit out = {};
    change(dsw_environment_split_edge, edge, edge_parameter, &out.vertex, &parts[0]);
    out.first = parts[0];
    out.second = parts[1];
    return out;
  }
  dsw_edge_id merge_edges(dsw_edge_id edge, dsw_vertex_id vertex) {
    dsw_edge_id merged = {};
    change(dsw_environment_merge_edges, edge, vertex, &merged);
    return merged;
  }
  void collapse_edge(dsw_edge_id edge, dsw_vertex_id vertex) {
    change(dsw_environment_collapse_edge, edge, vertex);
  }

  // `blade` has rows * columns points, row by row.
  Change cut(Points blade, std::uint32_t rows, std::uint32_t columns,
             const dsw_cut_desc *desc = nullptr) {
    dsw_cut_desc all = or_defaults(desc);
    count_points(dimension(), blade);
    same_count("blade", blade.count, std::size_t{rows} * columns);
    all.points = blade.data;
    all.point_stride_bytes = blade.stride_bytes;
    all.rows = rows;
    all.columns = columns;
    return changed(dsw_environment_cut, &all);
  }
  Change tear_faces(View<const dsw_face_id> faces, View<const double> loads, double threshold) {
    same_count("loads", loads.count, faces.count);
    return changed(dsw_environment_tear_faces, faces.data, loads.data, faces.count, threshold);
  }
  Change open_crack(View<const dsw_cut_face> faces, const dsw_open_crack_desc &desc) {
    dsw_open_crack_desc all = desc;
    all.faces = faces.data;
    all.face_count = faces.count;
    return changed(dsw_environment_open_crack, &all);
  }
  Change carve(Points points, View<const std::uint32_t> triangles,
               const dsw_carve_desc *desc = nullptr) {
    dsw_carve_desc all = or_defaults(desc);
    count_points(dimension(), points);
    same_count("corners of triangles", triangles.count,
               triangles.count / dimension() * dimension());
    all.points = points.data;
    all.point_count = points.count;
    all.point_stride_bytes = points.stride_bytes;
    all.triangles = triangles.data;
    all.triangle_count = triangles.count / dimension();
    return changed(dsw_environment_carve, &all);
  }
  Change tie(Points loop, const dsw_tie_desc *desc = nullptr) {
    dsw_tie_desc all = or_defaults(desc);
    count_points(dimension(), loop);
    all.points = loop.data;
    all.point_count = loop.count;
    all.point_stride_bytes = loop.stride_bytes;
    return changed(dsw_environment_tie, &all);
  }
  // `volumes` and `next` may be left out.
  Change remesh(View<const dsw_volume_id> volumes, View<const double> next,
                const dsw_remesh_desc *desc = nullptr) {
    dsw_remesh_desc all = or_defaults(desc);
    all.volumes = volumes.data;
    all.volume_count = volumes.count;
    same_count("coordinates of next", next.count, next.count / dimension() * dimension());
    all.next = next.data;
    all.point_count = next.count / dimension();
    return changed(dsw_environment_remesh, &all);
  }

  // --- deformation
  /** The environment reads `next` until the next deformation that is not refused. Points beyond the
   * number of vertices are room for vertices that operations add (options->point_room). */
  dsw_deform_report deform(Lent next, const dsw_deform_options *options = nullptr) {
    dsw_deform_options all = or_defaults(options);
    count_points(dimension(), next);
    const EnvironmentWriting self(*state_);
    const std::size_t count = read_count(self.handle, next, all);
    dsw_deform_report report = {};
    check(dsw_environment_deform(self.handle, next.data, count, &all, &report));
    if (is_read(self.handle, next)) state_->lent = std::move(next.owner);
    return report;
  }
  Array<dsw_wall_contact> get_wall_contacts() const {
    return list<dsw_wall_contact>(dsw_environment_get_wall_contacts);
  }
  Array<dsw_vertex_id> get_held_vertices() const {
    return list<dsw_vertex_id>(dsw_environment_get_held_vertices);
  }
  Array<dsw_volume_id> get_invalid_volumes() const {
    return list<dsw_volume_id>(dsw_environment_get_invalid_volumes);
  }

  // --- pieces that come off; get_change() says more
  dsw_body_id detach(const dsw_detach_desc &desc) {
    const EnvironmentWriting self(*state_);
    dsw_body_id body = {};
    check(dsw_environment_detach(self.handle, &desc, &body, nullptr));
    return body;
  }

  /** The last change of the topology. */
  Change get_change() const {
    const EnvironmentReading self(*state_);
    dsw_change out = {};
    out.struct_size = sizeof out;
    check(dsw_environment_get_change(self.handle, &out));
    return Change(out);
  }

 private:
  Environment() : state_(std::make_shared<EnvironmentState>()) {}

  static void same_width(const Indices &connectivity,
                         std::initializer_list<const Indices *> others) {
    for (const Indices *other : others)
      if (other->count && other->bytes != connectivity.bytes)
        throw WrongSize("integers of the cells differ in size");
  }

  /** The arrays of cells in a dsw_environment_desc or a dsw_volumes_desc. */
  template <class Description>
  void set_cells(Description &all, Points points, const Indices &connectivity, Indices offsets,
                 View<const std::uint8_t> cell_types, View<const std::int32_t> regions,
                 View<const std::uint32_t> tags) const {
    count_points(dimension(), points);
    leave_out_empty(cell_types);
    all.index_bytes = connectivity.bytes;
    all.points = points.data;
    all.point_count = points.count;
    all.point_stride_bytes = points.stride_bytes;
    all.connectivity = connectivity.data;
    all.connectivity_count = connectivity.count;
    all.cell_types = cell_types.data;
    all.volume_count = cell_types.count
                           ? cell_types.count
                           : uniform_count(all.uniform_cell_type, connectivity, offsets);
    optional_count("offsets", offsets, all.volume_count + 1);
    optional_count("regions", regions, all.volume_count);
    optional_count("tags", tags, all.volume_count);
    all.offsets = offsets.data;
    all.regions = regions.data;
    all.tags = tags.data;
  }

  // Readers with one result: call(environment, arguments..., &result).
  template <class T, class Call, class... Arguments>
  T one(Call call, Arguments... arguments) const {
    const EnvironmentReading self(*state_);
    T result = {};
    check(call(self.handle, arguments..., &result));
    return result;
  }
  template <class Call, class Id>
  Point point(Call call, Id id) const {
    double coordinates[3];
    const EnvironmentReading self(*state_);
    check(call(self.handle, id, coordinates));
    return {coordinates, dimension()};
  }
  const double *in(const Point &point) const { return in_dimension(dimension(), point); }
  template <class T, class Call>
  Array<T> list(Call call) const {
    const EnvironmentReading self(*state_);
    return copied<T>(
        [&](const T **out, std::size_t *count) { return call(self.handle, out, count); });
  }
  // Changes of the topology: call(environment, arguments..., &change).
  template <class Call, class... Arguments>
  Change changed(Call call, Arguments... arguments) {
    const EnvironmentWriting self(*state_);
    dsw_change out = {};
    out.struct_size = sizeof out;
    check(call(self.handle, arguments..., &out));
    return Change(out);
  }
  // call(environment, arguments...) for writers.
  template <class Call, class... Arguments>
  void change(Call call, Arguments... arguments) {
    const EnvironmentWriting self(*state_);
    check(call(self.handle, arguments...));
  }

  std::shared_ptr<EnvironmentState> state_;
  dsw_build_report report_ = {};
};

}  // namespace dartsweep
