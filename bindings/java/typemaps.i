// How arrays, ids, points and errors look in Java; see bindings/README.md for what belongs here.

%{
#include "convert.h"
%}

%include <enums.swg>
%javaconst(1);
%rename("$ignore", %$isenumitem, regexmatch$name="FORCE_INT32$") ""; // only fixes sizes in C

%rename("%(lowercamelcase)s", %$isfunction, %$ismember) "";
%rename("%(lowercamelcase)s", %$isvariable) "";
%rename(cellOf) dartsweep::cell_of;
%rename(sweepPairs) dartsweep::sweep_pairs;
%rename(sweepRigidPairs) dartsweep::sweep_rigid_pairs;
%rename(statusString) dsw_status_string;
%rename(raiseStatus) dartsweep::raise_status;
%javamethodmodifiers dartsweep::raise_status "final"; // of the package: for its tests

// The class that declares C functions loads them.
%pragma(java) jniclassclassmodifiers="final class"
%pragma(java) jniclasscode=%{
  static {
    NativeLibrary.load();
  }
%}

%exception {
  try {
    $action
  } catch (...) {
    dartsweep_java::throw_current(jenv);
    return $null;
  }
}

// --- numbers: C's unsigned ones as Java's of the same size, with the same bits
%apply int { std::int32_t, std::uint32_t, uint32_t, unsigned int };
%apply long long { std::uint64_t, uint64_t, std::size_t, size_t };

// --- objects: their memory goes when they are collected; what close() gives up goes at once
%typemap(javabody) SWIGTYPE %{
  private final long swigCPtr;
  private final Object owner; // has the memory, where this object has not

  $javaclassname(long address, boolean owned) {
    swigCPtr = address;
    owner = null;
    if (owned) NativeMemory.releaseWith(this, address, $imclassname::delete_$javaclassname);
  }

  $javaclassname(long address, Object owner) {
    swigCPtr = address;
    this.owner = owner;
  }

  static long getCPtr($javaclassname object) {
    return object == null ? 0 : object.swigCPtr;
  }
%}
%typemap(javadestruct) SWIGTYPE ""
%typemap(javafinalize) SWIGTYPE ""
%typemap(javaclassmodifiers) SWIGTYPE "public final class"
%typemap(javainterfaces) dartsweep::Environment, dartsweep::Scene "AutoCloseable"

%ignore dartsweep::Points;
%ignore dartsweep::PointsOut;
%ignore dartsweep::Indices;
%ignore dartsweep::Lent;
%ignore dartsweep::LogSink;

// --- members that are structs
%define DSW_COPIED(type, name)
%typemap(out) const type & {
  *(type **)&$result = new type(*$1);
}
%typemap(javaout) const type & {
    return new name($jnicall, true);
  }
%enddef
DSW_EACH_RECORD(DSW_COPIED)
DSW_EACH_RESULT(DSW_COPIED)
%ignore dartsweep::Vec3;

// --- points: DoubleBuffers, used in place where they are direct and of native byte order; one point is a double[3], in
// the plane a double[2]
%define DSW_POINTS(type, class)
%typemap(jni) type "jobject"
%typemap(jtype) type "Object"
%typemap(jstype) type "java.nio.DoubleBuffer"
%typemap(in) type (dartsweep_java::class holder) {
  holder.set(jenv, $input, $1.data, $1.count);
}
%enddef
DSW_POINTS(dartsweep::Points, Doubles)
DSW_POINTS(dartsweep::PointsOut, DoublesOut)
%typemap(javain) dartsweep::Points "NativeMemory.of($javainput)"
%typemap(javain, pre="    Object memory$javainput = NativeMemory.writable($javainput);",
  post="      NativeMemory.copyBack(memory$javainput, $javainput);") dartsweep::PointsOut "memory$javainput"

%typemap(jni) dartsweep::Lent "jobject"
%typemap(jtype) dartsweep::Lent "Object"
%typemap(jstype) dartsweep::Lent "java.nio.DoubleBuffer"
%typemap(javain) dartsweep::Lent "NativeMemory.writable($javainput)"
%typemap(in) dartsweep::Lent {
  if (!dartsweep_java::set_lent(jenv, $input, $1)) return $null;
}

%define DSW_POINT(type)
%typemap(jni) type "jdoubleArray"
%typemap(jtype) type "double[]"
%typemap(jstype) type "double[]"
%typemap(javain) type "$javainput"
%typemap(javaout) type {
    return $jnicall;
  }
