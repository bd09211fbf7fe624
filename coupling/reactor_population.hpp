// A stochastic population of any kind in a reactor whose gas it exchanges species with: what a run writes of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/modules.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::coupling {

class ReactorPopulation : public SplitParticles {
 public:
  struct Column {
    std::string name, unit, description;
  };
  // Names begin with the material: "soot_number_density". Every kind has its volume_fraction, number_density and
  // mean_diameter, of the sphere of mean volume.
  [[nodiscard]] virtual std::string material() const = 0;
  [[nodiscard]] virtual std::vector<Column> columns() const = 0;
  // Applies deferred processes up to the present time. Has to be called before values().
  virtual void applyDeferred() {}
  // SI, in a gas of species(), which rates depend on.
  [[nodiscard]] virtual std::vector<double> values(const ParticleGas& gas) const = 0;
  // Size distributions: the first without a name in results ("size_distribution").
  struct Distribution {
    std::string name, description;
  };
  [[nodiscard]] virtual std::vector<Distribution> distributions() const = 0;
  // The k-th, dN/dlog10 d (1/m3) in equal bins of log10(d/m).
  [[nodiscard]] virtual std::vector<double> distribution(std::size_t k, double logMin, double logMax,
                                                         std::size_t bins) const = 0;
  // The same of numbers from zero to one, dN/dx (1/m3) in equal bins, of kinds of particles that have such.
  [[nodiscard]] virtual std::vector<Distribution> shares() const { return {}; }
  [[nodiscard]] virtual std::vector<double> shareDistribution(std::size_t, std::size_t) const { return {}; }
  // What particles may be sorted into classes by, and what may be averaged over those of a class; of kinds that can.
  [[nodiscard]] virtual std::vector<Column> classedBy() const { return {}; }
  [[nodiscard]] virtual std::vector<Column> classAverages() const { return {}; }
  // Of each class below, between and above the rising edges: number (1/m3), then for each average its sum over the
  // particles times their number.
  [[nodiscard]] virtual std::vector<double> classSums(std::size_t, std::span<const double>) const { return {}; }
  // Every particle as tables, of kinds that have them; without particles the same tables without rows.
  struct TableColumn : Column {
    std::variant<std::vector<double>, std::vector<std::int64_t>> values;  // SI; numbers of rows are whole
  };
  struct Table {
    std::string name;
    std::vector<TableColumn> columns;
  };
  [[nodiscard]] virtual std::vector<Table> tables() const { return {}; }
  // What was counted, by name.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> counts() const = 0;
};

// Of a run: each repeat has another owner of random numbers.
using PopulationMaker = std::function<std::unique_ptr<ReactorPopulation>(std::uint64_t owner)>;

}  // namespace lampblack::coupling
