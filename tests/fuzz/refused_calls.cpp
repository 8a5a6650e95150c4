// A call that fails changes nothing. Random calls of every function that changes a scene, its environment or a body are
// made with one allocation refused after the other, and with arguments that are refused. Whenever one fails, the
// snapshots of the scene and of its environment are the same bytes as before.
// usage: refused_calls [REFUSALS [SEED]]   refusals of each kind of call; a kind is what Calls::make does for one byte

#include <algorithm>
#include <random>

#include "../aligned_memory.h"
#include "calls.h"

namespace {

constexpr size_t kKinds = 56;

/** A host that refuses one allocation. */
struct Host {
  size_t calls = 0, refused = 0;  // 0: none is
};

void* allocate(void* user, size_t size, size_t alignment) {
  auto& host = *static_cast<Host*>(user);
  return ++host.calls == host.refused ? nullptr : allocate_aligned(size, alignment);
}
void release(void*, void* block, size_t, size_t alignment) { release_aligned(block, alignment); }

dsw_context* make_context(Host* host) {
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.user = host;
  desc.allocate = allocate;
  desc.release = release;
  dsw_context* context = nullptr;
  dsw_fuzz::require(dsw_context_create(&desc, &context) == DSW_STATUS_OK, "a context");
  return context;
}

struct Tally {
  size_t by_memory = 0, otherwise = 0, changed = 0;
  size_t refusals() const { return by_memory + otherwise; }
};

/** What a scene and its environment are, to the bit. */
struct Saved {
  std::vector<uint8_t> environment, scene;

  explicit Saved(const dsw_scene* of)
      : environment(dsw_fuzz::save(dsw_scene_get_environment(of))), scene(dsw_fuzz::save(of)) {}
  bool operator==(const Saved& other) const { return environment == other.environment && scene == other.scene; }
};

class Round {
 public:
  explicit Round(uint64_t seed) : random_(seed), context_(make_context(&host_)) {
    world_ = dsw_fuzz::world_of(byte());
    home_ = dsw_fuzz::make_world(world_, context_);
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = byte() & 0x1fu;
    dsw_fuzz::require(dsw_scene_create(home_, &desc, &scene_) == DSW_STATUS_OK, "a scene");
  }
  ~Round() {
    dsw_scene_destroy(scene_);
    dsw_environment_destroy(home_);
    dsw_context_destroy(context_);
  }

  void run(Tally (&tallies)[kKinds]) {
    std::vector<uint8_t> program(1 << 14);
    for (uint8_t& each : program) each = byte();
    dsw_fuzz::Bytes bytes(program.data(), program.size());
    dsw_fuzz::Calls calls(scene_, world_, &bytes);
    for (int i = 0; i < 60; ++i) {
      const dsw_fuzz::Bytes begin = bytes;
      const uint8_t choice = bytes.byte();
      bytes = begin;
      Tally& tally = tallies[choice % kKinds];
      // What only looks is not asked. Few refusals are of bodies and particles unless there are some.
      if (choice >= 4 * kKinds) {
        bytes.byte();
      } else {
        call(calls, bytes, tally);
      }
    }
  }

 private:
  /** Where bytes differ first, but for the checksum that every snapshot has in its header. */
  static void tell(const Saved& before, const Saved& after) {
    const auto tell_of = [](const char* what, const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
      constexpr std::ptrdiff_t kBehindChecksum = 32;
      if (a == b) return;
      const auto at =
          std::mismatch(a.begin() + kBehindChecksum, a.end(), b.begin() + kBehindChecksum, b.end()).first - a.begin();
      std::printf("%s: %zu bytes were %zu, the first other one is %td; ", what, b.size(), a.size(), at);
    };
    tell_of("environment", before.environment, after.environment);
    tell_of("scene", before.scene, after.scene);
    std::printf("after %s\n", dsw_last_error_message());
  }
  uint8_t byte() { return static_cast<uint8_t>(random_()); }

  /** Makes one call until no memory is refused. */
  void call(dsw_fuzz::Calls& calls, dsw_fuzz::Bytes& bytes, Tally& tally) {
    const dsw_fuzz::Bytes begin = bytes;
    const Saved before(scene_);
    // If there are many allocations, some are left out.
    for (size_t n = 0;; n += 1 + n / 16) {
      bytes = begin;
      host_.refused = host_.calls + n + 1;
      const dsw_status status = calls.make();
      host_.refused = 0;
      dsw_fuzz::require(status != DSW_STATUS_INTERNAL, dsw_last_error_message());
      if (status == DSW_STATUS_OK) return;
      ++(status == DSW_STATUS_OUT_OF_MEMORY ? tally.by_memory : tally.otherwise);
      if (!(before == Saved(scene_))) {
        ++tally.changed;
        tell(before, Saved(scene_));
        return;
      }
      if (status != DSW_STATUS_OUT_OF_MEMORY) return;
    }
  }

  std::mt19937_64 random_;
  Host host_;
  dsw_context* context_;
  dsw_fuzz::World world_;
  dsw_environment* home_;
  dsw_scene* scene_ = nullptr;
};

}  // namespace

int main(int argc, char** argv) {
  const size_t wanted = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100;
  uint64_t seed = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
  Tally tallies[kKinds];
  const auto is_done = [&](const Tally& each) { return each.refusals() >= wanted; };
  for (size_t round = 0; round < 100 * wanted && !std::all_of(tallies, tallies + kKinds, is_done); ++round, ++seed) {
    Round(seed).run(tallies);
  }
  size_t changed = 0, with_memory = 0;
  for (size_t kind = 0; kind < kKinds; ++kind) {
    const Tally& each = tallies[kind];
    changed += each.changed;
    with_memory += each.by_memory != 0 ? 1 : 0;
    std::printf("kind %2zu: %zu refused by memory, %zu otherwise, %zu changed something\n", kind, each.by_memory,
                each.otherwise, each.changed);
  }
  std::printf("%zu kinds take memory\n", with_memory);
  return changed == 0 && with_memory >= 40 ? 0 : 1;
}
