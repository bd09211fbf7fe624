// Vectors of doubles for the kernels of BatchKinetics: what the compiler's vector types offer at any width, and 2^x and
// log2 x on top. Everything has internal linkage and nothing of the standard library is used: each file that includes
// this one is compiled for an instruction set of its own, and no function of it may be taken for another's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"

namespace lampblack::numerics {
namespace {

// Vectors of Bytes/8 doubles by the compiler's own means. An instruction set hides what it does better.
template <int Bytes>
struct PortableVector {
  typedef double D __attribute__((vector_size(Bytes)));
  typedef std::uint64_t U __attribute__((vector_size(Bytes)));
  typedef double Unaligned __attribute__((vector_size(Bytes), aligned(8), may_alias));
  typedef std::int64_t Mask __attribute__((vector_size(Bytes)));
  struct Exponent {
    U shifted;  // whole number to be added to exponents, in their place
  };
  static constexpr std::size_t lanes = Bytes / sizeof(double);

  static D load(const double* p) { return *reinterpret_cast<const D*>(p); }
  static void store(double* p, D x) { *reinterpret_cast<D*>(p) = x; }
  static D loadUnaligned(const double* p) { return *reinterpret_cast<const Unaligned*>(p); }
  static void storeUnaligned(double* p, D x) { *reinterpret_cast<Unaligned*>(p) = x; }
  static D all(double x) { return x - D{}; }
  static D multiplyAdd(D a, D b, D c) { return a * b + c; }
  static D smaller(D limit, D x) { return limit < x ? limit : x; }  // x if it is not a number
  static D larger(D limit, D x) { return limit > x ? limit : x; }
  static Mask notAbove(D a, D b) { return a <= b; }
  static D select(Mask mask, D yes, D no) { return mask ? yes : no; }
  static Mask both(Mask a, Mask b) { return a & b; }
  template <class M>
  static bool none(M mask) {
    std::int64_t found = 0;
    for (std::size_t i = 0; i < lanes; ++i) found |= mask[i];
    return found == 0;
  }
  static bool every(Mask mask) { return none(~mask); }

