// Statuses of the library as messages of a component.
#pragma once

#include <sofa/core/objectmodel/BaseComponent.h>

#include <string>

#include "dartsweep/dartsweep.h"

namespace sofadartsweep {

/** True for DSW_STATUS_OK. Otherwise writes an error of the component with the library's message. */
bool succeeded(const sofa::core::objectmodel::BaseComponent& component, const char* what, dsw_status status);

/** A struct of the library with its defaults. */
template <class Struct>
Struct defaults(void (*init)(Struct*, size_t)) {
  Struct value;
  init(&value, sizeof value);
  return value;
}

/** A struct of the library that is filled by it. */
template <class Struct>
Struct sized() {
  Struct value = {};
  value.struct_size = sizeof value;
  return value;
}

}  // namespace sofadartsweep
