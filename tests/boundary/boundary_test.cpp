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
#include <tuple>

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

/** Makes calls on one host, which other threads may share. */
class Caller {
 public:
  Caller(Host* host, std::shared_mutex* mutex)
      : host_(*host), mutex_(mutex), scratch_(kMostParameters * kScratchBytes), before_(scratch_) {}

  /** Everything as it should be, then each parameter wrong in each way. */
  template <class R, class... A>
  void test(const char* name, R (*function)(A...), std::string_view parameters) {
    int before = kAnything;
    attempt(name, function, parameters, SIZE_MAX, 0, &before);
    for (size_t i = 0; i < sizeof...(A); ++i) {
      for (size_t k = 0; attempt(name, function, parameters, i, k, &before); ++k) {
      }
    }
  }

 private:
  /** @return false where parameter `wrong` can't be wrong in so many ways; SIZE_MAX: nothing is, and the answer is
   * kept. */
  template <class R, class... A>
  bool attempt(const char* name, R (*function)(A...), std::string_view parameters, size_t wrong, size_t k,
               int* before) {
    static_assert(sizeof...(A) <= kMostParameters);
    // Whoever may change something is alone.
    constexpr bool writes = (is_written<A> || ...);
    std::shared_lock<std::shared_mutex> together;
    std::unique_lock<std::shared_mutex> alone;
    if (mutex_ != nullptr && writes) alone = std::unique_lock<std::shared_mutex>(*mutex_);
    if (mutex_ != nullptr && !writes) together = std::shared_lock<std::shared_mutex>(*mutex_);

    size_t next = 0;
    std::array<Argument, kMostParameters> about;
    for (size_t i = 0; i < sizeof...(A); ++i) {
      const size_t end = parameters.find(',', next);
      about[i] = {name, parameters.substr(next, end - next), &host_, scratch_.data() + i * kScratchBytes};
      next = end + 1;
    }
    std::tuple<A...> arguments = all_good<A...>(about, std::index_sequence_for<A...>());
    int wanted = wrong == SIZE_MAX ? static_cast<int>(kAnything) : static_cast<int>(kRefused);
    if (wrong != SIZE_MAX && !spoil_at(about, wrong, k, &arguments, &wanted, std::index_sequence_for<A...>()))
      return false;
    std::memcpy(before_.data(), scratch_.data(), sizeof...(A) * kScratchBytes);
    ++calls;
    if constexpr (!std::is_same_v<R, dsw_status>) {
      std::apply(function, arguments);  // of these only that they return
      return true;
    } else {
      const dsw_status status = std::apply(function, arguments);
      if (wrong == SIZE_MAX) *before = status;
      if (wrong == SIZE_MAX && status != DSW_STATUS_OK) ++refused;
      const std::string what =
          wrong == SIZE_MAX ? "as it should be" : std::string(about[wrong].name) + ", way " + std::to_string(k);
      check_status(name, what, status, wanted, *before);
      if (status != DSW_STATUS_OK) check_untouched(about, arguments, what, status, std::index_sequence_for<A...>());
      if (status == DSW_STATUS_OK) dispose(about, arguments, std::index_sequence_for<A...>());
      if (mutex_ != nullptr && !writes) return true;
      if (status == DSW_STATUS_OK && writes) {
        host_.renew();
      } else if (!host_.is_unchanged()) {
        report(name, what + ": something has changed");
        host_.renew();
      }
      return true;
    }
  }

  template <class T>
  static constexpr bool is_written =
      std::is_pointer_v<T>&& is_handle<std::remove_pointer_t<T>>;  // const handles are another type

  template <class... A, size_t... I>
  static std::tuple<A...> all_good(const std::array<Argument, kMostParameters>& about, std::index_sequence<I...>) {
    return {good<A>(about[I])...};
  }

  template <class Tuple, size_t... I>
  static bool spoil_at(const std::array<Argument, kMostParameters>& about, size_t wrong, size_t k, Tuple* arguments,
                       int* wanted, std::index_sequence<I...>) {
    bool some = false;
    ((some = some || (I == wrong && spoil(about[I], k, &std::get<I>(*arguments), wanted))), ...);
    (void)about, (void)k, (void)arguments, (void)wanted;  // of functions without parameters
    return some;
  }

