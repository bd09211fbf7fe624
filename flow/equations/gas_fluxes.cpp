#include "flow/equations/gas_fluxes.hpp"

namespace lampblack::flow {

GasFluxes::GasFluxes(const FlowContext& context, FaceState& faces, const SpeciesDiffusion& diffusion)
    : context_(context),
      faces_(faces),
      diffusion_(diffusion),
      diffuses_(context.mechanism.numSpecies()),
      enthalpies_(diffuses_.size()) {}

double GasFluxes::through(const State& state, int face, double massFlux, std::span<double> row) {
  faces_.interpolate(state, face, massFlux, row);
  diffusion_.flux(face, state.Y, diffuses_);
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = massFlux * row[k] + diffuses_[k];
  return massFlux * faces_.enthalpy[face] + ofDiffusion(state, face, diffuses_);
}

double GasFluxes::ofDiffusion(const State& state, int face, std::span<const double> species) {
  const Mesh& m = context_.mesh;
  const int low = m.low[face];
  const double T = m.high[face] >= 0 ? m.lowWeight[face] * state.temperature[low] +
                                           (1.0 - m.lowWeight[face]) * state.temperature[m.high[face]]
                                     : faces_.boundaryTemperature()[face - m.interiorFaces];
  context_.thermo.speciesEnthalpies(T, enthalpies_);
  double sum = 0.0;
  for (std::size_t k = 0; k < species.size(); ++k) sum += species[k] * enthalpies_[k];
  return sum;
}

}  // namespace lampblack::flow
