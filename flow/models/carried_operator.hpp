// Advances what a flow carries (State::carried) by its model, cell by cell, together with the gas it exchanges with:
// what the model takes from or gives to the gas changes the gas's species, mass and enthalpy. Cells are shared between
// the ranks as those of the chemistry are.
//
// Coupled as the chemistry is (ReactionOperator): particles and what they exchange are integrated from the step's start
// with the changes by transport and chemistry as a constant source, while State::balance held the particles' own rates
// of the last sweep. A steady state does then not depend on the step. Temperature and density of the gas are those of
// the step's end, of first order in time.
//
// Energy: gas and scalars together keep their enthalpy over a step, what was exchanged being as warm as the gas. The
// scalars' own sensible heat is not followed along their path.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/carried_model.hpp"
#include "flow/models/combustion/cell_mixing.hpp"
#include "flow/models/gas_exchange.hpp"
#include "flow/models/shared_cell_work.hpp"
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
    // Largest volume fraction in particles that cannot grow over the largest of all; more is a NumericsError of
    // checkResult(), which ends with `advice`.
    double allowedAtLimit = 1.0;
    std::string advice;
  };

  // What a State has to carry for the model, whose material owns it.
  [[nodiscard]] static ScalarBlock blockOf(const CarriedModel& model, const std::vector<BoundaryCondition>& boundaries);

  // The model's scalars stand in State::carried from `first` on.
  CarriedOperator(const FlowContext& context, CarriedModel& model, std::size_t first, Options options);

  [[nodiscard]] const char* name() const override { return "particles"; }
  void advance(State& state, double time, double dt) override;
  void endSweep(State& state) override;
  void addRates(const State& state, State::Balance& rates) override;
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State& state, const Slopes& slopes) override;
  [[nodiscard]] std::unique_ptr<CarriedInCells> carriedInCells(const State& state) override;
  void setDiffusivities(State& state) override;
  void endStep(State& state) override;
  void saveOrLoad(StateArchive& archive) override;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void checkResult() const override;
  [[nodiscard]] std::string status() const override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;
  [[nodiscard]] std::optional<Imbalance> imbalance() const override { return work_.imbalance(); }
  void beginRun() override { work_.beginRun(); }
  void fields(const State& state, const FieldSink& sink) const override;
  void addCost(const Mesh&, CellCost& cost) const override { work_.addCost(cost); }

  // How the cells are mixed: the particles change, and take from the gas, at the reacting share of their rates. Without
  // one by all of them. It has to live as long.
  void mixBy(MixingModel& mixing) { mixing_ = &mixing; }

  // Of a cell, in the order of the model.
  [[nodiscard]] std::span<double> densities(State& state, int cell) const;
  [[nodiscard]] std::span<const double> densities(const State& state, int cell) const;

 private:
  [[nodiscard]] double viscosityOf(const State& state, int cell) const;
  // The gas, and the share of the rates that goes.
  struct Input {
    CarrierGas gas;
    double share = 1.0;
  };
  struct BusyCell {
    int cell;
    double viscosity, meanMolecularWeight;
  };
  // Densities of the scalars (per m3), then concentrations of the exchanged species (mol/m3).
  void valuesOf(const State& state, int cell, std::span<double> values) const;
  // How a cell comes back from whoever advanced its particles.
  struct Result {
    double cost, steps;
  };
  // Behind the gas, and behind the result: values as valuesOf(); behind the gas's also what else brings them.
  [[nodiscard]] Input pack(const State& state, const BusyCell& busy, double dt, RowWriter rows) const;
  [[nodiscard]] Result solve(double dt, const SharedCellWork::Task<Input>& task, RowWriter rows) const;
  // Gives the cell the values `after` in place of those it has.
  void take(State& state, int cell, double dt, std::span<const double> after);
  void rest(State& state, int cell, double dt);
  void setDiffusivities(State& state, int cell, double viscosity);

  const FlowContext& context_;
  CarriedModel& model_;
  MixingModel* mixing_ = nullptr;
  std::size_t first_, scalars_;
  Options options_;
  SharedCellWork work_;
  // Of each owned cell: its values at the end of the last step; their mean rates by the particles in it, and
  // the power that these gave to the gas, W/m3.
  std::vector<double> before_, rate_, heat_;
  long steps_ = 0;  // since the start, on this rank
  // Of the last row.
  double peak_ = 0.0, partAtLimit_ = 0.0;
  Vector3 place_{};
  GasExchange exchange_;
  std::vector<double> values_, concentrations_, enthalpy_, slope_;
};

}  // namespace lampblack::flow
