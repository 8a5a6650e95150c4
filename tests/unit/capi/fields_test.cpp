// Structs in recordings: the same bytes on every machine. What translates them on machines with pointers of 4 bytes is
// run on every machine.
#include "capi/fields.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "base/error.h"
#include "capi/words.h"

#include "../../effort.h"

namespace dsw::capi {

/// A struct of the interface as it is where pointers have 4 bytes.
struct NarrowDesc {
  uint32_t struct_size, flags;
  uint32_t points, point_count;
  uint32_t rows;
  double width;
  uint32_t most, tag;
};
template <>
inline constexpr size_t first_size<NarrowDesc> = offsetof(NarrowDesc, width) + sizeof(double);
template <>
struct Fields<NarrowDesc> {
  static constexpr Field all[] = {
      same_field<uint32_t>(offsetof(NarrowDesc, struct_size)), same_field<uint32_t>(offsetof(NarrowDesc, flags)),
      wide_field<uint32_t>(offsetof(NarrowDesc, points)),      wide_field<uint32_t>(offsetof(NarrowDesc, point_count)),
      same_field<uint32_t>(offsetof(NarrowDesc, rows)),        same_field<double>(offsetof(NarrowDesc, width)),
      wide_field<uint32_t>(offsetof(NarrowDesc, most)),        same_field<uint32_t>(offsetof(NarrowDesc, tag))};
};

namespace {

using Bytes = std::vector<uint8_t>;

template <class T>
Bytes translated(const T& value) {
  uint8_t bytes[recorded_size<T>()];
  to_recorded(value, bytes);
  return Bytes(bytes, bytes + sizeof bytes);
}
template <class T>
Bytes in_memory(const T& value) {
  const auto* const bytes = reinterpret_cast<const uint8_t*>(&value);
  return Bytes(bytes, bytes + sizeof value);
}
/// The first bytes of a recorded struct, and zeros behind them.
Bytes of_size(Bytes bytes, size_t size) {
  bytes.resize(size);
  const auto number = static_cast<uint32_t>(size);
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}
template <class Read>
dsw_status status_of(const Read& read) {
  try {
    read();
    return DSW_STATUS_OK;
  } catch (const Error& error) {
    return error.status();
  }
}
/// A value at its place; bytes between are 0.
template <class T>
void put(Bytes& bytes, size_t at, T value) {
  bytes.resize(std::max(bytes.size(), at + sizeof value));
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class T>
class RecordedStruct : public testing::Test {
 protected:
  T random_value() {
    T value;
    auto* const bytes = reinterpret_cast<uint8_t*>(&value);
    for (size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<uint8_t>(random_());
    value.struct_size = sizeof value;
    return value;
  }

 private:
  std::mt19937 random_{static_cast<uint32_t>(seed_of(7))};
};
using All = testing::Types<dsw_volumes_desc, dsw_cut_desc, dsw_open_crack_desc, dsw_carve_desc, dsw_tie_desc,
                           dsw_detach_desc, dsw_remesh_desc, dsw_deform_options, dsw_body_desc, dsw_move_options,
                           dsw_cast_options, dsw_validation>;
TYPED_TEST_SUITE(RecordedStruct, All, testing::internal::DefaultNameGenerator);

TYPED_TEST(RecordedStruct, IsWhatLiesInMemoryWherePointersHave8Bytes) {
  if (sizeof(void*) != 8) GTEST_SKIP() << "pointers have another size";
  for (int i = 0; i < at_least(50); ++i) {
    const TypeParam value = this->random_value();
    EXPECT_EQ(translated(value), in_memory(value));
    use_recorded(value, [&](const void* bytes, size_t size) {
      EXPECT_EQ(bytes, &value);
      EXPECT_EQ(size, sizeof value);
    });
  }
}

TYPED_TEST(RecordedStruct, IsReadBackAtEverySize) {
  constexpr size_t kFirst = recorded_first_size<TypeParam>(), kWhole = recorded_size<TypeParam>();
  const Bytes whole = translated(this->random_value());
  ASSERT_EQ(of_size(whole, kWhole), whole) << "the size of the struct is that in recordings";
  for (size_t size = 0; size <= kWhole + 16; size += 4) {
    const Bytes recorded = of_size(whole, std::max(size, sizeof(uint32_t)));
    const auto read = [&] { return from_recorded<TypeParam>(recorded.data(), "it"); };
    if (size < kFirst) {
      EXPECT_EQ(status_of(read), DSW_STATUS_BAD_STRUCT_SIZE) << size;
      continue;
    }
    const TypeParam value = read();
    EXPECT_EQ(value.struct_size, sizeof value);
    EXPECT_EQ(translated(value), of_size(of_size(whole, std::min(size, kWhole)), kWhole)) << size;
    EXPECT_EQ(in_memory(read_recorded<TypeParam>(recorded.data(), "it")), in_memory(value)) << size;
    for (size_t i = kWhole; i < size; ++i) {
      Bytes unknown = recorded;
      unknown[i] = 1;
      EXPECT_EQ(status_of([&] { from_recorded<TypeParam>(unknown.data(), "it"); }), DSW_STATUS_UNSUPPORTED) << i;
    }
  }
  const Bytes garbage = of_size(whole, kLargestStruct + 4);
  EXPECT_EQ(status_of([&] { from_recorded<TypeParam>(garbage.data(), "it"); }), DSW_STATUS_UNSUPPORTED);
}

TEST(NarrowStruct, GetsThePlacesOfWidePointers) {
  NarrowDesc desc{};
  desc = {sizeof desc, 3, 0, 5, 7, 1.5, UINT32_MAX, 9};
  Bytes expected;
  put<uint32_t>(expected, 0, 48);  // the size in recordings
  put<uint32_t>(expected, 4, 3);
  put<uint64_t>(expected, 8, 0);
  put<uint64_t>(expected, 16, 5);
  put<uint32_t>(expected, 24, 7);
  put<double>(expected, 28, 1.5);
  put<uint64_t>(expected, 36, UINT32_MAX);
  put<uint32_t>(expected, 44, 9);
  EXPECT_EQ(translated(desc), expected);
  EXPECT_FALSE(lies_as_recorded<NarrowDesc>());
  use_recorded(desc, [&](const void* bytes, size_t size) {
    const auto* const from = static_cast<const uint8_t*>(bytes);
    EXPECT_EQ(Bytes(from, from + size), expected);
  });
}

TEST(NarrowStruct, TakesNumbersThatAreTooLargeForTheLargest) {
  Bytes recorded;
  put<uint32_t>(recorded, 0, 48);
  put<uint64_t>(recorded, 8, uint64_t{1} << 32);
  put<uint64_t>(recorded, 16, UINT32_MAX - 1);
  put<double>(recorded, 28, -2);
  put<uint64_t>(recorded, 36, UINT64_MAX);
  put<uint32_t>(recorded, 44, 9);
  const auto desc = read_recorded<NarrowDesc>(recorded.data(), "it");
  EXPECT_EQ(desc.struct_size, sizeof desc);
  EXPECT_EQ(desc.points, UINT32_MAX) << "no pointer that was not null becomes null";
  EXPECT_EQ(desc.point_count, UINT32_MAX - 1);
  EXPECT_EQ(desc.width, -2);
  EXPECT_EQ(desc.most, UINT32_MAX);
  EXPECT_EQ(desc.tag, 9u);
}

TEST(NarrowStruct, MayBeOfAnEarlierVersion) {
  ASSERT_EQ(recorded_first_size<NarrowDesc>(), 36u);
  Bytes recorded;
  put<uint32_t>(recorded, 0, 36);
  put<uint64_t>(recorded, 16, 5);
  put<double>(recorded, 28, -2);
  put<uint64_t>(recorded, 36, UINT64_MAX);  // of what follows the struct
  const auto desc = read_recorded<NarrowDesc>(recorded.data(), "it");
  EXPECT_EQ(desc.point_count, 5u);
  EXPECT_EQ(desc.width, -2);
  EXPECT_EQ(desc.most, 0u);
}

// The bytes themselves, which no machine may write otherwise.
TEST(RecordedBytes, AreThoseOfEveryMachine) {
  dsw_cut_desc desc{};
  desc.struct_size = sizeof desc;
  desc.flags = 2;
  desc.point_stride_bytes = 24;
  desc.rows = 3;
  desc.columns = 4;
  desc.start = {5, 6};
  desc.snap = 0.25;
  Bytes expected;
  put<uint32_t>(expected, 0, 48);
  put<uint32_t>(expected, 4, 2);
  put<uint64_t>(expected, 16, 24);
  put<uint32_t>(expected, 24, 3);
  put<uint32_t>(expected, 28, 4);
  put<uint32_t>(expected, 32, 5);
  put<uint32_t>(expected, 36, 6);
  put<double>(expected, 40, 0.25);
  EXPECT_EQ(translated(desc), expected);
  const size_t sizes[] = {
      recorded_size<dsw_volumes_desc>(), recorded_size<dsw_cut_desc>(),       recorded_size<dsw_open_crack_desc>(),
      recorded_size<dsw_carve_desc>(),   recorded_size<dsw_tie_desc>(),       recorded_size<dsw_detach_desc>(),
      recorded_size<dsw_remesh_desc>(),  recorded_size<dsw_deform_options>(), recorded_size<dsw_body_desc>(),
      recorded_size<dsw_move_options>(), recorded_size<dsw_cast_options>(),   recorded_size<dsw_validation>()};
  const size_t on_lp64[] = {128, 48, 40, 72, 48, 56, 48, 56, 120, 80, 16, 224};
  for (size_t i = 0; i < std::size(sizes); ++i) EXPECT_EQ(sizes[i], on_lp64[i]) << i;
}

TEST(RecordedBytes, AreNotLookedForBehindTheEnd) {
  for (const uint32_t size : {17u, 24u, 4096u, UINT32_MAX - 7, UINT32_MAX}) {
    const Array<uint64_t> words{size, 0};
    EXPECT_EQ(status_of([&] { WordReader(words).get_sized(); }), DSW_STATUS_CORRUPT) << size;
  }
  const Array<uint64_t> words{16, 0};
  EXPECT_EQ(WordReader(words).get_sized().count, 4u);
}

}  // namespace
}  // namespace dsw::capi
