#pragma once
// A recording: entries of bytes behind a header, each complete in itself, so that what was written before a process
// died can be read. README.md has the format. What the entries mean is capi's.

#include <cstddef>
#include <cstdint>

#include "base/memory.h"

namespace dsw {

enum class EntryKind : uint32_t {
  kEnvironment = 1,
  kScene = 2,
  kCall = 3,
  kResult = 4,
  kRepeated = 5,
  kMaker = 6,
  kNote = 7,
  kValidation = 8
};

/** Where bytes go. False: no more. */
struct ByteSink {
  bool (*write)(void* user, const void* bytes, size_t size);
  void* user;
};

/** Sum over bytes of any number, given in any parts; parts but the last one are multiples of 8. */
class Digest {
 public:
  void put(const void* bytes, size_t size) noexcept;
  uint64_t value() const noexcept { return sum_; }

 private:
  uint64_t sum_ = 0;
};

/** Writes a recording. Allocates nothing; after the sink has failed nothing is written any more. */
class RecordWriter {
 public:
  explicit RecordWriter(ByteSink sink) noexcept : sink_(sink) {}

  void write_header() noexcept;
  /** An entry of exactly `size` bytes, a multiple of 8, which follow by `put`: each part is filled up with zeros to a
   * multiple of 8. */
  void begin(EntryKind kind, uint64_t size) noexcept;
  void put(const void* bytes, size_t size) noexcept;
  /** Hands over all of it. */
  void end() noexcept;
  /** A whole entry. */
  void write(EntryKind kind, const void* bytes, size_t size) noexcept {
    begin(kind, size);
    put(bytes, size);
    end();
  }

  bool works() const noexcept { return works_; }
  /** The sink takes bytes again: what it has is whole. */
  void renew() noexcept { works_ = true; }

 private:
  void buffer(const void* bytes, size_t size) noexcept;
  void flush() noexcept;

  ByteSink sink_;
  Digest sum_;
  size_t filled_ = 0;
  bool works_ = true;
  uint8_t buffer_[4096];
};

struct Entry {
  EntryKind kind;
  const uint8_t* bytes;
  size_t size;  // a multiple of 8
};

/** Reads a recording that is not trusted. */
class RecordReader {
 public:
  /** Throws Error: TRUNCATED, BAD_VERSION or CORRUPT. The bytes are lent. */
  RecordReader(const uint8_t* bytes, size_t size);

  /** The next entry; false at the end, which an entry that is not whole is, too. Throws Error: CORRUPT. */
  bool next(Entry* entry);
  /** Bytes behind the last entry that was read. */
  size_t left() const noexcept { return static_cast<size_t>(end_ - at_); }

 private:
  const uint8_t* at_;
  const uint8_t* end_;
};

}  // namespace dsw
