#include "flow/equations/expansion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.hpp"
#include "flow/discretisation/face_fluxes.hpp"

namespace lampblack::flow {
namespace {

// Of what a step has missed, that the correction takes up: the whole would make the pressure swing where the chemistry
// changes fast.
constexpr double share = 0.1;

}  // namespace

Expansion::Expansion(const FlowContext& context)
    : context_(context),
      divergence_(static_cast<std::size_t>(context.mesh.owned), 0.0),
      correction_(divergence_),
      first_(divergence_),
      balance_(divergence_),
      gained_(divergence_),
      drift_(divergence_),
      lastDrift_(divergence_),
      heat_(divergence_),
      enthalpies_(context.mechanism.numSpecies()) {}

// Volume that comes in, m^3/s.
double Expansion::inflow() const {
  const Mesh& m = context_.mesh;
  double sum = 0.0;
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (context_.boundaryOf(face).kind == BoundaryKind::Inlet) sum += context_.boundarySpeed(face) * m.area[face];
  return sum;
}

double Expansion::ofSpecies(const State& state, const GasProperties& properties, int cell,
                            const double* species) const {
  context_.thermo.speciesEnthalpies(state.temperature[cell], enthalpies_);
  const auto molecularWeights = context_.mechanism.molecularWeights();
  double sensible = 0.0, moles = 0.0;
  for (std::size_t k = 0; k < enthalpies_.size(); ++k) {
    sensible -= enthalpies_[k] * species[k];
    moles += species[k] / molecularWeights[k];
  }
  const double mass = state.density[cell] * context_.mesh.volume[cell];
  return ofHeat(state, properties, cell, sensible) + properties.molecularWeight[cell] * moles / mass;
}

double Expansion::ofHeat(const State& state, const GasProperties& properties, int cell, double heat) const {
  const double mass = state.density[cell] * context_.mesh.volume[cell];
  return heat / (mass * properties.heatCapacity[cell] * state.temperature[cell]);
}

void Expansion::addBalance(const State& state, const GasProperties& properties, std::span<double> divergence) const {
  std::vector<double> rate(static_cast<std::size_t>(state.species));
  for (int c = 0; c < context_.mesh.owned; ++c) {
    state.balance.ofSpecies(static_cast<std::size_t>(c), rate);
    divergence[c] += context_.mesh.volume[c] * (ofSpecies(state, properties, c, rate.data()) +
                                                ofHeat(state, properties, c, state.balance.enthalpy[c]));
  }
}

void Expansion::addHeat(const State& state, const GasProperties& properties, const HeatFluxes& fluxes, double sign) {
  std::ranges::fill(heat_, 0.0);
  addFaceFluxes(context_.mesh, fluxes.enthalpy, 1, 1.0, heat_);
  addFaceFluxes(context_.mesh, fluxes.heat, 1, 1.0, heat_);
  for (int c = 0; c < context_.mesh.owned; ++c) divergence_[c] += sign * ofHeat(state, properties, c, heat_[c]);
}

void Expansion::addContents(const State& state, const GasProperties& properties, std::span<const double> contents,
                            double factor) {
  const auto n = static_cast<std::size_t>(state.species);
  for (int c = 0; c < context_.mesh.owned; ++c)
    divergence_[c] += factor * ofSpecies(state, properties, c, &contents[c * n]);
}

void Expansion::begin(const State& state, const GasProperties& properties, Sweep sweep, double dt, double lastStep) {
  pressureDrift(state);
  dt_ = dt;
  if (sweep == Sweep::Later) {
    for (std::size_t c = 0; c < divergence_.size(); ++c) divergence_[c] += drift_[c] / dt;
    return;
  }
  pressureRise_ = 0.0;
  std::ranges::fill(balance_, 0.0);
  addBalance(state, properties, balance_);
  for (std::size_t c = 0; c < divergence_.size(); ++c) {
    // What a steady state needs goes on all the time: it is in proportion to the step.
    if (lastStep > 0.0)
      correction_[c] = (correction_[c] + share * ((gained_[c] - balance_[c]) * lastStep + drift_[c])) * (dt / lastStep);
    double left = drift_[c];
    const double before = lastStep > 0.0 ? lastDrift_[c] : 0.0;
    if (sweep == Sweep::Only && left * before < 0.0)
      left = std::copysign(std::max(std::abs(left) - std::abs(before), 0.0), left);
    divergence_[c] = balance_[c] + (correction_[c] + left) / dt;
  }
  lastDrift_ = drift_;
}

void Expansion::changeReactions(const State& state, const GasProperties& properties, int cell,
                                std::span<const double> change, bool isFirstSweep) {
  const double more = context_.mesh.volume[cell] * ofSpecies(state, properties, cell, change.data());
  divergence_[cell] += more;
  if (isFirstSweep) balance_[cell] += more;
}

void Expansion::withdraw(const State& state, const GasProperties& properties, std::span<const double> species,
                         const HeatFluxes& fluxes) {
  addContents(state, properties, species, -1.0);
  addHeat(state, properties, fluxes, -1.0);
}

void Expansion::beforeDiffusion(const State& state, const GasProperties& properties, std::span<const double> contents) {
  addContents(state, properties, contents, -1.0 / dt_);
}

void Expansion::compress(const State& state, const GasProperties& properties) {
  const Mesh& m = context_.mesh;
  const auto compressibility = [&](int c) {  // 1/Pa
    const double R = constants::gasConstant / properties.molecularWeight[c];
    return (1.0 - R / properties.heatCapacity[c]) / state.thermodynamicPressure;
  };
  std::array<double, 3> sums{0.0, 0.0, inflow()};
  for (int c = 0; c < m.owned; ++c) {
    sums[0] += m.volume[c] * divergence_[c];
    sums[1] += m.volume[c] * compressibility(c);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_DOUBLE, MPI_SUM, m.comm);
  const double rate = (sums[0] + sums[2]) / sums[1];  // Pa/s
  for (int c = 0; c < m.owned; ++c) divergence_[c] -= rate * compressibility(c);
  pressureRise_ += dt_ * rate;
}

std::span<const double> Expansion::complete(const State& state, const GasProperties& properties,
                                            std::span<const double> contents, const HeatFluxes& fluxes,
                                            bool isFirstSweep) {
  addContents(state, properties, contents, 1.0 / dt_);
  addHeat(state, properties, fluxes, 1.0);
  if (context_.isClosed()) compress(state, properties);
  if (isFirstSweep) first_ = divergence_;
  for (std::size_t c = 0; c < divergence_.size(); ++c) gained_[c] = divergence_[c] - first_[c] + balance_[c];
  return divergence_;
}

std::span<const double> Expansion::initial(const State& state, const GasProperties& properties,
                                           std::span<const double> species, const HeatFluxes& fluxes) {
  std::ranges::fill(divergence_, 0.0);
  addBalance(state, properties, divergence_);
  addContents(state, properties, species, 1.0);
  addHeat(state, properties, fluxes, 1.0);
  if (context_.isClosed()) compress(state, properties);
  return divergence_;
}

void Expansion::saveOrLoad(StateArchive& archive) {
  archive.cells("expansion_correction", correction_, 1);
  archive.cells("expansion_gained", gained_, 1);
  archive.cells("expansion_drift", lastDrift_, 1);
}

std::span<const double> Expansion::pressureDrift(const State& state) {
  const auto n = static_cast<std::size_t>(state.species);
  for (int c = 0; c < context_.mesh.owned; ++c) {
    const double W = context_.thermo.meanMolecularWeight({&state.Y[c * n], n});
    const double equationOfState = state.density[c] * constants::gasConstant * state.temperature[c] / W;
    drift_[c] = equationOfState / state.thermodynamicPressure - 1.0;
  }
  return drift_;
}

}  // namespace lampblack::flow
