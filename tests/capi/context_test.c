#include <stddef.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* A description as a program built against a newer header would pass it. */
typedef struct newer_desc {
  dsw_context_desc known;
  uint64_t unknown;
} newer_desc;

static void init_writes_the_defaults(void) {
  dsw_context_desc d;
  memset(&d, 0xff, sizeof d);
  dsw_context_desc_init(&d, sizeof d);
  CHECK(d.struct_size == sizeof d);
  CHECK(d.thread_count == 0 && d.user == NULL && d.allocate == NULL && d.release == NULL);
  CHECK(d.log == NULL && d.parallel_for == NULL);
  dsw_context_desc_init(NULL, sizeof d);
}

static void init_writes_no_more_than_it_may(void) {
  unsigned char bytes[sizeof(dsw_context_desc)];
  uint32_t size;
  memset(bytes, 0xee, sizeof bytes);
  dsw_context_desc_init((dsw_context_desc *)(void *)bytes, 8);
  memcpy(&size, bytes, sizeof size);
  CHECK(size == 8 && bytes[8] == 0xee);
}

static void init_clears_what_only_a_newer_header_knows(void) {
  newer_desc d;
  memset(&d, 0xff, sizeof d);
  dsw_context_desc_init(&d.known, sizeof d);
  CHECK(d.known.struct_size == sizeof d && d.unknown == 0);
}

static void a_context_lives_from_create_to_destroy(void) {
  dsw_context *context = NULL;
  CHECK_OK(dsw_context_create(NULL, &context));
  CHECK(context != NULL);
  CHECK_OK(dsw_context_destroy(context));
  CHECK_OK(dsw_context_destroy(NULL));
}

static void bad_descriptions_are_refused(void) {
  dsw_context *context = NULL;
  dsw_context_desc d;
  host h;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_context_create(NULL, NULL));
  dsw_context_desc_init(&d, sizeof d);
  d.thread_count = 257;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_context_create(&d, &context));
  CHECK_MESSAGE("desc->thread_count is 257, must be 0 .. 256");
  d = host_desc(&h);
  d.release = NULL;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_context_create(&d, &context));
  d = host_desc(&h);
  d.allocate = NULL;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_context_create(&d, &context));
  CHECK(context == NULL);
}

static void sizes_are_understood(void) {
  dsw_context *context = NULL;
  newer_desc d;
  memset(&d, 0, sizeof d);
  dsw_context_desc_init(&d.known, sizeof(dsw_context_desc));
  d.known.struct_size = (uint32_t)offsetof(dsw_context_desc, kernel) - 1;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_context_create(&d.known, &context));
  CHECK_MESSAGE("desc->struct_size");
  d.known.struct_size = 0;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_context_create(&d.known, &context));
  d.known.struct_size = 0xffffffffu;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_context_create(&d.known, &context));
  d.known.struct_size = sizeof d;
  d.unknown = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_context_create(&d.known, &context));
  CHECK(context == NULL);
  d.unknown = 0;
  CHECK_OK(dsw_context_create(&d.known, &context));
  CHECK_OK(dsw_context_destroy(context));
}

static void the_hosts_memory_is_used_and_given_back(void) {
  host h;
  dsw_context *const context = make_context(&h);
  CHECK(h.alive == 1);
  end_context(context, &h);
}

static void no_memory_is_a_status(void) {
  host h;
  dsw_context *context = NULL;
  dsw_context_desc d = host_desc(&h);
  h.refuse = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_MEMORY, dsw_context_create(&d, &context));
  CHECK_MESSAGE("allocator returned null");
  CHECK(context == NULL && h.alive == 0);
}

static void a_context_in_use_stays(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const first = make_environment(context, 1, 1, 1);
  dsw_environment *const second = make_environment(context, 2, 1, 1);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_context_destroy(context));
  CHECK_MESSAGE("2 environments");
  CHECK_OK(dsw_environment_destroy(first));
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_context_destroy(context));
  CHECK_OK(dsw_environment_destroy(second));
  end_context(context, &h);
}

static void a_wrong_handle_is_refused(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 1, 1, 1);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_context_destroy((dsw_context *)(void *)environment));
  CHECK_MESSAGE("context is not a live object");
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
}

static void the_log_tells_what_was_created(void) {
  host h;
  dsw_context *const context = make_context(&h);
  const int before = (int)h.log_lines; /* a context says if this processor lacks the kernel of DARTSWEEP_KERNEL */
  dsw_environment *const environment = make_environment(context, 2, 1, 1);
  CHECK((int)h.log_lines == before + 1 && h.last_level == DSW_LOG_INFO);
  CHECK(strstr(h.last_line, "dsw_environment_create: 2 volumes, 11 faces") == h.last_line);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
}

int main(void) {
  init_writes_the_defaults();
  init_writes_no_more_than_it_may();
  init_clears_what_only_a_newer_header_knows();
  a_context_lives_from_create_to_destroy();
  bad_descriptions_are_refused();
  sizes_are_understood();
  the_hosts_memory_is_used_and_given_back();
  no_memory_is_a_status();
  a_context_in_use_stays();
  a_wrong_handle_is_refused();
  the_log_tells_what_was_created();
  return check_result();
}
