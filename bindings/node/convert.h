// Values of JavaScript as arguments of the shared layer, its results as values, and its exceptions as JavaScript's. What concerns
// structs and errors is done by functions of src/native.js, the hooks: one set for each environment of Node, that is for each thread.
#pragma once

#include <napi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/host.h"
#include "structs.h"

namespace dartsweep_node {

struct Hooks {
  Napi::FunctionReference error;     // (status, closed, message): the Error
  Napi::FunctionReference encode;    // (kind, value, memory): writes a struct over its defaults
  Napi::FunctionReference readable;  // (kind, value): Uint8Array of the structs in a list or an array
  Napi::FunctionReference writable;  // (kind, value): the same of a list
  Napi::FunctionReference decode;    // (kind, memory): the value of a struct
  Napi::FunctionReference list;      // (kind, memory): a list that has this memory
#ifdef __EMSCRIPTEN__
  Napi::FunctionReference
      read;  // (array, address, size): copies an array, or a view of one, to an address of the module
  Napi::FunctionReference write;  // (array, address, size): copies from there
#endif
  // Lines of the log wait here while a call lasts: JavaScript must not run in it.
  struct Line {
    std::shared_ptr<Napi::FunctionReference> log;
    int level;
    std::string text;
  };
  std::mutex mutex;
  std::vector<Line> lines;
};

inline std::unordered_map<napi_env, std::shared_ptr<Hooks>> &all_hooks() {
  thread_local std::unordered_map<napi_env, std::shared_ptr<Hooks>> all;
  return all;
}

inline const std::shared_ptr<Hooks> &hooks_of(napi_env env) {
  std::shared_ptr<Hooks> &hooks = all_hooks()[env];
  if (!hooks) {
    hooks = std::make_shared<Hooks>();
    napi_add_env_cleanup_hook(
        env, [](void *gone) { all_hooks().erase(static_cast<napi_env>(gone)); }, env);
  }
  return hooks;
}

// setHooks({ error, encode, ... })
inline void set_hooks(const Napi::Value &value) {
  const auto given = value.As<Napi::Object>();
  Hooks &hooks = *hooks_of(value.Env());
  const std::pair<const char *, Napi::FunctionReference *> all[] = {
      {"error", &hooks.error},       {"encode", &hooks.encode}, {"readable", &hooks.readable},
      {"writable", &hooks.writable}, {"decode", &hooks.decode}, {"list", &hooks.list},
#ifdef __EMSCRIPTEN__
      {"read", &hooks.read},         {"write", &hooks.write},
#endif
  };
  for (const auto &[name, hook] : all) *hook = Napi::Persistent(given.Get(name).As<Napi::Function>());
}

inline bool is_nothing(const Napi::Value &value) { return value.IsUndefined() || value.IsNull(); }

[[noreturn]] void raise_current(Napi::Env env);

[[noreturn]] inline void refuse(napi_env env, const std::string &message) { throw Napi::TypeError::New(env, message); }

// --- arrays of numbers
template <class T>
constexpr napi_typedarray_type array_type_of() {
  if (std::is_same_v<T, double>) return napi_float64_array;
  if (std::is_same_v<T, std::uint8_t>) return napi_uint8_array;
  if (std::is_same_v<T, std::int32_t>) return napi_int32_array;
  if (std::is_same_v<T, std::uint32_t>) return napi_uint32_array;
  return napi_biguint64_array;
}

template <class T>
T number(const Napi::Value &value) {
  if (!value.IsNumber()) refuse(value.Env(), "a number is needed");
  const double given = value.As<Napi::Number>().DoubleValue();
  if constexpr (std::is_integral_v<T>) {
    // The upper limit as a double is the next power of two where T has 64 bits.
    constexpr double end = static_cast<double>(std::numeric_limits<T>::max() / 2 + 1) * 2;
    if (!(given >= static_cast<double>(std::numeric_limits<T>::min()) && given < end) || std::trunc(given) != given)
      throw Napi::RangeError::New(value.Env(),
                                  "a number is not a whole one of " + std::to_string(8 * sizeof(T)) + " bits");
  }
  return static_cast<T>(given);
}

// The memory of JavaScript. A module of WebAssembly cannot address this memory and works on copies.
#ifdef __EMSCRIPTEN__
inline Napi::Number address_of(Napi::Env env, const void *data) {
  return Napi::Number::New(env, static_cast<double>(reinterpret_cast<std::uintptr_t>(data)));
}
inline void read_memory(const Napi::Value &array, void *to, std::size_t size) {
  Napi::Env env = array.Env();
  if (size) hooks_of(env)->read.Call({array, address_of(env, to), Napi::Number::New(env, static_cast<double>(size))});
}
inline void write_memory(const Napi::Value &array, const void *from, std::size_t size) {
  Napi::Env env = array.Env();
  if (size)
    hooks_of(env)->write.Call({array, address_of(env, from), Napi::Number::New(env, static_cast<double>(size))});
}
inline Napi::ArrayBuffer new_memory(Napi::Env env, const void *data, std::size_t size) {
  napi_value memory = nullptr;
  if (napi_create_arraybuffer(env, size, nullptr, &memory) != napi_ok) throw Napi::Error::New(env);
  write_memory(Napi::Value(env, memory), data, size);
  return Napi::ArrayBuffer(env, memory);
}
#else
inline void read_memory(const Napi::Value &array, void *to, std::size_t size) {
  std::memcpy(to, array.As<Napi::ArrayBuffer>().Data(), size);
}
inline Napi::ArrayBuffer new_memory(Napi::Env env, const void *data, std::size_t size) {
  auto memory = Napi::ArrayBuffer::New(env, size);
  if (size) std::memcpy(memory.Data(), data, size);
  return memory;
}
#endif

// The memory of a typed array for the time of a call.
class Memory {
 public:
  void set(const Napi::Value &array) {
    array_ = array;
#ifdef __EMSCRIPTEN__
    size_ = array.As<Napi::TypedArray>().ByteLength();
    try {
      copy_.reset(new std::uint8_t[size_]);
    } catch (const std::bad_alloc &) {
      raise_current(array.Env());
    }
    read_memory(array, copy_.get(), size_);
    data = copy_.get();
#else
    data = address();
#endif
  }
  // Reading a later argument may run the host's functions. Throws where the array no longer has its elements: its memory went to another
  // thread, or was made smaller.
  void check(std::size_t count) {
    if (count == 0 || array_.IsEmpty()) return;
    bool is_there = array_.As<Napi::TypedArray>().ElementLength() >= count;
#ifndef __EMSCRIPTEN__
    is_there = is_there && address() == data;
#endif
    if (!is_there) refuse(array_.Env(), "an array has lost its memory while arguments were read");
  }
  // After a call that has written to the memory.
  void give_back() {
#ifdef __EMSCRIPTEN__
    if (data) write_memory(array_, data, size_);
#endif
  }

