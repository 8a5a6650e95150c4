// What the program does; see main.cpp. Each returns whether all is well.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dartsweep/dartsweep.h"

namespace dsw::portable {

struct HashOptions {
  uint64_t casts = 200000;  // sweeps and moves: a tenth of it
  uint64_t seed = 1;
  std::string check;  // a file of lines to compare with, or empty
};

bool hash(const HashOptions& options, dsw_context* context);
bool record(const std::string& folder, dsw_context* context);
/// Fails where fewer than so many functions succeed.
bool replay(const std::vector<std::string>& folders, size_t functions, dsw_context* context);
bool same(const std::vector<std::string>& folders);

/// Names of a folder's recordings, from its list.txt; empty without one.
std::vector<std::string> list_of(const std::string& folder);
/// A file's bytes; empty if it cannot be read.
std::string read_file(const std::string& path);
bool write_file(const std::string& path, const std::string& bytes);

}  // namespace dsw::portable
