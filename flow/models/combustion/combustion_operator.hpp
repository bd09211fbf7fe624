// Reactions in turbulence: what share of them the mixing lets go, by the state at the end of each sweep. It changes
// nothing itself; the operators that react ask it (MixingModel): those of the gas always, those of particles where the
// deck says so. A steady state, in which nothing lags, does not depend on the step.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/combustion/cell_mixing.hpp"
#include "flow/models/combustion/chemical_time.hpp"
#include "flow/models/combustion/mixing_times.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

class CombustionOperator : public Operator, public MixingModel {
 public:
  enum class Model { PartiallyStirred, EddyDissipation };
  struct Options {
    Model model = Model::PartiallyStirred;
    ChemicalTime::Kind chemicalTime = ChemicalTime::Kind::WeightedReactions;
    MixingTime mixingTime = MixingTime::Effective;
    double mixingConstant = 0.3;
    // Of the eddy viscosity over that of the molecules, below which the gas reacts as it is: where turbulence dies out
    // the models would put out the flame.
    double laminarBelow = 0.1;
    FineStructures fine = {};
    bool dissipationOfShear = false;  // nu_t S^2 in place of the turbulence model's
  };
  // W/m3, of the owned cells.
  using HeatRelease = std::function<std::vector<double>(const State&)>;

  // All of it has to live as long. The model of turbulence knows its dissipation, or `dissipationOfShear` is set
  // (InputError).
  CombustionOperator(const FlowContext& context, const Options& options, const TurbulenceOperator& turbulence,
                     HeatRelease heatRelease);

  [[nodiscard]] std::span<const CellMixing> present() const override { return present_; }
  std::span<const CellMixing> of(const State& state) override;
  // By the time of the reactions.
  void slopesOfShare(const State& state, int cell, std::span<double> slopes) override;

  [[nodiscard]] const char* name() const override { return "combustion"; }
  void advance(State&, double, double) override {}
  void endSweep(State& state) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;
  void fields(const State& state, const FieldSink& sink) const override;

 private:
  // What is told of a cell.
  struct Times {
    double chemical = 0.0, mixing = 0.0;  // s
  };
  // `times`: empty where nobody asks for them.
  void find(const State& state, std::span<CellMixing> mixing, std::span<Times> times = {});
  [[nodiscard]] double damkoehler(std::size_t cell) const;
  [[nodiscard]] bool isLaminar(const Eddies& eddies) const {
    return eddies.eddyViscosity < options_.laminarBelow * eddies.viscosity;
  }

  const FlowContext& context_;
  Options options_;
  const TurbulenceOperator& turbulence_;
  HeatRelease heatRelease_;
  ChemicalTime chemicalTime_;
  std::vector<CellMixing> present_, ofState_;
  std::vector<Times> times_;
  static constexpr std::size_t told = 5;
  std::array<double, told> told_{};  // of the last row of the history
};

}  // namespace lampblack::flow
