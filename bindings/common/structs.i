// Structs as hosts see them: what is only for C is left out, descriptions are made with their defaults.

%define DSW_INITIALISED(type, name)
%extend type {
  type() {
    type *made = new type;
    type##_init(made, sizeof *made);
    return made;
  }
}
%enddef
DSW_EACH_DESCRIPTION(DSW_INITIALISED)

%ignore struct_size;
%ignore reserved;

// Arrays are arguments of methods.
%define DSW_CELLS_AS_ARGUMENTS(type)
%ignore type::index_bytes;
%ignore type::points;
%ignore type::point_count;
%ignore type::point_stride_bytes;
%ignore type::cell_types;
%ignore type::volume_count;
%ignore type::offsets;
%ignore type::connectivity;
%ignore type::connectivity_count;
%ignore type::regions;
%ignore type::tags;
%enddef
DSW_CELLS_AS_ARGUMENTS(dsw_environment_desc)
DSW_CELLS_AS_ARGUMENTS(dsw_volumes_desc)
%ignore dsw_environment_desc::faces;
%ignore dsw_environment_desc::faces_count;
%ignore dsw_environment_desc::face_locations;
%ignore dsw_volumes_desc::vertices;
%ignore dsw_volumes_desc::vertex_count;
%ignore dsw_volumes_desc::sew_to;
%ignore dsw_volumes_desc::sew_count;
%ignore dsw_body_desc::positions;
%ignore dsw_body_desc::vertex_count;
%ignore dsw_body_desc::stride_bytes;
%ignore dsw_body_desc::hints;
%ignore dsw_body_desc::edges;
%ignore dsw_body_desc::edge_count;
%ignore dsw_body_desc::face_offsets;
%ignore dsw_body_desc::face_corners;
%ignore dsw_body_desc::face_count;
%ignore dsw_body_desc::face_corner_count;
%ignore dsw_cut_desc::points;
%ignore dsw_cut_desc::point_stride_bytes;
%ignore dsw_cut_desc::rows;
%ignore dsw_cut_desc::columns;
%ignore dsw_open_crack_desc::faces;
%ignore dsw_open_crack_desc::face_count;
%ignore dsw_carve_desc::points;
%ignore dsw_carve_desc::point_count;
%ignore dsw_carve_desc::point_stride_bytes;
%ignore dsw_carve_desc::triangles;
%ignore dsw_carve_desc::triangle_count;
%ignore dsw_tie_desc::points;
%ignore dsw_tie_desc::point_count;
%ignore dsw_tie_desc::point_stride_bytes;
%ignore dsw_remesh_desc::volumes;
%ignore dsw_remesh_desc::volume_count;
%ignore dsw_remesh_desc::next;
%ignore dsw_remesh_desc::point_count;
%ignore dsw_move_options::order;
%ignore dsw_move_options::order_count;

// Lists are methods of Change, which derives from the struct.
%define DSW_LIST_OF_CHANGE(list, count)
%ignore dsw_change::list;
%ignore dsw_change::count;
%enddef
DSW_LIST_OF_CHANGE(volumes, volume_count)
DSW_LIST_OF_CHANGE(vertices, vertex_count)
DSW_LIST_OF_CHANGE(faces, face_count)
DSW_LIST_OF_CHANGE(whole, whole_count)
DSW_LIST_OF_CHANGE(carved, carved_count)
DSW_LIST_OF_CHANGE(unrepaired, unrepaired_count)
DSW_LIST_OF_CHANGE(detached, detached_count)
DSW_LIST_OF_CHANGE(body_vertices, body_vertex_count)
DSW_LIST_OF_CHANGE(body_faces, body_face_count)
%ignore dartsweep::Change::Change;

// Members that are structs are handled as `const type &`: typemaps copy them, since a host may keep them longer than the whole.
%define DSW_MEMBER(type, name)
%naturalvar type;
%enddef
DSW_EACH_ID(DSW_MEMBER)
DSW_EACH_RECORD(DSW_MEMBER)
DSW_EACH_RESULT(DSW_MEMBER)
%ignore dartsweep::Point;

// What classes of ours replace.
%ignore dsw_context_desc;
%ignore dsw_kernel;
%ignore dsw_trace_data;
%ignore dsw_coarsen_report;
%ignore dsw_recording_desc;
%ignore dsw_bug_report_desc;
%ignore dsw_replay_info;
%ignore dsw_replay_report;
%ignore dsw_replay_outcome;
%ignore dartsweep::NoWait;
%ignore dartsweep::Reading;
%ignore dartsweep::Writing;
%ignore dartsweep::Mutex;
%ignore dartsweep::EnvironmentState;
%ignore dartsweep::SceneState;
%ignore dartsweep::EnvironmentReading;
%ignore dartsweep::EnvironmentWriting;
%ignore dartsweep::SceneReading;
%ignore dartsweep::SceneWriting;
%ignore dartsweep::WholeWriting;
%ignore dartsweep::copied;
%ignore dartsweep::filled;
%ignore dartsweep::same_count;
%ignore dartsweep::count_points;
%ignore dartsweep::count_rows;
%ignore dartsweep::in_dimension;
%ignore dartsweep::refuse_point;
%ignore dartsweep::common_stride;
%ignore *::state;
%ignore dartsweep::Array::data;
%ignore dartsweep::Array::release;
%ignore dartsweep::Array::Array(const T *, std::size_t);

// Ids are values; C++ has a default constructor for them, whatever constructors hosts have.
%define DSW_ID_OF_TWO(type)
%feature("novaluewrapper") type;
%extend type {
  type(uint32_t index, uint32_t generation) { return new type{index, generation}; }
  /** Whether it names nothing. */
  bool is_null() const { return $self->generation == 0; }
}
%enddef
DSW_ID_OF_TWO(dsw_vertex_id)
DSW_ID_OF_TWO(dsw_volume_id)
DSW_ID_OF_TWO(dsw_particle_id)
DSW_ID_OF_TWO(dsw_body_id)
DSW_ID_OF_TWO(dsw_body_vertex_id)
DSW_ID_OF_TWO(dsw_body_edge_id)
DSW_ID_OF_TWO(dsw_body_face_id)

%define DSW_ID_OF_THREE(type)
%feature("novaluewrapper") type;
%extend type {
  type(uint32_t volume, uint32_t generation, uint32_t local) { return new type{volume, generation, local}; }
  /** Whether it names nothing. */
  bool is_null() const { return $self->generation == 0; }
}
%enddef
DSW_ID_OF_THREE(dsw_face_id)
DSW_ID_OF_THREE(dsw_edge_id)

%feature("director") dartsweep::LogSink;
