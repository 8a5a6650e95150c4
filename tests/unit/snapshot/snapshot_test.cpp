// Snapshots: what was saved comes back, every damage is answered, also where the checksum was set right again.

#include "snapshot/snapshot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "../../aligned_memory.h"
#include "base/error.h"
#include "environment/marking.h"
#include "map/dart.h"
#include "map/integrity.h"
#include "small_meshes.h"
#include "snapshot/bytes.h"

#include "../../effort.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;

// Positions of format version 1.
constexpr size_t kAtVersion = 8, kAtDimension = 12, kAtSize = 16, kAtChecksum = 24, kAtFlags = 32, kAtVertexCount = 36,
                 kAtCellCount = 40, kAtSectionCount = 44, kAtSections = 48, kHeaderBytes = 176;

template <int D>
std::vector<uint8_t> saved(const Environment<D>& env) {
  std::vector<uint8_t> block(snapshot_bytes(env), 0xcd);
  save(env, block.data());
  return block;
}

/** Loads a copy of exactly this size, so that a reader past the end is seen by a checker of memory. */
template <int D>
dsw_status load_status(const std::vector<uint8_t>& block, Environment<D>& env) {
  const std::unique_ptr<uint8_t[]> copy(new uint8_t[block.size()]);
  std::copy(block.begin(), block.end(), copy.get());
  try {
    load(env, copy.get(), block.size());
  } catch (const Error& error) {
    return error.status();
  }
  return DSW_STATUS_OK;
}

template <int D = 3>
dsw_status load_status(const std::vector<uint8_t>& block) {
  Environment<D> env(nullptr);
  return load_status(block, env);
}

bool is_refusal(dsw_status status) {
  return status == DSW_STATUS_TRUNCATED || status == DSW_STATUS_CORRUPT || status == DSW_STATUS_BAD_VERSION;
}

void put(std::vector<uint8_t>& block, size_t at, uint32_t value) { store(block.data() + at, &value, 1); }

/** Sets size and checksum right. */
std::vector<uint8_t> repaired(std::vector<uint8_t> block) {
  const uint64_t size = block.size();
  store(block.data() + kAtSize, &size, 1);
  const uint64_t sum =
      checksum(checksum(0, block.data(), kAtChecksum), block.data() + kAtChecksum + 8, block.size() - kAtChecksum - 8);
  store(block.data() + kAtChecksum, &sum, 1);
  return block;
}

/** An environment with a tree of its cells from the start, if `tree`, and marks of every kind. */
template <int D>
void make(Environment<D>& env, const SmallMesh& mesh, bool marked, bool tree) {
  build_mesh(env, mesh);
  if (tree) env.index.set_use(TreeUse::kAtOnce);
  if (tree) env.index.build(env);
  if (!marked) return;
  reserve_edge_marks(env, 4);
  reserve_vertex_marks(env);
  for (uint32_t n = 0; n < 3; ++n) {
    const Cell c = env.map.cell((2 * n) % env.map.cell_count);
    set_facet_mark(env, env.map.half_facet(c, n), true);
    set_vertex_mark(env, env.map.vertex(c, n), true);
    set_edge_mark(env, dart_vertex(env.map, {c, n}), dart_target(env.map, {c, n}), true);
  }
  set_cell_mark(env, env.map.cell(0), true);
}

template <int D>
void expect_same(const Environment<D>& a, const Environment<D>& b) {
  EXPECT_EQ(a.map.words, b.map.words);
  EXPECT_EQ(a.map.shape_tables, b.map.shape_tables);
  EXPECT_EQ(a.map.shape_offsets, b.map.shape_offsets);
  EXPECT_EQ(a.map.unit_of_cell, b.map.unit_of_cell);
  EXPECT_EQ(a.map.cell_of_unit, b.map.cell_of_unit);
  EXPECT_EQ(a.map.cell_count, b.map.cell_count);
  EXPECT_EQ(a.map.units_per_cell, b.map.units_per_cell);
  EXPECT_EQ(a.map.vertex_count, b.map.vertex_count);
  EXPECT_EQ(a.map.facet_count, b.map.facet_count);
  EXPECT_EQ(a.map.boundary_facet_count, b.map.boundary_facet_count);
  EXPECT_EQ(std::memcmp(a.points, b.points, size_t{a.map.vertex_count} * D * sizeof(double)), 0);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.tags, b.tags);
  Array<uint64_t> ea, eb;
  a.edge_marks.copy_sorted(ea);
  b.edge_marks.copy_sorted(eb);
  EXPECT_EQ(ea, eb);
  for (uint32_t v = 0; v < a.map.vertex_count; ++v) EXPECT_EQ(vertex_marked(a, v), vertex_marked(b, v));
  EXPECT_EQ(a.marked_cells, b.marked_cells);
  EXPECT_EQ(a.marked_facets, b.marked_facets);
  EXPECT_EQ(a.marked_edges, b.marked_edges);
  EXPECT_EQ(a.marked_vertices, b.marked_vertices);
  EXPECT_EQ(a.part_count, b.part_count);
  for (int k = 0; k < D; ++k) {
    EXPECT_EQ(a.lower[k], b.lower[k]);
    EXPECT_EQ(a.upper[k], b.upper[k]);
  }
  EXPECT_EQ(a.index.use(), b.index.use());
  EXPECT_EQ(a.index.memory_bytes(), b.index.memory_bytes());
}

