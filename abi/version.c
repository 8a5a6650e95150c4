/* The library that is loaded says the version of the header that this was compiled with. */
#include <stdio.h>

#include "dartsweep/base.h"

int main(void) {
  const uint32_t header = DSW_VERSION_MAJOR * 1000000u + DSW_VERSION_MINOR * 1000u + DSW_VERSION_PATCH;
  if (dsw_version() != header) {
    fprintf(stderr, "library %lu, header %lu\n", (unsigned long)dsw_version(), (unsigned long)header);
    return 1;
  }
  return 0;
}
