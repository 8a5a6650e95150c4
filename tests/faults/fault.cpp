// Which faults are on: DSW_FAULTS has their numbers. Numbers of faults that were reached go to the file DSW_FAULTS_REACHED.
#include "fault.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

unsigned char dsw_fault_states[DSW_FAULT_COUNT];

bool dsw_fault_first(int fault) noexcept {
  if (dsw_fault_states[fault] == 2) return true;
  dsw_fault_states[fault] = 1;
  return false;
}

namespace {

struct Faults {
  Faults() {
    const char* at = std::getenv("DSW_FAULTS");
    while (at != nullptr && *at != '\0') {
      char* end = nullptr;
      const long fault = std::strtol(at, &end, 10);
      if (end == at || fault < 0 || fault >= DSW_FAULT_COUNT) std::abort();
      dsw_fault_states[fault] = 2;
      at = *end == ',' ? end + 1 : end;
    }
  }

  ~Faults() {
    const char* const path = std::getenv("DSW_FAULTS_REACHED");
    std::FILE* const file = path == nullptr ? nullptr : std::fopen(path, "a");
    if (file == nullptr) return;
    for (int i = 0; i < DSW_FAULT_COUNT; ++i) {
      if (dsw_fault_states[i] != 0) std::fprintf(file, "%d\n", i);
    }
    std::fclose(file);
  }
} const faults;

}  // namespace
