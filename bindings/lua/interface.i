// The module dartsweep.core: the shared interface and a log. It is opened by luaopen_dartsweep_core of open.h.
%module dartsweep_interface

%{
#include "log.h"
%}

%ignore dartsweep_lua::Line;
%ignore dartsweep::Context::Context(std::uint32_t, LogSink *);
%extend dartsweep::Context {
  Context(std::uint32_t thread_count = 0, const dartsweep_lua::Log *log = nullptr) {
    return new dartsweep::Context(thread_count, log ? log->sink() : nullptr);
  }
}

%include "dartsweep.i"

%typemap(out) std::optional<dartsweep_lua::Line> {
  const std::optional<dartsweep_lua::Line> &line = *&$1;
  if (line) SWIG_arg += dartsweep_lua::push_all(L, line->level, line->text);
}
%include "log.h"

%define DSW_KIND(type, name)
  &dartsweep_lua::kKind<type>,
%enddef
%insert("header") {
static const dartsweep_lua::Kind *const dartsweep_lua_kinds[] = {
DSW_EACH_NUMBER(DSW_KIND)
DSW_EACH_ID(DSW_KIND)
DSW_EACH_RECORD(DSW_KIND)
};
}
%{
#include "open.h"
%}
