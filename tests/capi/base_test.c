#include <string.h>

#include "check.h"
#include "fixture.h"

static void version_is_that_of_the_header(void) {
  CHECK(dsw_version() == DSW_VERSION_MAJOR * 1000000u + DSW_VERSION_MINOR * 1000u + DSW_VERSION_PATCH);
}

static void every_status_has_its_name(void) {
  int i;
  CHECK(strcmp(dsw_status_string(DSW_STATUS_OK), "DSW_STATUS_OK") == 0);
  CHECK(strcmp(dsw_status_string(DSW_STATUS_OUTSIDE), "DSW_STATUS_OUTSIDE") == 0);
  CHECK(strcmp(dsw_status_string(DSW_STATUS_INTERNAL), "DSW_STATUS_INTERNAL") == 0);
  for (i = 0; i <= DSW_STATUS_NOT_CLOSED; ++i) {
    int other;
    CHECK(strncmp(dsw_status_string((dsw_status)i), "DSW_STATUS_", 11) == 0);
    for (other = 0; other < i; ++other) {
      CHECK(strcmp(dsw_status_string((dsw_status)i), dsw_status_string((dsw_status)other)) != 0);
    }
  }
}

static void an_unknown_status_has_a_text(void) {
  CHECK(strcmp(dsw_status_string((dsw_status)(DSW_STATUS_NOT_CONFORMING + 1)), "unknown status") == 0);
  CHECK(strcmp(dsw_status_string(DSW_STATUS_FORCE_INT32), "unknown status") == 0);
}

static void the_message_is_empty_until_something_fails_and_then_stays(void) {
  dsw_context *context = NULL;
  CHECK(strcmp(dsw_last_error_message(), "") == 0);
  CHECK(dsw_context_create(NULL, NULL) == DSW_STATUS_NULL_ARGUMENT);
  CHECK(strcmp(dsw_last_error_message(), "dsw_context_create: context is null") == 0);
  CHECK(dsw_context_create(NULL, &context) == DSW_STATUS_OK);
  CHECK(strcmp(dsw_last_error_message(), "dsw_context_create: context is null") == 0);
  CHECK(dsw_context_destroy(context) == DSW_STATUS_OK);
}

int main(void) {
  the_message_is_empty_until_something_fails_and_then_stays();
  version_is_that_of_the_header();
  every_status_has_its_name();
  an_unknown_status_has_a_text();
  return check_result();
}
