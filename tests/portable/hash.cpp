// Checksums of results, kind by kind.
#include "asks.h"
#include "commands.h"
#include "life.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace dsw::portable {
namespace {

class Lines {
 public:
  void add(const std::string& name, const Tally& tally) {
    char line[120];
    std::snprintf(line, sizeof line, "%s %llu %016llx", name.c_str(), static_cast<unsigned long long>(tally.count),
                  static_cast<unsigned long long>(tally.sum.value()));
    all.emplace_back(line);
    std::printf("%s\n", line);
    std::fflush(stdout);
    whole_.sum << tally.count << tally.sum.value();
    whole_.count += tally.count;
  }
  void finish() { add("all", Tally(whole_)); }

  std::vector<std::string> all;

 private:
  Tally whole_;
};

void hash_queries(const Kind& kind, uint64_t casts, Rng& rng, dsw_context* context, Lines& lines) {
  constexpr size_t kCastsOfScene = 240;
  Tally flights, sweeps, nearest, wholes;
  const size_t transforms = transform_count(kind);
  for (size_t scene = 0; flights.count < casts; ++scene) {
    const Ground ground = make_ground(kind, scene % transforms, rng.next() >> 1, context);
    flights.sum << ground.status;
    if (ground.environment == nullptr) {
      ++flights.count;  // refused, and so may be all others
      continue;
    }
    mark_some(ground, rng.chance(0.5) ? 0.1 : 0, rng);
    ask_casts(ground, kCastsOfScene, rng, flights);
    ask_sweeps(ground, kCastsOfScene / 10, rng, sweeps);
    ask_nearest(ground, kCastsOfScene / 30, rng, nearest);
    if (scene < transforms) ask_for_all(ground, rng, wholes);
  }
  const std::string name = std::string(kind.dimension == 3 ? "space." : "plane.") + kind.name;
  lines.add("cast." + name, flights);
  lines.add("sweep." + name, sweeps);
  lines.add("nearest." + name, nearest);
  lines.add("whole." + name, wholes);
}

void hash_life(const LifeKind& kind, uint64_t acts, uint64_t seed, dsw_context* context, Lines& lines) {
  Tally tally;
  for (uint64_t part = 0; tally.count < acts; ++part) {
    Life life(kind, seed + part, context);
    tally.sum << life.began();
    ++tally.count;
    if (!life.began()) continue;
    for (uint64_t i = 0; tally.count < acts && !life.is_over(); ++i, ++tally.count) {
      tally.sum << life.act();
      if (i % 8 == 0) add_state(tally.sum, life.scene());
    }
    add_snapshots(tally.sum, life.scene());
  }
  lines.add(std::string("life.") + kind.name, tally);
}

bool compare(const std::vector<std::string>& got, const std::string& path) {
  const std::string text = read_file(path);
  std::istringstream file(text);
  std::vector<std::string> wanted;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    wanted.push_back(line);
  }
  size_t wrong = 0;
  for (size_t i = 0; i < got.size() || i < wanted.size(); ++i) {
    const std::string one = i < got.size() ? got[i] : "nothing", other = i < wanted.size() ? wanted[i] : "nothing";
    if (one == other) continue;
    ++wrong;
    std::printf("differs: %s, but %s has %s\n", one.c_str(), path.c_str(), other.c_str());
  }
  std::printf("%zu of %zu lines are those of %s\n", got.size() - std::min(wrong, got.size()), got.size(), path.c_str());
  return wrong == 0 && !wanted.empty();
}

}  // namespace

bool hash(const HashOptions& options, dsw_context* context) {
  Lines lines;
  Rng rng(options.seed);
  const std::vector<Kind> all = kinds();
  for (const Kind& kind : all) {
    Rng own(rng.next());
    hash_queries(kind, options.casts / all.size() + 1, own, context, lines);
  }
  for (const uint32_t dimension : {2u, 3u}) {
    Tally pairs;
    Rng own(options.seed + dimension);
    ask_pairs(context, dimension, options.casts / 50 + 1, own, pairs);
    lines.add(dimension == 2 ? "pairs.plane" : "pairs.space", pairs);
  }
  // Where a call takes long, there are fewer.
  const auto weight = [](const LifeKind& kind) { return std::min<uint64_t>(kind.calls, 500); };
  uint64_t weights = 0;
  for (const LifeKind& kind : life_kinds()) weights += weight(kind);
  for (const LifeKind& kind : life_kinds()) {
    hash_life(kind, options.casts / 10 * weight(kind) / weights + 1, rng.next() >> 1, context, lines);
  }
  lines.finish();
  return options.check.empty() || compare(lines.all, options.check);
}

}  // namespace dsw::portable
