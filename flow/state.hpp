// The reacting flow in structure-of-arrays form: owned cells, then halo cells.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/scalar_block.hpp"

namespace lampblack::flow {

struct State {
  // `turns`: an axisymmetric flow with swirl. Fields have their sizes by fieldRegistry(). std::logic_error for two
  // blocks of one owner.
  State(const Mesh& mesh, std::size_t species, const std::vector<ScalarBlock>& carried, bool turns = false);

  int species = 0;
  int dimension = 2;
  bool swirls = false;
  bool hasEddies = false;
  int wallEnergy = -1;  // which carried scalar is the turbulent energy of the law of the wall; -1: walls are resolved
  WallLaw wallLaw = WallLaw::None;
  std::vector<ScalarRange> blocks;                                         // of carried scalars, one behind the other
  std::vector<CarriedScalar> scalars;                                      // of all blocks
  [[nodiscard]] const ScalarRange& block(const std::string& owner) const;  // std::logic_error
  [[nodiscard]] int carriedCount() const { return static_cast<int>(scalars.size()); }

  double thermodynamicPressure = 101325.0;  // Pa, uniform
  std::vector<double> velocity;             // m/s, `dimension` a cell
  std::vector<double> swirl;                // m/s, velocity about the axis, one a cell; empty where nothing swirls
  std::vector<double> pressure;             // Pa, hydrodynamic
  std::vector<double> temperature;          // K
  std::vector<double> density;              // kg/m^3, of the gas
  std::vector<double> enthalpy;             // J/kg, of the gas, formation included
  std::vector<double> Y;                    // mass fractions of the gas, `species` a cell
  std::vector<double> carried;              // per m^3, carriedCount() a cell
  std::vector<double> carriedDiffusivity;   // m^2/s, carriedCount() a cell; set by the model that owns the scalar
  std::vector<double> eddyViscosity;        // Pa s, set by the block that gives eddies; empty without: a laminar flow

  // What operators that are coupled to the transport stage did in the last sweep, as mean rates of the owned cells: the
  // transport stage takes them as sources, and they take its changes as theirs (ReactionOperator). Each adds
  // its part in Operator::endSweep(); that of the reactions stands here alone, from sweep to sweep.
  struct Balance {
    std::vector<double> reactions;  // kg/m^3/s, `species` a cell
    // kg/m^3/s, of some species, by number, a value of each a cell: what the gas gains by other means; or none.
    std::vector<std::size_t> exchangedSpecies;
    std::vector<double> exchanged;
    std::vector<double> enthalpy;  // W/m^3, of the gas
    std::vector<double> carried;   // per m^3 and s, carriedCount() a cell
    // 1/s, carriedCount() a cell, not below zero: at which each is taken beside that, in proportion to what there is at
    // the end of the step.
    std::vector<double> carriedSink;
    // Of all species in a cell; the sum is mass that the gas gains.
    void ofSpecies(std::size_t cell, std::span<double> rate) const;
    // Adds to what is exchanged. A species not seen before gets its place.
    void exchange(std::size_t cell, std::size_t species, double rate);
    void clear();  // but for the reactions
    // Per m^3 and s: what is made of a carried scalar less what is taken, where there is that much.
    [[nodiscard]] double netOfCarried(std::size_t i, std::span<const double> amounts) const {
      return carried[i] - carriedSink[i] * amounts[i];
    }
  } balance;

  // The step's start, which the first operator of a step keeps and the others read: what they change is counted from
  // there. Empty before the first step: nothing has changed yet.
  struct Start {
    std::vector<double> Y, density, enthalpy;
    double thermodynamicPressure = 0.0;  // Pa
  } start;
  void keepStart();

  // kg/s (per metre depth or radian) through each face, positive from low to high or outwards.
  std::vector<double> massFlux;

  // Fills the halo of every field that a neighbour needs.
  void updateHalo(HaloExchange& halo);

  // The thermodynamic pressure, and every field that checkpoints have. The halo of a loaded state has to be updated.
  void saveOrLoad(StateArchive& archive);
};

}  // namespace lampblack::flow
