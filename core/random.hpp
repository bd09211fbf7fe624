// Counter-based random numbers (Philox4x32-10; Salmon, Moraes, Dror, Shaw 2011). A stream is keyed by what it is for -
// (seed, owner, purpose), owner being a global cell, trajectory or repeat - so that results do not depend on which rank
// draws them. The state is one counter: saving it makes a restart exact.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lampblack {

// Maps a random word to the open interval (0, 1) by its upper 52 bits: the middles of 2^52 equal steps, each of them a
// double, so that neither end is ever rounded to and the mean is exactly 1/2.
constexpr double openUnitInterval(std::uint64_t word) {
  return (static_cast<double>(word >> 12) + 0.5) * 0x1.0p-52;
}

class RandomStream {
 public:
  static constexpr std::size_t buffered = 16;  // words made at a time

  RandomStream(std::uint64_t seed, std::uint64_t owner, std::uint32_t purpose)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        owner_(owner),
        purpose_(purpose) {}

  // Uniform in the open interval (0, 1): never 0 or 1, so that its logarithm is finite and not zero.
  [[gnu::always_inline]] double uniform() { return openUnitInterval(next64()); }

  // Exponentially distributed waiting time with the given rate (1/s, positive).
  [[gnu::always_inline]] double exponential(double rate) { return -std::log(uniform()) / rate; }

  // Uniform index in [0, n); n positive. The bias is below n/2^64 (multiply-shift, Lemire 2019).
  [[gnu::always_inline]] std::uint64_t below(std::uint64_t n) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>(next64()) * n) >> 64);
  }

  // 64 independent fair coins.
  std::uint64_t bits() { return next64(); }

  [[nodiscard]] std::uint64_t owner() const { return owner_; }
  // Number of 64-bit words drawn so far; restoring it restores the stream exactly.
  [[nodiscard]] std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position) {
    position_ = position;
    if (position_ % buffered != 0) generate();
  }

 private:
  [[gnu::always_inline]] std::uint64_t next64() {
    const std::size_t k = position_ % buffered;
    if (k == 0) generate();
    ++position_;
    return words_[k];
  }

  // Fills the buffer that position_ is in. One Philox call gives two 64-bit words. The counter holds 32 bits of block
  // number low and owner and purpose above; after each 2^33 words another key goes on, whose upper 16 bits differ: 2^49
  // words a stream, months of drawing. (Seeds below 2^48 have keys of their own.)
  void generate();

  std::array<std::uint32_t, 2> key_;
  std::uint64_t owner_;
  std::uint32_t purpose_;
  std::uint64_t position_ = 0;
  std::array<std::uint64_t, buffered> words_{};
};

}  // namespace lampblack
