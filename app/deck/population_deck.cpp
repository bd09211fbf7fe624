#include "app/deck/population_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/initial_distribution.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "io/request_limits.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/trees/tree_ensemble.hpp"

namespace lampblack::app {
namespace {

using MechanismOfDeck = std::shared_ptr<const Mechanism>;
enum class Beside { nothing, model };

void refuseModel(const Deck& deck, const char* why) {
  if (deck.isGiven("soot.model") && deck.choice("soot.model") != "none") throw deck.error("soot.model", why);
}

// Of one trajectory, as a rank has one at a time; `bytes` of a particle.
std::size_t readTravellers(const Deck& deck, double bytes) {
  const int particles = deck.integer<int>("trajectories.particles");
  requireMemory(deck, "trajectories.particles", fmt::format("an ensemble of {} particles", particles),
                bytes * particles);
  return static_cast<std::size_t>(particles);
}

// Trees of primaries, section `particles`.

PopulationRequest ofTrees(const MechanismOfDeck& mechanism, const TreeOptions& options,
                          const std::vector<TreeStart>& start) {
  PopulationRequest request;
  request.make = [mechanism, options, start](std::uint64_t owner) {
    TreeOptions own = options;
    own.owner = owner;
    return std::make_unique<TreeEnsemble>(*mechanism, own, start);
  };
  request.hasStart = !start.empty();
  return request;
}

// What is said of soot in the section `stochastic`, which says of trees where they are.
void refuseKeysOfSoot(const Deck& deck, std::initializer_list<const char*> more = {}) {
  std::vector<const char*> keys{"method",        "number", "shape",           "fractal_dimension", "active_sites",
                                "keep_hydrogen", "growth", "split_tolerance", "bundled_growth"};
  keys.insert(keys.end(), more);
  for (const char* key : keys)
    if (const std::string full = std::string("stochastic.") + key; deck.isGiven(full))
      throw deck.error(full, "this is of soot; what trees of primaries are like is said in the section 'particles'");
}

PopulationRequest readTreePopulation(const Deck& deck, const MechanismOfDeck& mechanism, Beside beside) {
  if (beside == Beside::model)
    refuseKeysOfSoot(deck, {"repeats", "seed", "bins", "smallest", "largest"});
  else if (deck.has("stochastic"))
    throw deck.error("stochastic",
                     "particles of the section 'particles' take the place of ensembles; leave out one of the two");
  if (beside != Beside::model)
    refuseModel(deck, "trees of primaries take the place of a model: leave this out, or the section 'particles'");
  const TreeRequest trees = readTrees(deck, *mechanism);
  PopulationRequest request = ofTrees(mechanism, trees.options, trees.start);
  request.repeats = trees.repeats;
  request.bins = trees.bins;
  request.viscosity = trees.viscosity;
  request.tablesAt = trees.tablesAt;
  if (!trees.classesByDiameter.empty()) request.classes.push_back({0, trees.classesByDiameter});
  if (!trees.classesByPrimaries.empty()) request.classes.push_back({1, trees.classesByPrimaries});
  return request;
}

PopulationRequest readTreesInCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  if (!deck.has("stochastic"))
    throw deck.error("particles",
                     "in a flow these need the section 'stochastic', which says how the cells hold them: 'stochastic: "
                     "{exchange: two_way}'");
  refuseModel(deck, "trees in the cells take the place of a model: leave this out, or 'particles'");
  refuseKeysOfSoot(deck);
  TreeOptions options = readTreeOptions(deck, *mechanism);
  if (deck.has("soot") && options.material.soot() == nullptr)
    throw deck.error("soot", "the trees of 'particles' are of another material: leave this out");
  options.seed = seed;
  const std::vector<TreeStart> start = readTreeStart(deck, options);
  if (deck.has("soot") && readInitialDistribution(deck, sootAtStart).number > 0)
    throw deck.error(sootAtStart, "what trees of primaries begin with is said in 'particles.initial'; leave this out");
  options.fullAt = deck.quantity("stochastic.minimum_number_density");
  return ofTrees(mechanism, options, start);
}

// As in the cells.
PopulationRequest readTreesOnTrajectory(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  TreeOptions options = readTreeOptions(deck, *mechanism);
  options.seed = seed;
  options.fullAt = deck.quantity("stochastic.minimum_number_density");
  options.particles = readTravellers(deck, 1000);
  options.splitTolerance = deck.number("trajectories.split_tolerance");
  return ofTrees(mechanism, options, readTreeStart(deck, options));
}

// Soot as spheres or aggregates, section `stochastic`.

PopulationRequest ofSoot(const MechanismOfDeck& mechanism, const EnsembleOptions& options,
                         const InitialPopulation& start) {
  PopulationRequest request;
  request.make = [mechanism, options, start](std::uint64_t owner) {
    EnsembleOptions own = options;
    own.owner = owner;
    return std::make_unique<SootEnsemble>(*mechanism, own, start);
  };
  request.hasStart = start.number > 0;
  return request;
}

PopulationRequest readSootPopulation(const Deck& deck, const MechanismOfDeck& mechanism, Beside beside) {
  if (!deck.has("soot")) throw deck.error("stochastic", "ensembles need the section 'soot': PAH, surface, switches");
  if (beside != Beside::model)
    refuseModel(deck, "an ensemble takes the place of a model: leave this out, or the section 'stochastic'");
  const EnsembleRequest ensembles = readEnsemble(deck, readSootModelOptions(deck, *mechanism));
  PopulationRequest request = ofSoot(mechanism, ensembles.soot, {});
  request.repeats = ensembles.repeats;
  request.bins = ensembles.bins;
  return request;
}

// A sample of equal numbers may miss what a few large particles hold.
void noteMisses(const Deck& deck, const EnsembleOptions& options, const InitialPopulation& start,
                PopulationRequest& request) {
  const auto sample = deck.at("stochastic", [&] { return request.make(0); });
  std::array<double, 4> moments{};
  sample->forEachRow([&](const double* row) {
    const GivenParticle particle = particleAt(row);
    double share = particle.number;
    for (double& moment : moments) {
      moment += share;
      share *= particle.carbon / options.soot.sootDensity;
    }
  });
  if (const std::string missed = missedMoments(start, moments); !missed.empty())
    request.notes.push_back(fmt::format(
        "soot.initial: the numerical particles of a cell miss what a few large ones hold: {} times that of the "
        "distribution; take more of them, or 'stochastic.method: sammc'",
        missed));
}

PopulationRequest readSootInCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  if (!deck.has("soot"))
    throw deck.error("stochastic",
                     "ensembles need the section 'soot': PAH, surface, switches; or 'particles', of another material");
  refuseModel(deck, "ensembles in the cells take the place of a model: leave this out, or the section 'stochastic'");
  EnsembleOptions options = readEnsemble(deck, readSootModelOptions(deck, *mechanism, {})).soot;
  options.seed = seed;
  options.leastNumberDensity = options.startNumberDensity = deck.quantity("stochastic.minimum_number_density");
  options.bundledGrowth = deck.number("stochastic.bundled_growth");
  const InitialPopulation start = readInitialDistribution(deck, sootAtStart);
  PopulationRequest request = ofSoot(mechanism, options, start);
  if (request.hasStart) noteMisses(deck, options, start, request);
  return request;
}

