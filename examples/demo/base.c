#if !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#include "base.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void require(dsw_status status, const char *what, int exit_code) {
  if (status != DSW_STATUS_OK) {
    fprintf(stderr, "demo: %s: %s: %s\n", what, dsw_status_string(status), dsw_last_error_message());
    exit(exit_code);
  }
}

double seconds_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
