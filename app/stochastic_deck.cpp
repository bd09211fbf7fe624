#include "app/stochastic_deck.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "io/request_limits.hpp"

namespace lampblack {

namespace {

// The section and what every ensemble is told.
void addEnsembleKeys(DeckSchema& schema, const std::string& description) {
  schema.section("stochastic", Presence::optional, description)
      .add(choiceKey("stochastic.method", {"dsmc", "sammc", "swa"},
                     "Monte Carlo method. dsmc: particles of equal weight, doubled when few, reduced when many; sammc: "
                     "particles of different weight, the nearest neighbours in size are merged; swa: stochastic "
                     "weighted algorithm, weights that conserve mass.")
               .byDefault("sammc"))
      .add(integerKey("stochastic.particles",
                      "Number of numerical particles of a repeat: more have less noise and cost more.")
               .byDefault("2000")
               .atLeast(8))
      .add(integerKey("stochastic.repeats",
                      "Number of independent repeats of every ensemble, from which mean and confidence follow.")
               .byDefault("8")
               .atLeast(2)
               .atMost(100000))
      .add(integerKey("stochastic.seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0))
      .add(choiceKey(
               "stochastic.shape", {"spheres", "aggregates"},
               "spheres: particles coalesce when they coagulate; aggregates: their primary particles stay and touch.")
               .byDefault("spheres"))
      .add(choiceKey("stochastic.active_sites", {"particle", "primary"},
                     "The mean size in the fraction alpha of active sites (Appel, Bockhorn, Frenklach 2000): carbon "
                     "atoms of the mean particle or of the mean primary particle.")
               .byDefault("particle"))
      .add(booleanKey("stochastic.keep_hydrogen",
                      "true: soot keeps the hydrogen of PAH; false: it returns to the gas as H2 when PAH become soot.")
               .byDefault("true"))
      .add(numberKey(
               "stochastic.split_tolerance",
               "Largest relative change of the population in a splitting step: smaller is more accurate and slower.")
               .byDefault("0.01")
               .above(0)
               .atMost(1))
      .add(integerKey("stochastic.bins", "Number of bins of the size distribution.")
               .byDefault("60")
               .atLeast(2)
               .atMost(10000))
      .add(quantityKey("stochastic.smallest", units::length,
                       "Smallest diameter of the size distribution, the lower end of its bins.")
               .byDefault("0.5 nm")
               .above(0))
      .add(quantityKey("stochastic.largest", units::length,
                       "Largest diameter of the size distribution, the upper end of its bins.")
               .byDefault("500 nm")
               .above(0));
}

}  // namespace

void addReactorEnsembleKeys(DeckSchema& schema) {
  addEnsembleKeys(
      schema,
      "Ensembles of soot particles in place of soot.model, coupled with the gas both ways: every repeat is a "
      "reactor of its own. Needs the section soot, whose PAH, surface and switches are theirs.");
  schema.add(numberKey("stochastic.coupling_change",
                       "Steps in which gas and particles change in turn are so long that a concentration which the "
                       "particles see changes by about this part of itself, or the temperature by this part of 200 K.")
                 .byDefault("0.05")
                 .above(0)
                 .atMost(1));
}

void addStochasticKeys(DeckSchema& schema) {
  addEnsembleKeys(schema,
                  "Ensembles of soot particles along the flame, by repeats of independent random numbers; needs the "
                  "section soot, whose PAH, surface and switches are theirs.");
  schema
      .add(choiceKey("stochastic.coupled", {"decoupled", "two_way"},
                     "decoupled: the flame as solved with soot.model, whose exchange with the gas stands for the "
                     "ensemble's; two_way: iterated until the gas sees what the ensemble exchanges.")
               .byDefault("decoupled"))
      .add(quantityKey("stochastic.start", units::length,
                       "Distance at which paths start, from the end of the domain that particles come from; absent: at "
                       "that end.")
               .optional()
               .atLeast(0))
      .add(quantityKey("stochastic.slowest", units::velocity,
                       "A path ends where the particles are slower than this, near the stagnation plane.")
               .byDefault("1 mm/s")
               .above(0))
      .add(quantityKey("stochastic.heights", units::length, "Positions at which size distributions are written.")
               .list()
               .optional())
      .add(integerKey("stochastic.iterations", "Largest number of iterations between gas and ensemble.")
               .byDefault("10")
               .atLeast(1)
               .onlyWith("stochastic.coupled", {"two_way"}))
      .add(numberKey("stochastic.relaxation",
                     "Weight of the new exchange between gas and ensemble in an iteration, the rest being the old one: "
                     "smaller is steadier and slower.")
               .byDefault("0.7")
               .above(0)
               .atMost(1)
               .onlyWith("stochastic.coupled", {"two_way"}))
      .add(numberKey("stochastic.tolerance",
                     "The iteration has converged where volume fraction, temperature and acetylene change relatively "
                     "by less than this.")
               .byDefault("0.01")
               .above(0)
               .onlyWith("stochastic.coupled", {"two_way"}));
}

EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot) {
  EnsembleRequest request;
  request.repeats = deck.integer<std::size_t>("stochastic.repeats");
  StochasticSootOptions& options = request.soot;
  const std::string method = deck.choice("stochastic.method");
  options.method = method == "dsmc"    ? StochasticSootMethod::dsmc
                   : method == "sammc" ? StochasticSootMethod::sammc
                                       : StochasticSootMethod::swa;
  options.particles = deck.integer<std::size_t>("stochastic.particles");
  requireMemory(deck, "stochastic.particles", fmt::format("a sample of {} particles", options.particles),
                40 * static_cast<double>(options.particles));
  options.seed = deck.integer<std::uint64_t>("stochastic.seed");
  options.soot = soot;
  options.coalescing = deck.choice("stochastic.shape") == "spheres";
  options.alphaOfPrimaries = deck.choice("stochastic.active_sites") == "primary";
  options.keepsHydrogen = deck.boolean("stochastic.keep_hydrogen");
  options.splitTolerance = deck.number("stochastic.split_tolerance");
  request.bins = {std::log10(deck.quantity("stochastic.smallest")),
                  std::log10(deck.quantity("stochastic.largest")),
                  deck.integer<std::size_t>("stochastic.bins"),
                  {}};
  if (!(request.bins.logDiameterMax > request.bins.logDiameterMin))
    throw deck.error("stochastic.largest", "expected more than 'smallest'");
  if (soot.pah.empty()) throw deck.error("stochastic", "ensembles need PAH that dimerise: name them in soot.pah");
  return request;
}

std::optional<StochasticRequest> readStochastic(const Deck& deck, const SootModelOptions& soot, double length,
                                                bool bothSides) {
  if (!deck.has("stochastic")) return std::nullopt;
  StochasticRequest request;
  request.twoWay = deck.choice("stochastic.coupled") == "two_way";
  FlameCouplingOptions& coupling = request.coupling;
  coupling.iterations = deck.integer<std::size_t>("stochastic.iterations");
  coupling.relaxation = deck.number("stochastic.relaxation");
  coupling.tolerance = deck.number("stochastic.tolerance");
  FlameEnsembleOptions& ensemble = coupling.ensemble;
  const EnsembleRequest given = readEnsemble(deck, soot);
  ensemble.soot = given.soot;
  ensemble.repeats = given.repeats;
  ensemble.march = given.bins;
  FlamePathOptions path;
  path.slowest = deck.quantity("stochastic.slowest");
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

}  // namespace lampblack
