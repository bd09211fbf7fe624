// What the particles of the cells take from a gas that stands still, in the mean over a time, as sources of a gas that
// is steady with them: so gas and particles of a steady flame are found in turn.
//
// What is made comes at its mean rate. What is taken goes with the mass fraction that is there, at the rate per mass
// fraction at which the particles took it: no gas gives what it does not have, and where the gas is that in which the
// particles were, the rates are theirs. The heat goes at its mean rate, which is theirs there too. Rates go half of the
// way to new ones, then as far as the last time tells: particles that grew in a gas without them take far too much,
// those that grow in what is left far too little, and so on. docs/theory/ensembles_in_cells.md, "In turn".
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/state.hpp"

namespace lampblack::coupling {

class MeanExchange {
 public:
  // Of species by their number in the mechanism; of nothing until approach().
  MeanExchange(const FlowContext& context, std::span<const std::size_t> species);

  // Goes a part of the way from the present rates to those at which the owned cells gained in `time` (s) from particles
  // in the gas of `state`: mol/m3 of each of the species, then J/m3. Collective.
  void approach(const State& state, std::span<const double> gained, double time);

  void addTo(const State& state, State::Balance& balance) const;
  void addSlopes(const Operator::Slopes& slopes, int species) const;
  void saveOrLoad(StateArchive& archive);

 private:
  [[nodiscard]] double nextWay(std::span<const double> lacks) const;  // collective
  [[nodiscard]] std::size_t width() const { return species_.size() + 1; }

  const FlowContext& context_;
  std::vector<std::size_t> species_;
  // Of the owned cells: kg/m3/s of each species that is made, then W/m3.
  std::vector<double> made_;
  std::vector<double> taken_;   // kg/m3/s of each species, for a mass fraction of one
  std::vector<double> lacked_;  // kg/m3/s of each species, by which the rates differed the last time
  double way_;                  // of that, which they then went; zero: never
};

}  // namespace lampblack::coupling
