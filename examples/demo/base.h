/* What every part of the demo needs: answers that must be OK, and a clock. */
#ifndef DARTSWEEP_DEMO_BASE_H
#define DARTSWEEP_DEMO_BASE_H

#include <dartsweep/dartsweep.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { kFailed = 1, kBadInput = 2 };

/* Ends the program with the library's message unless `status` is OK. */
void require(dsw_status status, const char *what, int exit_code);

/* Seconds of a clock that never goes back. */
double seconds_now(void);

#ifdef __cplusplus
}
#endif

#endif