%enddef
DSW_POINT(const dartsweep::Vec3 &)
DSW_POINT(const dartsweep::Point &)
DSW_POINT(dartsweep::Point)
DSW_POINT(double [ANY])
DSW_POINT(double [ANY][ANY])
%typemap(in) const dartsweep::Vec3 & (dartsweep::Vec3 point) {
  if (!dartsweep_java::set_doubles(jenv, $input, &point.x, 3)) return $null;
  $1 = &point;
}
%typemap(out) const dartsweep::Vec3 & {
  $result = dartsweep_java::to_java(jenv, &$1->x, 3);
}
%typemap(in) const dartsweep::Point & (dartsweep::Point point) {
  if (!dartsweep_java::set_point(jenv, $input, point)) return $null;
  $1 = &point;
}
%typemap(out) dartsweep::Point {
  $result = dartsweep_java::to_java(jenv, (&$1)->at, (&$1)->size);
}
%typemap(in) double [ANY] (double numbers[$1_dim0]) {
  if (!dartsweep_java::set_doubles(jenv, $input, numbers, $1_dim0)) return $null;
  $1 = numbers;
}
%typemap(out) double [ANY] {
  $result = dartsweep_java::to_java(jenv, $1, $1_dim0);
}
%typemap(out) double [ANY][ANY] {
  $result = dartsweep_java::to_java(jenv, $1[0], $1_dim0 * $1_dim1);
}
%typemap(freearg) double [ANY] ""
%typemap(argout) double [ANY] ""

// --- arrays of numbers
%define DSW_NUMBERS(type, java, jniarray)
%typemap(jni) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type> #jniarray
%typemap(jtype) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type> #java "[]"
%typemap(jstype) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type> #java "[]"
%typemap(javain) dartsweep::View<const type>, dartsweep::View<type> "$javainput"
%typemap(in) dartsweep::View<const type> (dartsweep_java::Numbers<j##java> holder) {
  $1 = dartsweep::View<const type>{holder.set<type>(jenv, $input, JNI_ABORT), holder.count};
}
%typemap(in) dartsweep::View<type> (dartsweep_java::Numbers<j##java> holder) {
  $1 = dartsweep::View<type>{holder.set<type>(jenv, $input, 0), holder.count};
}
%typemap(out) dartsweep::Array<type> {
  $result = dartsweep_java::to_java(jenv, (&$1)->data(), (&$1)->size());
}
%typemap(javaout) dartsweep::Array<type> {
    return $jnicall;
  }
%enddef
DSW_NUMBERS(double, double, jdoubleArray)
DSW_NUMBERS(std::uint8_t, byte, jbyteArray)
DSW_NUMBERS(std::int32_t, int, jintArray)
DSW_NUMBERS(std::uint32_t, int, jintArray)
DSW_NUMBERS(std::size_t, long, jlongArray)

%typemap(jni) dartsweep::Indices "jintArray"
%typemap(jtype) dartsweep::Indices "int[]"
%typemap(jstype) dartsweep::Indices "int[]"
%typemap(javain) dartsweep::Indices "$javainput"
%typemap(in) dartsweep::Indices (dartsweep_java::Numbers<jint> holder) {
  $1.data = holder.set<std::int32_t>(jenv, $input, JNI_ABORT);
  $1.count = holder.count;
  $1.bytes = 4;
}
%typemap(jni) uint32_t [ANY] "jintArray"
%typemap(jtype) uint32_t [ANY] "int[]"
%typemap(jstype) uint32_t [ANY] "int[]"
%typemap(out) uint32_t [ANY] {
  $result = dartsweep_java::to_java(jenv, $1, $1_dim0);
}
%typemap(javaout) uint32_t [ANY] {
    return $jnicall;
  }

%immutable dsw_build_report::offenders;
%immutable dsw_build_report::changed;
%immutable dsw_body_contact::fixed;
%immutable dsw_near_row::vertices;
%immutable dsw_near_row::obstacle_vertices;
%immutable dsw_near_row::key;

// --- arrays of structs: lists in C's memory
%define DSW_LISTS(type, name)
%typemap(jni) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type>, type [ANY] "jlong"
%typemap(jtype) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type>, type [ANY] "long"
%typemap(jstype) dartsweep::View<const type>, dartsweep::View<type>, dartsweep::Array<type>, type [ANY] #name "Array"
%typemap(javain) dartsweep::View<const type>, dartsweep::View<type> #name "Array.getCPtr($javainput)"
%typemap(in) dartsweep::View<const type> {
  auto *array = *(dartsweep::Array<type> **)&$input;
  $1 = array ? dartsweep::View<const type>{array->data(), array->size()} : dartsweep::View<const type>{};
}
%typemap(in) dartsweep::View<type> {
  auto *array = *(dartsweep::Array<type> **)&$input;
  $1 = array ? dartsweep::View<type>{array->data(), array->size()} : dartsweep::View<type>{};
}
%typemap(out) dartsweep::Array<type> {
  *(dartsweep::Array<type> **)&$result = new dartsweep::Array<type>(std::move($1));
}
%typemap(out) type [ANY] {
  *(dartsweep::Array<type> **)&$result = new dartsweep::Array<type>($1, $1_dim0);
}
%typemap(javaout) dartsweep::Array<type>, type [ANY] {
    return new name##Array($jnicall, true);
  }