  // x, or the nearest of the exponents of normal numbers.
  static D withinExponents(D x) { return smaller(all(1022.0), larger(all(-1020.0), x)); }
  // The nearest whole number to x, which is left with the rest; for |x| within exponents.
  static Exponent takeExponentInside(D& x) {
    const D shifter = all(6755399441055744.0);  // 1.5 * 2^52: the sum has the whole number in its lowest bits
    const D sum = x + shifter;
    x = x - (sum - shifter);
    return {reinterpret_cast<U>(sum) << 52U};
  }
  static D raise(D x, Exponent n) { return reinterpret_cast<D>(reinterpret_cast<U>(x) + n.shifted); }  // x 2^n
  static D lower(D x, Exponent n) { return reinterpret_cast<D>(reinterpret_cast<U>(x) - n.shifted); }  // x 2^-n
};

// Two vectors as one: twice the states share the loads of coefficients and row numbers.
template <class V>
struct Doubled {
  using Half = V;
  static constexpr std::size_t lanes = 2 * V::lanes;
  struct D {
    typename V::D a, b;
    friend D operator+(D x, D y) { return {x.a + y.a, x.b + y.b}; }
    friend D operator-(D x, D y) { return {x.a - y.a, x.b - y.b}; }
    friend D operator*(D x, D y) { return {x.a * y.a, x.b * y.b}; }
    friend D operator/(D x, D y) { return {x.a / y.a, x.b / y.b}; }
    D& operator+=(D y) { return *this = *this + y; }
    D& operator-=(D y) { return *this = *this - y; }
    D& operator*=(D y) { return *this = *this * y; }
  };
  struct Mask {
    typename V::Mask a, b;
  };
  static D load(const double* p) { return {V::load(p), V::load(p + V::lanes)}; }
  static void store(double* p, D x) {
    V::store(p, x.a);
    V::store(p + V::lanes, x.b);
  }
  static D loadUnaligned(const double* p) { return {V::loadUnaligned(p), V::loadUnaligned(p + V::lanes)}; }
  static void storeUnaligned(double* p, D x) {
    V::storeUnaligned(p, x.a);
    V::storeUnaligned(p + V::lanes, x.b);
  }
  static D all(double x) { return {V::all(x), V::all(x)}; }
  static D multiplyAdd(D x, D y, D z) { return {V::multiplyAdd(x.a, y.a, z.a), V::multiplyAdd(x.b, y.b, z.b)}; }
  static D smaller(D limit, D x) { return {V::smaller(limit.a, x.a), V::smaller(limit.b, x.b)}; }
  static D larger(D limit, D x) { return {V::larger(limit.a, x.a), V::larger(limit.b, x.b)}; }
  static Mask notAbove(D x, D y) { return {V::notAbove(x.a, y.a), V::notAbove(x.b, y.b)}; }
  static D select(Mask mask, D yes, D no) { return {V::select(mask.a, yes.a, no.a), V::select(mask.b, yes.b, no.b)}; }
  static Mask both(Mask x, Mask y) { return {V::both(x.a, y.a), V::both(x.b, y.b)}; }
  static bool none(Mask mask) { return V::none(mask.a) && V::none(mask.b); }
  static bool every(Mask mask) { return V::every(mask.a) && V::every(mask.b); }
};

template <class V>
concept IsDoubled = requires {
  typename V::Half;
};

// 2^r of |r| <= 1/2 by the polynomial nearest to it (Chebyshev), relative error 3e-16.
template <class V>
typename V::D powerOfRest(typename V::D r) {
  auto p = V::multiplyAdd(V::all(0x1.e6063f7217bc6p-28), r, V::all(0x1.b675bca4eeebbp-24));
  p = V::multiplyAdd(p, r, V::all(0x1.62bfd47773353p-20));
  p = V::multiplyAdd(p, r, V::all(0x1.ffcb54062e698p-17));
  p = V::multiplyAdd(p, r, V::all(0x1.430913096fd9fp-13));
  p = V::multiplyAdd(p, r, V::all(0x1.5d87fe9d7a584p-10));
  p = V::multiplyAdd(p, r, V::all(0x1.3b2ab6fba1ddap-7));
  p = V::multiplyAdd(p, r, V::all(0x1.c6b08d703ce49p-5));
  p = V::multiplyAdd(p, r, V::all(0x1.ebfbdff82c598p-3));
  p = V::multiplyAdd(p, r, V::all(0x1.62e42fefa3a19p-1));
  return V::multiplyAdd(p, r, V::all(1.0));
}

// Of |x| <= 1000 only: elsewhere a number, or none, without meaning.
template <class V>
typename V::D exp2Inside(typename V::D x) {
  if constexpr (IsDoubled<V>) {
    return {exp2Inside<typename V::Half>(x.a), exp2Inside<typename V::Half>(x.b)};
  } else {
    const auto n = V::takeExponentInside(x);
    return V::raise(powerOfRest<V>(x), n);
  }
}

template <class V>
typename V::D exp2(typename V::D x) {
  if constexpr (IsDoubled<V>)
    return {exp2<typename V::Half>(x.a), exp2<typename V::Half>(x.b)};
  else
    return exp2Inside<V>(V::withinExponents(x));
}

// 2^x and 2^-x: E(r^2) + r O(r^2) and E - r O with polynomials nearest to cosh and sinh (Chebyshev), whose error is
// below 1e-17.
template <class V>
void exp2Both(typename V::D x, typename V::D& power, typename V::D& inverse) {
  if constexpr (IsDoubled<V>) {
    exp2Both<typename V::Half>(x.a, power.a, inverse.a);
    exp2Both<typename V::Half>(x.b, power.b, inverse.b);
  } else {
    x = V::withinExponents(x);
    const auto n = V::takeExponentInside(x);
    const auto y = x * x;
    auto even = V::multiplyAdd(V::all(0x1.e6228acd1c6e5p-28), y, V::all(0x1.62bfc2c86d700p-20));
    even = V::multiplyAdd(even, y, V::all(0x1.430913112c61bp-13));
    even = V::multiplyAdd(even, y, V::all(0x1.3b2ab6fb9f1a5p-7));
    even = V::multiplyAdd(even, y, V::all(0x1.ebfbdff82c5aep-3));
    even = V::multiplyAdd(even, y, V::all(1.0));
    auto odd = V::multiplyAdd(V::all(0x1.e9ec1fcb69a7fp-32), y, V::all(0x1.b524ebd13a55fp-24));
    odd = V::multiplyAdd(odd, y, V::all(0x1.ffcbfc6da6ed1p-17));
    odd = V::multiplyAdd(odd, y, V::all(0x1.5d87fe78a3f9cp-10));
    odd = V::multiplyAdd(odd, y, V::all(0x1.c6b08d704a0c6p-5));
    odd = V::multiplyAdd(odd, y, V::all(0x1.62e42fefa39efp-1));
    power = V::raise(V::multiplyAdd(odd, x, even), n);
    inverse = V::lower(V::multiplyAdd(-odd, x, even), n);
  }
}

// log2 x of normal positive x: x = 2^n m, m in [sqrt(1/2), sqrt(2)), log2 m = 2/ln 2 artanh((m - 1)/(m + 1)) by a
// polynomial of error 1e-16.
template <class V>
typename V::D log2(typename V::D x) {
  if constexpr (IsDoubled<V>) {
    return {log2<typename V::Half>(x.a), log2<typename V::Half>(x.b)};
  } else {
    using U = typename V::U;
    const U bits = reinterpret_cast<U>(x);
    constexpr std::uint64_t rootHalf = 0x3fe6a09e667f3bcdU, one = 1023, mantissa = 52;
    const U biased = (bits - rootHalf + (one << mantissa)) >> mantissa;
    const auto m = reinterpret_cast<typename V::D>(bits - ((biased - one) << mantissa));
    // The whole number in the lowest bits of 2^52.
    const auto n = reinterpret_cast<typename V::D>(biased | 0x4330000000000000U) - V::all(4503599627370496.0 + 1023.0);
    const auto f = (m - V::all(1.0)) / (m + V::all(1.0));
    const auto s = f * f;
    auto p = V::multiplyAdd(V::all(0x1.b592d3c48c41cp-3), s, V::all(0x1.c46e1440404d7p-3));
    p = V::multiplyAdd(p, s, V::all(0x1.0ca160627dbfcp-2));
    p = V::multiplyAdd(p, s, V::all(0x1.484afb7a67652p-2));
    p = V::multiplyAdd(p, s, V::all(0x1.a61762d693934p-2));
    p = V::multiplyAdd(p, s, V::all(0x1.2776c50ee39dcp-1));
    p = V::multiplyAdd(p, s, V::all(0x1.ec709dc3a047dp-1));
    p = V::multiplyAdd(p, s, V::all(0x1.71547652b82fep+1));
    return V::multiplyAdd(p, f, n);
  }
}

}  // namespace
}  // namespace lampblack::numerics