  void *data = nullptr;

 private:
  Napi::Value array_;
#ifdef __EMSCRIPTEN__
  std::unique_ptr<std::uint8_t[]> copy_;
  std::size_t size_ = 0;
#else
  void *address() const {
    void *now = nullptr;
    napi_get_typedarray_info(array_.Env(), array_, nullptr, nullptr, &now, nullptr, nullptr);
    return now;
  }
#endif
};

// Numbers for the time of a call: the host's memory where it is a typed array of T, or a copy of a plain array's.
template <class T>
class Numbers {
 public:
  // For calls that write: typed arrays only.
  T *set_typed(const Napi::Value &value) {
    static_assert(!std::is_same_v<T, std::size_t>, "its size is the machine's");
    return borrow(value);
  }
  const T *set(const Napi::Value &value) {
    if (value.IsArray()) {
      const auto array = value.As<Napi::Array>();
      count = array.Length();  // of any size: there may be nothing in it
      for (std::uint32_t i = 0; i < count; ++i) copy_.push_back(number<T>(array.Get(i)));
      return copy_.data();
    }
    if constexpr (std::is_same_v<T, std::size_t> && is_narrow) {
      if (value.IsTypedArray() && value.As<Napi::TypedArray>().TypedArrayType() == napi_biguint64_array) {
        Numbers<std::uint64_t> wide;
        const std::uint64_t *data = wide.set(value);
        count = wide.count;
        // What does not fit is beyond all memory as well.
        for (std::size_t i = 0; i < count; ++i)
          copy_.push_back(static_cast<T>(std::min<std::uint64_t>(data[i], std::numeric_limits<T>::max())));
        return copy_.data();
      }
    }
    return borrow(value);
  }
  // To be called when all arguments are read.
  void check() { memory_.check(count); }
  void give_back() { memory_.give_back(); }

