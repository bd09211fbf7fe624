#include "particles/stochastic/row_sizes.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "numerics/vector_math.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"

namespace lampblack::particles {

// By the cube of the diameter, which needs no root.
void addSizes(const RowSizes& of, const SizeBins& bins, std::span<const double> population, std::span<double> density) {
  constexpr std::size_t atATime = 128;
  constexpr double toLog = std::numbers::log10e / 3.0;
  const double perVolume = of.type.perVolume(), perBin = 1.0 / bins.width();
  std::array<double, atATime> cubes, numbers;
  std::size_t count = 0;
  const auto flush = [&] {
    numerics::vectormath::log(cubes.data(), cubes.data(), count);
    for (std::size_t k = 0; k < count; ++k)
      if (const std::size_t bin = bins.ofLog(toLog * cubes[k]); bin < bins.count) density[bin] += numbers[k] * perBin;
    count = 0;
  };
  of.rows.forEach(of.rows.of(population), [&](const double* row) {
    const double primaries = of.type.coalescing() ? 1.0 : row[2];
    const double factor = SootAggregate::mobilityFactor(primaries);
    cubes[count] = perVolume * massAt(row) / primaries * (factor * factor * factor);
    numbers[count] = row[packedNumberAt];
    if (++count == atATime) flush();
  });
  flush();
}

double geometricDeviation(const RowSizes& of, std::span<const double> population) {
  WeightedDeviation deviation;
  of.rows.forEach(of.rows.of(population),
                  [&](const double* row) { deviation.add(std::log(of.mobilityDiameter(row)), row[packedNumberAt]); });
  return deviation.geometric();
}

}  // namespace lampblack::particles
