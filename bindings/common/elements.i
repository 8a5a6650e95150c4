// Lists that typemaps are made from: X(C type, name for hosts). Those of structs and enums are in lists.i, which headers.py makes.

%include "lists.i"

// Numbers that come in arrays.
%define DSW_EACH_NUMBER(X)
X(double, Double)
X(std::uint8_t, Byte)
X(std::int32_t, Int)
X(std::uint32_t, UInt)
X(std::size_t, Size)
%enddef

// Flags, which SWIG gives as constants: X(what they begin with, name for hosts that have types of flags).
%define DSW_EACH_FLAGS(X)
X(ENVIRONMENT_, EnvironmentFlag)
X(FEATURE_, Feature)
X(CAST_, CastFlag)
X(SWEEP_, SweepFlag)
X(MARK_, MarkFlag)
X(BODY_, BodyFlag)
X(MOVE_, MoveFlag)
X(NEAR_, NearFlag)
X(PAIRS_, PairFlag)
X(CUT_, CutFlag)
X(CARVE_, CarveFlag)
X(RECORDING_, RecordingFlag)
%enddef