  std::size_t count = 0;

 private:
  T *borrow(const Napi::Value &value) {
    if (is_nothing(value)) return nullptr;
    if (!value.IsTypedArray()) refuse(value.Env(), needed());
    const auto array = value.As<Napi::TypedArray>();
    if (array.TypedArrayType() != array_type_of<T>()) refuse(value.Env(), needed());
    count = array.ElementLength();
    memory_.set(value);
    return static_cast<T *>(memory_.data);
  }
  static std::string needed() {
    const char *type = std::is_same_v<T, double>          ? "Float64Array"
                       : std::is_same_v<T, std::uint8_t>  ? "Uint8Array"
                       : std::is_same_v<T, std::int32_t>  ? "Int32Array"
                       : std::is_same_v<T, std::uint32_t> ? "Uint32Array"
                                                          : "BigUint64Array";
    return std::string("a typed array is needed: ") + type;
  }
  Memory memory_;
  std::vector<T> copy_;
};

// Indices of 4 bytes, or of 8 as BigInt64Array.
class IndexNumbers {
 public:
  dartsweep::Indices set(const Napi::Value &value) {
    dartsweep::Indices out;
    if (value.IsTypedArray()) {
      const auto array = value.As<Napi::TypedArray>();
      const auto type = array.TypedArrayType();
      if (type != napi_int32_array && type != napi_uint32_array && type != napi_bigint64_array)
        refuse(value.Env(), "indices are an Int32Array, Uint32Array or BigInt64Array");
      memory_.set(value);
      out.data = memory_.data;
      out.count = count_ = array.ElementLength();
      out.bytes = static_cast<std::uint32_t>(array.ElementSize());
      return out;
    }
    out.data = copy_.set(value);
    out.count = copy_.count;
    out.bytes = 4;
    return out;
  }
  void check() { memory_.check(count_); }

