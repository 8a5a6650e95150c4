// Random changes of the topology on every kind of cell, with particles and bodies inside.
#include <cstdlib>
#include <iostream>

#include "random_edits.h"
#include "snapshot/bytes.h"

namespace dsw::oracle {
namespace {

template <int D>
size_t wanted_edits() {
  return static_cast<size_t>(effort_of(4000)) / (D == 2 ? plane::kinds().size() : scene_kinds().size()) + 1;
}

template <int D>
void keeps_everything_in_its_place(const std::string& scene) {
  const size_t wanted = wanted_edits<D>();
  constexpr size_t kRound = 150;  // changes of one environment
  constexpr size_t kExact = 50;   // and how often that is checked in exact integers
  EditTally sums[static_cast<size_t>(Operation::kCount)];
  size_t done = 0, exact_checks = 0;
  // Cuts can leave an outer boundary that crosses itself by a rounding, and then there is no partition to check.
  for (uint64_t seed = 1; done < wanted || (exact_checks == 0 && seed < 30); ++seed) {
    RandomEdits<D> edits(scene, seed);
    if (edits.environment() == nullptr) continue;
    size_t round = 0, exact = 0;
    const size_t goal = done < wanted ? std::min(kRound, wanted - done) : kRound;
    for (size_t calls = 0; round < goal && calls < 40 * kRound; ++calls) {
      const std::string wrong = edits.step();
      ASSERT_EQ(wrong, "") << "scene seed " << seed << ", call " << calls;
      if (calls % 16 == 15) {
        ASSERT_EQ(edits.move_all(), "") << "scene seed " << seed << ", call " << calls;
      }
      round = 0;
      for (const EditTally& tally : edits.tallies) round += tally.done;
      if (round < exact + kExact && round < goal) continue;
      exact = round;
      ASSERT_EQ(edits.check_exactly(), "") << "scene seed " << seed << ", call " << calls;
    }
    done += round;
    exact_checks += edits.exact_checks;
    for (size_t i = 0; i < std::size(sums); ++i) {
      sums[i].tried += edits.tallies[i].tried;
      sums[i].done += edits.tallies[i].done;
      sums[i].occupied += edits.tallies[i].occupied;
    }
  }
  EXPECT_GT(exact_checks, 0u);
  testing::Test::RecordProperty("changes", static_cast<int>(done));
  testing::Test::RecordProperty("exact_checks", static_cast<int>(exact_checks));
  for (size_t i = 0; i < std::size(sums); ++i) {
    testing::Test::RecordProperty(name_of(static_cast<Operation>(i)), static_cast<int>(sums[i].done));
  }
  if (effort_of(1) == 1) return;
  std::cout << exact_checks << " exact checks of a partition\n";
  for (size_t i = 0; i < std::size(sums); ++i) {
    std::cout << name_of(static_cast<Operation>(i)) << ": " << sums[i].tried << " tried, " << sums[i].done << " done, "
              << sums[i].occupied << " occupied\n";
  }
}

template <int D>
void changes_nothing_out_of_memory(const std::string& scene) {
  const auto changes = static_cast<size_t>(std::clamp(effort_of(20), 8, 20));
  for (const uint32_t features : {0u, uint32_t{DSW_FEATURE_LIVE_CHANGES}}) {
    FailingMemory memory;
    RandomEdits<D> edits(scene, 3, &memory, features);
    if (edits.environment() == nullptr) GTEST_SKIP() << "creation may refuse this mesh";
    size_t done = 0;
    for (size_t calls = 0; done < changes && calls < 1000; ++calls) {
      if (calls == changes) {
        ASSERT_EQ(edits.move_all(), "");  // from here on points are the host's
      }
      ASSERT_EQ(edits.step(), "") << "features " << features << ", call " << calls;
      done = 0;
      for (const EditTally& tally : edits.tallies) done += tally.done;
    }
    EXPECT_GT(edits.refusals, 5 * changes);
  }
}

/// The saved bytes, without the flags that name the features of the scene, and without the checksum.
template <int D>
std::string saved_without_features(const RandomEdits<D>& edits) {
  constexpr size_t kAtChecksum = 24, kAtFlags = 32;
  size_t scene = 0;
  EXPECT_EQ(dsw_environment_save(edits.environment(), nullptr, 0, &scene), DSW_STATUS_OK);
  std::string blocks = edits.saved();
  blocks.erase(scene + kAtFlags, 4).erase(scene + kAtChecksum, 8);
  return blocks;
}

template <int D>
void answers_alike_whatever_is_kept(const std::string& scene) {
  size_t occupied = 0;
  const auto seeds = static_cast<uint64_t>(std::max(3, effort_of(6)));  // one of three has other features
  const int calls = std::clamp(effort_of(60), 30, 60);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const uint32_t features = seed % 3 == 0 ? DSW_FEATURE_BODY_CONTACTS : 0;
    RandomEdits<D> plain(scene, seed, nullptr, features);
    RandomEdits<D> kept(scene, seed, nullptr, features | DSW_FEATURE_LIVE_CHANGES);
    if (plain.environment() == nullptr) continue;
    for (int call = 0; call < calls; ++call) {
      const auto same = [&](const std::string& a, const std::string& b) {
        occupied += plain.occupants().empty() ? 0u : 1u;
        return a == b && plain.occupants() == kept.occupants();
      };
      ASSERT_TRUE(same(plain.step(), kept.step())) << "scene seed " << seed << ", call " << call;
      ASSERT_TRUE(same(plain.mark(), kept.mark())) << "scene seed " << seed << ", call " << call;
      if (call % 4 == 3) {
        ASSERT_EQ(plain.move_all(), kept.move_all());
      }
      ASSERT_TRUE(saved_without_features(plain) == saved_without_features(kept)) << seed << ", call " << call;
    }
  }
  EXPECT_GT(occupied, 0u);
}

template <int D>
void goes_on_with_the_same_bits(const std::string& scene) {
  const auto seeds = static_cast<uint64_t>(std::max(2, effort_of(4)));
  const int rounds = std::clamp(effort_of(5), 3, 5);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const uint32_t features = seed % 2 == 0 ? DSW_FEATURE_LIVE_CHANGES : 0;
    RandomEdits<D> edits(scene, seed, nullptr, features), copy(scene, seed, nullptr, features);
    if (edits.environment() == nullptr) continue;
    for (int round = 0; round < rounds; ++round) {
      for (int calls = 0; calls < 20; ++calls) ASSERT_EQ(edits.step(), copy.step()) << "scene seed " << seed;
      ASSERT_EQ(edits.move_all(), copy.move_all());
      ASSERT_TRUE(edits.saved() == copy.saved()) << "scene seed " << seed << ", round " << round;
      ASSERT_EQ(copy.reload(), "") << "scene seed " << seed << ", round " << round;
      ASSERT_TRUE(edits.saved() == copy.saved()) << "scene seed " << seed << ", round " << round;
    }
  }
}

