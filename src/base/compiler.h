#pragma once
// What is not C++ but of a compiler or of a machine; no other file has such words. Everything has a portable form,
// which gives the same values. DSW_PORTABLE_COMPILER=1 selects the portable forms, so that tests can compare both.

#include <cmath>
#include <cstdint>

#include "base/int128.h"
#include "base/pairs.h"

#if DSW_PORTABLE_COMPILER
#elif defined(__GNUC__)  // clang says so, too
#define DSW_GNU 1
#elif defined(_MSC_VER) && (defined(_M_X64) || defined(_M_ARM64))
#define DSW_MSVC 1
#include <intrin.h>
#endif

#define DSW_PRAGMA(text) _Pragma(#text)

// Functions. What runs for every cell is DSW_HOT: it is always inlined. What runs for one in a thousand is DSW_COLD: it
// stays out of its caller's registers. DSW_HOT_LAMBDA follows the parameters of a lambda.
#if DSW_GNU
#define DSW_HOT inline __attribute__((always_inline))
#define DSW_HOT_LAMBDA __attribute__((always_inline))
#define DSW_NOINLINE __attribute__((noinline))
#define DSW_COLD __attribute__((noinline, cold))
#elif DSW_MSVC
#define DSW_HOT __forceinline
#define DSW_HOT_LAMBDA
#define DSW_NOINLINE __declspec(noinline)
#define DSW_COLD DSW_NOINLINE
#else
#define DSW_HOT inline
#define DSW_HOT_LAMBDA
#define DSW_NOINLINE
#define DSW_COLD
#endif

/** For a function with a format of printf: the positions of the format and of the first value, counted from 1. `this` counts. */
#if DSW_GNU && defined(__MINGW32__) && !defined(__clang__)
#define DSW_PRINTF(format_at, values_at) __attribute__((format(gnu_printf, format_at, values_at)))
#elif DSW_GNU
#define DSW_PRINTF(format_at, values_at) __attribute__((format(printf, format_at, values_at)))
#else
#define DSW_PRINTF(format_at, values_at)
#endif

// Hints for branches, and loops that are unrolled `passes` times.
#if DSW_GNU
#define DSW_LIKELY(condition) __builtin_expect(static_cast<bool>(condition), 1)
#define DSW_UNLIKELY(condition) __builtin_expect(static_cast<bool>(condition), 0)
#define DSW_UNROLL(passes) DSW_PRAGMA(GCC unroll passes)
#else
#define DSW_LIKELY(condition) (condition)
#define DSW_UNLIKELY(condition) (condition)
#define DSW_UNROLL(passes)
#endif

/** WebAssembly has threads only where it is compiled for them. */
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#define DSW_HAS_THREADS 0
#else
#define DSW_HAS_THREADS 1
#endif

/** x86-64: files and functions for its further instructions are compiled. */
#if DSW_GNU && defined(__x86_64__)
#define DSW_X86_64 1
#else
#define DSW_X86_64 0
#endif

#if DSW_X86_64
/** Whether processor and system have a feature: a literal. */
#define DSW_CPU_HAS(feature) (__builtin_cpu_init(), __builtin_cpu_supports(feature) != 0)

/** What is defined from here on, but not in headers above, may use the features: a list in quotation marks. */
#if defined(__clang__)
#define DSW_BEGIN_TARGET(features) \
  DSW_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define DSW_END_TARGET DSW_PRAGMA(clang attribute pop)
#define DSW_UNSET_REGISTERS
#else
#define DSW_BEGIN_TARGET(features) \
  DSW_PRAGMA(GCC push_options)     \
  DSW_PRAGMA(GCC target(features))
#define DSW_END_TARGET DSW_PRAGMA(GCC pop_options)
/** GCC 12 warns of its own intrinsics for AVX-512, which begin with a register that is not set. */
#define DSW_UNSET_REGISTERS                            \
  DSW_PRAGMA(GCC diagnostic ignored "-Wuninitialized") \
  DSW_PRAGMA(GCC diagnostic ignored "-Wmaybe-uninitialized")
#endif
#endif

