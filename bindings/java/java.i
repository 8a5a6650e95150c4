// The package dartsweep: the shared interface, and lists for arrays of structs.
%module Dartsweep

%{
#include <stdexcept>
%}

%include "dartsweep.i"
%define DSW_LIST(type, name)
%template(name##Array) dartsweep::Array<type>;
%enddef
DSW_EACH_ID(DSW_LIST)
DSW_EACH_RECORD(DSW_LIST)
