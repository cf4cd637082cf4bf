// Functions that are compiled once per instruction set, and chosen by what the machine has.
//
// There is one loop, a template over a struct that stands for vectors (words.h, costs.h). To be
// inlined by g++ and clang alike:
// - the struct's members have the target attribute, and work in place: no vector is an argument;
// - the template has none, and is always_inline;
// - so a function with the attribute, one per instruction set, takes in the template, then the
//   members.
#pragma once

#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>

#define WRAPATLAS_AVX2 [[gnu::target("avx2")]]
#define WRAPATLAS_AVX512 [[gnu::target("avx512f,avx512bw")]]
#endif

namespace wrapatlas {

/// The same function several times over.
template <typename Function>
struct Versions {
  Function scalar, avx2, avx512;

  /// Those that the machine can run, the widest first.
  [[nodiscard]] std::vector<Function> usable() const {
    std::vector<Function> functions;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512bw")) functions.push_back(avx512);
    if (__builtin_cpu_supports("avx2")) functions.push_back(avx2);
#endif
    functions.push_back(scalar);
    return functions;
  }
};

}  // namespace wrapatlas
