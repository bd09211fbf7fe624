#include "app/deck/population_deck.hpp"

#include <fmt/format.h>

#include <array>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/initial_distribution.hpp"
#include "app/deck/molecules_deck.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "io/request_limits.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/molecules/molecule_ensemble.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/trees/tree_ensemble.hpp"

namespace lampblack::app {
namespace {

using MechanismOfDeck = std::shared_ptr<const Mechanism>;

// Of one trajectory, as a rank has one at a time; `bytes` of a particle.
std::size_t readTravellers(const Deck& deck, double bytes) {
  const int particles = deck.integer<int>("trajectories.particles");
  requireMemory(deck, "trajectories.particles", fmt::format("an ensemble of {} particles", particles),
                bytes * particles);
  return static_cast<std::size_t>(particles);
}

void addRun(const PopulationRun& run, PopulationRequest& request) {
  request.repeats = run.repeats;
  request.bins = run.bins;
  request.viscosity = run.viscosity;
  request.tablesAt = run.tablesAt;
  if (!run.classesByDiameter.empty()) request.classes.push_back({0, run.classesByDiameter});
  if (!run.classesByPrimaries.empty()) request.classes.push_back({1, run.classesByPrimaries});
}

// Trees of primaries, and other materials by volume and surface.

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

PopulationRequest readTreePopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  const TreeRequest trees = readTrees(deck, *mechanism);
  PopulationRequest request = ofTrees(mechanism, trees.options, trees.start);
  addRun(trees, request);
  return request;
}

PopulationRequest readTreesInCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  TreeOptions options = readTreeOptions(deck, *mechanism);
  options.seed = seed;
  const std::vector<TreeStart> start = readTreeStart(deck, options);
  options.fullAt = deck.quantity("particles.minimum_number_density");
  return ofTrees(mechanism, options, start);
}

// As in the cells.
PopulationRequest readTreesOnTrajectory(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  TreeOptions options = readTreeOptions(deck, *mechanism);
  options.seed = seed;
  options.fullAt = deck.quantity("particles.minimum_number_density");
  options.particles = readTravellers(deck, 1000);
  options.splitTolerance = deck.number("trajectories.split_tolerance");
  return ofTrees(mechanism, options, readTreeStart(deck, options));
}

// Ensembles of soot.

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

PopulationRequest readSootPopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  const EnsembleRequest ensembles = readEnsemble(deck, readSootModelOptions(deck, *mechanism));
  PopulationRequest request = ofSoot(mechanism, ensembles.soot, {});
  request.repeats = ensembles.repeats;
  request.bins = ensembles.bins;
  return request;
}

// A sample of equal numbers may miss what a few large particles hold.
void noteMisses(const Deck& deck, const EnsembleOptions& options, const InitialPopulation& start,
                PopulationRequest& request) {
  const auto sample = deck.at(particleSection, [&] { return request.make(0); });
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
        "particles.initial: the numerical particles of a cell miss what a few large ones hold: {} times that of the "
        "distribution; take more of them, or 'particles.method: sammc'",
        missed));
}

PopulationRequest readSootInCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  EnsembleOptions options = readEnsemble(deck, readSootModelOptions(deck, *mechanism, {})).soot;
  options.seed = seed;
  options.leastNumberDensity = options.startNumberDensity = deck.quantity("particles.minimum_number_density");
  options.bundledGrowth = deck.number("particles.bundled_growth");
  const InitialPopulation start = readInitialDistribution(deck, "particles.initial");
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

// Molecules.

PopulationRequest ofMoleculeOptions(const MechanismOfDeck& mechanism, const MoleculeOptions& options) {
  PopulationRequest request;
  request.make = [mechanism, options](std::uint64_t owner) {
    MoleculeOptions own = options;
    own.owner = owner;
    return std::make_unique<MoleculeEnsemble>(*mechanism, own);
  };
  request.hasStart = options.atStart > 0;
  return request;
}

PopulationRequest readMoleculePopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  MoleculeOptions options = readMoleculeOptions(deck, *mechanism);
  options.fullAt = deck.quantity("particles.expected_number");
  options.seed = deck.integer<std::uint64_t>("particles.seed");
  PopulationRequest request = ofMoleculeOptions(mechanism, options);
  addRun(readPopulationRun(deck, true, options.particles), request);
  return request;
}

MoleculeOptions inCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  MoleculeOptions options = readMoleculeOptions(deck, *mechanism);
  options.seed = seed;
  options.fullAt = deck.quantity("particles.minimum_number_density");
  return options;
}

PopulationRequest readMoleculesInCells(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  return ofMoleculeOptions(mechanism, inCells(deck, mechanism, seed));
}

// As in the cells.
PopulationRequest readMoleculesOnTrajectory(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  MoleculeOptions options = inCells(deck, mechanism, seed);
  options.particles = readTravellers(deck, 10000);
  options.splitTolerance = deck.number("trajectories.split_tolerance");
  return ofMoleculeOptions(mechanism, options);
}

struct KindOfPopulation {
  PopulationRequest (*read)(const Deck& deck, const MechanismOfDeck& mechanism);
  PopulationRequest (*readInCells)(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed);
  PopulationRequest (*readOnTrajectory)(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed);
};
constexpr KindOfPopulation treeKind{readTreePopulation, readTreesInCells, readTreesOnTrajectory},
    moleculeKind{readMoleculePopulation, readMoleculesInCells, readMoleculesOnTrajectory},
    sootKind{readSootPopulation, readSootInCells, readSootOnTrajectory};

const KindOfPopulation& kindOf(const Deck& deck) {
  requireDescription(deck);
  return isOfTrees(deck) ? treeKind : isOfMolecules(deck) ? moleculeKind : sootKind;
}

// Of one that is made, which finds what it lacks.
PopulationRequest described(const Deck& deck, const char* section, PopulationRequest request) {
  deck.at(section, [&] {
    const auto trial = request.make(0);
    request.material = trial->material();
    request.elements = trial->elements();
    request.species = trial->species();
  });
  return request;
}

}  // namespace

PopulationRequest readPopulation(const Deck& deck, const MechanismOfDeck& mechanism) {
  return described(deck, particleSection, kindOf(deck).read(deck, mechanism));
}

PopulationRequest readTrajectoryPopulation(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  return described(deck, "trajectories", kindOf(deck).readOnTrajectory(deck, mechanism, seed));
}

PopulationRequest readCellPopulation(const Deck& deck, const MechanismOfDeck& mechanism, std::uint64_t seed) {
  return kindOf(deck).readInCells(deck, mechanism, seed);
}

}  // namespace lampblack::app
