#include "app/problems/flame/flame_stochastic_deck.hpp"

#include <fmt/format.h>

#include <string>

#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"

namespace lampblack::app {

void addStochasticKeys(DeckSchema& schema) {
  addRepeatKeys(schema);
  DeckSchema part;
  part.add(choiceKey("particles.coupling", {"decoupled", "two_way"},
                     "decoupled: the flame as solved with the model that it carries, whose exchange with the gas "
                     "stands for the ensemble's; two_way: iterated until the gas sees what the ensemble exchanges.")
               .formerly("coupled")
               .byDefault("decoupled"))
      .add(quantityKey("particles.start", units::length,
                       "Distance at which paths start, from the end of the domain that particles come from; absent: at "
                       "that end.")
               .optional()
               .atLeast(0))
      .add(quantityKey("particles.minimum_velocity", units::velocity,
                       "A path ends where the particles are slower than this, near the stagnation plane.")
               .formerly("slowest")
               .byDefault("1 mm/s")
               .above(0))
      .add(quantityKey("particles.heights", units::length, "Positions at which size distributions are written.")
               .list()
               .optional())
      .add(integerKey("particles.iterations", "Largest number of iterations between gas and ensemble.")
               .byDefault("10")
               .atLeast(1)
               .onlyWith("particles.coupling", {"two_way"}))
      .add(numberKey("particles.relaxation",
                     "Weight of the new exchange between gas and ensemble in an iteration, the rest being the old one: "
                     "smaller is steadier and slower.")
               .byDefault("0.7")
               .above(0)
               .atMost(1)
               .onlyWith("particles.coupling", {"two_way"}))
      .add(numberKey("particles.tolerance",
                     "The iteration has converged where volume fraction, temperature and the main species of growth "
                     "change relatively "
                     "by less than this.")
               .byDefault("0.01")
               .above(0)
               .onlyWith("particles.coupling", {"two_way"}));
  schema.add(part, ofPopulations());
  addTreeRunKeys(schema);
}

std::optional<StochasticRequest> readStochastic(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism,
                                                double length, bool bothSides) {
  if (!hasPopulation(deck)) return std::nullopt;
  StochasticRequest request;
  request.twoWay = deck.choice("particles.coupling") == "two_way";
  FlameCouplingOptions& coupling = request.coupling;
  coupling.iterations = deck.integer<std::size_t>("particles.iterations");
  coupling.relaxation = deck.number("particles.relaxation");
  coupling.tolerance = deck.number("particles.tolerance");
  FlameEnsembleOptions& ensemble = coupling.ensemble;
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
  if (deck.has("particles.heights")) request.heights = deck.quantities("particles.heights");
  for (const double z : request.heights)
    if (z < 0 || z > length)
      throw deck.error("particles.heights", fmt::format("{:g} m is outside the flame, 0 to {:g} m", z, length));
  return request;
}

}  // namespace lampblack::app
