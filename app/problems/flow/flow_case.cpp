#include "app/problems/flow/flow_case.hpp"

#include <fmt/format.h>

#include <array>

#include "app/deck/gas_input.hpp"
#include "app/deck/initial_distribution.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/flow_limits.hpp"
#include "app/problems/flow/given_fields.hpp"
#include "app/problems/flow/initial_flame1d.hpp"
#include "app/problems/flow/initial_flow.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"
#include "coupling/block_statistics.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/models/carried_operator.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"

namespace lampblack::app {

using namespace flowcase;

namespace {

Stream streamOf(const Deck& deck, const std::string& key, const FlowCase& flowCase) {
  const std::string name = deck.string(key);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.name == name && boundary.kind == BoundaryKind::Inlet) return {boundary.temperature, boundary.Y};
  std::string inlets;
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Inlet) inlets += (inlets.empty() ? "" : ", ") + boundary.name;
  throw deck.error(key, fmt::format("'{}' is not an inlet; the inlets are: {}", name, inlets));
}

// What is given over place, on whatever the start is otherwise.
void readInitialFields(const Deck& deck, FlowCase& flowCase) {
  const AxisNames axes = axisNames(flowCase);
  GivenFields::Names names{{"temperature", units::temperature}};
  for (const std::string& axis : axes) names["velocity_" + axis] = units::velocity;
  if (flowCase.mesh.geometry == Geometry::Axisymmetric) names["swirl_velocity"] = units::velocity;
  const GivenFields given(deck, "initial", axes, names, *flowCase.mechanism);
  InitialFields& fields = flowCase.initialFields;
  fields = {.gas = given.gas(),
            .velocity = {},
            .swirl = given.find("swirl_velocity"),
            .thermodynamicPressure = {},
            .carried = {},
            .turbulence = {}};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) fields.velocity[axis] = given.find("velocity_" + axes[axis]);
  for (const char* whole : {"initial.flame1d", "initial.flow"}) {
    if (!deck.has(whole)) continue;
    if (!fields.isEmpty() || deck.choice("initial.layer") != "none")
      throw deck.error(whole,
                       "it fills all of the mesh; expected 'layer: none' and nothing else that gives the start: no "
                       "formulas, no table, one of 'flame1d' and 'flow'");
    fields =
        std::string_view(whole) == "initial.flow" ? readInitialFlow(deck, flowCase) : readInitialFlame(deck, flowCase);
  }
  flowCase.swirls = fields.swirl || std::ranges::any_of(flowCase.boundaries, [](const BoundaryCondition& boundary) {
                      return boundary.swirl != 0.0 || boundary.varies.swirl;
                    });
  if (flowCase.swirls && flowCase.meshFile)
    throw deck.error("mesh.file",
                     "a flow that swirls needs a mesh of rectangles; expected a box, segments of 'r' and 'z'");
}

// One gas everywhere, under the fields that are given.
void readEvenStart(const Deck& deck, FlowCase& flowCase) {
  MixingLayer& layer = flowCase.initial;
  const GasVariation& gas = flowCase.initialFields.gas;
  if (!deck.has("initial.composition") && gas.moleFractions.empty())
    throw deck.error("initial", "a start without a layer needs the key 'composition'");
  std::vector<double> Y(flowCase.mechanism->numSpecies(), 0.0);
  if (deck.has("initial.composition")) {
    Y = readComposition(deck, "initial.composition", *flowCase.mechanism);
  } else {
    double T = layer.temperature;
    try {
      gas.apply({0.0, 0.0}, 0.0, Thermo(*flowCase.mechanism), T, Y);
    } catch (const InputError& error) {
      throw deck.error("initial", error.what());
    }
  }
  layer.low = layer.high = {layer.temperature, Y};
  layer.burnt = false;
  layer.hotWidth = 1.0;
}

