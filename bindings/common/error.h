// Statuses as exceptions. A binding turns each into the host's exception of that status (DSW_EACH_STATUS lists them).
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "dartsweep/base.h"

// The list that gives every language one exception class per status: X(name of the status, name of the class).
#define DSW_EACH_STATUS(X)               \
  X(NULL_ARGUMENT, NullArgument)         \
  X(BAD_STRUCT_SIZE, BadStructSize)      \
  X(UNSUPPORTED, Unsupported)            \
  X(OUT_OF_RANGE, OutOfRange)            \
  X(NON_FINITE, NonFinite)               \
  X(WRONG_SIZE, WrongSize)               \
  X(STALE_ID, StaleId)                   \
  X(BUFFER_TOO_SMALL, BufferTooSmall)    \
  X(OUT_OF_MEMORY, OutOfMemory)          \
  X(TOO_LARGE, TooLarge)                 \
  X(INDEX_OUT_OF_RANGE, IndexOutOfRange) \
  X(BAD_CELL_TYPE, BadCellType)          \
  X(BAD_CELL, BadCell)                   \
  X(INVERTED_CELL, InvertedCell)         \
  X(INVALID_CELL, InvalidCell)           \
  X(DUPLICATE_CELL, DuplicateCell)       \
  X(SHARED_FACE, SharedFace)             \
  X(BOUNDARY_CROSSES, BoundaryCrosses)   \
  X(OUTSIDE, Outside)                    \
  X(IMPASSABLE, Impassable)              \
  X(OCCUPIED, Occupied)                  \
  X(IN_USE, InUse)                       \
  X(SHARED, Shared)                      \
  X(DUPLICATE_ID, DuplicateId)           \
  X(NOT_FOUND, NotFound)                 \
  X(TRUNCATED, Truncated)                \
  X(CORRUPT, Corrupt)                    \
  X(BAD_VERSION, BadVersion)             \
  X(NOT_NAMED, NotNamed)                 \
  X(NOT_BUILT, NotBuilt)                 \
  X(INTERNAL, Internal)                  \
  X(BAD_TOPOLOGY, BadTopology)           \
  X(BORROWED, Borrowed)                  \
  X(WRITE_FAILED, WriteFailed)           \
  X(NOT_CLOSED, NotClosed)

namespace dartsweep {

class Error : public std::exception {
 public:
  Error(dsw_status status, std::string message) : status_(status), message_(std::move(message)) {}
  dsw_status status() const noexcept { return status_; }
  const char *what() const noexcept override { return message_.c_str(); }

 private:
  dsw_status status_;
  std::string message_;
};

// Use of an object after close().
class Closed : public Error {
 public:
  explicit Closed(const char *object) : Error(DSW_STATUS_NULL_ARGUMENT, std::string(object) + " is closed") {}
};

inline void check(dsw_status status) {
  if (status != DSW_STATUS_OK) throw Error(status, dsw_last_error_message());
}

}  // namespace dartsweep
