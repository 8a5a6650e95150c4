// How arrays, ids, points and errors look in C#; see bindings/README.md for what belongs here. Ids, reports and contacts are C# structs
// laid out as C's (Structs.cs, made by declare.py): they are passed by value, and arrays of them are pinned, not copied.

// Instead of SWIG's callbacks, which are one for each class of exceptions: one, of errors.h.
%insert(runtime) %{
#include "errors.h"
%}
%{
#include "convert.h"
%}
%pragma(csharp) imclassclassmodifiers="internal static unsafe class"
%pragma(csharp) moduleclassmodifiers="public static unsafe partial class"
%pragma(csharp) imclasscode=%{
  internal static class SWIGPendingException {
    internal static bool Pending { get { return Errors.Pending != null; } }

    internal static global::System.Exception Retrieve() {
      global::System.Exception error = Errors.Pending;
      Errors.Pending = null;
      return error;
    }
  }

  static $imclassname() {
    Callbacks.Register();
  }
%}

%csconst(1);
%rename("$ignore", %$isenumitem, regexmatch$name="FORCE_INT32$") ""; // only fixes sizes in C
%rename("%(camelcase)s", %$isfunction, %$ismember) "";
%rename("%(camelcase)s", %$isvariable) "";
%rename(Count) dartsweep::Marked::marked; // not the name of its class
%rename(CellOf) dartsweep::cell_of;
%rename(SweepPairs) dartsweep::sweep_pairs;
%rename(SweepRigidPairs) dartsweep::sweep_rigid_pairs;
%rename(Version) dsw_version;
%ignore dsw_status_string;
%rename(RaiseStatus) dartsweep::raise_status;
%csmethodmodifiers dartsweep::raise_status "internal";
%rename(CreateBodyId) dartsweep::Scene::create_body;
%csmethodmodifiers dartsweep::Scene::create_body "private unsafe";
%rename(Dispose) dartsweep::Environment::close;
%rename(Dispose) dartsweep::Scene::close;

// The text is looked for by SWIG, which then asks for exceptions after the call: SWIG_CSharpSetPendingException.
%exception {
  try {
    $action
  } catch (...) {
    dartsweep_csharp::set_pending_exception();
    return $null;
  }
}

%apply unsigned int { std::uint32_t, uint32_t };
%apply int { std::int32_t };
%apply long long { std::uint64_t, uint64_t, std::size_t, size_t };

// --- objects: a SafeHandle has the memory, so that none goes while a call uses it, or is forgotten
%typemap(csclassmodifiers) SWIGTYPE "public sealed unsafe partial class"
%typemap(csbody) SWIGTYPE %{
  private readonly NativeHandle swigCPtr;

  internal $csclassname(global::System.IntPtr address, bool owned) {
    swigCPtr = new NativeHandle(address, owned ? $imclassname.delete_$csclassname : (global::System.Action<NativeHandle>)null);
  }

  internal static NativeHandle getCPtr($csclassname value) {
    return value == null ? NativeHandle.Null : value.swigCPtr;
  }
%}
%typemap(csdispose) SWIGTYPE ""
%typemap(csdisposing, methodname="Dispose", methodmodifiers="protected", parameters="bool disposing") SWIGTYPE ""
%typemap(csinterfaces) SWIGTYPE ""
%typemap(csinterfaces) dartsweep::Environment, dartsweep::Scene "global::System.IDisposable"
%typemap(imtype, out="global::System.IntPtr") SWIGTYPE, SWIGTYPE *, SWIGTYPE & "NativeHandle"

%ignore dartsweep::Points;
%ignore dartsweep::PointsOut;
%ignore dartsweep::Indices;
%ignore dartsweep::Lent;
%ignore dartsweep::LogSink;

