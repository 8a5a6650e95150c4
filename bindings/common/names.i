// Names that hosts see: types without dsw_ (from the lists in elements.i), constants without DSW_. Languages may rename further.

%define DSW_NAMED(type, name)
%rename(name) type;
%enddef
DSW_EACH_ID(DSW_NAMED)
DSW_EACH_RECORD(DSW_NAMED)
DSW_EACH_DESCRIPTION(DSW_NAMED)
DSW_EACH_RESULT(DSW_NAMED)
DSW_EACH_ENUM(DSW_NAMED)

%rename("%(strip:[DSW_])s", %$isenumitem, regexmatch$name="^DSW_") "";
%rename("%(strip:[DSW_])s", %$isconstant, regexmatch$name="^DSW_") "";

// C functions; classes have methods in their place.
%rename("$ignore", %$isfunction, %$not %$ismember, regexmatch$name="^dsw_") "";
%rename(version) dsw_version;
%rename(status_string) dsw_status_string;
