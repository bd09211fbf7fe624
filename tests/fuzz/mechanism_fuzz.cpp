// The mechanism reader accepts a file or says what is wrong with it; nothing else. What it accepts holds finite
// numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

void requireFinite(std::span<const double> values) {
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
    throw std::runtime_error("the reader accepted a number that is not finite");
}

void requireFinite(const Arrhenius& rate) {
  requireFinite(std::array{rate.A, rate.b, rate.activationTemperature});
}

void requireFinite(const Reaction& reaction) {
  requireFinite(reaction.rate);
  requireFinite(reaction.lowPressureRate);
  for (const auto& entry : reaction.pressureRates) {
    requireFinite(std::array{entry.pressure});
    requireFinite(entry.rate);
  }
  if (reaction.chebyshev) requireFinite(reaction.chebyshev->coefficients);
  if (reaction.tsang) requireFinite(std::array{reaction.tsang->A, reaction.tsang->B});
  if (reaction.blowersMasel) requireFinite(std::array{reaction.blowersMasel->bondEnergy});
  for (const auto& collider : reaction.colliders) {
    requireFinite(collider.efficiency);
    requireFinite(collider.rate);
  }
}

void requireFinite(const Mechanism& mechanism) {
  requireFinite(mechanism.molecularWeights());
  for (const auto& species : mechanism.allSpecies()) {
    requireFinite(species.thermo.low);
    requireFinite(species.thermo.high);
    requireFinite(
        std::array{species.thermo.minTemperature, species.thermo.midTemperature, species.thermo.maxTemperature});
    if (species.nasa9)
      for (const auto& range : species.nasa9->ranges) requireFinite(range);
  }
  for (const auto& reaction : mechanism.reactions()) requireFinite(reaction);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const test::ScratchFolder folder;
  try {
    requireFinite(Mechanism::fromFile(folder.file("mechanism.yaml", {reinterpret_cast<const char*>(data), size})));
  } catch (const InputError&) {
  }
  return 0;
}
