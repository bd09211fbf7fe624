#include "app/problems/flow/flow_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/wall_distance.hpp"
#include "flow/models/combustion/fine_structure_cells.hpp"
#include "flow/models/constant_pressure_cells.hpp"
#include "flow/steady/lighting.hpp"

namespace lampblack::app {
namespace {

std::shared_ptr<BoundaryValues> varyingValues(const Mesh& mesh, const FlowCase& flowCase, const Thermo& thermo) {
  const auto varies = [](const BoundaryCondition& boundary) { return !boundary.varies.isEmpty(); };
  if (std::ranges::none_of(flowCase.boundaries, varies)) return nullptr;
  return std::make_shared<BoundaryValues>(mesh, flowCase.boundaries, thermo);
}

std::vector<double> distancesFromWalls(const Mesh& mesh, HaloExchange& halo, const FlowCase& flowCase) {
  const TurbulenceModel* turbulence = flowCase.turbulence.model.get();
  const bool isOfModel = turbulence != nullptr && turbulence->needsWallDistance();
  if (isOfModel && flowCase.turbulence.ignoresWalls)
    return std::vector<double>(static_cast<std::size_t>(mesh.owned), std::numeric_limits<double>::infinity());
  if (!flowCase.output.wallDistance && !isOfModel) return {};
  std::vector<int> walls;
  for (std::size_t b = 0; b < flowCase.boundaries.size(); ++b)
    if (flowCase.boundaries[b].kind == BoundaryKind::Wall && !(isOfModel && flowCase.boundaries[b].slip))
      walls.push_back(static_cast<int>(b));
  return wallDistance(mesh, halo, walls);
}

// What the state carries: a row an owner.
std::vector<ScalarBlock> carriedBlocks(const FlowCase& flowCase) {
  std::vector<ScalarBlock> blocks;
  if (flowCase.ensembles) blocks.push_back({flowCase.cellParticles->material(), flowCase.cellParticles->scalars()});
  if (flowCase.carried) blocks.push_back(CarriedOperator::blockOf(*flowCase.carried, flowCase.boundaries));
  if (const TurbulenceCase& of = flowCase.turbulence; of.model)
    blocks.push_back(TurbulenceOperator::blockOf(*of.model, flowCase.boundaries, of.boundaries));
  return blocks;
}

std::unique_ptr<CellReactor> cellReactor(const FlowCase& flowCase, const Thermo& thermo,
                                         const ReactionOperator::Options& options) {
  if (flowCase.combustion && flowCase.combustion->model == CombustionOperator::Model::EddyDissipation)
    return std::make_unique<FineStructureCells>(*flowCase.mechanism, thermo, options.reactor);
  return std::make_unique<ConstantPressureCells>(*flowCase.mechanism, thermo, options.reactor);
}

// The block of the particles; none without.
ScalarRange particleBlock(const FlowCase& flowCase, const State& state) {
  if (flowCase.ensembles) return state.block(flowCase.cellParticles->material());
  return flowCase.carried ? state.block(flowCase.carried->material()) : ScalarRange{};
}

RadiationOperator::Absorption particleAbsorption(const FlowCase& flowCase) {
  if (flowCase.ensembles)
    return [&particles = *flowCase.cellParticles, exchange = flowCase.ensembles->exchange](
               double temperature, std::span<const double> amounts) {
      return EnsembleOperator::absorption(particles, exchange, temperature, amounts);
    };
  if (!flowCase.carried) return {};
  return [&model = *flowCase.carried](double temperature, std::span<const double> densities) {
    return model.absorption(temperature, densities);
  };
}

}  // namespace

FlowDomain::FlowDomain(Mesh partitioned, const FlowCase& flowCase, const Thermo& thermo, Transport& transport,
                       const ReactionOperator::Options& chemistryOptions)
    : mesh(std::move(partitioned)),
      halo(mesh),
      context{mesh,
              halo,
              *flowCase.mechanism,
              thermo,
              transport,
              flowCase.boundaries,
              flowCase.gravity,
              flowCase.referenceDensity,
              varyingValues(mesh, flowCase, thermo),
              flowCase.transport,
              distancesFromWalls(mesh, halo, flowCase),
              flowCase.turbulence.numbers},
      state(mesh, flowCase.mechanism->numSpecies(), carriedBlocks(flowCase), flowCase.swirls),
      flow(context, state, flowCase.flow),
      chemistry(context, chemistryOptions, cellReactor(flowCase, thermo, chemistryOptions)),
      undershoots(context, flowCase.flow.sweeps),
      stepControl(context, {flowCase.flow.sweeps, flowCase.time.tolerance, flowCase.time.temperatureChange,
                            flowCase.time.leastMassFraction}) {
  state.thermodynamicPressure = flowCase.pressure;
  if (context.varying) context.varying->set(0.0, 0.0);
  flow.coupleWith(chemistry);
  operators = {&flow, &chemistry};
  const ScalarRange block = particleBlock(flowCase, state);
  const auto first = static_cast<std::size_t>(block.first);
  if (flowCase.carried) {
    carried = std::make_unique<CarriedOperator>(context, *flowCase.carried, first, flowCase.carriedOptions);
    operators.push_back(carried.get());
  }
  if (flowCase.ensembles) {
    ensembles = std::make_unique<EnsembleOperator>(context, flow, flowCase.cellParticles, *flowCase.ensembles, first);
    operators.push_back(ensembles.get());
  }
  if ((carried || ensembles) && DepositionOperator::isNeeded(flowCase.boundaries)) {
    deposition = std::make_unique<DepositionOperator>(
        context, carried ? flowCase.carried->material() : flowCase.cellParticles->material());
    operators.push_back(deposition.get());
    if (carried)
      flow.watchBoundary([this, &model = *flowCase.carried](const TransportOperator::BoundaryAmounts& amounts) {
        deposition->record(amounts.time, carriedThroughFaces(model, amounts.time));
      });
    else
      ensembles->watchFaces([this](double dt, std::span<const double> gone) { deposition->record(dt, gone); });
  }
  if (flowCase.radiation.on) {
    radiation = std::make_unique<RadiationOperator>(context, flowCase.radiation.surroundings,
                                                    particleAbsorption(flowCase), block);
    operators.push_back(radiation.get());
  }
  if (flowCase.turbulence.model) {
    turbulence = std::make_unique<TurbulenceOperator>(context, state, flowCase.turbulence.model, flow.properties(),
                                                      flowCase.turbulence.options);
    operators.push_back(turbulence.get());
  }
  if (flowCase.combustion) {
    combustion = std::make_unique<CombustionOperator>(context, *flowCase.combustion, *turbulence,
                                                      [this](const State& of) { return chemistry.heatReleases(of); });
    chemistry.mixBy(*combustion);
    if (flowCase.mixesParticles) carried->mixBy(*combustion);
    operators.push_back(combustion.get());
  }
  operators.push_back(&undershoots);
  operators.push_back(&stepControl);
}

void FlowDomain::setStart(const FlowCase& flowCase) {
  collectively(mesh.comm, [&] {
    setMixingLayer(context, flowCase.initial, state);
    setInitialFields(context, flowCase.initialFields, state);
  });
  if (flowCase.initialFields.isLit && lightMixture(context, state) == 0)
    printWarnings(
        {"initial.flow.light: no cell of the earlier run has a mixture that burns to a gas 500 K hotter, so that "
         "nothing is lit; leave the key out, or start from a flow in which fuel and air have mixed"});
  collectively(mesh.comm, [&] {
    for (int c = 0; c < mesh.owned && flowCase.startPopulation; ++c)
      ensembles->initialise(state, c, flowCase.startPopulation(static_cast<std::uint64_t>(mesh.naturalCell[c])));
  });
  if (turbulence) turbulence->setStart(state, flowCase.turbulence.start, flowCase.initialFields.turbulence);
  flow.initialise(state, flowCase.time.firstStep);
}

// Of a flow that is driven, or whose boundaries change, the start tells no speed.
void FlowDomain::warnOfThinCells(const FlowCase& flowCase) const {
  const auto varies = [](const BoundaryCondition& boundary) { return boundary.varies.inTime; };
  if (!turbulence || flowCase.isDriven || std::ranges::any_of(flowCase.boundaries, varies)) return;
  const TurbulenceOperator::ThinCells thin = turbulence->thinCells(state);
  if (!(thin.share > 0.5)) return;
  printWarnings({fmt::format(
      "turbulence.model: '{}' has wall functions, which are for a y+ of the cells beside walls from 30 to 300; on "
      "{:.0f} % of the walls' area it would be below {:.3g} even at a friction velocity of a tenth of the largest "
      "speed "
      "of the start, {:.3g} m/s, and such runs often fail; the run tells at its end what y+ was; 'turbulence.walls: "
      "automatic' is for cells of any thickness",
      flowCase.turbulence.model->name(), 100.0 * thin.share, thin.mostYPlus, thin.speed)});
}

std::vector<double> FlowDomain::carriedThroughFaces(const CarriedModel& model, double dt) const {
  const std::size_t n = model.scalars().size();
  std::vector<double> unit(n, 0.0);  // kg
  for (std::size_t s = 0; s < n; ++s)
    for (const double mass : model.scalars()[s].elements) unit[s] += mass;
  std::vector<double> through;
  const ScalarRange& block = state.block(model.material());
  for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
    const std::span<const double> flux = flow.carriedFlux(block, face);
    double mass = 0.0;
    for (std::size_t s = 0; s < n; ++s) mass += unit[s] * flux[s];
    through.push_back(dt * mass);
  }
  return through;
}

