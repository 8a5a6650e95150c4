#include "snapshot/record.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "snapshot/bytes.h"

namespace dsw {
namespace {

constexpr char kMagic[9] = "DSWREC\x1a\n";
constexpr uint32_t kVersion = 1;
constexpr size_t kHeaderBytes = 16;  // magic, version, layout
constexpr size_t kEntryBytes = 16;   // kind, sum of kind and size, size
/** What structs look like: as where a pointer has 8 bytes, and the order of bytes. */
constexpr uint32_t kLayout = 8u | (kBigEndian ? 0x100u : 0u);

/** The checksum of an entry's kind and size, which must be right before its bytes are looked at. */
uint32_t sum_of(uint32_t kind, uint64_t size) noexcept {
  const uint64_t both[2] = {kind, size};
  Digest sum;
  sum.put(both, sizeof both);
  return static_cast<uint32_t>(sum.value());
}

}  // namespace

void Digest::put(const void* bytes, size_t size) noexcept {
  const auto* const from = static_cast<const uint8_t*>(bytes);
  const size_t whole = size & ~size_t{7};
  sum_ = checksum(sum_, from, whole);
  if (whole == size) return;
  uint8_t rest[8] = {};
  std::memcpy(rest, from + whole, size - whole);
  sum_ = checksum(sum_, rest, 8);
}

void RecordWriter::write_header() noexcept {
  put(kMagic, 8);
  uint8_t numbers[8];
  store(numbers, &kVersion, 1);
  store(numbers + 4, &kLayout, 1);
  put(numbers, 8);
  flush();
}

void RecordWriter::begin(EntryKind kind, uint64_t size) noexcept {
  sum_ = Digest();
  uint8_t head[kEntryBytes];
  const auto number = static_cast<uint32_t>(kind);
  const uint32_t sum = sum_of(number, size);
  store(head, &number, 1);
  store(head + 4, &sum, 1);
  store(head + 8, &size, 1);
  put(head, kEntryBytes);
}

void RecordWriter::put(const void* bytes, size_t size) noexcept {
  constexpr uint8_t kZeros[8] = {};
  sum_.put(bytes, size);
  buffer(bytes, size);
  buffer(kZeros, (8 - size % 8) % 8);
}

void RecordWriter::buffer(const void* bytes, size_t size) noexcept {
  const auto* from = static_cast<const uint8_t*>(bytes);
  while (size != 0) {
    const size_t part = std::min(size, sizeof buffer_ - filled_);
    std::memcpy(buffer_ + filled_, from, part);
    filled_ += part;
    from += part;
    size -= part;
    if (filled_ == sizeof buffer_) flush();
  }
}

void RecordWriter::end() noexcept {
  uint8_t sum[8];
  const uint64_t value = sum_.value();
  store(sum, &value, 1);
  put(sum, 8);
  flush();
}

void RecordWriter::flush() noexcept {
  if (works_ && filled_ != 0) works_ = sink_.write(sink_.user, buffer_, filled_);
  filled_ = 0;
}

RecordReader::RecordReader(const uint8_t* bytes, size_t size) : at_(bytes), end_(bytes + size) {
  if (size < kHeaderBytes) {
    fail(DSW_STATUS_TRUNCATED, "the recording has %zu bytes, its header alone needs %zu", size, kHeaderBytes);
  }
  if (std::memcmp(bytes, kMagic, 8) != 0) fail(DSW_STATUS_CORRUPT, "these bytes do not begin as a recording does");
  uint32_t version, layout;
  fetch(&version, bytes + 8, 1);
  fetch(&layout, bytes + 12, 1);
  if (version != kVersion || layout != kLayout) {
    fail(DSW_STATUS_BAD_VERSION,
         "the recording has format %u, pointers of %u bytes and %s; this library reads %u, %u, %s", version,
         layout & 0xffu, layout >> 8 != 0 ? "big endian" : "little endian", kVersion, kLayout & 0xffu,
         kBigEndian ? "big endian" : "little endian");
  }
  at_ += kHeaderBytes;
}

bool RecordReader::next(Entry* entry) {
  const auto left = static_cast<uint64_t>(end_ - at_);
  if (left < kEntryBytes + 8) return false;
  uint32_t kind, head_sum;
  uint64_t size;
  fetch(&kind, at_, 1);
  fetch(&head_sum, at_ + 4, 1);
  fetch(&size, at_ + 8, 1);
  if (size % 8 != 0 || head_sum != sum_of(kind, size)) {
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: the head of an entry");
  }
  if (size > left - kEntryBytes - 8) return false;
  const auto bytes = static_cast<size_t>(size);
  Digest sum;
  sum.put(at_, kEntryBytes + bytes);
  uint64_t value;
  fetch(&value, at_ + kEntryBytes + bytes, 1);
  if (value != sum.value()) fail(DSW_STATUS_CORRUPT, "the recording is damaged: a checksum");
  *entry = {static_cast<EntryKind>(kind), at_ + kEntryBytes, bytes};
  at_ += kEntryBytes + bytes + 8;
  return true;
}

}  // namespace dsw
