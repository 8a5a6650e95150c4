// What a contact costs: moves of a catheter in a vessel, recorded once and made again without the physics, and a rope
// that meets itself, beside one that passes through itself.
#include "contact_parts.h"

#include "catheter_moves.h"
#include "rope.h"
#include "timing.h"

#include <cinttypes>
#include <cstdio>
#include <functional>
#include <numeric>

namespace dsw::bench {

namespace {

constexpr std::size_t kRopeEdges = 1000;
constexpr std::size_t kWarmUp = 20;
constexpr std::size_t kCountedMoves = 200, kCountedSteps = 60;  // of the catheter and of the rope, by valgrind
constexpr std::size_t kColdBytes = std::size_t{64} << 20;

/** FNV-1a over what moves told: version by version the same bits, or something has changed. */
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
  }

  /** Contacts of the last move of a body and where its vertices are now. @return how many contacts */
  std::size_t add(dsw_scene* scene, dsw_body_id body, std::size_t vertices) {
    const dsw_body_contact* contacts = nullptr;
    std::size_t contact_count = 0, vertex_count = 0;
    check(dsw_body_get_contacts(scene, body, &contacts, &contact_count));
    // All of its members are numbers, and nothing lies between them.
    static_assert(sizeof(dsw_body_contact) == 21 * sizeof(double) + sizeof(dsw_contact) + 8 * sizeof(std::uint32_t));
    static_assert(sizeof(dsw_contact) == 3 * sizeof(double) + 14 * sizeof(std::uint32_t));
    add(contacts, contact_count * sizeof *contacts);
    positions_.resize(3 * vertices);
    volumes_.resize(vertices);
    check(dsw_body_get_positions(scene, body, positions_.data(), vertices, 0, volumes_.data(), &vertex_count));
    add(positions_.data(), positions_.size() * sizeof(double));
    add(volumes_.data(), volumes_.size() * sizeof volumes_.front());
    return contact_count;
  }

  void report(const std::string& key, Report& report) const {
    std::printf("  %-46s %016" PRIx64 "\n", key.c_str(), value_);
    report.add(key, static_cast<double>(value_ >> 12));  // what a double holds
  }

 private:
  std::uint64_t value_ = 14695981039346656037u;
  std::vector<double> positions_;
  std::vector<dsw_volume_id> volumes_;
};

/** Times and contacts of moves. */
struct Measured {
  std::vector<double> ns, contacts;

  double per_contact() const { return sum(ns) / sum(contacts); }
  static double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
};

/** Writes to more memory than a core's caches hold. */
void touch_memory(std::vector<unsigned char>& bytes) {
  for (std::size_t i = 0; i < bytes.size(); i += 64) ++bytes[i];
}

/** Makes the moves once. With `cold`, everything else is thrown out of the caches between them. */
Measured replay(dsw_environment* environment, const CatheterMoves& moves, std::size_t count, bool cold, Hash& hash) {
  CatheterReplay catheter(environment, moves);
  std::vector<unsigned char> others(cold ? kColdBytes : 0);
  Measured measured;
  for (std::size_t i = 0; i < count; ++i) {
    touch_memory(others);
    measured.ns.push_back(cpu_time_ns([&] { catheter.move(i); }));
    const std::size_t contacts = hash.add(catheter.scene(), catheter.body(), moves.start.size() / 3);
    measured.contacts.push_back(static_cast<double>(contacts));
  }
  return measured;
}

/** Gives the moves that the folder keeps, if it has `most`; otherwise records moves now, and keeps them there. */
CatheterMoves moves_of(const insertion::Vessel& vessel, const insertion::Options& catheter,
                       const ContactOptions& options, std::size_t most) {
  const std::string path = options.moves + (catheter.mesh.empty() ? "/generated.moves" : "/phantom.moves");
  CatheterMoves moves;
  if (options.moves.empty() || !read_moves(path, moves) || moves.count() < most) {
    moves = record_moves(vessel, catheter, most);
    if (!options.moves.empty()) write_moves(path, moves);
  }
  moves.targets.resize(std::min(moves.count(), most) * moves.start.size());
  return moves;
}