  static void check_status(const char* name, const std::string& what, dsw_status status, int wanted, int before) {
    const bool holds = wanted == kAnything   ? true
                       : wanted == kAsBefore ? status == before
                       : wanted == kRefused  ? status != DSW_STATUS_OK || before != DSW_STATUS_OK
                       : wanted == kNullMayPass
                           ? status == DSW_STATUS_NULL_ARGUMENT || status == before || before != DSW_STATUS_OK
                           : status == wanted;
    if (!holds || status == DSW_STATUS_INTERNAL || status == DSW_STATUS_OUT_OF_MEMORY || status < 0 ||
        status > DSW_STATUS_NOT_CLOSED) {
      report(name, what + ": answers " + dsw_status_string(status));
    }
    const std::string_view message = dsw_last_error_message();
    if (status != DSW_STATUS_OK && message.substr(0, std::strlen(name)) != name) {
      report(name, what + ": its message is \"" + std::string(message) + "\"");
    }
  }

  /** Out-arguments after a failure. Some answer what was wrong, as the headers say. */
  template <class Tuple, size_t... I>
  void check_untouched(const std::array<Argument, kMostParameters>& about, const Tuple& arguments,
                       const std::string& what, dsw_status status, std::index_sequence<I...>) {
    const auto check = [&](const Argument& a, bool out) {
      const size_t at = static_cast<size_t>(a.scratch - scratch_.data());
      if (!out || std::memcmp(a.scratch, before_.data() + at, kScratchBytes) == 0) return;
      const bool says_size = status == DSW_STATUS_BUFFER_TOO_SMALL && (a.called("count") || a.called("size_bytes"));
      const bool says_what = a.called("offender") || a.called("report") || a.called("sweeps");
      if (!says_size && !says_what) report(a.function, what + ": writes " + std::string(a.name) + " and fails");
    };
    (check(about[I], is_out<std::tuple_element_t<I, Tuple>>), ...);
    (void)arguments;
  }

  template <class T>
  static constexpr bool is_out =
      std::is_pointer_v<T> && !std::is_const_v<std::remove_pointer_t<T>> && !is_handle<std::remove_pointer_t<T>>;

  /** What a call has made goes again, what it has destroyed is forgotten. */
  template <class Tuple, size_t... I>
  void dispose(const std::array<Argument, kMostParameters>& about, const Tuple& arguments, std::index_sequence<I...>) {
    const auto each = [&](const Argument& a, auto value) {
      using T = decltype(value);
      if constexpr (is_written<T>) {
        if (a.function.find("_destroy") != std::string_view::npos &&
            a.called(std::string(a.function.substr(4, a.function.size() - 12)).c_str())) {
          host_.forget(value);
        }
      }
      if constexpr (std::is_same_v<T, dsw_context**>) dsw_context_destroy(*value);
      if constexpr (std::is_same_v<T, dsw_environment**>) dsw_environment_destroy(*value);
      if constexpr (std::is_same_v<T, dsw_trace**>) dsw_trace_destroy(*value);
      if constexpr (std::is_same_v<T, dsw_replay**>) dsw_replay_destroy(*value);
      if constexpr (std::is_same_v<T, dsw_scene**>) {
        if (!a.of("dsw_replay_get_scene")) dsw_scene_destroy(*value);
      }
    };
    (each(about[I], std::get<I>(arguments)), ...);
  }

  Host& host_;
  std::shared_mutex* mutex_;
  Block scratch_;  // of the arguments, one after the other
  Block before_;   // the same before the call
};

using Test = void (*)(Caller&);
#undef MEMBER
#define MEMBER(type, member)
#define FUNCTION(name, parameters) [](Caller& caller) { caller.test(#name, name, parameters); },
const Test kTests[] = {
#include "functions.inc"
};
constexpr size_t kTestCount = sizeof kTests / sizeof kTests[0];

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
      const size_t first = thread * kTestCount / count, end = (thread + 1) * kTestCount / count;
      const size_t tests = shared || effort_of(8) >= 8 ? kTestCount : end - first;
      for (size_t i = 0; i < tests; ++i) kTests[(first + i) % kTestCount](caller);
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
    const size_t tests = (threads + (effort_of(8) >= 8 ? threads : 1)) * kTestCount,
                 most = tests / (dimension == 2 ? 6 : 10);
    std::printf("dimension %u: %zu functions, %zu calls, %zu failures; %zu of %zu are refused with nothing wrong\n",
                dimension, kTestCount, calls.load(), failures.load(), refused.load(), tests);
    passed = passed && failures == 0 && refused < most;
  }
  return passed ? 0 : 1;
}
