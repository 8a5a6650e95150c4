#pragma once
// The engine's templates on the dimension are compiled for the plane (2) and for space (3).

/** Instantiates a function template that has one parameter, the dimension, and no overload. */
#define DSW_INSTANTIATE(function)             \
  template decltype(function<2>) function<2>; \
  template decltype(function<3>) function<3>
