#include "particles/soot/soot_model.hpp"

#include <algorithm>
#include <array>

#include "core/constants.hpp"
#include "particles/two_equation.hpp"

namespace lampblack {
namespace {

// a1..a6 of H/RT = a1 + a2 T/2 + a3 T^2/3 + a4 T^3/4 + a5 T^4/5 + a6/T, below and above 1000 K.
struct EnthalpyFit {
  std::array<double, 6> low, high;

  // J/kg and J/kg/K, with the weight in kg/mol.
  [[nodiscard]] std::pair<double, double> at(double T, double weight) const {
    const std::array<double, 6>& a = T < 1000 ? low : high;
    const double perWeight = constants::gasConstant / weight;
    return {perWeight * (a[5] + T * (a[0] + T * (a[1] / 2 + T * (a[2] / 3 + T * (a[3] / 4 + T * a[4] / 5))))),
            perWeight * (a[0] + T * (a[1] + T * (a[2] + T * (a[3] + T * a[4]))))};
  }
};

constexpr EnthalpyFit graphite{
    {-3.10872072e-01, 4.40353686e-03, 1.90394118e-06, -6.38546966e-09, 2.98964248e-12, -1.08650794e+02},
    {1.45571829e+00, 1.71702216e-03, -6.97562786e-07, 1.35277032e-10, -9.67590652e-15, -6.95138814e+02}};
constexpr EnthalpyFit hydrogenMolecule{
    {2.34433112e+00, 7.98052075e-03, -1.94781510e-05, 2.01572094e-08, -7.37611761e-12, -9.17935173e+02},
    {3.33727920e+00, -4.94024731e-05, 4.99456778e-07, -1.79566394e-10, 2.00255376e-14, -9.50158922e+02}};

// Steps of the differences: a relative 1e-7, where half the digits are left in the quotient; of a value far below its
// typical size, that of the smallest value that matters.
constexpr double relativeStep = 1e-7;
constexpr double smallestShare = 1e-5;

}  // namespace

void SootModel::jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const {
  const std::size_t n = scalars().size(), m = gasSpecies().size(), rows = n + m, columns = rows + 1;
  thread_local std::vector<double> state, base, moved;
  state.resize(rows);
  base.resize(rows);
  moved.resize(rows);
  for (std::size_t i = 0; i < n; ++i) state[i] = std::max(densities[i], 0.0);
  for (std::size_t i = 0; i < m; ++i) state[n + i] = std::max(gas.concentrations[i], 0.0);
  ParticleGas at = gas;
  at.concentrations = {state.data() + n, m};
  const auto evaluate = [&](std::vector<double>& out) {
    sources(at, {state.data(), n}, {out.data(), n}, {out.data() + n, m});
  };
  const auto column = [&](std::size_t j, double step) {
    evaluate(moved);
    for (std::size_t i = 0; i < rows; ++i) values[i * columns + j] = (moved[i] - base[i]) / step;
  };
  evaluate(base);
  const double total = gas.pressure / (constants::gasConstant * gas.temperature);  // mol/m3
  for (std::size_t j = 0; j < rows; ++j) {
    const double x = state[j], typical = j < n ? scalars()[j].scale * gas.density : total;
    state[j] = x + relativeStep * std::max(x, smallestShare * typical);
    column(j, state[j] - x);
    state[j] = x;
  }
  at.temperature = gas.temperature * (1 + relativeStep);
  column(rows, at.temperature - gas.temperature);
}

double SootModel::volumeFraction(std::span<const double> densities) const {
  const std::vector<double> none(gasSpecies().size(), 0.0);
  ParticleGas gas;  // nitrogen at 1500 K
  gas.temperature = 1500;
  gas.pressure = constants::oneAtmosphere;
  gas.meanMolecularWeight = 0.028;
  gas.density = gas.pressure * gas.meanMolecularWeight / (constants::gasConstant * gas.temperature);
  gas.viscosity = 5.4e-5;
  gas.concentrations = none;
  return properties(gas, densities).volumeFraction;
}

double SootModel::volumeFractionAtLimit(std::span<const double> /*densities*/) const {
  return 0;
}

SootSizeDistribution SootModel::sizeDistribution(std::span<const double> /*densities*/) const {
  return {};
}

double sootThermophoresis() {
  return TwoEquationSoot::thermophoreticCoefficient();
}

std::pair<double, double> sootCarbonEnthalpy(double temperature) {
  return graphite.at(temperature, 12.011e-3);
}

std::pair<double, double> sootHydrogenEnthalpy(double temperature) {
  return hydrogenMolecule.at(temperature, 2 * 1.008e-3);
}

}  // namespace lampblack
