/* Plays the scenario in four Lua states on four threads at once, as hosts that embed Lua have them. Usage: threads SCENARIO.JSON */
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#include <pthread.h>
#include <stdio.h>

enum { THREADS = 4 };

static const char *expected;

/* The module is loaded by all threads at the same time, too. */
static void *play(void *result) {
  static const char text[] =
      "local file <close> = assert(io.open(...))\n"
      "assert(require('scenario').play() == file:read('a'), 'results differ')";
  lua_State *L = luaL_newstate();
  luaL_openlibs(L);
  if (luaL_loadstring(L, text) == LUA_OK) lua_pushstring(L, expected);
  *(int *)result = lua_pcall(L, lua_gettop(L) - 1, 0, 0);
  if (*(int *)result != LUA_OK) fprintf(stderr, "threads: %s\n", luaL_tolstring(L, -1, NULL));
  lua_close(L);
  return NULL;
}

int main(int argc, char **argv) {
  pthread_t threads[THREADS];
  int results[THREADS], failed = 0, i;
  if (argc != 2) {
    fprintf(stderr, "usage: threads SCENARIO.JSON\n");
    return 2;
  }
  expected = argv[1];
  for (i = 0; i < THREADS; ++i)
    if (pthread_create(&threads[i], NULL, play, &results[i]) != 0) return 1;
  for (i = 0; i < THREADS; ++i) {
    pthread_join(threads[i], NULL);
    failed |= results[i] != LUA_OK;
  }
  return failed;
}
