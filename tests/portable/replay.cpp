// Recordings whose calls are made again, and folders of them that are compared.
#include "commands.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace dsw::portable {
namespace {

struct Replayed {
  uint64_t calls = 0;
  std::string difference;  // the first one; empty: none
};

Replayed replay_one(const std::string& recording, dsw_context* context, std::set<std::string>& succeeded) {
  Replayed result;
  dsw_replay* replay = nullptr;
  if (dsw_replay_create(context, recording.data(), recording.size(), &replay) != DSW_STATUS_OK) {
    result.difference = dsw_last_error_message();
    return result;
  }
  dsw_replay_report report = {};
  while (result.difference.empty()) {
    const bool stepped = dsw_replay_step(replay, &report) == DSW_STATUS_OK;
    if (stepped && report.outcome == DSW_REPLAY_END) break;
    if (stepped && report.outcome == DSW_REPLAY_SAME) {
      ++result.calls;
      if (report.status == DSW_STATUS_OK) succeeded.insert(report.function);
      continue;
    }
    const std::string call = "call " + std::to_string(result.calls);
    if (!stepped) {
      result.difference = call + ": " + dsw_last_error_message();
      continue;
    }
    result.difference = call + ", " + report.function + ": ";
    if (report.outcome == DSW_REPLAY_UNFINISHED) result.difference += " unfinished";
    if ((report.differs & DSW_DIFFERS_STATUS) != 0) result.difference += " another status";
    if ((report.differs & DSW_DIFFERS_RESULTS) != 0) result.difference += " other results";
    if ((report.differs & DSW_DIFFERS_STATE) != 0) result.difference += " another state";
  }
  dsw_replay_destroy(replay);
  return result;
}

}  // namespace

bool replay(const std::vector<std::string>& folders, size_t functions, dsw_context* context) {
  uint64_t identical = 0, all = 0, calls = 0;
  std::set<std::string> succeeded;
  for (const std::string& folder : folders) {
    for (const std::string& name : list_of(folder)) {
      const std::string path = folder + "/" + name;
      const Replayed result = replay_one(read_file(path), context, succeeded);
      ++all;
      calls += result.calls;
      if (result.difference.empty()) {
        ++identical;
      } else {
        std::printf("%s: %s\n", path.c_str(), result.difference.c_str());
      }
    }
  }
  std::printf("replays %llu of %llu identical, %llu calls\n", static_cast<unsigned long long>(identical),
              static_cast<unsigned long long>(all), static_cast<unsigned long long>(calls));
  std::printf("%zu functions succeeded\n", succeeded.size());
  return identical == all && all != 0 && succeeded.size() >= functions;
}

bool same(const std::vector<std::string>& folders) {
  uint64_t files = 0, different = 0;
  const std::vector<std::string> names = list_of(folders[0]);
  for (size_t i = 1; i < folders.size(); ++i) {
    if (list_of(folders[i]) != names) {
      std::printf("%s has other recordings than %s\n", folders[i].c_str(), folders[0].c_str());
      ++different;
      continue;
    }
    for (const std::string& name : names) {
      const std::string one = read_file(folders[0] + "/" + name), other = read_file(folders[i] + "/" + name);
      ++files;
      if (one == other) continue;
      ++different;
      const auto at = std::mismatch(
          one.begin(), one.begin() + static_cast<std::ptrdiff_t>(std::min(one.size(), other.size())), other.begin());
      std::printf("%s/%s differs from byte %llu on\n", folders[i].c_str(), name.c_str(),
                  static_cast<unsigned long long>(at.first - one.begin()));
    }
  }
  std::printf("files %llu of %llu identical\n", static_cast<unsigned long long>(files - std::min(files, different)),
              static_cast<unsigned long long>(files));
  return different == 0 && !names.empty();
}

}  // namespace dsw::portable