void run_catheter_contacts(const std::string& mesh, const std::string& suffix, const ContactOptions& options,
                           Report& report) {
  const insertion::Options catheter = catheter_options(mesh);
  const insertion::Vessel vessel(catheter);
  const CatheterMoves moves = moves_of(vessel, catheter, options, options.quick ? 1000 : 4000);
  const std::size_t cold_moves = std::min<std::size_t>(moves.count(), options.quick ? 100 : 400);
  Hash hash;
  Measured warm = replay(vessel.environment(), moves, moves.count(), false, hash);
  // A move does the same every time; what it took longer, others took.
  for (int round = 1; round < 3; ++round) {
    Hash again;
    const Measured other = replay(vessel.environment(), moves, moves.count(), false, again);
    for (std::size_t i = 0; i < warm.ns.size(); ++i) warm.ns[i] = std::min(warm.ns[i], other.ns[i]);
  }
  Hash unused;
  const Measured cold = replay(vessel.environment(), moves, cold_moves, true, unused);
  report.set("contact.us_per_contact.catheter" + suffix, 1e-3 * warm.per_contact());
  report.set("contact.us_per_contact.catheter.cold" + suffix, 1e-3 * cold.per_contact());
  const auto count = static_cast<double>(moves.count());
  report.set("contact.us_per_move" + suffix, 1e-3 * Measured::sum(warm.ns) / count);
  report.set("contact.us_p999" + suffix, 1e-3 * quantile(warm.ns, 0.999));
  report.set("contact.us_max" + suffix, 1e-3 * quantile(warm.ns, 1));
  report.set("contact.per_move" + suffix, Measured::sum(warm.contacts) / count);
  hash.report("contact.hash" + suffix, report);
}

void run_self_contacts(const ContactOptions& options, Report& report) {
  const std::size_t steps = options.quick ? 80 : 320;
  const RopeSpace space;
  const std::vector<std::vector<double>> targets = rope_targets(kRopeEdges, steps);
  std::vector<double> extra, contacts;
  Hash hash;
  for (int round = 0; round < 3; ++round) {
    Rope rope(space.environment(), targets[0], true), free_rope(space.environment(), targets[0], false);
    RopeStep step;
    std::vector<double> ns, free_ns;
    for (std::size_t i = 1; i <= steps; ++i) {
      const double ours = rope.move(targets[i], step), alone = free_rope.move(targets[i], step);
      const std::size_t count = round == 0 ? hash.add(rope.scene(), rope.body(), kRopeEdges + 1) : 0;
      if (i <= kWarmUp) continue;
      ns.push_back(ours);
      free_ns.push_back(alone);
      if (round == 0) contacts.push_back(static_cast<double>(count));
    }
    extra.push_back(Measured::sum(ns) - Measured::sum(free_ns));
  }
  report.set("contact.us_per_contact.self", 1e-3 * median(extra) / Measured::sum(contacts));
  report.set("contact.per_move.self", Measured::sum(contacts) / static_cast<double>(contacts.size()));
  hash.report("contact.hash.self", report);
}

}  // namespace

/** Valgrind counts what is below this name. */
extern "C" __attribute__((noinline)) void dsw_bench_counted(const std::function<void()>& move) { move(); }

namespace {

/** Makes moves for valgrind, without clocks and hashes. The first moves are not counted. */
void count_instructions(const ContactOptions& options, Report& report) {
  double contacts = 0;
  const auto count = [&](dsw_scene* scene, dsw_body_id body) {
    const dsw_body_contact* ignored = nullptr;
    std::size_t number = 0;
    check(dsw_body_get_contacts(scene, body, &ignored, &number));
    contacts += static_cast<double>(number);
  };
  std::size_t counted = 0;
  if (options.counted == "self") {
    counted = kCountedSteps;
    const RopeSpace space;
    const std::vector<std::vector<double>> targets = rope_targets(kRopeEdges, kWarmUp + counted);
    Rope rope(space.environment(), targets[0], true);
    RopeStep step;
    for (std::size_t i = 0; i < kWarmUp; ++i) rope.move(targets[i + 1], step);
    for (std::size_t i = kWarmUp; i < kWarmUp + counted; ++i) {
      dsw_bench_counted([&] { rope.move(targets[i + 1], step); });
      count(rope.scene(), rope.body());
    }
  } else {
    const insertion::Options catheter = catheter_options(options.mesh);
    const insertion::Vessel vessel(catheter);
    const CatheterMoves moves = moves_of(vessel, catheter, options, kWarmUp + kCountedMoves);
    counted = std::min(moves.count(), kWarmUp + kCountedMoves) - kWarmUp;
    CatheterReplay replay(vessel.environment(), moves);
    for (std::size_t i = 0; i < kWarmUp; ++i) replay.move(i);
    for (std::size_t i = kWarmUp; i < kWarmUp + counted; ++i) {
      dsw_bench_counted([&] { replay.move(i); });
      count(replay.scene(), replay.body());
    }
  }
  report.set("contact.counted_moves", static_cast<double>(counted));
  report.set("contact.counted_contacts", contacts);
}

}  // namespace

void run_contact(const ContactOptions& options, Report& report) {
  if (!options.counted.empty()) {
    count_instructions(options, report);
    return;
  }
  run_catheter_contacts("", options.mesh.empty() ? "" : ".generated", options, report);
  if (!options.mesh.empty()) run_catheter_contacts(options.mesh, "", options, report);
  run_self_contacts(options, report);
}

}  // namespace dsw::bench
