// Statuses as exceptions: one class for each, and Error for all. Bindings turn each class into an
// exception of their language.
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "dartsweep/base.h"

// X(name of the status, name of the class), for every status but OK.
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
  X(NOT_ENABLED, NotEnabled)             \
  X(NOT_BUILT, NotBuilt)                 \
  X(INTERNAL, Internal)                  \
  X(BAD_TOPOLOGY, BadTopology)           \
  X(BORROWED, Borrowed)                  \
  X(WRITE_FAILED, WriteFailed)           \
  X(NOT_CLOSED, NotClosed)               \
  X(REPEATED_VERTEX, RepeatedVertex)     \
  X(DUPLICATE_PART, DuplicatePart)       \
  X(NOT_MANIFOLD, NotManifold)           \
  X(NOT_ORIENTED, NotOriented)           \
  X(NOT_CONFORMING, NotConforming)

namespace dartsweep {

/** What every method throws when the C function answers another status than OK. */
class Error : public std::exception {
 public:
  Error(dsw_status status, std::string message) : status_(status), message_(std::move(message)) {}
  dsw_status status() const noexcept { return status_; }
  const char *what() const noexcept override { return message_.c_str(); }

 private:
  dsw_status status_;
  std::string message_;
};

/** Use of an object after close(). */
class Closed : public Error {
 public:
  explicit Closed(const char *object)
      : Error(DSW_STATUS_NULL_ARGUMENT, std::string(object) + " is closed") {}
};

#ifndef SWIG
template <dsw_status S>
class StatusError : public Error {
 public:
  explicit StatusError(std::string message) : Error(S, std::move(message)) {}
};

#define DSW_STATUS_CLASS(status, name) using name = StatusError<DSW_STATUS_##status>;
DSW_EACH_STATUS(DSW_STATUS_CLASS)
#undef DSW_STATUS_CLASS

/** Throws the class of the status; Error for statuses of a newer library. */
[[noreturn]] inline void throw_status(dsw_status status, std::string message) {
#define DSW_THROW_STATUS(status, name) \
  case DSW_STATUS_##status:            \
    throw name(std::move(message));
  switch (status) {
    DSW_EACH_STATUS(DSW_THROW_STATUS)
    default:
      throw Error(status, std::move(message));
  }
#undef DSW_THROW_STATUS
}

/** Throws unless the status is OK. For calls of C functions, too. */
inline void check(dsw_status status) {
  if (status != DSW_STATUS_OK) throw_status(status, dsw_last_error_message());
}
#endif

}  // namespace dartsweep
