// How arrays, structs, points and errors look in JavaScript; see bindings/README.md for what belongs here. Structs are values: plain
// objects and classes of src/, laid out by structs.js; SWIG makes classes of handles only.

%{
#include "convert.h"
%}

%feature("compactdefaultargs");
%rename("$ignore", %$isenumitem) "";
%rename("$ignore", %$isconstant) "";
%rename("%(lowercamelcase)s", %$isfunction, %$ismember) "";
%rename("%(lowercamelcase)s", %$isvariable) "";
%rename(version) dsw_version;
%rename(statusString) dsw_status_string;
%rename(raiseStatus) dartsweep::raise_status;
%rename(sweepPairs) dartsweep::sweep_pairs;
%rename(sweepRigidPairs) dartsweep::sweep_rigid_pairs;
%rename(createBodyId) dartsweep::Scene::create_body;
%ignore dartsweep::cell_of;

%exception {
  try {
    $action
  } catch (...) {
    dartsweep_node::raise_current(env);
  }
  dartsweep_node::deliver_log(env);
}
%exception dsw_version "$action"
%exception dsw_status_string "$action"

%ignore dartsweep::Points;
%ignore dartsweep::PointsOut;
%ignore dartsweep::Indices;
%ignore dartsweep::Lent;
%ignore dartsweep::View;
%ignore dartsweep::Array;
%ignore dartsweep::LogSink;

// --- numbers
%define DSW_NUMBER(type)
%typemap(in) type "$1 = dartsweep_node::number<type>($input);"
%typemap(out) type "$result = Napi::Number::New(env, static_cast<double>($1));"
%enddef
DSW_NUMBER(double)
DSW_NUMBER(std::int32_t)
DSW_NUMBER(std::uint32_t)
DSW_NUMBER(uint32_t)
DSW_NUMBER(std::uint64_t)
DSW_NUMBER(std::size_t)
%typemap(in) enum SWIGTYPE "$1 = static_cast<$1_ltype>(dartsweep_node::number<std::int32_t>($input));"
%typemap(out) enum SWIGTYPE "$result = Napi::Number::New(env, static_cast<double>($1));"

// --- arrays of numbers. Reading a later argument may run the host's functions, getters, which may take an earlier one's memory away: where
// arrays lie is asked once more when all are read ("check").
%define DSW_POINTS(type, set)
%typemap(in) type (dartsweep_node::Numbers<double> numbers) {
  $1.data = numbers.set($input);
  $1.count = numbers.count;
}
%typemap(check) type "numbers$argnum.check();"
%enddef
DSW_POINTS(dartsweep::Points, set)
DSW_POINTS(dartsweep::PointsOut, set_typed)
// What a call has written goes back after the call. The log is delivered before that, and its function could take the array away: no call
// that fills arrays writes to the log.
%typemap(freearg) dartsweep::PointsOut "numbers$argnum.give_back();"

%typemap(in) dartsweep::Indices (dartsweep_node::IndexNumbers numbers) {
  $1 = numbers.set($input);
}
%typemap(check) dartsweep::Indices "numbers$argnum.check();"

%define DSW_NUMBERS(type)
%typemap(in) dartsweep::View<const type> (dartsweep_node::Numbers<type> numbers) {
  const type *data = numbers.set($input);
  $1 = dartsweep::View<const type>{data, numbers.count};
}
%typemap(in) dartsweep::View<type> (dartsweep_node::Numbers<type> numbers) {
  type *data = numbers.set_typed($input);
  $1 = dartsweep::View<type>{data, numbers.count};
}
%typemap(check) dartsweep::View<const type>, dartsweep::View<type> "numbers$argnum.check();"
%typemap(freearg) dartsweep::View<type> "numbers$argnum.give_back();"
%typemap(out) dartsweep::Array<type> {
  $result = dartsweep_node::from_numbers(env, (&$1)->data(), (&$1)->size());
}
%enddef
%define DSW_NUMBERS_OF(type, name)
DSW_NUMBERS(type)
%enddef
DSW_EACH_NUMBER(DSW_NUMBERS_OF)

