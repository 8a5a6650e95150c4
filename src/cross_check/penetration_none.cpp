#include "base/error.h"
#include "cross_check/penetration.h"

namespace dsw {

void require_libccd() { fail(DSW_STATUS_NOT_BUILT, "this library was built without libccd (DSW_WITH_LIBCCD)"); }

bool find_penetration(const Hull&, const Hull&, Penetration&) { return false; }

}  // namespace dsw
