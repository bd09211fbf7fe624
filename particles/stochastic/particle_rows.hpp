// Where the particles of a packed population are, for owners of many populations, who keep them packed and move
// particles between them: behind a head of as many values for all, a row each. Rows begin with what moves a particle
// and how large it is (GivenParticle). Those of kinds that keep more have it behind that, with the row's length first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/modules.hpp"

namespace lampblack::particles {

// One particle of a given population: kg, number per m3. Of a material without carbon and hydrogen the first is its
// mass; `primaries` are those equal ones of the same volume and surface.
struct GivenParticle {
  double carbon = 0, hydrogen = 0, primaries = 1, number = 0;
};
inline constexpr std::size_t packedParticle = sizeof(GivenParticle) / sizeof(double);
inline constexpr std::size_t packedNumberAt = 3;

// Whose random numbers a population draws, in two halves: in every packed population at this place.
using PackedOwner = std::array<double, 2>;
inline constexpr std::size_t packedOwnerAt = 3;
[[nodiscard]] inline PackedOwner packedOwner(std::uint64_t owner) {
  return {static_cast<double>(owner >> 32U), static_cast<double>(owner & 0xffffffffU)};
}
[[nodiscard]] inline std::uint64_t ownerOf(const PackedOwner& packed) {
  return (static_cast<std::uint64_t>(packed[0]) << 32U) | static_cast<std::uint64_t>(packed[1]);
}

// How they are laid out.
struct ParticleRows {
  std::size_t head = 0;
  bool haveLengths = false;
  bool haveEqualNumbers = false;  // all of a population: its numerical particles have one weight

  [[nodiscard]] std::size_t lengthOf(const double* row) const {
    return haveLengths ? static_cast<std::size_t>(row[packedParticle]) : packedParticle;
  }
  [[nodiscard]] bool isEmpty(std::span<const double> population) const { return population.size() <= head; }
  // Rows of a population, without its head.
  [[nodiscard]] std::span<const double> of(std::span<const double> population) const {
    return isEmpty(population) ? std::span<const double>{} : population.subspan(head);
  }
  // f(const double* row), of rows without a head.
  template <class F>
  void forEach(std::span<const double> rows, F f) const {
    for (std::size_t i = 0; i < rows.size(); i += lengthOf(&rows[i])) f(&rows[i]);
  }
  [[nodiscard]] std::size_t count(std::span<const double> rows) const {
    if (!haveLengths) return rows.size() / packedParticle;
    std::size_t n = 0;
    forEach(rows, [&](const double*) { ++n; });
    return n;
  }
};

[[nodiscard]] inline GivenParticle particleAt(const double* row) {
  return {row[0], row[1], row[2], row[3]};
}
[[nodiscard]] inline double massAt(const double* row) {  // kg
  return row[0] + row[1];
}

}  // namespace lampblack::particles
