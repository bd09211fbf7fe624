#include "app/flame1d/flame_stochastic_deck.hpp"

#include <fmt/format.h>

#include <string>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"

namespace lampblack::app {

void addStochasticKeys(DeckSchema& schema) {
  addEnsembleKeys(schema,
                  "Ensembles of particles along the flame, by repeats of independent random numbers: of soot, with the "
                  "section soot, whose PAH, surface and switches are theirs; or those of the section particles, of "
                  "which this one says where they go and how they are coupled with the gas.");
  addRepeatKeys(schema, "stochastic");
  schema
      .add(choiceKey("stochastic.coupling", {"decoupled", "two_way"},
                     "decoupled: the flame as solved with soot.model, whose exchange with the gas stands for the "
                     "ensemble's; two_way: iterated until the gas sees what the ensemble exchanges.")
               .formerly("coupled")
               .byDefault("decoupled"))
      .add(quantityKey("stochastic.start", units::length,
                       "Distance at which paths start, from the end of the domain that particles come from; absent: at "
                       "that end.")
               .optional()
               .atLeast(0))
      .add(quantityKey("stochastic.minimum_velocity", units::velocity,
                       "A path ends where the particles are slower than this, near the stagnation plane.")
               .formerly("slowest")
               .byDefault("1 mm/s")
               .above(0))
      .add(quantityKey("stochastic.heights", units::length, "Positions at which size distributions are written.")
               .list()
               .optional())
      .add(integerKey("stochastic.iterations", "Largest number of iterations between gas and ensemble.")
               .byDefault("10")
               .atLeast(1)
               .onlyWith("stochastic.coupling", {"two_way"}))
      .add(numberKey("stochastic.relaxation",
                     "Weight of the new exchange between gas and ensemble in an iteration, the rest being the old one: "
                     "smaller is steadier and slower.")
               .byDefault("0.7")
               .above(0)
               .atMost(1)
               .onlyWith("stochastic.coupling", {"two_way"}))
      .add(numberKey("stochastic.tolerance",
                     "The iteration has converged where volume fraction, temperature and the main species of growth "
                     "change relatively "
                     "by less than this.")
               .byDefault("0.01")
               .above(0)
               .onlyWith("stochastic.coupling", {"two_way"}));
  addTreeFlameKeys(schema);
}

std::optional<StochasticRequest> readStochastic(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism,
                                                double length, bool bothSides) {
  if (!hasPopulation(deck)) return std::nullopt;
  if (!deck.has("stochastic"))
    throw deck.error("particles",
                     "in a flame these need the section 'stochastic', which says where they go and how they are "
                     "coupled with the gas: 'stochastic: {coupling: decoupled}'");
  StochasticRequest request;
  request.twoWay = deck.choice("stochastic.coupling") == "two_way";
  FlameCouplingOptions& coupling = request.coupling;
  coupling.iterations = deck.integer<std::size_t>("stochastic.iterations");
  coupling.relaxation = deck.number("stochastic.relaxation");
  coupling.tolerance = deck.number("stochastic.tolerance");
  FlameEnsembleOptions& ensemble = coupling.ensemble;
  const PopulationRequest given = readFlamePopulation(deck, mechanism);
  ensemble.make = given.make;
  ensemble.repeats = given.repeats;
  ensemble.march.bins = given.bins;
  request.elements = given.elements;
  request.watched = mechanism->speciesName(given.species[given.make(0)->watchedSpecies()]);
  FlamePathOptions path;
  path.slowest = deck.quantity("stochastic.minimum_velocity");
  path.start = deck.optionalQuantity("stochastic.start");
  if (path.start && *path.start >= length)
    throw deck.error("stochastic.start", fmt::format("expected less than the flame's length of {:g} m", length));
  ensemble.paths.push_back(path);
  if (bothSides) {
    path.fromRight = true;
    if (path.start) path.start = length - *path.start;
    ensemble.paths.push_back(path);
  }
  if (deck.has("stochastic.heights")) request.heights = deck.quantities("stochastic.heights");
  for (const double z : request.heights)
    if (z < 0 || z > length)
      throw deck.error("stochastic.heights", fmt::format("{:g} m is outside the flame, 0 to {:g} m", z, length));
  return request;
}

}  // namespace lampblack::app