%ignore dartsweep::Array<type>::Array();
%ignore dartsweep::Array<type>::Array(std::size_t);
%extend dartsweep::Array<type> {
  Array(int count) {
    if (count < 0) throw std::out_of_range("fewer than 0 entries");
    auto *made = new dartsweep::Array<type>(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) made->data()[i] = {};
    return made;
  }
}
%ignore dartsweep::Array<type>::get;
%javamethodmodifiers dartsweep::Array<type>::at "private";
%javamethodmodifiers dartsweep::Array<type>::count "private";
%rename(count) dartsweep::Array<type>::size;
%enddef

%define DSW_RECORDS(type, name)
DSW_LISTS(type, name)
%typemap(javabase) dartsweep::Array<type> "java.util.AbstractList<" #name ">"
%typemap(javaout) type *at {
    return new name($jnicall, this);
  }
%extend dartsweep::Array<type> {
  type *at(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= $self->size()) throw std::out_of_range("index beyond the list");
    return $self->data() + index;
  }
}
%typemap(javacode) dartsweep::Array<type> %{
  /** An entry, in the list's memory: it changes when the list is filled again. */
  @Override
  public name get(int index) {
    return at(index);
  }

  @Override
  public int size() {
    return (int) count();
  }
%}
%enddef
DSW_EACH_RECORD(DSW_RECORDS)

// --- ids: values of Java
%define DSW_IDS(type, name)
DSW_LISTS(type, name)
%ignore type;
%typemap(jni) type, const type & "jintArray"
%typemap(jtype) type, const type & "int[]"
%typemap(jstype) type, const type & #name
%typemap(javain) type, const type & #name ".numbers($javainput)"
%typemap(in) type {
  dartsweep_java::read_id(jenv, $input, &$1);
}
%typemap(in) const type & (type id) {
  dartsweep_java::read_id(jenv, $input, &id);
  $1 = &id;
}
%typemap(out) type {
  $result = dartsweep_java::to_java(jenv, reinterpret_cast<const std::uint32_t *>(&$1), sizeof(type) / 4);
}
%typemap(out) const type & {
  $result = dartsweep_java::to_java(jenv, reinterpret_cast<const std::uint32_t *>($1), sizeof(type) / 4);
}
%typemap(javaout) type, const type & {
    return name.of($jnicall);
  }
%typemap(javabase) dartsweep::Array<type> "java.util.AbstractList<" #name ">"
%javamethodmodifiers dartsweep::Array<type>::put "private";
%extend dartsweep::Array<type> {
  type at(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= $self->size()) throw std::out_of_range("index beyond the list");
    return $self->data()[index];
  }
  void put(int index, type id) {
    if (index < 0 || static_cast<std::size_t>(index) >= $self->size()) throw std::out_of_range("index beyond the list");
    $self->data()[index] = id;
  }
}
%typemap(javacode) dartsweep::Array<type> %{
  public name##Array(java.util.Collection<name> ids) {
    this(ids.size());
    int index = 0;
    for (name id : ids) put(index++, id);
  }

  public static name##Array of(name... ids) {
    return new name##Array(java.util.Arrays.asList(ids));
  }

  @Override
  public name get(int index) {
    return at(index);
  }

  @Override
  public name set(int index, name id) {
    name before = at(index);
    put(index, id);
    return before;
  }

  @Override
  public int size() {
    return (int) count();
  }
%}
%enddef
DSW_EACH_ID(DSW_IDS)
%immutable dsw_body_edit::ends;
%immutable dsw_body_cut::ends;
%immutable dsw_body_cut::vertices;
%immutable dsw_body_cut::parts;
%immutable dsw_vertex_origin::from;
%immutable dsw_wall_contact::others;

// --- a change: its numbers and lists in one class
%include "common/change_numbers.i"

// --- the log: any object with write(level, text)
%typemap(jni) std::unique_ptr<dartsweep::LogSink> "jobject"
%typemap(jtype) std::unique_ptr<dartsweep::LogSink> "Log"
%typemap(jstype) std::unique_ptr<dartsweep::LogSink> "Log"
%typemap(javain) std::unique_ptr<dartsweep::LogSink> "$javainput"
%typemap(in) std::unique_ptr<dartsweep::LogSink> {
  $1 = std::unique_ptr<dartsweep::LogSink>($input ? new dartsweep_java::JavaLog(jenv, $input) : nullptr);
}
%ignore dartsweep::Context::Context(std::uint32_t, LogSink *);
%extend dartsweep::Context {
  Context(std::uint32_t threads, std::unique_ptr<dartsweep::LogSink> log) { return new dartsweep::Context(threads, std::move(log)); }
}

%include "idioms.i"
%include "fillers.i" // made by declare.py
