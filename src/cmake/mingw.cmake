# GCC for Windows takes its own copy of an inline function for the one that the linker will choose, and keeps values in registers
# that this copy leaves alone (-fipa-ra). The chosen copy, of another unit, may use them. GCC 12 for Linux knows better.
if(MINGW)
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-ipa-ra>)
endif()