void readInitial(const Deck& deck, FlowCase& flowCase) {
  MixingLayer& layer = flowCase.initial;
  layer.temperature = readTemperature(deck, "initial.temperature", *flowCase.mechanism, TemperatureUse::transport);
  readInitialFields(deck, flowCase);
  if (deck.choice("initial.layer") == "none") {
    readEvenStart(deck, flowCase);
    return;
  }
  for (const char* key : {"low", "high"})
    if (!deck.has(std::string("initial.") + key))
      throw deck.error("initial", fmt::format("a layer needs the key '{}'", key));
  layer.low = streamOf(deck, "initial.low", flowCase);
  layer.high = streamOf(deck, "initial.high", flowCase);
  layer.position = neededQuantity(deck, "initial", "position", "a layer");
  layer.width = neededQuantity(deck, "initial", "width", "a layer");
  layer.burnt = deck.choice("initial.layer") == "burnt";
  const std::vector<double>& along = flowCase.mesh.vertices[static_cast<std::size_t>(layer.axis)];
  const auto requireInside = [&](const char* key, double place) {
    if (flowCase.meshFile || flowCase.mesh.map) return;  // it is known later how far the mesh goes
    const double end = along.back();
    if (place < 0 || place > end)
      throw deck.error(key, fmt::format("expected a place in the domain, from 0 to {:g} m, found {:g} m", end, place));
  };
  requireInside("initial.position", layer.position);
  if (layer.burnt) return;
  layer.hotPosition = neededQuantity(deck, "initial", "hot_position", "a hot layer");
  layer.hotWidth = neededQuantity(deck, "initial", "hot_width", "a hot layer");
  requireInside("initial.hot_position", layer.hotPosition);
}

// Whether a symmetry of a box is normal to an axis somewhere. Of a file the mesh tells (flow_mesh).
bool isSymmetryAcross(const FlowCase& flowCase, std::size_t boundary, std::size_t axis) {
  if (flowCase.meshFile || flowCase.boundaries[boundary].kind != BoundaryKind::Symmetry) return false;
  const BoundaryPatch& patch = flowCase.mesh.patches[boundary];
  const bool isBent = flowCase.mesh.map && patch.axis == 1;
  return patch.leftOut >= 0 || isBent || patch.axis == static_cast<int>(axis);
}

// Gravity, which an axis or a plane of symmetry allows along it only.
void readGravity(const Deck& deck, FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase);
  for (const char* name : {"r", "x", "y", "z"}) {
    const std::string key = std::string("gravity.") + name;
    if (!deck.has(key)) continue;
    const auto axis = std::ranges::find(names, name);
    if (axis == names.end()) throw deck.error(key, axesText(names));
    const auto i = static_cast<std::size_t>(axis - names.begin());
    flowCase.gravity[i] = deck.quantity(key);
    for (std::size_t b = 0; b < flowCase.boundaries.size(); ++b)
      if (isSymmetryAcross(flowCase, b, i))
        throw deck.error(key, fmt::format("gravity would point through '{}', where the flow is symmetric",
                                          flowCase.boundaries[b].name));
  }
  flowCase.referenceDensity =
      Thermo(*flowCase.mechanism).density(flowCase.initial.low.temperature, flowCase.pressure, flowCase.initial.low.Y);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Outlet)
      flowCase.referenceDensity =
          Thermo(*flowCase.mechanism).density(boundary.temperature, flowCase.pressure, boundary.Y);
}

// The weight of all of the gas, which the pressure of a flow without outlets may hold or not.
void readDrivingForce(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("driving_acceleration")) return;
  if (deck.has("gravity")) throw deck.error("driving_acceleration", "expected no 'gravity' beside it");
  const AxisNames names = axisNames(flowCase);
  for (const BoundaryCondition& boundary : flowCase.boundaries)
    if (boundary.kind == BoundaryKind::Outlet)
      throw deck.error(
          "driving_acceleration",
          fmt::format("'{}' is an outlet, through which the pressure would fall; expected none", boundary.name));
  for (const char* name : {"x", "y", "z"}) {
    const std::string key = std::string("driving_acceleration.") + name;
    if (!deck.has(key)) continue;
    const auto axis = std::ranges::find(names, name);
    if (axis == names.end()) throw deck.error(key, axesText(names));
    const auto i = static_cast<std::size_t>(axis - names.begin());
    if (flowCase.meshFile || !flowCase.mesh.periodic[i])
      throw deck.error(key, fmt::format("expected a box whose sides along {} are periodic", name));
    flowCase.gravity[i] = deck.quantity(key);
  }
  flowCase.referenceDensity = 0.0;
}

