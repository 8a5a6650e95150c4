#include "commands.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dsw::portable {

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) std::fprintf(stderr, "%s cannot be read\n", path.c_str());
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool write_file(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) std::fprintf(stderr, "%s cannot be written\n", path.c_str());
  return static_cast<bool>(file);
}

std::vector<std::string> list_of(const std::string& folder) {
  std::istringstream list(read_file(folder + "/list.txt"));
  std::vector<std::string> names;
  for (std::string name; std::getline(list, name);) names.push_back(name);
  return names;
}

}  // namespace dsw::portable
