#include "snapshot/block.h"

#include <algorithm>

#include "base/error.h"

namespace dsw {
namespace {

/** Positions in the header. */
constexpr size_t kAtVersion = 8, kAtDimension = 12, kAtSize = 16, kAtChecksum = 24, kAtFlags = 32, kAtCounts = 36,
                 kAtSectionCount = 44, kAtSections = 48;

constexpr size_t header_bytes(const BlockKind& kind) { return kAtSections + size_t{8} * kind.sections; }
constexpr uint64_t padded(uint64_t bytes) { return (bytes + 7) & ~uint64_t{7}; }

uint64_t total_bytes(const BlockKind& kind, const BlockHeader& header) {
  uint64_t total = header_bytes(kind);
  for (uint32_t i = 0; i < kind.sections; ++i) total += padded(header.bytes[i]);
  return total;
}

/** The sum of all bytes but its own. */
uint64_t block_checksum(const uint8_t* block, size_t size) {
  const uint64_t head = checksum(0, block, kAtChecksum);
  return checksum(head, block + kAtChecksum + 8, size - kAtChecksum - 8);
}

}  // namespace

void fail_corrupt(const char* what) { fail(DSW_STATUS_CORRUPT, "the snapshot is damaged: %s", what); }

size_t block_bytes(const BlockKind& kind, const BlockHeader& header) noexcept {
  return static_cast<size_t>(total_bytes(kind, header));
}

BlockWriter::BlockWriter(const BlockKind& kind, const BlockHeader& header, uint32_t dimension, uint8_t* out) noexcept
    : out_(out), at_(out + header_bytes(kind)) {
  const uint64_t total = total_bytes(kind, header);
  std::memcpy(out, kind.magic, 8);
  store(out + kAtVersion, &kind.version, 1);
  store(out + kAtDimension, &dimension, 1);
  store(out + kAtSize, &total, 1);
  store(out + kAtFlags, &header.flags, 1);
  store(out + kAtCounts, header.counts, 2);
  store(out + kAtSectionCount, &kind.sections, 1);
  store(out + kAtSections, header.bytes, kind.sections);
}

void BlockWriter::finish() noexcept {
  const uint64_t sum = block_checksum(out_, static_cast<size_t>(at_ - out_));
  store(out_ + kAtChecksum, &sum, 1);
}

uint32_t saved_dimension(const uint8_t* block, size_t size) noexcept {
  uint32_t dimension = 3;
  if (size >= kAtSections) fetch(&dimension, block + kAtDimension, 1);
  return dimension == 2 ? 2 : 3;
}

uint32_t saved_version(const uint8_t* block) noexcept {
  uint32_t version = 0;
  fetch(&version, block + kAtVersion, 1);
  return version;
}

BlockReader::BlockReader(const BlockKind& kind, uint32_t dimension, const uint8_t* block, size_t size) : at_(block) {
  // Blocks of another version may have a shorter header.
  if (size < kAtSections) {
    fail(DSW_STATUS_TRUNCATED, "the snapshot has %zu bytes, its header alone needs %zu", size, header_bytes(kind));
  }
  if (std::memcmp(block, kind.magic, 8) != 0) fail_corrupt("it begins with other bytes than a snapshot of its kind");
  uint32_t of_dimension, sections;
  uint64_t total, sum;
  fetch(&version_, block + kAtVersion, 1);
  fetch(&of_dimension, block + kAtDimension, 1);
  fetch(&sections, block + kAtSectionCount, 1);
  fetch(&total, block + kAtSize, 1);
  fetch(&sum, block + kAtChecksum, 1);
  // Versions are those of a dimension.
  if (of_dimension != dimension) fail_corrupt("it has another dimension");
  if (version_ < kind.oldest || version_ > kind.version) {
    fail(DSW_STATUS_BAD_VERSION, "the snapshot has format version %u, this library reads %u to %u", version_,
         kind.oldest, kind.version);
  }
  BlockKind of = kind;
  of.sections = kind.sections_of(version_);
  if (size < total || size < header_bytes(of)) {
    fail(DSW_STATUS_TRUNCATED, "the snapshot has %zu of %llu bytes", size,
         static_cast<unsigned long long>(std::max<uint64_t>(total, header_bytes(of))));
  }
  if (size > total) fail_corrupt("there are bytes behind its end");
  if (size % 8 != 0) fail_corrupt("its size is no multiple of 8");
  if (block_checksum(block, size) != sum) fail_corrupt("its checksum is wrong");
  if (sections != of.sections) fail_corrupt("it has another number of sections");
  fetch(&header_.flags, block + kAtFlags, 1);
  fetch(header_.counts, block + kAtCounts, 2);
  fetch(header_.bytes, block + kAtSections, of.sections);
  for (const uint64_t bytes : header_.bytes) {
    if (bytes > size) fail_corrupt("a section is larger than the block");
  }
  if (total_bytes(of, header_) != size) fail_corrupt("the sizes of its sections do not add up");
  at_ += header_bytes(of);
}

void BlockReader::end_section() {
  const uint64_t bytes = header_.bytes[section_++];  // 0: beyond those of an older version
  for (uint64_t i = bytes; i < padded(bytes); ++i) {
    if (at_[i] != 0) fail_corrupt("bytes between its sections");
  }
  at_ += padded(bytes);
}

}  // namespace dsw