template <int D>
void expect_round_trips(const SmallMesh& mesh) {
  for (const bool marked : {false, true}) {
    SCOPED_TRACE(mesh.name + (marked ? ", marked" : ""));
    Environment<D> env(nullptr), again(nullptr), other_dimension(nullptr);
    make(env, mesh, marked, marked);
    if (marked) {
      EXPECT_GT(env.marked_edges * env.marked_vertices * env.marked_facets * env.marked_cells, 0u);
    }
    const std::vector<uint8_t> block = saved(env);
    ASSERT_EQ(load_status(block, again), DSW_STATUS_OK);
    expect_same(env, again);
    EXPECT_STREQ(check_integrity(again.map), nullptr);
    EXPECT_EQ(saved(again), block);
    EXPECT_EQ(load_status<5 - D>(block), DSW_STATUS_CORRUPT) << "the other dimension";
    // Any alignment of the block.
    std::vector<uint8_t> odd(block.size() + 3, 0xee);
    save(env, odd.data() + 3);
    EXPECT_TRUE(std::equal(block.begin(), block.end(), odd.begin() + 3));
    Environment<D> third(nullptr);
    load(third, odd.data() + 3, block.size());
    EXPECT_EQ(saved(third), block);
  }
}

TEST(Snapshot, RoundTripGivesTheSameEnvironmentAndBytes) {
  for (const SmallMesh& mesh : small_meshes()) expect_round_trips<3>(mesh);
  for (const SmallMesh& mesh : planar_meshes()) expect_round_trips<2>(mesh);
}

TEST(Snapshot, WhatWasNeverGivenTakesNoBytes) {
  SmallMesh mesh = pair_of(kHexahedron, kHexahedron);
  Environment<3> env(nullptr);
  build_mesh(env, mesh);
  EXPECT_EQ(snapshot_bytes(env), kHeaderBytes + 2 * 64 + 12 * 24);
  reserve_vertex_marks(env);
  set_vertex_mark(env, 3, true);
  EXPECT_EQ(snapshot_bytes(env), kHeaderBytes + 2 * 64 + 12 * 24 + 8);
  set_vertex_mark(env, 3, false);
  EXPECT_EQ(snapshot_bytes(env), kHeaderBytes + 2 * 64 + 12 * 24) << "no marks are as good as no room for them";
}

TEST(Snapshot, TruncatedAtEveryLength) {
  for (const SmallMesh& mesh : small_meshes()) {
    Environment<3> env(nullptr);
    make(env, mesh, true, true);
    const std::vector<uint8_t> block = saved(env);
    for (size_t size = 0; size < block.size(); ++size) {
      const std::vector<uint8_t> part(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(load_status(part), DSW_STATUS_TRUNCATED) << mesh.name << " " << size << " of " << block.size();
      if (size < kHeaderBytes || size % 8 != 0) continue;
      ASSERT_EQ(load_status(repaired(part)), DSW_STATUS_CORRUPT) << mesh.name << " " << size;
    }
    std::vector<uint8_t> longer = block;
    for (int i = 0; i < 8; ++i) {
      longer.push_back(0);
      EXPECT_EQ(load_status(longer), DSW_STATUS_CORRUPT);
    }
    EXPECT_EQ(load_status(repaired(longer)), DSW_STATUS_CORRUPT);
  }
}

TEST(Snapshot, EveryDamagedByteIsSeenByTheChecksum) {
  for (const SmallMesh& mesh : {pair_of(kPyramid, kPolyhedron), polygon_prism(6), ring(5, 5)}) {
    Environment<3> env(nullptr);
    make(env, mesh, true, false);
    std::vector<uint8_t> block = saved(env);
    for (size_t at = 0; at < block.size(); ++at) {
      const uint8_t was = block[at];
      for (const uint32_t flip : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u, 255u}) {
        block[at] = static_cast<uint8_t>(was ^ flip);
        const dsw_status status = load_status(block);
        ASSERT_TRUE(is_refusal(status)) << mesh.name << " byte " << at;
        // Version 2 is written where no cell was split, and 3 is known as well: then the checksum tells.
        const bool is_known = at == kAtVersion && block[at] == 3;
        if (at / 4 == kAtVersion / 4 && !is_known) {
          EXPECT_EQ(status, DSW_STATUS_BAD_VERSION);
        } else if (at / 8 != kAtSize / 8) {
          EXPECT_EQ(status, DSW_STATUS_CORRUPT);
        }
      }
      block[at] = was;
    }
  }
}

