#include "queries.h"

#include <dartsweep/pairs.h>
#include <gmpxx.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

namespace dsw::pairs {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRows = 8;  // of a query: four points at the start, four at the end

std::runtime_error fault(const fs::path& path, std::size_t line, const std::string& what) {
  return std::runtime_error(path.string() + ":" + std::to_string(line) + ": " + what);
}

/** The whole numbers of a row. */
std::vector<mpz_class> numbers(const fs::path& path, std::size_t line, const std::string& row) {
  std::vector<mpz_class> found;
  for (std::size_t begin = 0; begin <= row.size();) {
    const std::size_t end = std::min(row.find(',', begin), row.size());
    std::string word = row.substr(begin, end - begin);
    word.erase(std::remove_if(word.begin(), word.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
               word.end());
    mpz_class number;
    if (number.set_str(word, 10) != 0) throw fault(path, line, "'" + word + "' is no whole number");
    found.push_back(number);
    begin = end + 1;
  }
  return found;
}

/** The double that a fraction is; `exact` becomes false if there is none. */
double to_double(const fs::path& path, std::size_t line, const mpz_class& above, const mpz_class& below, bool& exact) {
  if (below == 0) throw fault(path, line, "a denominator is 0");
  mpq_class fraction(above, below);
  fraction.canonicalize();
  const double value = fraction.get_d();
  exact = exact && std::isfinite(value) && mpq_class(value) == fraction;
  return value;
}

std::vector<bool> read_truth(const fs::path& path) {
  std::ifstream file(path);
  const nlohmann::json list = nlohmann::json::parse(file, nullptr, false);
  if (!list.is_array()) throw std::runtime_error(path.string() + ": no array of truth values");
  return list.get<std::vector<bool>>();
}

/** @param truth of each query, or null: it is in the last column. */
void read_file(const fs::path& path, std::uint8_t kind, const std::vector<bool>* truth, QuerySet& set) {
  std::ifstream file(path);
  const std::size_t columns = truth != nullptr ? 6 : 7;
  std::string row;
  std::size_t line = 0;
  Query query{};
  bool exact = true;
  while (std::getline(file, row)) {
    if (row.find_first_not_of(" \r") == std::string::npos) continue;
    const std::size_t place = line % kRows, index = line / kRows;
    ++line;
    const std::vector<mpz_class> n = numbers(path, line, row);
    if (n.size() != columns) throw fault(path, line, std::to_string(n.size()) + " columns");
    if (place == 0) {
      query = {};
      query.kind = kind;
      exact = true;
      if (truth != nullptr && index >= truth->size()) throw fault(path, line, "a query without a truth value");
      query.set_truth = truth != nullptr ? (*truth)[index] : n[6] != 0;
    } else if (truth == nullptr && query.set_truth != (n[6] != 0)) {
      throw fault(path, line, "two truth values for one query");
    }
    auto& point = place < 4 ? query.start[place] : query.end[place - 4];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = to_double(path, line, n[2 * axis], n[2 * axis + 1], exact);
    }
    if (place + 1 < kRows) continue;
    if (exact) {
      set.list.push_back(query);
    } else {
      ++set.inexact;
    }
  }
  if (line % kRows != 0) throw fault(path, line, "the last query has fewer than 8 rows");
  if (truth != nullptr && line != kRows * truth->size()) throw fault(path, line, "truth values without a query");
  ++set.files;
}

}  // namespace

std::vector<QuerySet> read_sets(const std::string& folder) {
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  QuerySet sample{"sample queries", true, {}}, scalable{"scalable CCD", true, {}};
  for (const fs::path& path : paths) {
    const std::string above = path.parent_path().filename(), stem = path.stem();
    if (above == "vertex-face" || above == "edge-edge") {
      read_file(path, above == "edge-edge" ? DSW_PAIR_EDGE_EDGE : DSW_PAIR_VERTEX_FACE, nullptr, sample);
    } else if (above == "queries") {
      const fs::path truth = path.parent_path().parent_path() / "mma_bool" / (stem + "_mma_bool.json");
      if (!fs::exists(truth)) {
        std::printf("  %s is left out: there is no %s\n", path.c_str(), truth.c_str());
        continue;
      }
      const bool edges = stem.size() > 2 && stem.compare(stem.size() - 2, 2, "ee") == 0;
      const std::vector<bool> values = read_truth(truth);
      read_file(path, edges ? DSW_PAIR_EDGE_EDGE : DSW_PAIR_VERTEX_FACE, &values, scalable);
    }
  }
  std::vector<QuerySet> sets;
  for (QuerySet* set : {&sample, &scalable}) {
    if (set->files == 0) continue;
    std::mt19937_64 random;
    for (std::size_t i = set->list.size(); i > 1; --i) std::swap(set->list[i - 1], set->list[random() % i]);
    sets.push_back(std::move(*set));
  }
  return sets;
}

}  // namespace dsw::pairs
