// One repeat of a reactor, or a network, with stochastic particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/problems/reactor/reactor_ensemble_columns.hpp"
#include "app/problems/reactor/reactor_ensemble_gas.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/reactor_population.hpp"

namespace lampblack::app {

// Whether what stands in an open reactor has to have the elements of all that flows in, as these agree and so does the
// start; closed reactors keep theirs, and a given gas has no balance.
[[nodiscard]] bool hasElementBalance(const ReactorCase& reactorCase);

class EnsembleRepeat {
 public:
  // Called at each row with its number and place; false stops the repeat.
  using AtRow = std::function<bool(std::size_t row, double x)>;

  // The case has to live as long.
  EnsembleRepeat(const ReactorCase& reactorCase, std::uint64_t repeat);

  // Rows at these places into numbers of this shape. NumericsError.
  void run(std::span<const double> places, const ReactorRepeatNumbers<double>& numbers, const AtRow& atRow);
  [[nodiscard]] const StochasticPopulation& population(std::size_t reactor) const {
    return populations_[reactor]->population();
  }

 private:
  void fill(std::size_t row, const ReactorRepeatNumbers<double>& numbers);
  void appendReactor(std::size_t reactor, std::vector<double>& columns);

  const ReactorCase& case_;
  std::uint64_t repeat_;
  std::vector<std::unique_ptr<ReactorPopulation>> populations_;
  EnsembleGas gas_;
  std::optional<SplitReactor> reactor_;
  ReactorBalance balance_;
  Thermo thermo_;
  bool hasElements_;
  // Elements and energy, as they were in the first row or have to be.
  std::vector<double> elements_;
  std::optional<double> energy_;
};

}  // namespace lampblack::app