/** Damage behind a right checksum: refused, or sound and saved as it was. */
template <int D>
void expect_answered(const std::vector<uint8_t>& damaged, size_t* accepted) {
  Environment<D> env(nullptr);
  const std::vector<uint8_t> block = repaired(damaged);
  const dsw_status status = load_status(block, env);
  if (status == DSW_STATUS_OK) {
    ++*accepted;
    ASSERT_STREQ(check_integrity(env.map), nullptr);
    ASSERT_EQ(saved(env), block);
  } else {
    ASSERT_TRUE(is_refusal(status)) << status;
  }
}

template <int D>
void damage_behind_the_checksum(const SmallMesh& mesh, uint32_t seed, size_t* accepted) {
  SCOPED_TRACE(mesh.name);
  std::mt19937 random(static_cast<uint32_t>(seed_of(seed)));
  Environment<D> env(nullptr);
  make(env, mesh, true, true);
  const std::vector<uint8_t> block = saved(env);
  std::vector<uint8_t> damaged = block;
  for (size_t at = 0; at < block.size(); ++at) {
    for (const uint32_t value : {uint32_t{block[at]} ^ (1u << random() % 8), 0u, 0xffu}) {
      damaged[at] = static_cast<uint8_t>(value);
      if (damaged[at] != block[at]) expect_answered<D>(damaged, accepted);
      if (testing::Test::HasFatalFailure()) FAIL() << "byte " << at;
    }
    damaged[at] = block[at];
  }
  const uint32_t words = static_cast<uint32_t>(env.map.words.size());
  for (int round = 0; round < at_least(500); ++round) {
    for (int n = 0; n < 3; ++n) {
      const size_t at = kAtFlags + 4 * (random() % ((block.size() - kAtFlags) / 4));
      put(damaged, at, static_cast<uint32_t>(round % 2 == 0 ? random() % (words + 2) : random()));
    }
    expect_answered<D>(damaged, accepted);
    if (testing::Test::HasFatalFailure()) FAIL() << "round " << round;
    damaged = block;
  }
}

TEST(Snapshot, DamageBehindARightChecksumIsRefusedOrSound) {
  size_t accepted = 0;
  const std::vector<SmallMesh> meshes = small_meshes();
  for (size_t i = 0; i < meshes.size(); i += 2) damage_behind_the_checksum<3>(meshes[i], 3, &accepted);
  EXPECT_GT(accepted, 0u) << "a moved point, another tag or region are as sound as before";
  accepted = 0;
  for (const SmallMesh& mesh : planar_meshes()) damage_behind_the_checksum<2>(mesh, 5, &accepted);
  EXPECT_GT(accepted, 0u);
}

/** Allocation hooks that know how much is out, and fail on demand. */
struct Meter {
  size_t out = 0, most = 0, left = SIZE_MAX;
  Memory memory{this, allocate, release};

  static void* allocate(void* user, size_t size, size_t alignment) {
    Meter& m = *static_cast<Meter*>(user);
    if (m.left == 0) return nullptr;
    --m.left;
    m.out += size;
    m.most = std::max(m.most, m.out);
    return allocate_aligned(size, alignment);
  }
  static void release(void* user, void* block, size_t size, size_t alignment) {
    static_cast<Meter*>(user)->out -= size;
    release_aligned(block, alignment);
  }
};

TEST(Snapshot, ClaimedSizesAskForNoMemory) {
  Environment<3> env(nullptr);
  make(env, two_polygon_prisms(6), true, true);
  const std::vector<uint8_t> block = saved(env);
  for (const size_t at : {kAtVersion,       kAtDimension,     kAtSize,          kAtSize + 4,      kAtFlags,
                          kAtVertexCount,   kAtCellCount,     kAtSectionCount,  kAtSections,      kAtSections + 4,
                          kAtSections + 8,  kAtSections + 12, kAtSections + 16, kAtSections + 20, kAtSections + 24,
                          kAtSections + 32, kAtSections + 40, kAtSections + 44, kAtSections + 48, kAtSections + 52}) {
    for (const uint32_t value : {0u, 1u, 8u, 0x0fffffffu, 0x7fffffffu, 0x80000000u, 0xfffffff8u, 0xffffffffu}) {
      std::vector<uint8_t> damaged = block;
      put(damaged, at, value);
      if (damaged == block) continue;
      for (const std::vector<uint8_t>& tried : {damaged, repaired(damaged)}) {
        Meter meter;
        {
          Environment<3> loaded(&meter.memory);
          const dsw_status status = load_status(tried, loaded);
          // Flags of 0 leave out the grid, and repairing takes back a wrong size; all else is refused.
          if (status != DSW_STATUS_OK) {
            EXPECT_TRUE(is_refusal(status)) << at << " " << value;
          } else {
            EXPECT_TRUE(tried == block || at == kAtFlags) << at << " " << value;
          }
        }
        EXPECT_EQ(meter.out, 0u);
        EXPECT_LE(meter.most, 16 * block.size() + 4096);
      }
    }
  }
}