// Spheres of equal weight, which begin with none.
PopulationRequest readSootOnTrajectory(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  EnsembleOptions options;
  options.soot = readSootModelOptions(deck, *mechanism);
  options.particles = readTravellers(deck, 40);
  options.splitTolerance = deck.number("trajectories.split_tolerance");
  options.seed = seed;
  return ofSoot(mechanism, options, {});
}

// The first section that a deck has is that of the kind: `stochastic` may stand beside another, to say how cells hold
// its particles.
struct KindOfPopulation {
  const char* section;
  PopulationRequest (*read)(const Deck& deck, const MechanismOfDeck& mechanism, Beside beside);
  PopulationRequest (*readInCells)(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed);
  PopulationRequest (*readOnTrajectory)(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed);
};
constexpr std::array kinds{KindOfPopulation{"particles", readTreePopulation, readTreesInCells, readTreesOnTrajectory},
                           KindOfPopulation{"stochastic", readSootPopulation, readSootInCells, readSootOnTrajectory}};

const KindOfPopulation* kindOf(const Deck& deck) {
  const auto* found = std::ranges::find_if(kinds, [&](const KindOfPopulation& kind) { return deck.has(kind.section); });
  return found == kinds.end() ? nullptr : found;
}

// Of one that is made, which finds what it lacks.
PopulationRequest described(const Deck& deck, const char* section, PopulationRequest request) {
  request.section = section;
  deck.at(section, [&] {
    const auto trial = request.make(0);
    request.material = trial->material();
    request.elements = trial->elements();
    request.species = trial->species();
  });
  return request;
}

}  // namespace

bool hasPopulation(const Deck& deck) {
  return kindOf(deck) != nullptr;
}

PopulationRequest readPopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  const KindOfPopulation& kind = *kindOf(deck);
  return described(deck, kind.section, kind.read(deck, mechanism, Beside::nothing));
}

PopulationRequest readFlamePopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  const KindOfPopulation& kind = *kindOf(deck);
  return described(deck, kind.section, kind.read(deck, mechanism, Beside::model));
}

PopulationRequest readTrajectoryPopulation(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  const KindOfPopulation* kind = kindOf(deck);
  const auto read = kind != nullptr ? kind->readOnTrajectory : readSootOnTrajectory;
  return described(deck, "trajectories", read(deck, mechanism, seed));
}

PopulationRequest readCellPopulation(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  const KindOfPopulation& kind = *kindOf(deck);
  PopulationRequest request = kind.readInCells(deck, mechanism, seed);
  request.section = kind.section;
  return request;
}

}  // namespace lampblack::app
