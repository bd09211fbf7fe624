#include "particles/models/soot_model.hpp"

#include <array>

#include "core/constants.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::particles {
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

}  // namespace

std::vector<std::size_t> SootModel::precursors() const {
  std::vector<std::size_t> pah;
  for (std::size_t i = SootSpecies::fixed; i < gasSpecies().size(); ++i) pah.push_back(i);
  return pah;
}

void SootModel::enthalpies(double temperature, std::span<double> h, std::span<double> slope) const {
  const auto [carbon, carbonSlope] = sootCarbonEnthalpy(temperature);
  const auto [hydrogen, hydrogenSlope] = sootHydrogenEnthalpy(temperature);
  for (std::size_t i = 0; i < scalars().size(); ++i) {
    h[i] = slope[i] = 0;
    for (const ElementMass& part : scalars()[i].elements) {
      const bool isCarbon = part.element == "C";
      h[i] += part.mass * (isCarbon ? carbon : hydrogen);
      slope[i] += part.mass * (isCarbon ? carbonSlope : hydrogenSlope);
    }
  }
}

double SootModel::absorption(double temperature, double volumeFraction) const {
  return sootAbsorption(temperature, volumeFraction);
}

double sootAbsorption(double temperature, double volumeFraction) {
  return 700 * volumeFraction * temperature;
}

std::pair<double, double> sootCarbonEnthalpy(double temperature) {
  return graphite.at(temperature, 12.011e-3);
}

std::pair<double, double> sootHydrogenEnthalpy(double temperature) {
  return hydrogenMolecule.at(temperature, 2 * 1.008e-3);
}

}  // namespace lampblack::particles
