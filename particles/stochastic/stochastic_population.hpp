// A stochastic population of any kind of particles in one gas: what a kind (soot as spheres or aggregates, trees of
// primaries) offers to the places that hold populations (the cells of a flow, reactors), which know no kind. A kind
// says what its particles are made of and exchange, how the population changes, how it is packed, and functionals of
// its particles, from which distributions and averages follow here, for all kinds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "core/quantity.hpp"
#include "particles/stochastic/particle_process.hpp"
#include "particles/stochastic/row_sizes.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::particles {

// Where sums over a population stand, per m3: number of particles, kg of each of their elements, number of primaries,
// surface, sum of mobility diameters.
struct AmountsOfParticles {
  std::size_t held = 0;  // elements of the particles

  static constexpr std::size_t number = 0;
  [[nodiscard]] std::size_t element(std::size_t e) const { return 1 + e; }
  [[nodiscard]] std::size_t primaries() const { return 1 + held; }
  [[nodiscard]] std::size_t surface() const { return 2 + held; }
  [[nodiscard]] std::size_t diameters() const { return 3 + held; }
};

// A number of each particle, SI.
struct ParticleFunctional : Quantity {
  // size: a diameter that has distributions, named "<...>_diameter"; share: from zero to one, with distributions.
  enum class Use { plain, size, share };
  Use use = Use::plain;
  bool isClassed = false;  // whether averages over classes of it can be wanted
};

class StochasticPopulation {
 public:
  virtual ~StochasticPopulation() = default;

  // Material of the particles: names of results begin with it.
  [[nodiscard]] const std::string& material() const { return kind_.material; }
  // Of the particles, by symbol.
  [[nodiscard]] const std::vector<std::string>& elements() const { return kind_.elements; }
  // Of the mechanism, in the order of the gas that advance() is given.
  [[nodiscard]] const std::vector<std::size_t>& species() const { return kind_.species; }
  [[nodiscard]] const RowSizes& sizes() const { return kind_.sizes; }
  [[nodiscard]] const ParticleRows& rows() const { return kind_.sizes.rows; }
  // Absorption coefficient, 1/m.
  [[nodiscard]] virtual double absorption(double temperature, double volumeFraction) const = 0;
  // Whether there can be inception in this gas.
  [[nodiscard]] virtual bool hasPrecursors(const ParticleGas& gas) const = 0;

  // Most numerical particles from now on, not more than it was made for. Kinds that cannot change it leave it as it is.
  virtual void setRoom(std::size_t /*particles*/) {}
  // Over dt (s). NumericsError.
  virtual void advance(const ParticleGas& gas, double dt) = 0;
  // The same where the particles' velocity diverges (1/s): diluted for half of it, advanced, diluted for the other half
  // (Strang 1968).
  virtual void advanceDiverging(const ParticleGas& gas, double divergence, double dt);
  // Species, by their places, whose changes along a path make a difference to the particles.
  [[nodiscard]] virtual std::vector<std::size_t> pathSpecies() const;
  // The species, by its place, by which a coupling with a gas sees whether it changes.
  [[nodiscard]] virtual std::size_t watchedSpecies() const { return 0; }
  // Applies deferred processes up to the present time. Has to be called before particles move and before values().
  virtual void applyDeferred() {}
  // Transferred amounts since the previous call, per m3.
  struct Exchange {
    std::vector<double> gas;       // mol, of the species: gained by the gas
    std::vector<double> elements;  // kg of each element, gained by the particles: the same atoms
  };
  virtual Exchange takeExchange() = 0;
  // What single processes did from one takeExchange() to the next, per m3; their names are the same for all materials.
  [[nodiscard]] virtual std::vector<ParticleProcess> processes() const { return {}; }
  // The last of these amounts.
  [[nodiscard]] virtual std::vector<double> amountsOfProcesses() const { return {}; }
  // kg/m3 of each element that came and went with numerical particles from unpack() to the last takeExchange(): zero in
  // the mean.
  [[nodiscard]] virtual std::vector<double> resampled() const = 0;
  // Rate (mol/m3/s) at which the particles gain the i-th species, where a law gives the rate.
  [[nodiscard]] virtual std::optional<double> rateOf(std::size_t, const ParticleGas&) const { return std::nullopt; }
  // Multiplies all numbers per volume.
  virtual void dilute(double factor) = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  // Number of numerical particles removed at random, to limit their number, since the beginning.
  [[nodiscard]] virtual std::uint64_t removals() const = 0;
  // Of the last advance(): number of particles visited and of events; and the time for each, about (microseconds).
  [[nodiscard]] virtual double cost() const = 0;
  [[nodiscard]] virtual double costPerParticle() const = 0;

