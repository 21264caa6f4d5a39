/* The choice of the instruction set at run time. */
#ifndef SB_BASE_MULTIVERSION_H
#define SB_BASE_MULTIVERSION_H

/* A function with this mark is compiled once per instruction set, and the loader selects one. Sanitizers cannot
   instrument that selection. SB_INSTRUCTIONS names a single set instead, for tests. A build for one processor
   (SB_NATIVE) needs only the set of that processor. */
#ifdef SB_INSTRUCTIONS
#define SB_MULTIVERSION __attribute__((target("arch=" SB_INSTRUCTIONS)))
#elif defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(SB_NATIVE) &&                        \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SB_MULTIVERSION __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define SB_MULTIVERSIONED
#else
#define SB_MULTIVERSION
#endif
#define SB_INLINE static inline __attribute__((always_inline))
/* A static function that computes in floats and that a function with SB_MULTIVERSION calls is either SB_INLINE,
   compiled with its caller, or SB_APART, compiled once. Otherwise the compiler may choose, and the last digits with it.
 */
#define SB_APART static __attribute__((noinline))

#endif
