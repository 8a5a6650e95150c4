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
DSW_CHANGE_NUMBER(double, distance)
DSW_CHANGE_NUMBER(double, smallest_width)
DSW_CHANGE_NUMBER(double, largest_width)
DSW_CHANGE_NUMBER(uint32_t, is_closed)
DSW_CHANGE_NUMBER(uint32_t, volumes_visited)
DSW_CHANGE_NUMBER(uint32_t, volumes_crossed)
DSW_CHANGE_NUMBER(uint32_t, volumes_split)
DSW_CHANGE_NUMBER(uint32_t, volumes_changed)
DSW_CHANGE_NUMBER(uint32_t, vertices_parted)
DSW_CHANGE_NUMBER(uint32_t, vertices_shortened)
DSW_CHANGE_NUMBER(uint32_t, faces_sewn)
DSW_CHANGE_NUMBER(uint32_t, faces_unsewn)
DSW_CHANGE_NUMBER(uint32_t, volumes_invalid)
DSW_CHANGE_NUMBER(uint32_t, volumes_removed)
DSW_CHANGE_NUMBER(uint32_t, volumes_added)
DSW_CHANGE_NUMBER(uint32_t, patch_count)
DSW_CHANGE_NUMBER(uint32_t, most_faces)
