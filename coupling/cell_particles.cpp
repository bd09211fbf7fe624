#include "coupling/cell_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

// What an element is called in names of fields.
std::string wordOf(const std::string& element) {
  constexpr std::array<std::pair<const char*, const char*>, 6> words{
      {{"C", "carbon"}, {"H", "hydrogen"}, {"O", "oxygen"}, {"N", "nitrogen"}, {"Si", "silicon"}, {"Ti", "titanium"}}};
  for (const auto& [symbol, word] : words)
    if (element == symbol) return word;
  return element;
}

}  // namespace

CellParticles::CellParticles(const Mechanism& mechanism, std::shared_ptr<StochasticPopulation> population)
    : population_(std::move(population)), blank_(population_->pack()), exchangedElements_(elements()) {
  for (std::size_t e = 0; e < mechanism.numElements(); ++e)
    if (std::ranges::any_of(species(), [&](std::size_t k) { return mechanism.atoms(k, e) != 0.0; }) &&
        std::ranges::find(elements(), mechanism.elementName(e)) == elements().end())
      exchangedElements_.push_back(mechanism.elementName(e));
  const auto enthalpies = elementEnthalpies(elements());
  if (!enthalpies)
    throw InputError(
        fmt::format("the heat of particles of {} is not known, which a flow needs: the program has that of "
                    "soot (C, H) and of silica (Si, O, H)",
                    material()));
  enthalpies_ = *enthalpies;
  for (const std::string& name : exchangedElements_) {
    const std::size_t e = mechanism.elementIndex(name);
    for (const std::size_t k : species()) massOfAtoms_.push_back(mechanism.atoms(k, e) * mechanism.atomicWeight(e));
  }
}

std::vector<CarriedScalar> CellParticles::scalars() const {
  std::vector<CarriedScalar> all;
  const auto add = [&](const std::string& name, const char* unit, std::string description) {
    all.push_back({material() + "_" + name, unit, std::move(description), 0.0, false});
  };
  add("number", "1/m^3", "particles, per volume");
  for (const std::string& element : elements())
    add(wordOf(element), "kg/m^3", wordOf(element) + " in particles, per volume");
  add("primaries", "1/m^3", "primary particles, per volume");
  add("surface", "m^2/m^3", "surface of particles, per volume");
  add("mobility_diameters", "m/m^3", "sum of mobility diameters, per volume");
  for (const std::string& element : exchangedElements_)
    add("owed_" + wordOf(element), "kg/m^3", wordOf(element) + " that the gas is still to get from the reserve");
  return all;
}

std::vector<std::vector<double>> CellParticles::unitElements(const Mechanism& mechanism) const {
  const AmountPlaces at = amounts();
  std::vector<std::vector<double>> all(at.count(), std::vector<double>(mechanism.numElements(), 0.0));
  for (std::size_t e = 0; e < elements().size(); ++e) all[at.element(e)][mechanism.elementIndex(elements()[e])] = 1.0;
  for (std::size_t e = 0; e < exchangedElements_.size(); ++e)
    all[at.owedElement(e)][mechanism.elementIndex(exchangedElements_[e])] = 1.0;
  return all;
}

double CellParticles::enthalpy(double temperature, std::span<const double> elements) const {
  double sum = 0.0;
  for (std::size_t e = 0; e < elements.size(); ++e) sum += elements[e] * enthalpies_[e](temperature).first;
  return sum;
}

double CellParticles::volumeOf(std::span<const double> amounts) const {
  double mass = 0.0;
  for (std::size_t e = 0; e < elements().size(); ++e) mass += amounts[this->amounts().element(e)];
  return mass / sizes().type.density();
}

void CellParticles::addAmounts(std::span<const double> population, std::span<double> amounts) const {
  population_->addAmountsOf(rows().of(population), amounts);
}

CellParticles::Change CellParticles::advance(std::span<const double> population, std::span<const double> arrived,
                                             const ParticleGas& gas, double dt) {
  population_->unpack(population);
  if (!arrived.empty()) population_->join(arrived, 1.0);
  population_->advance(gas, dt);
  // Deferred processes are applied before the exchange is looked at, and before particles move on.
  population_->applyDeferred();
  Change change{population_->takeExchange(), {}};
  change.resampled = population_->resampled();
  return change;
}

std::vector<double> CellParticles::empty(std::uint64_t cell) const {
  std::vector<double> population = blank_;
  std::ranges::copy(packedOwner(cell), &population[packedOwnerAt]);
  return population;
}

}  // namespace lampblack::coupling
