// A kind of stochastic particles in the cells of a flow: the change of the population of a cell in its gas, the
// elements of the particles, and the exchange with the gas. EnsembleOperator moves the particles between cells and adds
// the exchange to the gas, for any kind.
//
// The populations of all cells are kept packed by their owner (ParticleRows) and are unpacked, one after the other,
// into the one that this object advances.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "coupling/ensemble_sizes.hpp"
#include "flow/state.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::coupling {

// Where the amounts of a cell stand (State::carried), per m3: number of particles, kg of each of their elements, number
// of primaries, surface, sum of mobility diameters; then what the reserve owes the gas, kg of each element that is
// exchanged.
struct AmountPlaces {
  std::size_t held = 0, owed = 0;  // elements of the particles, and of the species that they exchange

  static constexpr std::size_t number = 0;
  [[nodiscard]] std::size_t element(std::size_t e) const { return 1 + e; }
  [[nodiscard]] std::size_t primaries() const { return 1 + held; }
  [[nodiscard]] std::size_t surface() const { return 2 + held; }
  [[nodiscard]] std::size_t diameters() const { return 3 + held; }
  [[nodiscard]] std::size_t owedElement(std::size_t e) const { return 4 + held + e; }
  [[nodiscard]] std::size_t count() const { return 4 + held + owed; }
};

class CellParticles {
 public:
  // Transferred amounts of an advance() of a cell, per m3.
  struct Change {
    std::vector<double> gas;       // mol, of the species: gained by the gas
    std::vector<double> elements;  // kg of each element, gained by the particles: the same atoms
    // kg of each element that came and went with numerical particles: zero in the mean.
    std::vector<double> resampled;
  };

  virtual ~CellParticles() = default;

  // Material of the particles: the prefix of the names of fields.
  [[nodiscard]] const std::string& material() const { return material_; }
  // Of the particles, by symbol; and of the species that the gas exchanges with them: theirs, and others behind them.
  [[nodiscard]] const std::vector<std::string>& elements() const { return elements_; }
  [[nodiscard]] const std::vector<std::string>& exchangedElements() const { return exchangedElements_; }
  [[nodiscard]] AmountPlaces amounts() const { return {elements_.size(), exchangedElements_.size()}; }
  // Of the mechanism, in the order of the gas that advance() is given.
  [[nodiscard]] const std::vector<std::size_t>& species() const { return species_; }
  // kg of each exchanged element in a mol of each species, species by species.
  [[nodiscard]] const std::vector<double>& massOfAtoms() const { return massOfAtoms_; }
  [[nodiscard]] const RowSizes& sizes() const { return sizes_; }
  [[nodiscard]] const ParticleRows& rows() const { return sizes_.rows; }

  // The scalars of State::carried.
  [[nodiscard]] std::vector<CarriedScalar> scalars() const;
  // kg of each element of the mechanism in a unit of each amount.
  [[nodiscard]] std::vector<std::vector<double>> unitElements(const Mechanism& mechanism) const;

  // m3/m3 of a cell's amounts.
  [[nodiscard]] double volumeOf(std::span<const double> amounts) const;

  // Adds all of a packed population but what is owed.
  void addAmounts(std::span<const double> population, std::span<double> amounts) const;
  // Of one particle, times `number`.
  virtual void addAmounts(const double* row, double number, std::span<double> amounts) const = 0;
  // J/m3 of so many kg/m3 of each element.
  [[nodiscard]] double enthalpy(double temperature, std::span<const double> elements) const;
  // Absorption coefficient, 1/m.
  [[nodiscard]] virtual double absorption(double temperature, double volumeFraction) const = 0;
  // Whether there can be inception in this gas.
  [[nodiscard]] virtual bool hasPrecursors(const ParticleGas& gas) const = 0;

  // A packed population without particles of the cell with this permanent number, which keys its random numbers.
  [[nodiscard]] std::vector<double> empty(std::uint64_t cell) const;
  // Replaces the population; join() then adds particles that arrive (rows without a head).
  virtual void unpack(std::span<const double> population) = 0;
  virtual void join(std::span<const double> rows) = 0;
  // Over dt (s). NumericsError.
  virtual Change advance(const ParticleGas& gas, double dt) = 0;
  // Of the last advance(): number of particles visited and of events, as Ensemble::cost(); and the time for each, about
  // (microseconds).
  [[nodiscard]] virtual double cost() const = 0;
  [[nodiscard]] virtual double costPerParticle() const = 0;
  [[nodiscard]] virtual std::vector<double> pack() const = 0;

 protected:
  // InputError where the mechanism lacks an element, and for elements whose heat in particles is not known.
  CellParticles(std::string material, std::vector<std::string> elements, const Mechanism& mechanism,
                std::vector<std::size_t> species, const RowSizes& sizes);
  CellParticles(const CellParticles&) = default;
  CellParticles& operator=(const CellParticles&) = default;

  std::vector<double> blank_;  // a packed population without particles; set by the kind

 private:
  std::string material_;
  std::vector<std::string> elements_, exchangedElements_;
  std::vector<std::size_t> species_;
  std::vector<double> massOfAtoms_;
  std::vector<ElementEnthalpy> enthalpies_;
  RowSizes sizes_;
};

}  // namespace lampblack::coupling
