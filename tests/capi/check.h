/* A test framework in C: checks print what failed and go on; the program fails if any did, or if none was made. */
#ifndef DARTSWEEP_TESTS_CAPI_CHECK_H
#define DARTSWEEP_TESTS_CAPI_CHECK_H

#include "dartsweep/dartsweep.h"

#define CHECK(condition) check_that((condition) ? 1 : 0, #condition, __FILE__, __LINE__)
#define CHECK_OK(call) check_status(DSW_STATUS_OK, (call), #call, __FILE__, __LINE__)
/* Also checks that the message begins with the name of the function that was called. */
#define CHECK_FAILS(status, call) check_status((status), (call), #call, __FILE__, __LINE__)
/* Checks as CHECK_FAILS does, after the variable `bad` has become a copy of `desc` with another value of one member. */
#define CHECK_REFUSES(status, desc, member, value, call) \
  (bad = (desc), bad.member = (value), check_status((status), (call), #call, __FILE__, __LINE__))
/* The message of the last failure contains `text`. */
#define CHECK_MESSAGE(text) check_message((text), __FILE__, __LINE__)

void check_that(int passed, const char *what, const char *file, int line);
void check_status(dsw_status wanted, dsw_status got, const char *call, const char *file, int line);
void check_message(const char *text, const char *file, int line);
/* What failures from here on name beside their line: a case of a test that runs several times. */
void check_in(const char *where);
/* What main returns. */
int check_result(void);

#endif
