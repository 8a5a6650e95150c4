#include "check.h"

#include <stdio.h>
#include <string.h>

static unsigned g_checks = 0, g_failures = 0;
static const char *g_where = "";

void check_in(const char *where) { g_where = where; }

static void fail_at(const char *file, int line) {
  ++g_failures;
  fprintf(stderr, "%s:%d: %s%s", file, line, g_where, *g_where != '\0' ? ": " : "");
}

void check_that(int passed, const char *what, const char *file, int line) {
  ++g_checks;
  if (passed) return;
  fail_at(file, line);
  fprintf(stderr, "does not hold: %s\n", what);
}

void check_status(dsw_status wanted, dsw_status got, const char *call, const char *file, int line) {
  const char *const message = dsw_last_error_message();
  const size_t name = strcspn(call, "(");
  ++g_checks;
  if (got != wanted) {
    fail_at(file, line);
    fprintf(stderr, "%s gave %s (%s), wanted %s\n", call, dsw_status_string(got), message, dsw_status_string(wanted));
  } else if (got != DSW_STATUS_OK && strncmp(call, "dsw_", 4) == 0 &&
             (strncmp(message, call, name) != 0 || message[name] != ':')) {
    fail_at(file, line);
    fprintf(stderr, "the message does not begin with the function: %s\n", message);
  }
}

void check_message(const char *text, const char *file, int line) {
  ++g_checks;
  if (strstr(dsw_last_error_message(), text) != NULL) return;
  fail_at(file, line);
  fprintf(stderr, "the message lacks \"%s\": %s\n", text, dsw_last_error_message());
}

int check_result(void) {
  if (g_failures != 0) fprintf(stderr, "%u of %u checks failed\n", g_failures, g_checks);
  return g_failures != 0 || g_checks == 0;
}
