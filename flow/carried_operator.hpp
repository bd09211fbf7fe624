// Advances what a flow carries (State::carried) by its model, cell by cell, together with the gas it exchanges with:
// what the model takes from or gives to the gas changes the gas's species, mass and enthalpy. Cells are shared between
// the ranks as those of the chemistry are.
//
// Energy: gas and scalars together keep their enthalpy over a step, what was exchanged being as warm as the gas. The
// scalars' own sensible heat is not followed along their path.
#pragma once

#include <string>
#include <vector>

#include "core/particle_gas.hpp"
#include "core/rooms.hpp"
#include "core/work_sharing.hpp"
#include "flow/carried_model.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

// The gas of a cell as a model sees it; its concentrations, of the species named by their indices, are in
// `concentrations`.
[[nodiscard]] ParticleGas gasOfCell(const FlowContext& context, const State& state, int cell, double viscosity,
                                    const std::vector<std::size_t>& species, std::vector<double>& concentrations);

class CarriedOperator : public Operator {
 public:
  struct Options {
    bool shareWork = true;
    // Largest volume fraction in particles that cannot grow over the largest of all; more is a NumericsError, when a
    // row of the history is due, which ends with `advice`.
    double allowedAtLimit = 1.0;
    std::string advice;
  };

  // What a State has to carry for the model.
  [[nodiscard]] static std::vector<CarriedScalar> scalarsOf(const CarriedModel& model);

  // The model's scalars stand in State::carried from `first` on.
  CarriedOperator(const FlowContext& context, CarriedModel& model, std::size_t first, Options options);

  [[nodiscard]] const char* name() const override { return "particles"; }
  void advance(State& state, double time, double dt) override;
  void saveOrLoad(StateArchive& archive) override;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::string status() const override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;
  [[nodiscard]] std::optional<Imbalance> imbalance() const override;
  void fields(const State& state, const FieldSink& sink) const override;

  // Of a cell, in the order of the model.
  [[nodiscard]] std::span<double> densities(State& state, int cell) const;
  [[nodiscard]] std::span<const double> densities(const State& state, int cell) const;

 private:
  [[nodiscard]] double viscosityOf(const State& state, int cell) const;
  void solve(double time, double dt, std::span<const double> in, std::span<double> out) const;
  void unpack(State& state, int cell, std::span<const double> in, std::span<const double> out);
  void setDiffusivities(State& state, int cell, double viscosity);

  const FlowContext& context_;
  CarriedModel& model_;
  std::size_t first_, scalars_;
  Options options_;
  WorkSharing sharing_;
  std::vector<double> cost_;  // s, of each owned cell's last advance
  // Since the start, on this rank.
  long steps_ = 0, limitedOxidations_ = 0;
  Imbalance imbalances_{0.0, 0.0};  // sums over the stages
  int stages_ = 0;
  // Of the last row.
  double peak_ = 0.0, limited_ = 0.0;
  std::array<double, 2> place_{};
  std::vector<double> speciesEnthalpy_, partialDensity_, concentrations_, enthalpy_, slope_;
};

}  // namespace lampblack::flow
