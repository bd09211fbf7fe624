// What transport tells: what goes through the boundary in a step, its columns of the history, its fields, checkpoints,
// the longest step that it can take, and what a cell costs.
#include <algorithm>
#include <cmath>

#include "flow/stepping/time_step.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::flow {

void TransportOperator::recordBoundary(const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const int scalars = state.carriedCount();
  boundary_ = {std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(scalars, 0.0),
               std::vector<double>(scalars, 0.0)};
  boundary_.time = dt;
  std::ranges::fill(boundaryFlows_, 0.0);
  const auto book = [dt](double outward, double& in, double& out) {
    (outward < 0.0 ? in : out) += dt * std::abs(outward);
  };
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    faces_.massFractions(face, state.massFlux[face], row_);
    const double* diffuses = &boundaryFlux_[static_cast<std::size_t>(face - m.interiorFaces) * n];
    double* flows = &boundaryFlows_[3 * static_cast<std::size_t>(m.patch[face - m.interiorFaces])];
    for (int k = 0; k < n; ++k) {
      const double outward = state.massFlux[face] * row_[k] + diffuses[k];
      book(outward, boundary_.speciesIn[k], boundary_.speciesOut[k]);
      flows[0] -= outward;
    }
    for (int s = 0; s < scalars; ++s)
      book(carried_.flux()[static_cast<std::size_t>(face) * scalars + s], boundary_.carriedIn[s],
           boundary_.carriedOut[s]);
    const double enthalpy = state.massFlux[face] * faces_.enthalpy[face] + heat_.enthalpy[face] + heat_.heat[face];
    book(enthalpy, boundary_.enthalpyIn, boundary_.enthalpyOut);
    flows[1] -= enthalpy;
    flows[2] -= heat_.heat[face];
  }
}

void TransportOperator::saveOrLoad(StateArchive& archive) {
  properties_.saveOrLoad(context_, archive, heat_.heat);
  std::vector<double> seen{diagnostics_.continuityError, static_cast<double>(diagnostics_.pressureIterations),
                           static_cast<double>(diagnostics_.speciesIterations), lastStep_};
  archive.sums("boundary_flows", boundaryFlows_);
  archive.shared("transport_diagnostics", seen);
  diagnostics_ = {seen.at(0), static_cast<int>(seen.at(1)), static_cast<int>(seen.at(2))};
  lastStep_ = seen.at(3);
  if (archive.loading()) sweep_ = 0;  // of a step that was broken off
  if (movesForOthers_) {
    archive.faces("face_density", carried_.faceDensity(), 1);
    archive.faces("drift_flux", carried_.driftFlux(), 1);
    archive.cells("mean_molecular_weight", properties_.molecularWeight, 1);
    if (archive.loading()) {
      context_.halo.update(properties_.viscosity, 1);
      context_.halo.update(properties_.molecularWeight, 1);
    }
  }
  momentum_.saveOrLoad(archive);
  expansion_.saveOrLoad(archive);
}

double TransportOperator::pressureDrift(const State& state) {
  double largest = 0.0;
  for (const double drift : expansion_.pressureDrift(state)) largest = std::max(largest, std::abs(drift));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  return largest;
}

std::vector<Quantity> TransportOperator::historyColumns() const {
  return {{"pressure_drift", "1", "largest |p_eos - p0| / p0 at the end of the step, reactions and particles included"},
          {"thermodynamic_pressure", "Pa", "uniform part of the pressure, which changes in a closed vessel"},
          {"continuity_error", "1/s", "largest error of the projected velocity's divergence"},
          {"pressure_iterations", "1", "of the pressure solve"},
          {"species_iterations", "1", "of the implicit species diffusion"},
          {"kinetic_energy", integralUnit(context_.mesh, "J"), "integral of half the density times velocity squared"},
          {"enstrophy", integralUnit(context_.mesh, "kg/s^2"), "integral of half the density times vorticity squared"}};
}

std::vector<double> TransportOperator::historyValues(const State& state) {
  const Integrals whole = integrals(state);
  return {pressureDrift(state),
          state.thermodynamicPressure,
          diagnostics_.continuityError,
          static_cast<double>(diagnostics_.pressureIterations),
          static_cast<double>(diagnostics_.speciesIterations),
          whole.kineticEnergy,
          whole.enstrophy};
}

void TransportOperator::fields(const State&, const FieldSink& sink) const {
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  sink({"viscosity", "Pa s", "dynamic viscosity"}, {properties_.viscosity.data(), owned});
  sink({"conductivity", "W/m/K", "thermal conductivity"}, {properties_.conductivity.data(), owned});
}

// The same for each cell, fitted to gases of 9 and 47 species.
void TransportOperator::addCost(const Mesh&, CellCost& cost) const {
  const double cell = options_.sweeps * (8.8 + 0.3 * static_cast<double>(context_.mechanism.numSpecies()));
  for (double& own : cost.own) own += cell;
}

double TransportOperator::largestStep(const State& state) {
  return convectiveTimeStep(context_.mesh, state, options_.courant);
}

}  // namespace lampblack::flow