EnsembleStatistics::Options readStatistics(const Deck& deck, FlowCase& flowCase) {
  constexpr double usualBlocks = 20.0;  // in the whole run
  const std::string section = "particles.statistics";
  EnsembleStatistics::Options options;
  options.drift = deck.number(section + ".drift");
  options.start = deck.optionalQuantity(section + ".start");
  const std::optional<double> block = deck.optionalQuantity(section + ".block");
  if (isSearched(deck)) {
    options.block = block.value_or(0.0);  // what the flow gives
    return options;
  }
  const double end = deck.quantity("time.end");
  options.block = block.value_or(end / usualBlocks);
  if (options.start && *options.start >= end)
    throw deck.error(section + ".start", fmt::format("expected less than 'time.end', {} s", end));
  // Of averages that start by themselves those blocks come first that show it.
  const double begin = options.start.value_or(static_cast<double>(leastToBeStationary) * options.block);
  if (begin + static_cast<double>(leastBlocks) * options.block > end * (1.0 + 1e-12))
    flowCase.notes.push_back(fmt::format(
        "averages of the soot cannot start before {:.4g} s: until time.end there are no {} blocks of {:.4g} "
        "s, which intervals of confidence take",
        begin, leastBlocks, options.block));
  return options;
}

void readRooms(const Deck& deck, FlowCase& flowCase, EnsembleOperator::Options& options) {
  const std::string key = "particles.number_at_edges";
  options.particles = deck.integer<std::size_t>("particles.number");
  options.particlesAtEdges = deck.integer<std::size_t>(key);
  if (options.particlesAtEdges > options.particles) throw deck.error(key, "no more than 'particles.number'");
  if (deck.has("particles.method") && deck.choice("particles.method") == "pairs") return;
  options.particlesAtEdges = 0;
  flowCase.notes.push_back(key + ": only 'particles.method: pairs' has it, here all cells have 'particles.number'");
}

void readEnsembles(const Deck& deck, FlowCase& flowCase) {
  EnsembleOperator::Options options;
  const PopulationRequest request = readCellPopulation(deck, flowCase.mechanism, flowCase.seed);
  flowCase.cellParticles =
      deck.at(particleSection, [&] { return std::make_shared<CellParticles>(*flowCase.mechanism, request.make(0)); });
  if (request.hasStart)
    flowCase.startPopulation = [make = request.make](std::uint64_t cell) { return make(cell)->pack(); };
  std::ranges::copy(request.notes, std::back_inserter(flowCase.notes));
  options.seed = flowCase.seed;
  options.bins = readSizeBins(deck, particleSection);
  options.sizes = deck.boolean("particles.size_distribution");
  const bool isTwoWay = deck.choice("particles.exchange") == "two_way";
  options.exchange = isTwoWay ? EnsembleOperator::Exchange::TwoWay : EnsembleOperator::Exchange::OneWay;
  if (isTwoWay) options.average = deck.quantity("particles.averaging_time");
  options.frozenFrom = deck.optionalQuantity("particles.frozen_gas");
  options.diffusion = deck.boolean("particles.diffusion");
  options.secondOrder = deck.choice("particles.order") == "second";
  options.shareWork = flowCase.chemistry.shareWork;
  options.sweeps = deck.integer<int>("time.sweeps");
  if (deck.has("particles.number_at_edges")) readRooms(deck, flowCase, options);
  if (deck.has("particles.statistics")) options.statistics = readStatistics(deck, flowCase);
  flowCase.ensembles = options;
}

// Scalars of a model that begins with particles, the same in every cell.
void readCarriedStart(const Deck& deck, FlowCase& flowCase) {
  if (flowCase.ensembles || !deck.has(particleSection)) return;
  constexpr const char* sootAtStart = "particles.initial";
  const InitialPopulation sizes = readInitialDistribution(deck, sootAtStart);
  if (!(sizes.number > 0.0)) return;
  if (!flowCase.carried)
    throw deck.error(sootAtStart,
                     "there is no soot that could begin with particles; expected a model as 'particles.description'");
  if (!flowCase.initialFields.carried.empty())
    throw deck.error(sootAtStart, "the particles at the start are those of 'initial.flow'; leave one of the two out");
  const auto* model = dynamic_cast<const SootModel*>(&dynamic_cast<const CarriedParticles&>(*flowCase.carried).model());
  if (model == nullptr) throw deck.error(sootAtStart, "this model cannot begin with particles");
  // As many as hold all moments, drawn anew by no seed of a deck: the scalars are the same for all.
  constexpr std::size_t many = 4096;
  RandomStream random(0, 0, 0);
  std::vector<double> densities(model->scalars().size(), 0.0);
  for (const auto& [volume, number] : initialParticles(sizes, many, InitialWeights::moments, random))
    model->addSpheres(number, volume, densities);
  for (const double density : densities)
    flowCase.initialFields.carried.emplace_back([density](const Vector3&, double) { return density; });
}

