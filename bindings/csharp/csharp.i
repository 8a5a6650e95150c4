// The namespace Dartsweep: the shared interface. Free functions and flags are in the class Library.
%module Library

%include "dartsweep.i"
