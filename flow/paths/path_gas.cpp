#include "flow/paths/path_gas.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "flow/models/carried_operator.hpp"

namespace lampblack::flow {
namespace {

void put(const ParticleGas& gas, double* out) {
  for (const double value : {gas.temperature, gas.density, gas.viscosity, gas.meanMolecularWeight}) *out++ = value;
  std::ranges::copy(gas.concentrations, out);
}

// The gas at a boundary face whose temperature or composition is given; what is not given is the cell's.
class GasAtBoundary {
 public:
  GasAtBoundary(const FlowContext& context, const State& state, const std::vector<std::size_t>& species)
      : context_(context), state_(state), species_(species), Y_(at(state.species)), X_(Y_.size()), D_(Y_.size()) {}

  ParticleGas gas(int face) {
    const int cell = context_.mesh.low[face];
    const auto n = at(state_.species);
    const double T = context_.isTemperatureGiven(face) ? context_.boundaryTemperature(face) : state_.temperature[cell];
    const std::span<const double> Y = context_.isCompositionGiven(face)
                                          ? std::span<const double>(context_.boundaryY(face))
                                          : std::span{&state_.Y[at(cell) * n], n};
    const double p = state_.thermodynamicPressure, rho = context_.thermo.density(T, p, Y);
    for (std::size_t k = 0; k < Y_.size(); ++k) Y_[k] = std::max(Y[k], 0.0);  // as of cells (GasProperties)
    context_.thermo.massToMole(Y_, X_);
    concentrations_.clear();
    for (const std::size_t k : species_)
      concentrations_.push_back(rho * Y[k] / context_.mechanism.molecularWeights()[k]);
    return {{T, p, rho, context_.transport.mixture(T, p, X_, D_).viscosity, context_.thermo.meanMolecularWeight(Y)},
            concentrations_};
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const FlowContext& context_;
  const State& state_;
  const std::vector<std::size_t>& species_;
  std::vector<double> Y_, X_, D_, concentrations_;
};

VertexField::Source gasField(const FlowContext& context, const State& state, const GasProperties& properties,
                             const std::vector<std::size_t>& species, int width) {
  const Mesh& m = context.mesh;
  VertexField::Source source;
  source.components = width;
  source.isBounded = true;
  source.values.resize(static_cast<std::size_t>(m.cells) * width);
  source.boundary.resize(static_cast<std::size_t>(m.boundaryFaces()) * width);
  collectively(m.comm, [&] {
    std::vector<double> concentrations;
    for (int c = 0; c < m.owned; ++c)
      put(gasOfCell(context, state, c, properties.viscosity[c], species, concentrations), &source.values[c * width]);
    GasAtBoundary beyond(context, state, species);
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      const bool isGiven = context.isTemperatureGiven(face) || context.isCompositionGiven(face);
      source.known.push_back(isGiven ? BoundaryData::Value : knownTemperature(context, face));
      if (isGiven) put(beyond.gas(face), &source.boundary[(face - m.interiorFaces) * width]);
    }
  });
  context.halo.update(source.values, width);
  return source;
}

}  // namespace

PathGas::PathGas(const FlowContext& context, const State& state, const GasProperties& properties,
                 const std::vector<std::size_t>& species)
    : pressure_(state.thermodynamicPressure),
      width_(fixed + static_cast<int>(species.size())),
      field_(context, gasField(context, state, properties, species, width_)) {}

void PathGas::append(const PlaceInCell& place, std::vector<double>& numbers) const {
  for (int i = 0; i < width_; ++i) numbers.push_back(field_.at(place, i));
}

ParticleGas PathGas::gasOf(std::span<const double> numbers) const {
  return {{numbers[0], pressure_, numbers[1], numbers[2], numbers[3]}, numbers.subspan(fixed)};
}

}  // namespace lampblack::flow