TEST(Snapshot, RefusedMemoryLeavesNothingBehind) {
  Environment<3> env(nullptr);
  make(env, pair_of(kPyramid, kPolyhedron), true, true);
  const std::vector<uint8_t> block = saved(env);
  for (size_t left = 0;; ++left) {
    ASSERT_LT(left, 10000u);
    Meter meter;
    meter.left = left;
    bool loaded = false;
    {
      Environment<3> again(&meter.memory);
      try {
        load(again, block.data(), block.size());
        loaded = true;
      } catch (const std::bad_alloc&) {
      }
    }
    EXPECT_EQ(meter.out, 0u);
    if (loaded) break;
  }
}

/** Blocks that are whole but could not have been saved. */
TEST(Snapshot, OnlyWhatSaveWritesIsAccepted) {
  Environment<3> env(nullptr);
  SmallMesh mesh = pair_of(kHexahedron, kHexahedron);
  mesh.regions = {4, 5};
  mesh.tags = {1, 2};
  make(env, mesh, true, false);
  const std::vector<uint8_t> block = saved(env);
  ASSERT_EQ(load_status(repaired(block)), DSW_STATUS_OK);
  const size_t words = kHeaderBytes, points = words + 128, regions = points + 288, edges = regions + 16;
  const size_t edge_count = env.edge_marks.size(), vertices = edges + 8 * edge_count;
  ASSERT_EQ(block.size(), vertices + 8);
  const auto status_of = [&](size_t at, uint32_t value) {
    std::vector<uint8_t> damaged = block;
    put(damaged, at, value);
    EXPECT_NE(damaged, block);
    return load_status(repaired(damaged));
  };
  EXPECT_EQ(status_of(kAtFlags, 2), DSW_STATUS_CORRUPT);
  EXPECT_EQ(status_of(kAtFlags, 1), DSW_STATUS_OK) << "with a grid";
  EXPECT_EQ(status_of(words, env.map.words[0] ^ kConvexBit), DSW_STATUS_CORRUPT);
  EXPECT_EQ(status_of(words, env.map.words[0] ^ kMarkBit), DSW_STATUS_OK) << "a mark more or less";
  EXPECT_EQ(status_of(regions, 77), DSW_STATUS_OK);
  EXPECT_EQ(status_of(edges, 0xffffffffu), DSW_STATUS_CORRUPT) << "no such vertex";
  EXPECT_EQ(status_of(edges + 8 * (edge_count - 1), 11), DSW_STATUS_CORRUPT) << "no such edge";
  EXPECT_EQ(status_of(vertices, 0), DSW_STATUS_CORRUPT) << "marks without any";
  EXPECT_EQ(status_of(vertices, 1u << 12), DSW_STATUS_CORRUPT) << "a mark beyond the last vertex";
  std::vector<uint8_t> swapped = block;
  ASSERT_GE(edge_count, 2u);
  std::swap_ranges(swapped.begin() + static_cast<std::ptrdiff_t>(edges),
                   swapped.begin() + static_cast<std::ptrdiff_t>(edges + 8),
                   swapped.begin() + static_cast<std::ptrdiff_t>(edges + 8));
  EXPECT_EQ(load_status(repaired(swapped)), DSW_STATUS_CORRUPT) << "edges out of order";
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    std::vector<uint8_t> damaged = block;
    store(damaged.data() + points + 8, &value, 1);
    EXPECT_EQ(load_status(repaired(damaged)), DSW_STATUS_CORRUPT);
  }
  const double far = 3;  // the middle points of one side: the left cell turns inside out
  std::vector<uint8_t> inverted = block;
  for (const size_t v : {0u, 3u, 6u, 9u}) store(inverted.data() + points + 24 * v, &far, 1);
  EXPECT_EQ(load_status(repaired(inverted)), DSW_STATUS_CORRUPT);
}

TEST(Snapshot, ScaledAndDenormalCoordinatesComeBack) {
  for (const double scale : {1e100, 1e-100, 1e300, 1e-310, -1.0 / -3.0}) {
    SmallMesh mesh = lattice(2, kHexahedron);
    for (double& x : mesh.points) x *= scale;
    Environment<3> env(nullptr), again(nullptr);
    build_mesh(env, mesh);
    ASSERT_EQ(load_status(saved(env), again), DSW_STATUS_OK) << scale;
    expect_same(env, again);
  }
}

}  // namespace
