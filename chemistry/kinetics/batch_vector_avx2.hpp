// Four doubles in a register of AVX2 (and FMA), for the kernels of states in lanes (batch_kinetics_simd.hpp). Only for
// files compiled for these instructions.
#pragma once

#include <immintrin.h>

#include "core/modules.hpp"
#include "numerics/simd_vectors.hpp"

namespace lampblack::chemistry {

namespace {

struct Avx2Vector : PortableVector<32> {
  static D all(double x) { return _mm256_set1_pd(x); }
  static D multiplyAdd(D a, D b, D c) { return _mm256_fmadd_pd(a, b, c); }
  static D smaller(D limit, D x) { return _mm256_min_pd(limit, x); }
  static D larger(D limit, D x) { return _mm256_max_pd(limit, x); }
  static bool none(Mask mask) { return _mm256_movemask_pd(reinterpret_cast<D>(mask)) == 0; }
  static bool every(Mask mask) { return _mm256_movemask_pd(reinterpret_cast<D>(mask)) == 15; }
  static D select(Mask mask, D yes, D no) { return _mm256_blendv_pd(no, yes, reinterpret_cast<D>(mask)); }
  static D withinExponents(D x) { return smaller(all(1022.0), larger(all(-1020.0), x)); }
};

}  // namespace

}  // namespace lampblack::chemistry
