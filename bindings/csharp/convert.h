// Arrays on their way from C# and back, and what the library keeps of C#'s.
#pragma once

#include <cstring>
#include <memory>
#include <string>

#include "common/host.h"
#include "errors.h"
#include "structs.h"

namespace dartsweep_csharp {

// An array of C#, pinned for the call, or for as long as `handle` (a GCHandle) is not freed.
struct Pinned {
  void *data;
  std::size_t count;
  void *handle;
};

inline bool has_count(const Pinned &array, std::size_t count) {
  return array.count == count || refuse(("an array of " + std::to_string(count) + " numbers is needed").c_str());
}

// Points as numbers.
template <class T>
void set_points(const Pinned &array, T *&data, std::size_t &count) {
  data = static_cast<T *>(array.data);
  count = array.count;
}

// An array for C#, which copies it and gives it back by dartsweep_take.
struct Block {
  void *data;
  std::size_t bytes;
  void (*release)(void *data);
};

template <class T>
Block block(dartsweep::Array<T> array) {
  const std::size_t bytes = sizeof(T) * array.size();
  return {array.release(), bytes, [](void *data) { delete[] static_cast<T *>(data); }};
}

// Callbacks of C#, set once: they free a GCHandle, and hand a line to the delegate that one holds.
inline void(DSW_CALLBACK *free_handle)(void *handle) = nullptr;
inline void(DSW_CALLBACK *write_log)(void *handle, int level, const char *text) = nullptr;

inline std::shared_ptr<void> owner_of(const Pinned &array) {
  return {array.handle, [](void *handle) {
            if (handle) free_handle(handle);
          }};
}

class Log : public dartsweep::LogSink {
 public:
  explicit Log(void *handle) : handle_(handle) {}
  ~Log() override { free_handle(handle_); }
  void write(int level, const char *text) override { write_log(handle_, level, text); }

 private:
  void *handle_;
};

}  // namespace dartsweep_csharp

DSW_CSHARP_API void dartsweep_take(dartsweep_csharp::Block *block, void *out) {
  if (block->bytes) std::memcpy(out, block->data, block->bytes);
  if (block->data) block->release(block->data);
}

DSW_CSHARP_API void dartsweep_set_callbacks(dartsweep_csharp::ErrorCallback error, void(DSW_CALLBACK *free)(void *),
                                            void(DSW_CALLBACK *log)(void *, int, const char *)) {
  dartsweep_csharp::set_error = error;
  dartsweep_csharp::free_handle = free;
  dartsweep_csharp::write_log = log;
}

// Sizes of structs of C, in the order of Structs.All, for tests.
DSW_CSHARP_API std::size_t dartsweep_size_of(int index) { return dartsweep_csharp::sizes_of_structs[index]; }
