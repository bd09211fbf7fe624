#include "particles/gas_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr double SootGasState::*gasValues[] = {&SootGasState::temperature,
                                               &SootGasState::pressure,
                                               &SootGasState::density,
                                               &SootGasState::viscosity,
                                               &SootGasState::meanMolecularWeight,
                                               &SootGasState::H,
                                               &SootGasState::H2,
                                               &SootGasState::OH,
                                               &SootGasState::H2O,
                                               &SootGasState::O2,
                                               &SootGasState::C2H2};

}  // namespace

SootGasState mixed(const GasSample& from, const GasSample& to, double w, std::span<double> pah) {
  SootGasState gas;
  for (const auto value : gasValues) gas.*value = (1 - w) * from.gas.*value + w * to.gas.*value;
  for (std::size_t i = 0; i < pah.size(); ++i) pah[i] = (1 - w) * from.pah[i] + w * to.pah[i];
  gas.pah = pah;
  return gas;
}

void checkInterval(const GasSample& from, const GasSample& to, std::size_t pah) {
  for (const GasSample* sample : {&from, &to})
    if (sample->pah.size() != pah)
      throw InputError(
          fmt::format("path of soot: {} PAH at t = {} s, {} in the model", sample->pah.size(), sample->time, pah));
  if (!(to.time >= from.time))
    throw InputError(fmt::format("path of soot: time falls from {} to {} s", from.time, to.time));
}

std::size_t parts(const GasSample& from, const GasSample& to, const GasDivision& division) {
  double most = std::abs(to.gas.temperature - from.gas.temperature) / division.temperatureStep;
  const auto consider = [&](double x, double y) {
    const double larger = std::max(std::abs(x), std::abs(y));
    if (larger > 1e-9) most = std::max(most, std::abs(x - y) / larger / division.relativeStep);  // mol/m3
  };
  consider(from.gas.H, to.gas.H);
  consider(from.gas.OH, to.gas.OH);
  consider(from.gas.O2, to.gas.O2);
  consider(from.gas.C2H2, to.gas.C2H2);
  for (std::size_t i = 0; i < from.pah.size(); ++i) consider(from.pah[i], to.pah[i]);
  return std::clamp(static_cast<std::size_t>(std::ceil(most)), std::size_t{1}, division.most);
}

}  // namespace lampblack
