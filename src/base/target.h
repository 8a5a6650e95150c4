#pragma once
// Functions for one instruction set.

#define DSW_PRAGMA(text) _Pragma(#text)

/** What is defined from here on, but not in headers above, may use the features: a list in quotation marks. */
#if defined(__clang__)
#define DSW_BEGIN_TARGET(features) \
  DSW_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define DSW_END_TARGET DSW_PRAGMA(clang attribute pop)
#else
#define DSW_BEGIN_TARGET(features) \
  DSW_PRAGMA(GCC push_options)     \
  DSW_PRAGMA(GCC target(features))
#define DSW_END_TARGET DSW_PRAGMA(GCC pop_options)
#endif
