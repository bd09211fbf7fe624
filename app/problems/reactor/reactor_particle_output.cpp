#include "app/problems/reactor/reactor_particle_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/soot_deck.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

std::vector<Quantity> particleColumns(const CarriedParticles& particles) {
  const std::string material = particles.material() + "_";
  std::vector<Quantity> columns;
  for (const auto& p : particlePropertyNames) columns.push_back({material + p.name, p.unit, p.description});
  for (const auto& p : particleProcessNames) columns.push_back({material + p.name, p.unit, p.description});
  for (const auto& scalar : particles.scalars())
    columns.push_back({material + scalar.density.name, scalar.density.unit, scalar.density.description});
  return columns;
}

ReactorParticleOutput::ReactorParticleOutput(const ReactorCase& reactorCase, Kept kept)
    : case_(reactorCase), kept_(kept) {
  if (!case_.particles) return;
  balance_.emplace(*case_.mechanism, *case_.particles, case_.particles->unitElements());
  densities_.resize(case_.particles->size());
}

std::vector<Quantity> ReactorParticleOutput::columns() const {
  if (!balance_) return {};
  std::vector<Quantity> columns = particleColumns(*case_.soot);
  if (keepsElements())
    columns.push_back({"element_imbalance", "1", "largest relative change of an element in gas and particles"});
  if (keepsEnergy())
    columns.push_back({"energy_imbalance", "1", "change of the energy of gas and particles over cp T"});
  return columns;
}

void ReactorParticleOutput::append(double pressure, double density, std::span<const double> y,
                                   std::vector<double>& row) {
  if (!balance_) return;
  const std::size_t n = case_.mechanism->numSpecies();
  const std::span<const double> Y = y.first(n), amounts = y.subspan(n + 1, densities_.size());
  const double T = y[n];
  const ParticleModel& model = case_.soot->model();
  case_.particles->densities(density, amounts, densities_);
  const ParticleGas& gas = case_.particles->gas().atComposition(T, pressure, Y);
  last_ = model.propertiesForResults(gas, densities_);
  for (const auto& p : particlePropertyNames) row.push_back(last_.*p.value);
  const ParticleProcesses processes = model.processes(gas, densities_);
  for (const auto& p : particleProcessNames) row.push_back(processes.*p.value);
  row.insert(row.end(), densities_.begin(), densities_.end());
  most_ = std::max(most_, last_.volumeFraction);
  mostAtLimit_ = std::max(mostAtLimit_, model.volumeFractionAtLimit(densities_));
  const SizeDistribution sizes = model.sizeDistribution(densities_);
  diameter_ = sizes.diameter;
  distribution_.insert(distribution_.end(), sizes.density.begin(), sizes.density.end());

  if (!keepsElements()) return;
  const std::vector<double> elements = balance_->elements(Y, amounts);
  const bool isFirst = elements_.empty();
  if (isFirst) elements_ = elements;
  row.push_back(largestImbalance(elements_, elements));
  elementImbalance_ = std::max(elementImbalance_, row.back());
  if (!keepsEnergy()) return;
  const double energy =
      kept_ == Kept::enthalpy ? balance_->enthalpy(T, Y, amounts) : balance_->internalEnergy(T, Y, amounts);
  if (isFirst) energyAtStart_ = energy;
  row.push_back((energy - energyAtStart_) / (Thermo(*case_.mechanism).cpMass(T, Y) * T));
  energyImbalance_ = std::max(energyImbalance_, std::abs(row.back()));
}

void ReactorParticleOutput::write(ResultsWriter& results) const {
  // Rank 0 alone has the rows, but all know of the model.
  if (!balance_) return;
  const std::size_t sizes = case_.soot->model().sizeDistribution(densities_).diameter.size();
  if (sizes == 0) return;
  const auto count = static_cast<std::int64_t>(sizes), rows = static_cast<std::int64_t>(distribution_.size() / sizes);
  results.dataset("/particles/diameter", {count}, diameter_, "m", "diameters of the size distribution");
  results.dataset("/particles/size_distribution", {rows, count}, distribution_, "1/m^3",
                  "dN/dlog10 d of each row of the table");
}

void ReactorParticleOutput::record(JsonWriter& json) const {
  if (!balance_) return;
  const std::string material = case_.soot->material() + "_";
  for (const auto& p : particlePropertyNames) json.field("final_" + material + p.name, last_.*p.value);
  json.field("maximum_" + material + "volume_fraction", most_);
  if (keepsElements()) json.field("element_imbalance", elementImbalance_);
  if (keepsEnergy()) json.field("energy_imbalance", energyImbalance_);
  if (mostAtLimit_ > 0) json.field(material + "in_last_section", mostAtLimit_ / most_);
}

void ReactorParticleOutput::print() const {
  if (!balance_) return;
  fmt::print("{}: volume fraction {:.4g}, {:.4g} particles a cubic metre of mean diameter {:.4g} nm\n",
             case_.soot->material(), last_.volumeFraction, last_.numberDensity, 1e9 * last_.meanDiameter);
  if (!keepsElements()) return;
  fmt::print("elements are conserved to {:.1e}", elementImbalance_);
  if (keepsEnergy()) fmt::print(", energy to {:.1e}", energyImbalance_);
  fmt::print("\n");
}

void ReactorParticleOutput::requireSizeRangeCovered() const {
  if (!balance_ || mostAtLimit_ <= case_.sootAtLimit * most_) return;
  throw NumericsError(fmt::format(
      "a fraction {:.2g} of the largest volume fraction of {} is in the largest particles of the model; the limit is "
      "{:.2g}. {}",
      mostAtLimit_ / most_, case_.soot->material(), case_.sootAtLimit, tooFewSections));
}

}  // namespace lampblack::app