void readSoot(const Deck& deck, FlowCase& flowCase) {
  if (hasPopulation(deck)) {
    readEnsembles(deck, flowCase);
    return;
  }
  auto model = readSootModel(deck, *flowCase.mechanism);
  if (!model) {
    if (deck.has(particleSection) && deck.has("trajectories"))
      flowCase.notes.push_back("particles.description is none: the trajectories of the deck are left out");
    return;
  }
  flowCase.carried =
      std::make_shared<CarriedParticles>(*flowCase.mechanism, std::move(model), deck.boolean("particles.diffusion"));
  flowCase.carriedOptions = {flowCase.chemistry.shareWork, deck.number("particles.sectional.overflow"), tooFewSections};
}

// Of a plane mesh r and z may stand for x and y.
Vector3 readStart(const Deck& deck, const std::string& item, const FlowCase& flowCase) {
  AxisNames names = axisNames(flowCase);
  if (flowCase.mesh.geometry == Geometry::Planar && names.size() == 2 && deck.has(item + ".r")) names = {"r", "z"};
  for (const char* other : {"r", "x", "y", "z"})
    if (const std::string key = fmt::format("{}.{}", item, other);
        deck.has(key) && std::ranges::find(names, other) == names.end())
      throw deck.error(key, axesText(axisNames(flowCase)));
  Vector3 place{};
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    const std::string key = item + "." + names[axis];
    if (!deck.has(key))
      throw deck.error(item, fmt::format("a start needs the key '{}': {}", names[axis], axesText(axisNames(flowCase))));
    place[axis] = deck.quantity(key);
  }
  return place;
}

void readTrajectories(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("trajectories")) return;
  if (deck.has(particleSection) && deck.choice(descriptionKey) == "none") return;
  if (!flowCase.carried && !flowCase.ensembles)
    throw deck.error("trajectories", "trajectories need the section 'particles', which says what rides along");
  TrajectoryRequest options;
  options.make = readTrajectoryPopulation(deck, flowCase.mechanism, flowCase.seed).make;
  options.duration = deck.quantity("trajectories.duration");
  options.timeStep = deck.quantity("trajectories.time_step");
  options.bins = readSizeBins(deck, "trajectories");
  options.gasTables = deck.boolean("trajectories.gas_tables");
  if (options.timeStep > options.duration)
    throw deck.error("trajectories.time_step", "expected no more than 'duration'");
  for (std::size_t i = 0; i < deck.size("trajectories.start"); ++i)
    options.starts.push_back(readStart(deck, fmt::format("trajectories.start[{}]", i), flowCase));
  options.deck = deck;
  flowCase.trajectories = options;
}

}  // namespace

FlowCase readFlowCase(const Deck& deck) {
  FlowCase flowCase;
  flowCase.title = deck.string("title");
  flowCase.pressure = deck.quantity("pressure");
  flowCase.seed = deck.integer<std::uint64_t>("seed");
  flowCase.mechanism = readMechanism(deck);
  readMesh(deck, flowCase);
  flowCase.transport = readTransport(deck, *flowCase.mechanism);
  readBoundaries(deck, flowCase);
  readChemistry(deck, flowCase);
  readSoot(deck, flowCase);
  readTurbulenceModel(deck, flowCase);
  readInitial(deck, flowCase);
  readCarriedStart(deck, flowCase);
  readGravity(deck, flowCase);
  readDrivingForce(deck, flowCase);
  readTurbulence(deck, flowCase);
  readCombustion(deck, flowCase);
  flowCase.radiation = readRadiation(deck, *flowCase.mechanism);
  readTime(deck, flowCase);
  readOutput(deck, flowCase);
  readTrajectories(deck, flowCase);
  if (!flowCase.meshFile) {
    double cells = 1;
    for (int axis = 0; axis < flowCase.dimension; ++axis)
      cells *= static_cast<double>(flowCase.mesh.vertices[static_cast<std::size_t>(axis)].size() - 1);
    refuseExcess(deck, flowCase, cells);
  }
  return flowCase;
}

}  // namespace lampblack::app
