// Eight doubles in a register of AVX-512 (F, DQ, VL), for the kernels of states in lanes (batch_kinetics_simd.hpp).
// Only for files compiled for these instructions.
#pragma once

#include <immintrin.h>

#include "core/modules.hpp"
#include "numerics/simd_vectors.hpp"

namespace lampblack::chemistry {

namespace {

struct Avx512Vector : PortableVector<64> {
  using Mask = __mmask8;
  // Instructions with a mask of all lanes: the same as those without, whose headers make g++ 12 warn (GCC bug 105593).
  static constexpr Mask everyLane = 0xff;
  struct Exponent {
    D n;
  };
  static D all(double x) { return _mm512_set1_pd(x); }
  static D multiplyAdd(D a, D b, D c) { return _mm512_fmadd_pd(a, b, c); }
  static D smaller(D limit, D x) { return _mm512_maskz_min_pd(everyLane, limit, x); }
  static D larger(D limit, D x) { return _mm512_maskz_max_pd(everyLane, limit, x); }
  static Mask notAbove(D a, D b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static D select(Mask mask, D yes, D no) { return _mm512_mask_blend_pd(mask, no, yes); }
  static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
  static bool none(Mask mask) { return mask == 0; }
  static bool every(Mask mask) { return mask == everyLane; }
  static D withinExponents(D x) { return x; }  // the instruction that raises knows zero and infinity
  static Exponent takeExponentInside(D& x) {
    const D rest = _mm512_maskz_reduce_pd(everyLane, x, _MM_FROUND_TO_NEAREST_INT);
    const D n = x - rest;
    x = rest;
    return {n};
  }
  static D raise(D x, Exponent n) { return _mm512_maskz_scalef_pd(everyLane, x, n.n); }
  static D lower(D x, Exponent n) { return _mm512_maskz_scalef_pd(everyLane, x, -n.n); }
};

}  // namespace

}  // namespace lampblack::chemistry
