// Snapshots: the same bytes, the same marks, the same answers; damage is an error.
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

class SnapshotTest : public SceneTest {};
DSW_FOR_ALL_SCENES(SnapshotTest);

Place marked_place(const std::string& name, uint64_t seed) {
  Rng rng(seed);
  Mesh mesh = kind_named(name).make(rng);
  for (size_t c = 0; c < mesh.cells.size(); ++c) {
    mesh.regions.push_back(rng.between(-5, 5));
    mesh.tags.push_back(static_cast<uint32_t>(rng.next()));
  }
  Place place = place_of(std::move(mesh), DSW_ENVIRONMENT_LOCATE_TREE);
  if (place.world == nullptr) return place;
  World& world = *place.world;
  const Edges edges(world);
  for (int i = 0; i < 6; ++i) {
    const size_t c = rng.below(world.ids.size());
    if (i < 2) {
      world.cell_marked[c] = 1;
      EXPECT_EQ(dsw_environment_mark_volumes(place.get(), &world.ids[c], 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                DSW_STATUS_OK);
    }
    const size_t f = rng.below(world.faces.size());
    world.faces[f].marked = true;
    const dsw_face_id face = face_id(world, static_cast<int>(f));
    EXPECT_EQ(dsw_environment_mark_faces(place.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    const dsw_edge_id edge = edges.id(world, static_cast<int>(rng.below(edges.edges.size())));
    EXPECT_EQ(dsw_environment_mark_edges(place.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    dsw_vertex_id vertex;
    EXPECT_EQ(dsw_environment_get_vertex_id(place.get(), rng.below(place.mesh.points.size()), &vertex), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_mark_vertices(place.get(), &vertex, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  return place;
}

TEST_P(SnapshotTest, RoundTripGivesTheSameBytesMarksAndAnswers) {
  const Place place = marked_place(GetParam(), 71);
  ASSERT_PLACE(place);
  const std::vector<unsigned char> block = saved(place.get());
  // Any alignment.
  std::vector<unsigned char> odd(block.size() + 1);
  std::copy(block.begin(), block.end(), odd.begin() + 1);
  dsw_environment* raw = nullptr;
  ASSERT_EQ(dsw_environment_load(nullptr, odd.data() + 1, block.size(), &raw), DSW_STATUS_OK)
      << dsw_last_error_message();
  const EnvironmentPtr loaded(raw);
  EXPECT_EQ(saved(loaded.get()), block);
  EXPECT_EQ(World(place.mesh, loaded.get()).fault(), "");
  const World& world = *place.world;
  for (dsw_cell_kind kind : {DSW_CELL_VERTEX, DSW_CELL_EDGE, DSW_CELL_FACE, DSW_CELL_VOLUME}) {
    size_t a = 0, b = 1;
    ASSERT_EQ(dsw_environment_get_mark_count(place.get(), kind, &a), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_get_mark_count(loaded.get(), kind, &b), DSW_STATUS_OK);
    EXPECT_EQ(a, b);
  }
  const auto compare_mark = [&](dsw_cell cell) {
    int a = 0, b = 1;
    ASSERT_EQ(dsw_environment_is_marked(place.get(), cell, &a), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_is_marked(loaded.get(), cell, &b), DSW_STATUS_OK);
    EXPECT_EQ(a, b) << cell;
  };
  for (size_t f = 0; f < world.faces.size(); ++f) compare_mark(cell_of(face_id(world, static_cast<int>(f))));
  const Edges edges(world);
  for (size_t e = 0; e < edges.edges.size(); ++e) compare_mark(cell_of(edges.id(world, static_cast<int>(e))));
  for (size_t c = 0; c < world.ids.size(); ++c) {
    compare_mark(cell_of(world.ids[c]));
    int32_t region = 0;
    uint32_t tag = 0;
    ASSERT_EQ(dsw_environment_get_region(loaded.get(), world.ids[c], &region), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_get_tag(loaded.get(), world.ids[c], &tag), DSW_STATUS_OK);
    EXPECT_EQ(region, place.mesh.regions[c]);
    EXPECT_EQ(tag, place.mesh.tags[c]);
  }
  Rng rng(71);
  Motions motions(world, rng);
  for (int i = 0; i < at_least(200); ++i) {
    const Vec p = motions.start(), q = motions.target(p);
    dsw_flight a, b;
    ASSERT_EQ(dsw_environment_cast(place.get(), {0, 0}, p.data(), q.data(), nullptr, &a), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_cast(loaded.get(), {0, 0}, p.data(), q.data(), nullptr, &b), DSW_STATUS_OK);
    EXPECT_EQ(bits_of(a), bits_of(b));
  }
  EXPECT_EQ(dsw_environment_check(loaded.get(), nullptr), DSW_STATUS_OK);
}

TEST_P(SnapshotTest, EveryTruncationAndEveryDamagedByteIsAnError) {
  const Place place = marked_place(GetParam(), 73);
  ASSERT_PLACE(place);
  const std::vector<unsigned char> block = saved(place.get());
  dsw_environment* const untouched = reinterpret_cast<dsw_environment*>(0x1);
  const auto refused = [&](const std::vector<unsigned char>& damaged, size_t size) {
    dsw_environment* raw = untouched;
    const dsw_status status = dsw_environment_load(nullptr, damaged.data(), size, &raw);
    if (status == DSW_STATUS_OK) dsw_environment_destroy(raw);
    EXPECT_TRUE(status == DSW_STATUS_TRUNCATED || status == DSW_STATUS_CORRUPT || status == DSW_STATUS_BAD_VERSION)
        << dsw_status_string(status);
    if (status != DSW_STATUS_OK) {
      EXPECT_EQ(raw, untouched);
    }
    return status != DSW_STATUS_OK;
  };
  const size_t step = std::max<size_t>(1, block.size() / 400);
  for (size_t size = 0; size < block.size(); size += size < 256 ? 1 : step) {
    // An exact copy of the part, so that a reader past the end is seen by a checker of memory.
    std::vector<unsigned char> part(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size));
    if (size == 0) part.push_back(0);  // no null pointer
    ASSERT_TRUE(refused(part, size)) << "first " << size << " of " << block.size();
  }
  Rng rng(73);
  std::vector<unsigned char> damaged = block;
  for (size_t at = 0; at < block.size(); at += at < 256 ? 1 : step) {
    damaged[at] = static_cast<unsigned char>(block[at] ^ (1u << rng.below(8)));
    ASSERT_TRUE(refused(damaged, damaged.size())) << "byte " << at << " of " << block.size();
    damaged[at] = block[at];
  }
  damaged.push_back(0);
  EXPECT_TRUE(refused(damaged, damaged.size())) << "a byte after the block";
  unsigned char small[8];
  size_t needed = 0;
  EXPECT_EQ(dsw_environment_save(place.get(), small, sizeof small, &needed), DSW_STATUS_BUFFER_TOO_SMALL);
  EXPECT_EQ(needed, block.size());
}

}  // namespace
}  // namespace dsw::oracle
