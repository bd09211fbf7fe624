// The sections particles and trajectories of a flow deck.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "app/deck/initial_distribution.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"
#include "coupling/block_statistics.hpp"
#include "coupling/carried_particles.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"

namespace lampblack::app::flowcase {
namespace {

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

}  // namespace

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

}  // namespace lampblack::app::flowcase
