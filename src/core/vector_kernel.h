#pragma once
// For loops that are compiled once for each instruction set, the fittest of which is chosen when
// the program starts. Not under ThreadSanitizer: the choice is made before its runtime starts, and
// crashes in it. The files that use these are compiled with -O3 -fno-math-errno
// -fno-trapping-math: gcc 12 does not vectorise such loops at -O2.

#define SKYLAPSE_INLINE static inline __attribute__((always_inline))

/// Before a loop that reads nothing which another of its turns writes: gcc's vectoriser need not
/// prove it. (Clang's has a hint that warns where it is not taken.)
#if defined(__GNUC__) && !defined(__clang__)
#define SKYLAPSE_INDEPENDENT_TURNS _Pragma("GCC ivdep")
#else
#define SKYLAPSE_INDEPENDENT_TURNS
#endif

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define SKYLAPSE_X86 1
/// One text, compiled for each instruction set by the compiler.
#define SKYLAPSE_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
/// Versions from a template with vectors of our own, as wide as each set's registers.
#define SKYLAPSE_V3 __attribute__((target("arch=x86-64-v3")))
#define SKYLAPSE_V4 __attribute__((target("arch=x86-64-v4")))
#else
#define SKYLAPSE_X86 0
#define SKYLAPSE_CLONES
#define SKYLAPSE_V3
#define SKYLAPSE_V4
#endif
