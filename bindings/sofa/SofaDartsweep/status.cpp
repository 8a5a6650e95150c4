#include "SofaDartsweep/status.h"

#include <sofa/helper/logging/Messaging.h>

namespace sofadartsweep {

bool succeeded(const sofa::core::objectmodel::BaseComponent& component, const char* what, dsw_status status) {
  if (status == DSW_STATUS_OK) return true;
  msg_error(&component) << what << ": " << dsw_status_string(status) << " (" << dsw_last_error_message() << ")";
  return false;
}

}  // namespace sofadartsweep
