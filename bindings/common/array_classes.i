// For languages without arrays of structs: each array that a call gives, or fills, as a class with size() and get(i).
// Included at the end of a language's own interface, after dartsweep.i.
%define DSW_ARRAY_CLASS(type, name)
%template(name##Array) dartsweep::Array<type>;
%enddef
DSW_EACH_ID(DSW_ARRAY_CLASS)
DSW_EACH_RECORD(DSW_ARRAY_CLASS)
DSW_EACH_NUMBER(DSW_ARRAY_CLASS)