  // The complete state with its owner of random numbers. InputError for what pack() did not write.
  [[nodiscard]] virtual std::vector<double> pack() const = 0;
  virtual void unpack(std::span<const double> state) = 0;
  // Rows (without a head) of all particles, with deferred processes applied, as join() of another population takes
  // them: of each `share` times its number comes in.
  [[nodiscard]] virtual std::vector<double> content() = 0;
  virtual void join(std::span<const double> rows, double share) = 0;
  // Everything that a step may change, for restore() after a rejected step.
  struct State {
    virtual ~State() = default;
  };
  [[nodiscard]] virtual std::unique_ptr<State> save() const;
  virtual void restore(const State& state);

  // Adds the amounts (AmountsOfParticles) of the particle of a row, times `number`.
  virtual void addAmounts(const double* row, double number, std::span<double> amounts) const = 0;
  // The same of all particles of these rows (without a head), each times its own number.
  virtual void addAmountsOf(std::span<const double> of, std::span<double> amounts) const;

  // What a run writes of the population. Names begin with the material. Every kind has its volume_fraction,
  // number_density and mean_diameter, of the sphere of mean volume.
  [[nodiscard]] virtual std::vector<Quantity> columns() const = 0;
  // SI, in a gas of species(), which rates depend on.
  [[nodiscard]] virtual std::vector<double> values(const ParticleGas& gas) const = 0;
  // What was counted, by name.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> counts() const { return {}; }
  [[nodiscard]] virtual std::vector<ParticleFunctional> functionals() const = 0;
  // Of the particle of a row, of which nothing behind the fixed part is looked at.
  [[nodiscard]] virtual double functional(std::size_t which, const double* row) const = 0;
  // f(row) of every particle, with the fixed part of its row alone.
  virtual void forEachRow(const std::function<void(const double* row)>& f) const = 0;
  // dN/dlog10 d (1/m3) of all primaries by their diameter, of kinds whose particles have different ones.
  [[nodiscard]] virtual bool hasPrimarySizes() const { return false; }
  [[nodiscard]] virtual std::vector<double> primarySizes(const SizeBins&) const { return {}; }

  // Size distributions: the first without a name in results ("size_distribution").
  struct Distribution {
    std::string name, description;
  };
  [[nodiscard]] std::vector<Distribution> distributions() const;
  // The k-th, dN/dlog10 d (1/m3).
  [[nodiscard]] virtual std::vector<double> distribution(std::size_t k, const SizeBins& bins) const;
  // The same of shares, dN/dx (1/m3) in equal bins from zero to one.
  [[nodiscard]] std::vector<Distribution> shares() const;
  [[nodiscard]] std::vector<double> shareDistribution(std::size_t k, std::size_t bins) const;
  // What particles may be sorted into classes by. Averages over those of a class are of all functionals.
  [[nodiscard]] std::vector<Quantity> classedBy() const;
  // Of each class below, between and above the rising edges: number (1/m3), then for each functional its sum over the
  // particles times their number.
  [[nodiscard]] std::vector<double> classSums(std::size_t by, std::span<const double> edges) const;

  // Every particle as tables, of kinds that have them; without particles the same tables without rows.
  struct TableColumn : Quantity {
    std::variant<std::vector<double>, std::vector<std::int64_t>> values;  // SI; numbers of rows are whole
  };
  struct Table {
    std::string name;
    std::vector<TableColumn> columns;
  };
  [[nodiscard]] virtual std::vector<Table> tables() const { return {}; }

 protected:
  struct Kind {
    std::string material;
    std::vector<std::size_t> species;
    std::vector<std::string> elements;
    RowSizes sizes;
  };
  explicit StochasticPopulation(Kind kind) : kind_(std::move(kind)) {}
  StochasticPopulation(const StochasticPopulation&) = delete;
  StochasticPopulation& operator=(const StochasticPopulation&) = delete;

 private:
  // Places of the functionals of one use, or of those that are classed.
  [[nodiscard]] std::vector<std::size_t> placesOf(ParticleFunctional::Use use) const;
  [[nodiscard]] std::vector<std::size_t> placesOfClassed() const;

  Kind kind_;
};

// Makes a population with the random numbers of this owner and with what is there from the beginning. InputError.
using MakePopulation = std::function<std::unique_ptr<StochasticPopulation>(std::uint64_t owner)>;

}  // namespace lampblack::particles
