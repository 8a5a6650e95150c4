// Optional: the numbers of a change as members of Change itself, for languages whose classes have no bases. Included in
// a language's own typemaps.i, after its renames.

%ignore dsw_change;
%define DSW_CHANGE_NUMBER(type, name)
%insert("header") {
static inline type dartsweep_Change_##name##_get(const dartsweep::Change *change) { return change->name; }
}
%immutable dartsweep::Change::name;
%extend dartsweep::Change {
  type name;
}
%enddef
DSW_EACH_CHANGE_NUMBER(DSW_CHANGE_NUMBER)
