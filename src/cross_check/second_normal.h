#pragma once
// What libccd says about a contact's normal.

#include "cross_check/features.h"

namespace dsw {

enum class Answer : uint32_t { kNotConverged, kNotUnique, kGiven };

struct SecondNormal {
  Answer answer = Answer::kNotConverged;  // unless it is kGiven what follows is 0
  double normal[3] = {};
  double depth = 0, pushed_in = 0;  // scene units
  double angle = 0;                 // to our normal, radians
};

/** Only after require_libccd. May throw std::bad_alloc. */
SecondNormal second_normal(const Features& features, const double* normal);

}  // namespace dsw
