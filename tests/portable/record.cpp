// Recordings of all kinds of lives, and a list of them.
#include "commands.h"
#include "defaults.h"
#include "life.h"

#include "../effort.h"

#include <algorithm>
#include <cstdio>

namespace dsw::portable {
namespace {

int append(void* user, const void* bytes, size_t size) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
  return 0;
}

}  // namespace

bool record(const std::string& folder, dsw_context* context) {
  constexpr uint64_t kMostParts = 200;
  std::string list;
  uint64_t all_calls = 0, all_bytes = 0, files = 0;
  for (const LifeKind& kind : life_kinds()) {
    // A quarter at least: with less, functions that rarely succeed would be in no recording.
    const int all = static_cast<int>(kind.calls);
    const uint64_t wanted = static_cast<uint64_t>(std::max(effort_of(all), all / 4));
    uint64_t calls = 0;
    for (uint64_t part = 0; calls < wanted && part < kMostParts; ++part) {
      Life life(kind, 1000 * part + 7, context);
      if (!life.began()) continue;
      std::string recording;
      dsw_recording_desc desc = oracle::defaults(dsw_recording_desc_init);
      desc.write = append;
      desc.user = &recording;
      desc.flags = DSW_RECORDING_STATES;
      if (dsw_scene_start_recording(life.scene(), &desc) != DSW_STATUS_OK) return false;
      uint64_t made = 0;
      for (; calls + made < wanted && !life.is_over(); ++made) life.act();
      if (dsw_scene_stop_recording(life.scene()) != DSW_STATUS_OK) return false;
      calls += made;
      const std::string name = std::string(kind.name) + "_" + std::to_string(part) + ".dswrec";
      if (!write_file(folder + "/" + name, recording)) return false;
      list += name + "\n";
      all_bytes += recording.size();
      ++files;
    }
    all_calls += calls;
  }
  std::printf("%llu recordings, %llu acts, %llu bytes\n", static_cast<unsigned long long>(files),
              static_cast<unsigned long long>(all_calls), static_cast<unsigned long long>(all_bytes));
  return write_file(folder + "/list.txt", list);
}

}  // namespace dsw::portable
