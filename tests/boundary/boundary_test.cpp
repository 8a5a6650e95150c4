// Every exported function is called with one thing wrong after the other, from several threads at once: it answers a
// status, says in which function, leaves its out-arguments alone, and nothing has changed. First each thread has a
// world of its own, and below full effort a part of the functions; then all share one, readers together and writers
// alone, as the headers promise. All of it in the plane, then in space. The list of functions is that of the headers.
// usage: boundary_test [THREADS], without which they are as many as DSW_EFFORT asks for.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "../effort.h"
#include "arguments.h"

namespace boundary {
namespace {

constexpr size_t kMostParameters = 13;
std::atomic<size_t> calls{0}, failures{0}, refused{0};

void report(std::string_view function, const std::string& what) {
  ++failures;
  std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(function.size()), function.data(), what.c_str());
}

/** The value of a parameter. */
struct alignas(8) Value {
  unsigned char bytes[16];
};

/** A parameter's type. */
struct Type {
  bool is_written, is_out;
  void (*make_good)(const Argument& about, Value* value);
  bool (*spoil)(const Argument& about, size_t k, Value* value, int* wanted);
  void (*dispose)(const Argument& about, Value* value);
};

template <class T>
T& as(Value* value) {
  static_assert(sizeof(T) <= sizeof(Value) && std::is_trivially_copyable_v<T>);
  return *reinterpret_cast<T*>(value->bytes);
}

/** What a call has made goes again, what it has destroyed is forgotten. */
template <class T>
void dispose(const Argument& a, T value) {
  if constexpr (std::is_pointer_v<T> && is_handle<std::remove_pointer_t<T>>) {
    if (a.function.find("_destroy") != std::string_view::npos &&
        a.called(std::string(a.function.substr(4, a.function.size() - 12)).c_str())) {
      a.host->forget(value);
    }
  }
  if constexpr (std::is_same_v<T, dsw_context**>) dsw_context_destroy(*value);
  if constexpr (std::is_same_v<T, dsw_environment**>) dsw_environment_destroy(*value);
  if constexpr (std::is_same_v<T, dsw_trace**>) dsw_trace_destroy(*value);
  if constexpr (std::is_same_v<T, dsw_replay**>) dsw_replay_destroy(*value);
  if constexpr (std::is_same_v<T, dsw_scene**>) {
    if (!a.of("dsw_replay_get_scene")) dsw_scene_destroy(*value);
  }
  (void)a, (void)value;
}

template <class T, class Pointee = std::remove_pointer_t<T>>
const Type kTypeOf = {
    std::is_pointer_v<T>&& is_handle<Pointee>,  // const handles are another type
    std::is_pointer_v<T> && !std::is_const_v<Pointee> && !is_handle<Pointee>,
    [](const Argument& about, Value* value) { as<T>(value) = good<T>(about); },
    [](const Argument& about, size_t k, Value* value, int* wanted) { return spoil(about, k, &as<T>(value), wanted); },
    [](const Argument& about, Value* value) { dispose(about, as<T>(value)); }};

struct Function {
  std::string_view name, parameters;
  std::vector<const Type*> types;
  bool answers;  // a status; of others only that they return
  void (*address)();
  int (*call)(void (*address)(), Value* values);
};

template <class R, class... A, size_t... I>
Function function_of(const char* name, R (*function)(A...), const char* parameters, std::index_sequence<I...>) {
  static_assert(sizeof...(A) <= kMostParameters);
  const auto call = [](void (*address)(), Value* values) -> int {
    const auto known = reinterpret_cast<R (*)(A...)>(address);
    (void)values;  // of functions without parameters
    if constexpr (std::is_same_v<R, dsw_status>) return known(as<A>(values + I)...);
    known(as<A>(values + I)...);
    return DSW_STATUS_OK;
  };
  return {name, parameters, {&kTypeOf<A>...}, std::is_same_v<R, dsw_status>, reinterpret_cast<void (*)()>(function),
          call};
}

template <class R, class... A>
Function function_of(const char* name, R (*function)(A...), const char* parameters) {
  return function_of(name, function, parameters, std::index_sequence_for<A...>());
}

/** Makes calls on one host, which other threads may share. */
class Caller {
 public:
  Caller(Host* host, std::shared_mutex* mutex)
      : host_(*host), mutex_(mutex), scratch_(kMostParameters * kScratchBytes), before_(scratch_) {}

  /** Everything as it should be, then each parameter wrong in each way. */
  void test(const Function& f) {
    int before = kAnything;
    attempt(f, SIZE_MAX, 0, &before);
    for (size_t i = 0; i < f.types.size(); ++i) {
      for (size_t k = 0; attempt(f, i, k, &before); ++k) {
      }
    }
  }