// A copy: what is lent would be gone when somebody transfers the array to another thread.
%typemap(in) dartsweep::Lent (dartsweep_node::Numbers<double> numbers) {
  const double *data = numbers.set($input);
  $1.count = numbers.count;
  const std::shared_ptr<double[]> copy(new double[numbers.count]);
  std::copy(data, data + numbers.count, copy.get());
  $1.data = copy.get();
  $1.owner = copy;
}

// --- structs
%define DSW_STRUCT(type)
%ignore type;
%typemap(in) type {
  type value = {};
  if (!dartsweep_node::is_nothing($input)) dartsweep_node::set_struct($input, value);
  $1 = value;
}
%typemap(out) type {
  $result = dartsweep_node::from_struct<type>(env, $1);
}
%enddef
%define DSW_STRUCT_BY_REFERENCE(type, name)
DSW_STRUCT(type)
%typemap(in) const type & (type value) {
  value = {};
  dartsweep_node::set_struct($input, value);
  $1 = &value;
}
%enddef
%define DSW_STRUCTS(type, name)
DSW_STRUCT_BY_REFERENCE(type, name)
%typemap(in) dartsweep::View<const type> (dartsweep_node::Structs<const type> structs) "$1 = structs.set($input);"
%typemap(in) dartsweep::View<type> (dartsweep_node::Structs<type> structs) "$1 = structs.set($input);"
%typemap(check) dartsweep::View<const type>, dartsweep::View<type> "structs$argnum.check();"
%typemap(freearg) dartsweep::View<type> "structs$argnum.give_back();"
%typemap(out) dartsweep::Array<type> {
  $result = dartsweep_node::from_structs<type>(env, (&$1)->data(), (&$1)->size());
}
%enddef
DSW_EACH_ID(DSW_STRUCTS)
DSW_EACH_RECORD(DSW_STRUCTS)
DSW_EACH_RESULT(DSW_STRUCT_BY_REFERENCE)
DSW_STRUCT(dartsweep::Located)
DSW_STRUCT(dartsweep::VolumeCounts)
DSW_STRUCT(dartsweep::FaceVolumes)
DSW_STRUCT(dartsweep::Neighbour)
DSW_STRUCT(dartsweep::Marked)
DSW_STRUCT(dartsweep::VolumeSplit)
DSW_STRUCT(dartsweep::FaceSplit)
DSW_STRUCT(dartsweep::EdgeSplit)
DSW_STRUCT(dartsweep::Particle)
DSW_STRUCT(dartsweep::BodyFilter)
DSW_STRUCT(dartsweep::Depenetration)

// One point: an array of 3 numbers, or 2 in the plane.
%typemap(in) const dartsweep::Point & (dartsweep::Point point) {
  point = dartsweep_node::to_point($input);
  $1 = &point;
}
%typemap(out) dartsweep::Point {
  $result = dartsweep_node::from_point(env, *&$1);
}

// Options: what is left out has its default.
%define DSW_OPTIONS(type, name)
%ignore type;
%typemap(in) const type & (type options), const type * (type options) {
  type##_init(&options, sizeof options);
  if (!dartsweep_node::is_nothing($input)) dartsweep_node::set_struct($input, options);
  $1 = &options;
}
%enddef
DSW_EACH_DESCRIPTION(DSW_OPTIONS)

// --- a change: its numbers and lists in one class
%include "common/change_numbers.i"

// --- the log: a function (level, text)
%typemap(in) std::unique_ptr<dartsweep::LogSink> {
  $1 = std::unique_ptr<dartsweep::LogSink>(dartsweep_node::is_nothing($input) ? nullptr : new dartsweep_node::Log($input));
}
%ignore dartsweep::Context::Context(std::uint32_t, LogSink *);
%extend dartsweep::Context {
  Context(std::uint32_t threads, std::unique_ptr<dartsweep::LogSink> log) {
    return new dartsweep::Context(threads, std::move(log));
  }
}

// For src/native.js.
%rename(setHooks) set_hooks;
%exception set_hooks "$action"
%typemap(in) const Napi::Value & (Napi::Value value) {
  value = $input;
  $1 = &value;
}
%inline %{
void set_hooks(const Napi::Value &value) { dartsweep_node::set_hooks(value); }
%}
