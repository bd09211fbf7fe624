#include "app/problems/flame/flame_stochastic_deck.hpp"

#include <fmt/format.h>

#include <string>

#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

namespace {

DeckKeys<StochasticRequest> stochasticKeys() {
  using Request = StochasticRequest;
  constexpr auto coupling = [](auto member) { return inner(&Request::coupling, member); };
  DeckKeys<Request> keys("particles");
  keys.choice("coupling", &Request::twoWay, {{"decoupled", false}, {"two_way", true}},
              rules().formerly("coupled").byDefault("decoupled"),
              "decoupled: the flame as solved with the model that it carries, whose exchange with the gas stands for "
              "the ensemble's; two_way: iterated until the gas sees what the ensemble exchanges.");
  keys.quantity(
      "start", units::length, rules().optional().atLeast(0),
      "Distance at which paths start, from the end of the domain that particles come from; absent: at that end.");
  keys.quantity("minimum_velocity", units::velocity, rules().formerly("slowest").byDefault("1 mm/s").above(0),
                "A path ends where the particles are slower than this, near the stagnation plane.");
  keys.quantity("heights", units::length, &Request::heights, rules().list().optional(),
                "Positions at which size distributions are written.");
  keys.integer("iterations", coupling(&FlameCouplingOptions::iterations),
               rules().byDefault("10").atLeast(1).onlyWith("particles.coupling", {"two_way"}),
               "Largest number of iterations between gas and ensemble.");
  keys.number("relaxation", coupling(&FlameCouplingOptions::relaxation),
              rules().byDefault("0.7").above(0).atMost(1).onlyWith("particles.coupling", {"two_way"}),
              "Weight of the new exchange between gas and ensemble in an iteration, the rest being the old one: "
              "smaller is steadier and slower.");
  keys.number("tolerance", coupling(&FlameCouplingOptions::tolerance),
              rules().byDefault("0.01").above(0).onlyWith("particles.coupling", {"two_way"}),
              "The iteration has converged where volume fraction, temperature and the main species of growth change "
              "relatively by less than this.");
  return keys;
}

}  // namespace

void addStochasticKeys(DeckSchema& schema) {
  addRepeatKeys(schema);
  schema.add(stochasticKeys().schema(), ofPopulations());
  addTreeRunKeys(schema);
}

std::optional<StochasticRequest> readStochastic(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism,
                                                double length, bool bothSides) {
  if (!hasPopulation(deck)) return std::nullopt;
  StochasticRequest request = stochasticKeys().read(deck);
  FlameEnsembleOptions& ensemble = request.coupling.ensemble;
  const PopulationRequest given = readPopulation(deck, mechanism);
  ensemble.make = given.make;
  ensemble.repeats = given.repeats;
  ensemble.march.bins = given.bins;
  request.elements = given.elements;
  request.watched = mechanism->speciesName(given.species[given.make(0)->watchedSpecies()]);
  FlamePathOptions path;
  path.slowest = deck.quantity("particles.minimum_velocity");
  path.start = deck.optionalQuantity("particles.start");
  if (path.start && *path.start >= length)
    throw deck.error("particles.start", fmt::format("expected less than the flame's length of {:g} m", length));
  ensemble.paths.push_back(path);
  if (bothSides) {
    path.fromRight = true;
    if (path.start) path.start = length - *path.start;
    ensemble.paths.push_back(path);
  }
  for (const double z : request.heights)
    if (z < 0 || z > length)
      throw deck.error("particles.heights", fmt::format("{:g} m is outside the flame, 0 to {:g} m", z, length));
  return request;
}

}  // namespace lampblack::app
