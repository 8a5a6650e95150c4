rockspec_format = "3.0"
package = "dartsweep"
version = "2.1.0-1"
source = {
  url = "file://.", -- made in a clone of the project, by luarocks make
}
description = {
  summary = "Exact contacts of moving particles and bodies with a volume mesh",
  license = "MIT",
}
dependencies = {
  "lua >= 5.1, < 5.5",
}
external_dependencies = {
  DARTSWEEP = {header = "dartsweep/dartsweep.h"},
}
build = {
  type = "cmake",
  variables = {
    CMAKE_BUILD_TYPE = "Release",
    CMAKE_PREFIX_PATH = "$(DARTSWEEP_DIR)",
    LUA_INCLUDE_DIR = "$(LUA_INCDIR)",
    LUA_MODULES = "$(LIBDIR)",
    LUA_SCRIPTS = "$(LUADIR)",
  },
}
