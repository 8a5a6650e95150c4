/* Contexts, and the host's callbacks: every byte that was taken is given back, with the sizes it was taken with. */
#include <stdlib.h>
#include <string.h>

#include "calls.h"

typedef struct host {
  long blocks, calls, wrong, loops;
  long long bytes;
} host;

enum { HEAD = 64 };

static void *allocate(void *user, size_t size_bytes, size_t alignment_bytes) {
  host *const h = (host *)user;
  unsigned char *const raw = (unsigned char *)malloc(size_bytes + alignment_bytes + HEAD);
  unsigned char *memory;
  if (raw == NULL) return NULL;
  if (size_bytes == 0 || alignment_bytes > 64 || (alignment_bytes & (alignment_bytes - 1)) != 0) ++h->wrong;
  memory = raw + HEAD + (alignment_bytes - ((size_t)raw + HEAD) % alignment_bytes) % alignment_bytes;
  memcpy(memory - sizeof(void *), &raw, sizeof raw);
  memcpy(memory - sizeof(void *) - sizeof(size_t), &size_bytes, sizeof size_bytes);
  ++h->blocks, ++h->calls, h->bytes += (long long)size_bytes;
  return memory;
}

static void release(void *user, void *memory, size_t size_bytes, size_t alignment_bytes) {
  host *const h = (host *)user;
  unsigned char *raw;
  size_t taken;
  memcpy(&raw, (unsigned char *)memory - sizeof(void *), sizeof raw);
  memcpy(&taken, (unsigned char *)memory - sizeof(void *) - sizeof(size_t), sizeof taken);
  if (taken != size_bytes || alignment_bytes == 0) ++h->wrong;
  --h->blocks, h->bytes -= (long long)size_bytes;
  free(raw);
}

static void run_all(void *user, dsw_task_fn task, void *task_data, size_t task_count) {
  size_t i;
  ++((host *)user)->loops;
  for (i = task_count; i > 0; --i) task(task_data, i - 1);
}

static void no_log(void *user, dsw_log_level level, const char *text) {
  if (user == NULL || level == DSW_LOG_NONE || text == NULL) say("a strange line of the log");
}

static void refused_contexts(void) {
  dsw_context *context = NULL;
  dsw_context_desc desc;
  TRY(dsw_context_create(NULL, NULL));
  dsw_context_desc_init(&desc, sizeof desc);
  desc.allocate = allocate;
  TRY(dsw_context_create(&desc, &context));
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 257;
  TRY(dsw_context_create(&desc, &context));
  desc.struct_size = 3;
  TRY(dsw_context_create(&desc, &context));
  TRY(dsw_context_destroy(NULL));
}

void call_context(void) {
  host h;
  dsw_context *context = NULL;
  dsw_context_desc desc;
  dsw_environment *environment;
  dsw_scene *scene;
  memset(&h, 0, sizeof h);
  say("* contexts");
  refused_contexts();
  dsw_context_desc_init(&desc, sizeof desc);
  desc.user = &h;
  desc.allocate = allocate;
  desc.release = release;
  desc.log = no_log;
  desc.parallel_for = run_all;
  desc.thread_count = 2;
  TRY(dsw_context_create(&desc, &context));
  environment = make_block(context, 2, 2, 2, 0);
  scene = make_scene(environment, DSW_FEATURE_STATISTICS);
  say("  the host's memory %s", h.calls > 0 && h.bytes > 0 ? "is used" : "is NOT used");
  TRY(dsw_context_destroy(context));
  TRY(dsw_environment_destroy(environment));
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
  TRY(dsw_context_destroy(context));
  say("  blocks left %ld, bytes left %lld, wrong sizes %ld", h.blocks, h.bytes, h.wrong);
}
