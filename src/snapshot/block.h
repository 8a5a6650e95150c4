#pragma once
// A block of bytes in sections behind a header: what every kind of snapshot is made of; README.md has the format.

#include <cstring>

#include "base/memory.h"
#include "snapshot/bytes.h"

namespace dsw {

/** What tells one kind of block from another. */
struct BlockKind {
  char magic[9];       // 8 bytes
  uint32_t version;    // of the format that is written
  uint32_t oldest;     // of those that are read
  uint32_t sections;   // how many there are
  uint32_t before[3];  // in the oldest version and the next ones, up to the last

  constexpr uint32_t sections_of(uint32_t format) const noexcept {
    return format == version ? sections : before[format - oldest];
  }
};

constexpr uint32_t kMostSections = 40;

/** What a header says beside what belongs to every block. */
struct BlockHeader {
  uint32_t flags = 0, counts[2] = {};
  uint64_t bytes[kMostSections] = {};  // of each section
};

[[noreturn]] void fail_corrupt(const char* what);

/** Size of a block with these sections. */
size_t block_bytes(const BlockKind& kind, const BlockHeader& header) noexcept;

/** Writes a block, section by section in their order. */
class BlockWriter {
 public:
  /** `out` has room for block_bytes. */
  BlockWriter(const BlockKind& kind, const BlockHeader& header, uint32_t dimension, uint8_t* out) noexcept;

  /** A section, whole or in parts: as many values as its bytes hold. */
  template <class T>
  void write(const T* values, size_t count) noexcept {
    store(at_, values, count);
    at_ += count * sizeof(T);
  }
  template <class T>
  void write(const Array<T>& values) noexcept {
    write(values.data(), values.size());
  }
  /** Fills up the section that has been written. */
  void end_section() noexcept {
    for (; (at_ - out_) % 8 != 0; ++at_) *at_ = 0;
  }
  /** After the last section. */
  void finish() noexcept;

 private:
  uint8_t *out_, *at_;
};

/** What a block says of its dimension, not to be trusted: 2, or else 3. */
uint32_t saved_dimension(const uint8_t* block, size_t size) noexcept;
/** The version of the format of a block that a BlockReader has accepted. */
uint32_t saved_version(const uint8_t* block) noexcept;

/** Reads a block that is not trusted. Whatever is wrong throws Error: TRUNCATED, BAD_VERSION or CORRUPT. */
class BlockReader {
 public:
  /** Checks the header, the sizes, which must add up to `size`, and the checksum. */
  BlockReader(const BlockKind& kind, uint32_t dimension, const uint8_t* block, size_t size);

  const BlockHeader& header() const noexcept { return header_; }
  /** The format of the block. */
  uint32_t version() const noexcept { return version_; }

  /** The next section, whole. Throws std::bad_alloc too. */
  template <class T>
  void read(Array<T>& out) {
    if (header_.bytes[section_] % sizeof(T) != 0) fail_corrupt("the size of a section");
    out.resize(static_cast<size_t>(header_.bytes[section_] / sizeof(T)));
    fetch(out.data(), at_, out.size());
    end_section();
  }

 private:
  void end_section();

  BlockHeader header_;
  uint32_t version_;
  const uint8_t* at_;
  uint32_t section_ = 0;
};

}  // namespace dsw
