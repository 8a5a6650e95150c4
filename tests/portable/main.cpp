// Proof that a build computes the same bits as others: see README.md.
#include "commands.h"
#include "defaults.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using dsw::portable::HashOptions;

constexpr int kNoSuchKernel = 77;  // exit code: nothing was done

int usage() {
  std::fprintf(stderr,
               "usage: dartsweep_portable hash [--casts N] [--seed S] [--check FILE]\n"
               "       dartsweep_portable record FOLDER      (which exists)\n"
               "       dartsweep_portable replay [--functions N] FOLDER...\n"
               "       dartsweep_portable same FOLDER FOLDER...\n");
  return 2;
}

bool read_options(const std::vector<std::string>& words, HashOptions& options) {
  for (size_t i = 0; i < words.size(); i += 2) {
    if (i + 1 == words.size()) return false;
    const char* const value = words[i + 1].c_str();
    if (words[i] == "--casts") {
      options.casts = std::strtoull(value, nullptr, 10);
    } else if (words[i] == "--seed") {
      options.seed = std::strtoull(value, nullptr, 10);
    } else if (words[i] == "--check") {
      options.check = value;
    } else {
      return false;
    }
  }
  return true;
}

/// Whether the kernel that DARTSWEEP_KERNEL names is not to be had: the library says so, and takes another.
void note_kernel(void* user, dsw_log_level, const char* text) {
  if (std::strstr(text, "DARTSWEEP_KERNEL") != nullptr) *static_cast<bool*>(user) = true;
}

/// One thread: what a batch has visited is then the same each time.
int run(const std::string& command, const std::vector<std::string>& words, dsw_context* context) {
  HashOptions options;
  if (command == "hash" && read_options(words, options)) return dsw::portable::hash(options, context) ? 0 : 1;
  if (command == "record" && words.size() == 1) return dsw::portable::record(words[0], context) ? 0 : 1;
  if (command == "replay" && words.size() > 2 && words[0] == "--functions") {
    const size_t functions = std::strtoull(words[1].c_str(), nullptr, 10);
    return dsw::portable::replay({words.begin() + 2, words.end()}, functions, context) ? 0 : 1;
  }
  if (command == "replay" && !words.empty()) return dsw::portable::replay(words, 0, context) ? 0 : 1;
  if (command == "same" && words.size() > 1) return dsw::portable::same(words) ? 0 : 1;
  return usage();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return usage();
  dsw_context_desc desc = dsw::oracle::defaults(dsw_context_desc_init);
  desc.thread_count = 1;
  bool is_replaced = false;
  desc.log = note_kernel;
  desc.user = &is_replaced;
  dsw_context* context = nullptr;
  if (dsw_context_create(&desc, &context) != DSW_STATUS_OK) {
    std::fprintf(stderr, "%s\n", dsw_last_error_message());
    return 1;
  }
  const int result =
      is_replaced ? kNoSuchKernel : run(argv[1], std::vector<std::string>(argv + 2, argv + argc), context);
  return dsw_context_destroy(context) == DSW_STATUS_OK ? result : 1;
}
