// A kind of stochastic particles in the cells of a flow (StochasticPopulation): the scalars that a cell carries of
// them, their heat, the populations of cells as they are packed, and the change of one in its gas. EnsembleOperator
// moves the particles between cells and adds the exchange to the gas.
//
// The populations of all cells are kept packed by their owner (ParticleRows) and are unpacked, one after the other,
// into the one that this object advances.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "flow/state.hpp"
#include "particles/models/element_enthalpies.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::coupling {

// Where the amounts of a cell stand (State::carried), per m3: those of the particles, then what the reserve owes the
// gas, kg of each element that is exchanged.
struct AmountPlaces : AmountsOfParticles {
  std::size_t owed = 0;  // elements of the species that they exchange

  [[nodiscard]] std::size_t owedElement(std::size_t e) const { return 4 + held + e; }
  [[nodiscard]] std::size_t count() const { return 4 + held + owed; }
};

class CellParticles {
 public:
  // InputError where the mechanism lacks an element, and for elements whose heat in particles is not known.
  CellParticles(const Mechanism& mechanism, std::shared_ptr<StochasticPopulation> population);

  [[nodiscard]] const StochasticPopulation& population() const { return *population_; }
  // Prefix of the names of fields.
  [[nodiscard]] const std::string& material() const { return population_->material(); }
  // Of the particles, by symbol; and of the species that the gas exchanges with them: theirs, and others behind them.
  [[nodiscard]] const std::vector<std::string>& elements() const { return population_->elements(); }
  [[nodiscard]] const std::vector<std::string>& exchangedElements() const { return exchangedElements_; }
  [[nodiscard]] AmountPlaces amounts() const { return {{elements().size()}, exchangedElements_.size()}; }
  // Of the mechanism, in the order of the gas that advance() is given.
  [[nodiscard]] const std::vector<std::size_t>& species() const { return population_->species(); }
  // kg of each exchanged element in a mol of each species, species by species.
  [[nodiscard]] const std::vector<double>& massOfAtoms() const { return massOfAtoms_; }
  [[nodiscard]] const RowSizes& sizes() const { return population_->sizes(); }
  [[nodiscard]] const ParticleRows& rows() const { return population_->rows(); }

  // The scalars of State::carried.
  [[nodiscard]] std::vector<CarriedScalar> scalars() const;
  // kg of each element of the mechanism in a unit of each amount.
  [[nodiscard]] std::vector<std::vector<double>> unitElements(const Mechanism& mechanism) const;

  // m3/m3 of a cell's amounts.
  [[nodiscard]] double volumeOf(std::span<const double> amounts) const;

  // Adds all of a packed population but what is owed.
  void addAmounts(std::span<const double> population, std::span<double> amounts) const;
  // Of one particle, times `number`.
  void addAmounts(const double* row, double number, std::span<double> amounts) const {
    population_->addAmounts(row, number, amounts);
  }
  // J/m3 of so many kg/m3 of each element.
  [[nodiscard]] double enthalpy(double temperature, std::span<const double> elements) const;

  // A packed population without particles of the cell with this permanent number, which keys its random numbers.
  [[nodiscard]] std::vector<double> empty(std::uint64_t cell) const;

  // Transferred amounts of an advance() of a cell, per m3.
  struct Change {
    StochasticPopulation::Exchange exchange;
    // kg of each element that came and went with numerical particles: zero in the mean.
    std::vector<double> resampled;
  };
  // Of the next populations: StochasticPopulation::setRoom().
  void setRoom(std::size_t particles) { population_->setRoom(particles); }
  // A packed population over dt (s), to which particles have come (rows without a head). NumericsError.
  Change advance(std::span<const double> population, std::span<const double> arrived, const ParticleGas& gas,
                 double dt);
  // Of the last advance(): the population, packed, and microseconds that it took, about.
  [[nodiscard]] std::vector<double> pack() const { return population_->pack(); }
  [[nodiscard]] double cost() const { return population_->costPerParticle() * population_->cost(); }

 private:
  std::shared_ptr<StochasticPopulation> population_;
  std::vector<double> blank_;  // a packed population without particles
  std::vector<std::string> exchangedElements_;
  std::vector<double> massOfAtoms_;
  std::vector<ElementEnthalpy> enthalpies_;
};

}  // namespace lampblack::coupling