 private:
  /** @return false where parameter `wrong` can't be wrong in so many ways; SIZE_MAX: nothing is, and the answer is
   * kept. */
  bool attempt(const Function& f, size_t wrong, size_t k, int* before) {
    // Whoever may change something is alone.
    const size_t count = f.types.size();
    const bool writes = std::any_of(f.types.begin(), f.types.end(), [](const Type* t) { return t->is_written; });
    std::shared_lock<std::shared_mutex> together;
    std::unique_lock<std::shared_mutex> alone;
    if (mutex_ != nullptr && writes) alone = std::unique_lock<std::shared_mutex>(*mutex_);
    if (mutex_ != nullptr && !writes) together = std::shared_lock<std::shared_mutex>(*mutex_);

    size_t next = 0;
    std::array<Argument, kMostParameters> about;
    std::array<Value, kMostParameters> values;
    for (size_t i = 0; i < count; ++i) {
      const size_t end = f.parameters.find(',', next);
      about[i] = {f.name, f.parameters.substr(next, end - next), &host_, scratch_.data() + i * kScratchBytes};
      next = end + 1;
      f.types[i]->make_good(about[i], &values[i]);
    }
    int wanted = wrong == SIZE_MAX ? static_cast<int>(kAnything) : static_cast<int>(kRefused);
    if (wrong != SIZE_MAX && !f.types[wrong]->spoil(about[wrong], k, &values[wrong], &wanted)) return false;
    std::memcpy(before_.data(), scratch_.data(), count * kScratchBytes);
    ++calls;
    const int status = f.call(f.address, values.data());
    if (!f.answers) return true;
    if (wrong == SIZE_MAX) *before = status;
    if (wrong == SIZE_MAX && status != DSW_STATUS_OK) ++refused;
    const std::string what =
        wrong == SIZE_MAX ? "as it should be" : std::string(about[wrong].name) + ", way " + std::to_string(k);
    check_status(f.name, what, status, wanted, *before);
    for (size_t i = 0; i < count; ++i) {
      if (status != DSW_STATUS_OK && f.types[i]->is_out) check_untouched(about[i], what, status);
      if (status == DSW_STATUS_OK) f.types[i]->dispose(about[i], &values[i]);
    }
    if (mutex_ != nullptr && !writes) return true;
    if (status == DSW_STATUS_OK && writes) {
      host_.renew();
    } else if (!host_.is_unchanged()) {
      report(f.name, what + ": something has changed");
      host_.renew();
    }
    return true;
  }

  static void check_status(std::string_view name, const std::string& what, int status, int wanted, int before) {
    const bool holds = wanted == kAnything   ? true
                       : wanted == kAsBefore ? status == before
                       : wanted == kRefused  ? status != DSW_STATUS_OK || before != DSW_STATUS_OK
                       : wanted == kNullMayPass
                           ? status == DSW_STATUS_NULL_ARGUMENT || status == before || before != DSW_STATUS_OK
                           : status == wanted;
    if (!holds || status == DSW_STATUS_INTERNAL || status == DSW_STATUS_OUT_OF_MEMORY || status < 0 ||
        status > DSW_STATUS_NOT_CLOSED) {
      report(name, what + ": answers " + dsw_status_string(static_cast<dsw_status>(status)));
    }
    const std::string_view message = dsw_last_error_message();
    if (status != DSW_STATUS_OK && message.substr(0, name.size()) != name) {
      report(name, what + ": its message is \"" + std::string(message) + "\"");
    }
  }

  /** An out-argument after a failure. Some answer what was wrong, as the headers say. */
  void check_untouched(const Argument& a, const std::string& what, int status) const {
    const size_t at = static_cast<size_t>(a.scratch - scratch_.data());
    if (std::memcmp(a.scratch, before_.data() + at, kScratchBytes) == 0) return;
    const bool says_size = status == DSW_STATUS_BUFFER_TOO_SMALL && (a.called("count") || a.called("size_bytes"));
    const bool says_what = a.called("offender") || a.called("report") || a.called("sweeps");
    if (!says_size && !says_what) report(a.function, what + ": writes " + std::string(a.name) + " and fails");
  }

  Host& host_;
  std::shared_mutex* mutex_;
  Block scratch_;  // of the arguments, one after the other
  Block before_;   // the same before the call
};

#undef MEMBER
#define MEMBER(type, member)
#define FUNCTION(name, parameters) function_of(#name, name, parameters),
const Function kFunctions[] = {
#include "functions.inc"
};
constexpr size_t kCount = sizeof kFunctions / sizeof kFunctions[0];

void on_all_threads(size_t count, uint32_t dimension, bool shared) {
  Host host(dimension);
  std::shared_mutex mutex;
  mutex.lock();  // winpthreads makes a mutex at the first lock, and two threads may make two
  mutex.unlock();
  std::vector<std::thread> threads;
  for (size_t thread = 0; thread < count; ++thread) {
    threads.emplace_back([&, thread] {
      std::unique_ptr<Host> own;
      if (!shared) own = std::make_unique<Host>(dimension);
      Caller caller(shared ? &host : own.get(), shared ? &mutex : nullptr);
      // Each begins elsewhere, so that different functions meet.
      const size_t first = thread * kCount / count, end = (thread + 1) * kCount / count;
      const size_t tests = shared || effort_of(8) >= 8 ? kCount : end - first;
      for (size_t i = 0; i < tests; ++i) caller.test(kFunctions[(first + i) % kCount]);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace boundary

int main(int argc, char** argv) {
  using namespace boundary;
  const auto threads = static_cast<size_t>(argc == 2 ? std::atoi(argv[1]) : std::max(3, effort_of(8)));
  graveyard();
  bool passed = true;
  for (const uint32_t dimension : {2u, 3u}) {
    calls = failures = refused = 0;
    on_all_threads(threads, dimension, false);
    on_all_threads(threads, dimension, true);
    // Where nothing is wrong nearly all have to succeed, or one wrong thing would not be seen for another; the plane
    // lacks some.
    const size_t tests = (threads + (effort_of(8) >= 8 ? threads : 1)) * kCount,
                 most = tests / (dimension == 2 ? 6 : 10);
    std::printf("dimension %u: %zu functions, %zu calls, %zu failures; %zu of %zu are refused with nothing wrong\n",
                dimension, kCount, calls.load(), failures.load(), refused.load(), tests);
    passed = passed && failures == 0 && refused < most;
  }
  return passed ? 0 : 1;
}