// --- arrays: pinned for the call
%define DSW_PINNED(type, element)
%typemap(ctype) type "dartsweep_csharp::Pinned"
%typemap(imtype) type "Pinned"
%typemap(cstype) type #element "[]"
%typemap(csin, pre="    fixed (" #element "* at_$csinput = $csinput) {", terminator="    }") type
  "new Pinned(at_$csinput, $csinput)"
%enddef
%define DSW_POINTS(type)
DSW_PINNED(type, double)
%typemap(in) type {
  dartsweep_csharp::set_points($input, $1.data, $1.count);
}
%enddef
DSW_POINTS(dartsweep::Points)
DSW_POINTS(dartsweep::PointsOut)

DSW_PINNED(dartsweep::Indices, int)
%typemap(in) dartsweep::Indices {
  $1.data = $input.data;
  $1.count = $input.count;
  $1.bytes = 4;
}

%define DSW_ARRAYS(type, element)
DSW_PINNED(dartsweep::View<const type>, element)
DSW_PINNED(dartsweep::View<type>, element)
%typemap(in) dartsweep::View<const type> {
  $1 = dartsweep::View<const type>{static_cast<const type *>($input.data), $input.count};
}
%typemap(in) dartsweep::View<type> {
  $1 = dartsweep::View<type>{static_cast<type *>($input.data), $input.count};
}
%typemap(ctype) dartsweep::Array<type>, type [ANY] "dartsweep_csharp::Block"
%typemap(imtype) dartsweep::Array<type>, type [ANY] "Block"
%typemap(cstype) dartsweep::Array<type>, type [ANY] #element "[]"
%typemap(out, null="dartsweep_csharp::Block()") dartsweep::Array<type> {
  $result = dartsweep_csharp::block<type>(std::move($1));
}
%typemap(csout, excode=SWIGEXCODE) dartsweep::Array<type> {
    Block block = $imcall;$excode
    return block.ToArray<element>();
  }
%enddef
DSW_ARRAYS(double, double)
DSW_ARRAYS(std::uint8_t, byte)
DSW_ARRAYS(std::int32_t, int)
DSW_ARRAYS(std::uint32_t, uint)
DSW_ARRAYS(std::size_t, ulong)
%define DSW_ARRAYS_OF_STRUCTS(type, name)
DSW_ARRAYS(type, name)
%enddef
DSW_EACH_ID(DSW_ARRAYS_OF_STRUCTS)
DSW_EACH_RECORD(DSW_ARRAYS_OF_STRUCTS)

// --- structs by value
%define DSW_VALUE(type, name)
%ignore type;
%typemap(ctype) type, const type & #type
%typemap(imtype) type, const type & #name
%typemap(cstype) type, const type & #name
%typemap(csin) type, const type & "$csinput"
%typemap(in) type "$1 = $input;"
%typemap(in) const type & "$1 = &$input;"
%typemap(out, null=#type "()") type "$result = $1;"
%typemap(out, null=#type "()") const type & "$result = *$1;"
%typemap(csout, excode=SWIGEXCODE) type, const type & {
    name value = $imcall;$excode
    return value;
  }
%typemap(csvarin, excode=SWIGEXCODE2) type, const type & %{
    set {
      $imcall;$excode
    } %}
%typemap(csvarout, excode=SWIGEXCODE2) type, const type & %{
    get {
      name value = $imcall;$excode
      return value;
    } %}
%enddef
DSW_EACH_ID(DSW_VALUE)
DSW_EACH_RECORD(DSW_VALUE)
DSW_VALUE(dartsweep::Vec3, Vec3)
%typemap(ctype) dartsweep::Point, const dartsweep::Point & "dartsweep::Vec3"
%typemap(imtype) dartsweep::Point, const dartsweep::Point & "Vec3"
%typemap(cstype) dartsweep::Point, const dartsweep::Point & "Vec3"
%typemap(csin) const dartsweep::Point & "$csinput"
%typemap(in) const dartsweep::Point & (dartsweep::Point point) {
  point = dartsweep::Point(&$input.x, 3);
  $1 = &point;
}
%typemap(out, null="dartsweep::Vec3()") dartsweep::Point {
  $result = dartsweep::Vec3{(&$1)->at[0], (&$1)->at[1], (&$1)->at[2]};
}
%typemap(csout, excode=SWIGEXCODE) dartsweep::Point {
    Vec3 value = $imcall;$excode
    return value;
  }
DSW_VALUE(dsw_cell, Cell)
DSW_VALUE(dsw_contact, Contact)

// --- members that are structs of other kinds, or arrays: copies
%define DSW_COPIED(type, name)
%typemap(out) const type & {
  $result = new type(*$1);
}
%typemap(csvarout, excode=SWIGEXCODE2) const type & %{
    get {
      name value = new name($imcall, true);$excode
      return value;
    } %}
%enddef
DSW_COPIED(dsw_cross_check, CrossCheck)

%define DSW_NUMBERS_MEMBER(type, element)
%typemap(ctype, out="dartsweep_csharp::Block") type [ANY] "dartsweep_csharp::Pinned"
%typemap(imtype, out="Block") type [ANY] "Pinned"
%typemap(cstype) type [ANY] #element "[]"
%typemap(in) type [ANY] {
  if (!dartsweep_csharp::has_count($input, $1_dim0)) return $null;
  $1 = static_cast<type *>($input.data);
}
%typemap(freearg) type [ANY] ""
%typemap(out, null="dartsweep_csharp::Block()") type [ANY] {
  $result = dartsweep_csharp::block(dartsweep::Array<type>($1, $1_dim0));
}
%typemap(csvarin, excode=SWIGEXCODE2) type [ANY] %{
    set {
      fixed (element* at_value = value) {
        $imcall;$excode
      }
    } %}
%typemap(csin) type [ANY] "new Pinned(at_$csinput, $csinput)"
%typemap(csvarout, excode=SWIGEXCODE2) type [ANY] %{
    get {
      Block block = $imcall;$excode
      return block.ToArray<element>();
    } %}
%enddef
DSW_NUMBERS_MEMBER(double, double)
DSW_NUMBERS_MEMBER(uint32_t, uint)

// --- members that are text: SWIG's own way needs its helper
%immutable dsw_validation::text;
%typemap(ctype) char [ANY] "dartsweep_csharp::Block"
%typemap(imtype) char [ANY] "Block"
%typemap(cstype) char [ANY] "string"
%typemap(out, null="dartsweep_csharp::Block()") char [ANY] {
  $result = dartsweep_csharp::block(dartsweep::Array<char>($1, strnlen($1, $1_dim0)));
}
%typemap(csvarout, excode=SWIGEXCODE2) char [ANY] %{
    get {
      Block block = $imcall;$excode
      return global::System.Text.Encoding.UTF8.GetString(block.ToArray<byte>());
    } %}

// --- positions that stay with the library: pinned until it lets go
%typemap(ctype) dartsweep::Lent "dartsweep_csharp::Pinned"
%typemap(imtype) dartsweep::Lent "Pinned"
%typemap(cstype) dartsweep::Lent "double[]"
%typemap(csin) dartsweep::Lent "Pinned.Lend($csinput)"
%typemap(in) dartsweep::Lent {
  $1.owner = dartsweep_csharp::owner_of($input);
  dartsweep_csharp::set_points($input, $1.data, $1.count);
}

// --- a change: its numbers and lists in one class
%include "common/change_numbers.i"

// --- the log: a delegate
%typemap(ctype) std::unique_ptr<dartsweep::LogSink> "void *"
%typemap(imtype) std::unique_ptr<dartsweep::LogSink> "global::System.IntPtr"
%typemap(cstype) std::unique_ptr<dartsweep::LogSink> "global::System.Action<LogLevel, string>"
%typemap(csin) std::unique_ptr<dartsweep::LogSink> "Callbacks.Keep($csinput)"
%typemap(in) std::unique_ptr<dartsweep::LogSink> {
  $1 = std::unique_ptr<dartsweep::LogSink>($input ? new dartsweep_csharp::Log($input) : nullptr);
}
%ignore dartsweep::Context::Context(std::uint32_t, LogSink *);
%extend dartsweep::Context {
  Context(std::uint32_t threads, std::unique_ptr<dartsweep::LogSink> log) { return new dartsweep::Context(threads, std::move(log)); }
}
