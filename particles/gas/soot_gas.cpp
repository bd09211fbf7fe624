#include "particles/gas/soot_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"

namespace lampblack::particles {

std::optional<double> defaultStickingCoefficient(std::string_view name) {
  static constexpr std::pair<std::string_view, double> table[] = {
      {"A2", 2.0e-3},     {"C10H8", 2.0e-3},   {"A2R5", 4.0e-3},  {"P2", 8.5e-3},      {"A3", 1.5e-2},
      {"A3R5", 2.5e-2},   {"A4", 2.5e-2},      {"FLTN", 2.5e-2},  {"A4R5", 3.9e-2},    {"C18H12", 3.9e-2},
      {"BAPYR", 6.1e-2},  {"BEPYREN", 6.1e-2}, {"BEPYR", 6.1e-2}, {"PERYLEN", 6.1e-2}, {"BGHIPER", 8.7e-2},
      {"ANTHAN", 8.7e-2}, {"CORONEN", 1.2e-1}};
  const auto upper = [](char c) { return std::toupper(static_cast<unsigned char>(c)); };
  for (const auto& [known, value] : table) {
    if (std::ranges::equal(known, name, {}, upper, upper)) return value;
  }
  return std::nullopt;
}

double stickingCoefficientByMass(double molecularWeight) {
  const double gram = molecularWeight * 1e3;
  return 1.5e-11 * gram * gram * gram * gram;
}

double pahDensity(int carbon, int hydrogen) {
  // Wang (2025, eq. 7-38) takes the weights in g/mol, lengths in angstrom and gives g/cm3: 0.260884 = (sqrt(3)/4) N_A
  // 1e-24.
  constexpr double basalCell = 2.46, spacing = 3.35;  // angstrom, graphite
  const double atoms = carbon + hydrogen;
  const double meanWeight = (12.011 * carbon + 1.008 * hydrogen) / atoms;
  return 1e3 * meanWeight / (0.260884 * basalCell * basalCell * spacing);
}

std::vector<std::string> sootSpecies(const SootModelOptions& options) {
  std::vector<std::string> names{"H", "H2", "OH", "H2O", "O2", "C2H2", "CO"};
  for (const PahSpecies& pah : options.pah) names.push_back(pah.name);
  return names;
}

std::vector<std::size_t> indicesOfSootSpecies(const Mechanism& mechanism, const SootModelOptions& options) {
  return knownSpecies(mechanism, sootSpecies(options), "ensembles need");
}

std::vector<std::string> sootPrecursors(const SootModelOptions& options) {
  std::vector<std::string> names;
  for (const PahSpecies& pah : options.pah) names.push_back(pah.name);
  return names;
}

bool hasPrecursors(const ParticleGas& gas) {
  double pah = 0;
  for (std::size_t i = SootSpecies::fixed; i < gas.concentrations.size(); ++i)
    pah += std::max(gas.concentrations[i], 0.0);
  return !(pah < 1e-15 * gas.pressure / (constants::gasConstant * gas.temperature));
}

void requirePhysical(const CarrierGas& gas, std::string_view what) {
  if (gas.temperature > 0 && gas.pressure > 0 && gas.viscosity > 0 && gas.meanMolecularWeight > 0) return;
  throw NumericsError(fmt::format("{}: gas at T = {} K, p = {} Pa, viscosity {} Pa s, W = {} kg/mol", what,
                                  gas.temperature, gas.pressure, gas.viscosity, gas.meanMolecularWeight));
}

}  // namespace lampblack::particles
