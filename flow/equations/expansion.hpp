// The divergence of the velocity that the equation of state demands, so that p_eos = rho R T / W stays p0.
//
// In a step's first sweep it is
//   (1/(rho cp T)) (E - sum_k h_k M_k) + sum_k (W/W_k) M_k / rho   (Day and Bell 2000)
// with E and M_k the enthalpy and mass that diffusion and State::balance bring into a cell, and what takes away the
// p_eos - p0 that the last step has left (volume discrepancy; Nonaka et al. 2012); in steps of one sweep, of what has
// changed its sign since the step before, only what is more than that was. Of heat that goes to and fro from step to
// step all taken away at once would make the velocity answer three times as much as the heat, and a cell that burns
// what comes to it, and pushes it back while it burns, go to and fro for ever. A correction is added that takes up, a
// tenth each step, what this has missed, but for what State::balance has got to know since: nothing of p_eos - p0 is
// left in a steady state. Each further sweep adds what takes away the p_eos - p0 that the last sweep has left (Pazner
// et al. 2016).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// What diffusion carries through the faces, from low to high or outwards.
struct HeatFluxes {
  std::vector<double> enthalpy;  // W, of the diffusing species
  std::vector<double> heat;      // W, conduction
};

class Expansion {
 public:
  explicit Expansion(const FlowContext& context);

  // Which of a step's sweeps.
  enum class Sweep { Only, First, Later };
  // Begins a sweep over dt: with p_eos - p0 of the state. `lastStep` (s): that before this one, 0 if there is none.
  void begin(const State& state, const GasProperties& properties, Sweep sweep, double dt, double lastStep);
  // After begin(): the reactions of State::balance in a cell have become others, by `change` (kg/m3/s).
  void changeReactions(const State& state, const GasProperties& properties, int cell, std::span<const double> change,
                       bool isFirstSweep);
  // Diffusion is about to change these contents (kg, species a owned cell) to those that complete() is given.
  void beforeDiffusion(const State& state, const GasProperties& properties, std::span<const double> contents);
  // The sweep's divergence (1/s, owned cells), with this diffusion.
  std::span<const double> complete(const State& state, const GasProperties& properties,
                                   std::span<const double> contents, const HeatFluxes& fluxes, bool isFirstSweep);
  // Rise of the thermodynamic pressure in the step, Pa: in a closed vessel what its gas needs to keep its volume,
  //   div u = ... - (1/(gamma p0)) dp0/dt,    integral of div u = what flows in.
  [[nodiscard]] double pressureRise() const { return pressureRise_; }
  // Of a diffusion and State::balance alone: it brings `species` (kg/s, species a owned cell) and what the fluxes say.
  std::span<const double> initial(const State& state, const GasProperties& properties, std::span<const double> species,
                                  const HeatFluxes& fluxes);
  // Takes the last sweep's diffusion out, before a new one's is brought in.
  void withdraw(const State& state, const GasProperties& properties, std::span<const double> species,
                const HeatFluxes& fluxes);

  // p_eos / p0 - 1 of each owned cell.
  std::span<const double> pressureDrift(const State& state);

  void saveOrLoad(StateArchive& archive);

 private:
  // 1/s, by which a cell is expanded by mass (kg/s, of each species) or heat (W) that comes into it.
  [[nodiscard]] double ofSpecies(const State& state, const GasProperties& properties, int cell,
                                 const double* species) const;
  [[nodiscard]] double ofHeat(const State& state, const GasProperties& properties, int cell, double heat) const;
  void addBalance(const State& state, const GasProperties& properties, std::span<double> divergence) const;
  void addHeat(const State& state, const GasProperties& properties, const HeatFluxes& fluxes, double sign);
  void addContents(const State& state, const GasProperties& properties, std::span<const double> contents,
                   double factor);
  // Makes the divergence of a closed vessel that of what flows in, by a rise of p0.
  [[nodiscard]] double inflow() const;
  void compress(const State& state, const GasProperties& properties);

  const FlowContext& context_;
  std::vector<double> divergence_;  // 1/s, of the sweep
  std::vector<double> correction_;  // of a step
  std::vector<double> first_;       // 1/s, divergence of the step's first sweep
  std::vector<double> balance_;     // 1/s, of that by State::balance
  std::vector<double> gained_;      // 1/s, divergence_ - first_ + balance_: what stands against the next step's balance
  std::vector<double> drift_;       // p_eos/p0 - 1
  std::vector<double> lastDrift_;   // the same at the start of the last step
  double dt_ = 0.0;                 // s, the step
  double pressureRise_ = 0.0;       // Pa
  std::vector<double> heat_;        // W, that comes into each owned cell
  mutable std::vector<double> enthalpies_;  // J/kg
};

}  // namespace lampblack::flow
