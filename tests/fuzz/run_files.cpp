// Runs a fuzz target on files, and on every truncation and a few damaged bytes of each, without a fuzzer: any compiler
// can keep what once broke from breaking again.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "bytes.h"

namespace {

std::vector<uint8_t> read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

size_t run(const std::vector<uint8_t>& input) {
  size_t runs = 1;
  LLVMFuzzerTestOneInput(input.data(), input.size());
  const size_t step = std::max<size_t>(1, input.size() / 64);
  for (size_t size = 0; size < input.size(); size += step, ++runs) {
    const std::vector<uint8_t> cut(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(size));
    LLVMFuzzerTestOneInput(cut.data(), cut.size());
  }
  for (size_t i = 0; i < input.size(); i += step, ++runs) {
    std::vector<uint8_t> damaged = input;
    damaged[i] = static_cast<uint8_t>(damaged[i] ^ (1u << (i / step % 8)));
    LLVMFuzzerTestOneInput(damaged.data(), damaged.size());
  }
  return runs;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i) {
    if (std::filesystem::is_directory(argv[i])) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
        if (entry.is_regular_file() && entry.path().extension() != ".md") files.push_back(entry.path());
      }
    } else {
      files.emplace_back(argv[i]);
    }
  }
  std::sort(files.begin(), files.end());
  size_t runs = 0;
  for (const auto& file : files) {
    std::printf("%s\n", file.filename().string().c_str());
    std::fflush(stdout);
    runs += run(read(file));
  }
  std::printf("%zu files, %zu runs\n", files.size(), runs);
  return files.empty() ? 1 : 0;
}