 private:
  Memory memory_;
  std::size_t count_ = 0;
  Numbers<std::int32_t> copy_;
};

// One point: an array of 3 numbers, or 2 in the plane.
inline dartsweep::Point to_point(const Napi::Value &value) {
  Numbers<double> numbers;
  const double *coordinates = numbers.set(value);
  if (numbers.count != 3 && numbers.count != 2)
    refuse(value.Env(), "a point is an array of 3 numbers, or 2 in the plane");
  return {coordinates, static_cast<std::uint32_t>(numbers.count)};
}

// Always of 3, as all points of results: so TypeScript knows what comes.
inline Napi::Value from_point(Napi::Env env, const dartsweep::Point &point) {
  auto array = Napi::Array::New(env, 3);
  for (std::uint32_t i = 0; i < 3; ++i) array.Set(i, point.at[i]);
  return array;
}

// A typed array of its own with these numbers.
template <class T>
Napi::Value from_numbers(Napi::Env env, const T *data, std::size_t count) {
  const Napi::ArrayBuffer memory = new_memory(env, data, count * sizeof(T));
  napi_value array = nullptr;
  if (napi_create_typedarray(env, array_type_of<T>(), count, memory, 0, &array) != napi_ok) throw Napi::Error::New(env);
  return Napi::Value(env, array);
}
inline Napi::Value from_numbers(Napi::Env env, const std::size_t *data, std::size_t count) {
  auto array = Napi::Array::New(env, count);
  for (std::size_t i = 0; i < count; ++i) array.Set(static_cast<std::uint32_t>(i), static_cast<double>(data[i]));
  return array;
}

// --- structs
template <class T>
Napi::Value from_struct(Napi::Env env, const T &value) {
  return hooks_of(env)->decode.Call({Napi::Number::New(env, kind_of<T>), new_memory(env, &value, sizeof value)});
}

template <class T>
Napi::Value from_structs(Napi::Env env, const T *data, std::size_t count) {
  return hooks_of(env)->list.Call({Napi::Number::New(env, kind_of<T>), new_memory(env, data, count * sizeof(T))});
}

// What is left out of `value` stays as it is in `out`.
template <class T>
void set_struct(const Napi::Value &value, T &out) {
  Napi::Env env = value.Env();
  auto memory = new_memory(env, &out, sizeof out);
  hooks_of(env)->encode.Call({Napi::Number::New(env, kind_of<T>), value, memory});
  read_memory(memory, &out, sizeof out);
}

// A list of structs for the time of a call.
template <class T>
class Structs {
 public:
  dartsweep::View<T> set(const Napi::Value &value) {
    if (is_nothing(value)) return {};
    const Hooks &hooks = *hooks_of(value.Env());
    const Napi::FunctionReference &hook = std::is_const_v<T> ? hooks.readable : hooks.writable;
    const Napi::Value bytes = hook.Call({Napi::Number::New(value.Env(), kind_of<std::remove_const_t<T>>), value});
    count_ = bytes.As<Napi::TypedArray>().ElementLength();
    memory_.set(bytes);
    return {static_cast<T *>(memory_.data), count_ / sizeof(T)};
  }
  void check() { memory_.check(count_); }
  void give_back() { memory_.give_back(); }

 private:
  Memory memory_;
  std::size_t count_ = 0;
};

// --- the log: lines go to the function after the call in which they came
class Log : public dartsweep::LogSink {
 public:
  explicit Log(const Napi::Value &function)
      : hooks_(hooks_of(function.Env())),
        function_(std::make_shared<Napi::FunctionReference>(Napi::Persistent(function.As<Napi::Function>()))) {}
  void write(int level, const char *text) override {
    const std::lock_guard<std::mutex> hold(hooks_->mutex);
    hooks_->lines.push_back({function_, level, text});
  }

 private:
  std::shared_ptr<Hooks> hooks_;
  std::shared_ptr<Napi::FunctionReference> function_;
};

inline void deliver_log(Napi::Env env) {
  Hooks &hooks = *hooks_of(env);
  std::vector<Hooks::Line> lines;
  {
    const std::lock_guard<std::mutex> hold(hooks.mutex);
    lines.swap(hooks.lines);
  }
  for (const Hooks::Line &line : lines) {
    try {
      line.log->Call({Napi::Number::New(env, line.level), Napi::String::New(env, line.text)});
    } catch (const Napi::Error &) {  // a log that throws is not the caller's fault
    }
  }
}

// --- exceptions. To be called in a handler: throws the Error that this one stands for.
[[noreturn]] inline void raise_current(Napi::Env env) {
  const auto raise = [env](int status, bool closed, const char *message) {
    const Napi::Value error = hooks_of(env)->error.Call(
        {Napi::Number::New(env, status), Napi::Boolean::New(env, closed), Napi::String::New(env, message)});
    throw Napi::Error(env, error);
  };
  deliver_log(env);
  try {
    throw;
  } catch (const dartsweep::Closed &error) {
    raise(error.status(), true, error.what());
  } catch (const dartsweep::Error &error) {
    raise(error.status(), false, error.what());
  } catch (const std::bad_alloc &) {
    raise(DSW_STATUS_OUT_OF_MEMORY, false, "out of memory");
  } catch (const std::exception &error) {
    raise(DSW_STATUS_INTERNAL, false, error.what());
  }
  std::terminate();  // nothing else is thrown
}

}  // namespace dartsweep_node
