#include "core/random.hpp"

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace lampblack {
namespace {

constexpr std::uint32_t multiplier0 = 0xD2511F53, multiplier1 = 0xCD9E8D57;  // Salmon et al. 2011, table 2
constexpr std::uint32_t weyl0 = 0x9E3779B9, weyl1 = 0xBB67AE85;
constexpr int rounds = 10;

// Lanes of 64 bits, each with one 32-bit word of the counter of one block in its lower half; what is above it after a
// multiplication is not looked at. (GCC 12 warns of its own forms without a mask.)
#if defined(__AVX512F__)
struct Lanes {
  static constexpr std::size_t count = 8;
  __m512i x;
  static Lanes all(std::uint64_t value) { return {_mm512_set1_epi64(static_cast<long long>(value))}; }
  static Lanes load(const std::uint64_t* from) { return {_mm512_loadu_si512(from)}; }
  void store(std::uint64_t* to) const { _mm512_storeu_si512(to, x); }
  friend Lanes operator^(Lanes a, Lanes b) { return {_mm512_xor_si512(a.x, b.x)}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {_mm512_maskz_mul_epu32(0xff, a.x, b.x)}; }  // of the lower halves
  [[nodiscard]] Lanes upper() const { return {_mm512_maskz_srli_epi64(0xff, x, 32)}; }
};
#elif defined(__AVX2__)
struct Lanes {
  static constexpr std::size_t count = 4;
  __m256i x;
  static Lanes all(std::uint64_t value) { return {_mm256_set1_epi64x(static_cast<long long>(value))}; }
  static Lanes load(const std::uint64_t* from) { return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))}; }
  void store(std::uint64_t* to) const { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), x); }
  friend Lanes operator^(Lanes a, Lanes b) { return {_mm256_xor_si256(a.x, b.x)}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_epu32(a.x, b.x)}; }
  [[nodiscard]] Lanes upper() const { return {_mm256_srli_epi64(x, 32)}; }
};
#else
struct Lanes {
  static constexpr std::size_t count = 1;
  std::uint64_t x;
  static Lanes all(std::uint64_t value) { return {value}; }
  static Lanes load(const std::uint64_t* from) { return {*from}; }
  void store(std::uint64_t* to) const { *to = x; }
  friend Lanes operator^(Lanes a, Lanes b) { return {a.x ^ b.x}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {(a.x & 0xffffffff) * (b.x & 0xffffffff)}; }
  [[nodiscard]] Lanes upper() const { return {x >> 32}; }
};
#endif

}  // namespace

// The rounds of Random123's philox4x32, for a register of consecutive counters at a time.
void RandomStream::generate() {
  constexpr std::size_t blocks = buffered / 2, groups = blocks / Lanes::count;
  const std::uint64_t first = position_ / buffered * blocks;
  std::uint64_t numbers[blocks];
  for (std::size_t b = 0; b < blocks; ++b) numbers[b] = first + b;
  const Lanes m0 = Lanes::all(multiplier0), m1 = Lanes::all(multiplier1);
  Lanes c0[groups], c1[groups], c2[groups], c3[groups];
  for (std::size_t g = 0; g < groups; ++g) {
    c0[g] = Lanes::load(&numbers[g * Lanes::count]);
    c1[g] = Lanes::all(static_cast<std::uint32_t>(owner_));
    c2[g] = Lanes::all(owner_ >> 32);
    c3[g] = Lanes::all(purpose_);
  }
  std::uint32_t k0 = key_[0], k1 = key_[1] ^ (static_cast<std::uint32_t>(first >> 32U) << 16U);
  for (int round = 0; round < rounds; ++round) {
    const Lanes key0 = Lanes::all(k0), key1 = Lanes::all(k1);
    for (std::size_t g = 0; g < groups; ++g) {
      const Lanes product0 = c0[g] * m0, product1 = c2[g] * m1;
      c0[g] = product1.upper() ^ c1[g] ^ key0;
      c1[g] = product1;
      c2[g] = product0.upper() ^ c3[g] ^ key1;
      c3[g] = product0;
    }
    k0 += weyl0;
    k1 += weyl1;
  }
  std::uint64_t words[4][blocks];
  for (std::size_t g = 0; g < groups; ++g) {
    c0[g].store(&words[0][g * Lanes::count]);
    c1[g].store(&words[1][g * Lanes::count]);
    c2[g].store(&words[2][g * Lanes::count]);
    c3[g].store(&words[3][g * Lanes::count]);
  }
  constexpr std::uint64_t lower = 0xffffffff;
  for (std::size_t b = 0; b < blocks; ++b) {
    words_[2 * b] = (words[0][b] & lower) | (words[1][b] << 32);
    words_[2 * b + 1] = (words[2][b] & lower) | (words[3][b] << 32);
  }
}

}  // namespace lampblack
