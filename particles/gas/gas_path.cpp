#include "particles/gas/gas_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles {

GasSample mixed(const GasSample& from, const GasSample& to, double w) {
  const auto mix = [w](double& x, double y) { x = (1 - w) * x + w * y; };
  GasSample sample = from;
  for (const auto value : {&CarrierGas::temperature, &CarrierGas::pressure, &CarrierGas::density,
                           &CarrierGas::viscosity, &CarrierGas::meanMolecularWeight})
    mix(sample.gas.*value, to.gas.*value);
  for (std::size_t k = 0; k < sample.concentrations.size(); ++k) mix(sample.concentrations[k], to.concentrations[k]);
  return sample;
}

void checkInterval(const GasSample& from, const GasSample& to, std::size_t species) {
  for (const GasSample* sample : {&from, &to})
    if (sample->concentrations.size() != species)
      throw InputError(fmt::format("path of particles: {} species at t = {} s, {} in the model",
                                   sample->concentrations.size(), sample->time, species));
  if (!(to.time >= from.time))
    throw InputError(fmt::format("path of particles: time falls from {} to {} s", from.time, to.time));
}

std::size_t parts(const GasSample& from, const GasSample& to, const GasDivision& division) {
  double most = std::abs(to.gas.temperature - from.gas.temperature) / division.temperatureStep;
  const auto consider = [&](double x, double y) {
    const double larger = std::max(std::abs(x), std::abs(y));
    if (larger > 1e-9) most = std::max(most, std::abs(x - y) / larger / division.relativeStep);  // mol/m3
  };
  for (const std::size_t k : division.counted) consider(from.concentrations[k], to.concentrations[k]);
  return std::clamp(static_cast<std::size_t>(std::ceil(most)), std::size_t{1}, division.most);
}

}  // namespace lampblack::particles
