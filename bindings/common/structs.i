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

// Lists are methods of Change, which derives from the struct. Other members that hosts don't see are in lists.i.
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
%ignore dartsweep::uniform_count;
%ignore dartsweep::check_nearest;
%ignore dartsweep::count_points;
%ignore dartsweep::count_pairs;
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
DSW_EACH_ID_OF_TWO(DSW_ID_OF_TWO)

%define DSW_ID_OF_THREE(type)
%feature("novaluewrapper") type;
%extend type {
  type(uint32_t volume, uint32_t generation, uint32_t local) { return new type{volume, generation, local}; }
  /** Whether it names nothing. */
  bool is_null() const { return $self->generation == 0; }
}
%enddef
DSW_EACH_ID_OF_THREE(DSW_ID_OF_THREE)

%feature("director") dartsweep::LogSink;