void FlowDomain::adopt(const FlowCase& flowCase) {
  flow.adopt(state);
  if (combustion) combustion->endSweep(state);  // what it tells is of this state
  if (radiation) radiation->endStep(state);
  if (deposition && carried) deposition->setRate(carriedThroughFaces(*flowCase.carried, 1.0));
}

void FlowDomain::beginAnew(const FlowCase& flowCase) {
  chemistry.setRates(state, std::vector<double>(state.balance.reactions.size(), 0.0));
  flow.initialise(state, flowCase.time.firstStep);
  budget->begin(state);
}

void FlowDomain::beginBudget(const FlowCase& flowCase) {
  // Of all that is carried; what is not of particles has no mass of its own.
  const auto first = static_cast<std::size_t>(particleBlock(flowCase, state).first);
  std::vector<std::vector<double>> carriedMass(state.scalars.size(),
                                               std::vector<double>(flowCase.mechanism->numElements(), 0.0));
  const auto set = [&](std::size_t scalar, const std::vector<double>& elements) {
    carriedMass[first + scalar] = elements;
  };
  if (flowCase.carried)
    for (std::size_t s = 0; s < flowCase.carried->scalars().size(); ++s)
      set(s, flowCase.carried->scalars()[s].elements);
  if (flowCase.ensembles) {
    const auto amounts =
        EnsembleOperator::unitElements(*flowCase.mechanism, *flowCase.cellParticles, flowCase.ensembles->exchange);
    for (std::size_t i = 0; i < amounts.size(); ++i) set(i, amounts[i]);
  }
  budget = std::make_unique<Budget>(context, massAndElements(*flowCase.mechanism, carriedMass), state);
  flow.watchBoundary([this](const TransportOperator::BoundaryAmounts& amounts) { budget->addStep(amounts); });
  if (!ensembles) return;
  ensembles->watchAmounts([this, first](std::span<const double> resampled, std::span<const double> gone) {
    TransportOperator::BoundaryAmounts amounts;
    for (std::vector<double>* all : {&amounts.carriedIn, &amounts.carriedOut}) all->resize(state.scalars.size());
    std::ranges::copy(gone, amounts.carriedOut.begin() + static_cast<std::ptrdiff_t>(first));
    std::ranges::copy(resampled, amounts.carriedIn.begin() + static_cast<std::ptrdiff_t>(first));
    budget->addStep(amounts);
  });
}

}  // namespace lampblack::app