namespace dsw {

/** Asks the memory for the line of the cache with this address, which need not be one of an object. */
DSW_HOT void prefetch_line([[maybe_unused]] const void* address) noexcept {
#if DSW_GNU
  __builtin_prefetch(address);
#endif
}

/** The number of the lowest bit that is set; x is not 0. */
DSW_HOT uint32_t lowest_bit(uint64_t x) noexcept {
#if DSW_GNU
  return static_cast<uint32_t>(__builtin_ctzll(x));
#elif DSW_MSVC
  unsigned long at = 0;
  _BitScanForward64(&at, x);
  return at;
#else
  return plain::lowest_bit(x);
#endif
}
DSW_HOT uint32_t lowest_bit(uint32_t x) noexcept {
#if DSW_GNU
  return static_cast<uint32_t>(__builtin_ctz(x));
#else
  return lowest_bit(uint64_t{x});
#endif
}

/** The number of the highest bit that is set; x is not 0. */
DSW_HOT uint32_t highest_bit(uint64_t x) noexcept {
#if DSW_GNU
  return 63u - static_cast<uint32_t>(__builtin_clzll(x));
#elif DSW_MSVC
  unsigned long at = 0;
  _BitScanReverse64(&at, x);
  return at;
#else
  return plain::highest_bit(x);
#endif
}
DSW_HOT uint32_t highest_bit(uint32_t x) noexcept {
#if DSW_GNU
  return 31u - static_cast<uint32_t>(__builtin_clz(x));
#else
  return highest_bit(uint64_t{x});
#endif
}

/** How many bits are set. */
DSW_HOT uint32_t bit_count(uint64_t x) noexcept {
#if DSW_GNU
  return static_cast<uint32_t>(__builtin_popcountll(x));
#else
  return plain::bit_count(x);
#endif
}
DSW_HOT uint32_t bit_count(uint32_t x) noexcept {
#if DSW_GNU
  return static_cast<uint32_t>(__builtin_popcount(x));
#else
  return plain::bit_count(x);
#endif
}

/** a * b + c, rounded once. One instruction where the target has one, else slow. */
DSW_HOT double fused_multiply_add(double a, double b, double c) noexcept {
#if DSW_GNU
  return __builtin_fma(a, b, c);
#else
  return std::fma(a, b, c);
#endif
}

// Integers of 128 bits.
#if DSW_GNU && defined(__SIZEOF_INT128__)
#define DSW_NATIVE_INT128 1
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;
#else
using Int128 = plain::Int128;
using Uint128 = plain::Uint128;
#endif

// Two doubles and two words of 64 bits, eight words of 16 bits. A comparison gives words of all bits or none. They have
// the operators of numbers, lane by lane, `[]`, and are made of a list of numbers.
#if DSW_GNU
typedef double DoublePair __attribute__((vector_size(16)));
typedef int64_t PairMask __attribute__((vector_size(16)));
typedef int16_t ShortEight __attribute__((vector_size(16)));
DSW_HOT PairMask bits_of(DoublePair x) noexcept { return reinterpret_cast<PairMask>(x); }
DSW_HOT DoublePair pair_of(PairMask bits) noexcept { return reinterpret_cast<DoublePair>(bits); }
DSW_HOT ShortEight eight_of(int16_t x) noexcept { return x - ShortEight{}; }
/** Swaps the lanes. */
DSW_HOT DoublePair turned(DoublePair x) noexcept { return DoublePair{x[1], x[0]}; }
#else
using DoublePair = plain::DoublePair;
using PairMask = plain::PairMask;
using ShortEight = plain::ShortEight;
using plain::bits_of;
using plain::eight_of;
using plain::pair_of;
using plain::turned;
#endif
/** In each lane, the first if the mask is set, else the second. */
DSW_HOT DoublePair chosen(PairMask mask, DoublePair first, DoublePair second) noexcept {
  return pair_of((mask & bits_of(first)) | (~mask & bits_of(second)));
}
/** In each lane, the smaller number or the larger one; the second if they are equal or one is NaN. */
#if DSW_GNU
DSW_HOT DoublePair smaller(DoublePair a, DoublePair b) noexcept { return a < b ? a : b; }
DSW_HOT DoublePair larger(DoublePair a, DoublePair b) noexcept { return a > b ? a : b; }
#else
DSW_HOT DoublePair smaller(DoublePair a, DoublePair b) noexcept { return chosen(a < b, a, b); }
DSW_HOT DoublePair larger(DoublePair a, DoublePair b) noexcept { return chosen(a > b, a, b); }
#endif
/** The absolute value of each lane. */
DSW_HOT DoublePair magnitude_of(DoublePair x) noexcept { return pair_of(bits_of(x) & PairMask{INT64_MAX, INT64_MAX}); }
/** Bit i tells whether lane i of a mask is set. */
DSW_HOT uint32_t lanes_of(PairMask mask) noexcept {
#if DSW_X86_64
  return static_cast<uint32_t>(__builtin_ia32_movmskpd(reinterpret_cast<DoublePair>(mask)));
#else
  return static_cast<uint32_t>((mask[0] & 1) | (mask[1] & 2));
#endif
}

}  // namespace dsw