/// Words changed behind a right checksum: refused, or sound and saved as they are.
template <int D>
void refuses_damage(const std::string& scene) {
  RandomEdits<D> edits(scene, 2);
  if (edits.environment() == nullptr) GTEST_SKIP() << "creation may refuse this mesh";
  for (int calls = 0; calls < 40; ++calls) ASSERT_EQ(edits.step(), "");
  constexpr size_t kAtChecksum = 24, kAtFlags = 32;
  const std::string blocks = edits.saved();
  size_t size = 0;
  ASSERT_EQ(dsw_environment_save(edits.environment(), nullptr, 0, &size), DSW_STATUS_OK);
  Rng rng(31);
  for (int round = 0; round < effort_of(1500); ++round) {
    std::vector<uint8_t> block(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(size));
    for (int n = rng.between(1, 3); n > 0; --n) {
      const size_t at = kAtFlags + 4 * rng.below((size - kAtFlags) / 4);
      uint32_t word = 0;
      fetch(&word, block.data() + at, 1);
      const uint32_t values[] = {0, word + 1, word - 1, word ^ 1u << rng.below(32), UINT32_MAX, rng.below(200u)};
      store(block.data() + at, &values[rng.below(6)], 1);
    }
    const uint64_t sum =
        checksum(checksum(0, block.data(), kAtChecksum), block.data() + kAtChecksum + 8, size - kAtChecksum - 8);
    store(block.data() + kAtChecksum, &sum, 1);
    dsw_environment* raw = nullptr;
    const dsw_status status = dsw_environment_load(nullptr, block.data(), size, &raw);
    const EnvironmentPtr loaded(raw);
    if (status != DSW_STATUS_OK) {
      ASSERT_TRUE(status == DSW_STATUS_CORRUPT || status == DSW_STATUS_TRUNCATED) << round;
      continue;
    }
    std::vector<uint8_t> again(size);
    size_t needed = 0;
    ASSERT_EQ(dsw_environment_save(loaded.get(), again.data(), again.size(), &needed), DSW_STATUS_OK) << round;
    ASSERT_TRUE(again == block) << round;
  }
}

class EditsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(EditsTest);
class PlaneEditsTest : public SceneTest {};
DSW_FOR_ALL_PLANE_SCENES(PlaneEditsTest);

TEST_P(EditsTest, EveryChangeKeepsEverythingInItsPlace) { keeps_everything_in_its_place<3>(GetParam()); }
TEST_P(EditsTest, RunningOutOfMemoryAnywhereChangesNothing) { changes_nothing_out_of_memory<3>(GetParam()); }
TEST_P(EditsTest, WhatIsKeptToFindOccupantsChangesNoAnswer) { answers_alike_whatever_is_kept<3>(GetParam()); }
TEST_P(EditsTest, WhatIsLoadedGoesOnWithTheSameBits) { goes_on_with_the_same_bits<3>(GetParam()); }
TEST_P(EditsTest, DamageOfWhatHasChangedIsRefusedOrSound) { refuses_damage<3>(GetParam()); }

TEST_P(PlaneEditsTest, EveryChangeKeepsEverythingInItsPlace) { keeps_everything_in_its_place<2>(GetParam()); }
TEST_P(PlaneEditsTest, RunningOutOfMemoryAnywhereChangesNothing) { changes_nothing_out_of_memory<2>(GetParam()); }
TEST_P(PlaneEditsTest, WhatIsKeptToFindOccupantsChangesNoAnswer) { answers_alike_whatever_is_kept<2>(GetParam()); }
TEST_P(PlaneEditsTest, WhatIsLoadedGoesOnWithTheSameBits) { goes_on_with_the_same_bits<2>(GetParam()); }
TEST_P(PlaneEditsTest, DamageOfWhatHasChangedIsRefusedOrSound) { refuses_damage<2>(GetParam()); }

}  // namespace
}  // namespace dsw::oracle
