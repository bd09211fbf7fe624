#include "app/deck/ensemble_deck.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "app/deck/size_bins_deck.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {

void addEnsembleKeys(DeckSchema& schema, const std::string& description, const std::string& method,
                     const std::string& particles) {
  schema.section("stochastic", Presence::optional, description)
      .add(choiceKey("stochastic.method", {"dsmc", "sammc", "swa", "pairs"},
                     "Monte Carlo method. dsmc: particles of equal weight, doubled when few, reduced when many; sammc: "
                     "particles of different weight, the nearest neighbours in size are merged; swa: stochastic "
                     "weighted algorithm, weights that conserve mass; pairs: as sammc, with pairs drawn in time steps.")
               .byDefault(method))
      .add(integerKey("stochastic.particles",
                      "Number of numerical particles of an ensemble: more have less noise and cost more.")
               .byDefault(particles)
               .atLeast(8))
      .add(choiceKey(
               "stochastic.shape", {"spheres", "aggregates", "surface_volume"},
               "spheres: particles coalesce when they coagulate; aggregates: their primary particles stay and touch; "
               "surface_volume: by volume and surface, which coagulation adds up and growth makes rounder (Patterson, "
               "Kraft 2007).")
               .byDefault("spheres"))
      .add(numberKey("stochastic.fractal_dimension",
                     "Fractal dimension in the diameter of collision, d_p n_p^(1/D_f) of n_p primaries of d_p = 6V/S. "
                     "Absent: mean of the diameters of the spheres of the particle's volume and of its surface.")
               .optional()
               .atLeast(1)
               .atMost(3)
               .onlyWith("stochastic.shape", {"surface_volume"}))
      .add(choiceKey("stochastic.active_sites", {"particle", "primary"},
                     "The mean size in the fraction alpha of active sites (Appel, Bockhorn, Frenklach 2000): carbon "
                     "atoms of the mean particle or of the mean primary particle.")
               .byDefault("particle"))
      .add(booleanKey("stochastic.keep_hydrogen",
                      "true: soot keeps the hydrogen of PAH; false: it returns to the gas as H2 when PAH become soot.")
               .byDefault("true"))
      .add(choiceKey(
               "stochastic.growth", {"mean", "events"},
               "How particles grow, take up PAH and are oxidised in a splitting step. mean: all of a size alike, by "
               "the rates; events: by whole events as often as chance has it, so that particles of few atoms differ.")
               .byDefault("mean"))
      .add(numberKey(
               "stochastic.split_tolerance",
               "Largest relative change of the population in a splitting step: smaller is more accurate and slower.")
               .byDefault("0.01")
               .above(0)
               .atMost(1));
  addSizeBinKeys(schema, "stochastic");
}

void addRepeatKeys(DeckSchema& schema) {
  schema
      .add(integerKey("stochastic.repeats",
                      "Number of independent repeats of every ensemble, from which mean and confidence follow.")
               .byDefault("8")
               .atLeast(2)
               .atMost(100000))
      .add(integerKey("stochastic.seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0));
}

void addCouplingKeys(DeckSchema& schema, const std::string& section) {
  schema
      .add(choiceKey(
               section + ".coupling", {"splitting", "predictor_corrector"},
               "How gas and particles go on together, both of second order. splitting: half a step of the gas, the "
               "particles, half a step of the gas (Strang 1968); predictor_corrector: the gas with the exchange that "
               "is expected, the particles in its mean, the difference, for species that live shorter than a step; "
               "not in networks.")
               .byDefault("splitting"))
      .add(numberKey(
               section + ".coupling_change",
               "Steps of the coupling are so long that a concentration which the particles see changes by about this "
               "part of itself, or the temperature by this part of 200 K.")
               .byDefault("0.05")
               .above(0)
               .atMost(1));
}

EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot) {
  EnsembleRequest request;
  if (deck.has("stochastic.repeats")) request.repeats = deck.integer<std::size_t>("stochastic.repeats");
  EnsembleOptions& options = request.soot;
  const std::string method = deck.choice("stochastic.method");
  options.method = method == "dsmc"    ? EnsembleMethod::dsmc
                   : method == "sammc" ? EnsembleMethod::sammc
                   : method == "swa"   ? EnsembleMethod::swa
                                       : EnsembleMethod::pairs;
  options.particles = deck.integer<std::size_t>("stochastic.particles");
  requireMemory(deck, "stochastic.particles", fmt::format("a sample of {} particles", options.particles),
                40 * static_cast<double>(options.particles));
  if (deck.has("stochastic.seed")) options.seed = deck.integer<std::uint64_t>("stochastic.seed");
  options.soot = soot;
  const std::string shape = deck.choice("stochastic.shape");
  options.shape = shape == "spheres"      ? SootShape::spheres
                  : shape == "aggregates" ? SootShape::aggregates
                                          : SootShape::surfaceVolume;
  options.fractalDimension = deck.optionalNumber("stochastic.fractal_dimension").value_or(0);
  options.alphaOfPrimaries = deck.choice("stochastic.active_sites") == "primary";
  options.keepsHydrogen = deck.boolean("stochastic.keep_hydrogen");
  options.growthByEvents = deck.choice("stochastic.growth") == "events";
  options.splitTolerance = deck.number("stochastic.split_tolerance");
  request.bins = readSizeBins(deck, "stochastic");
  if (soot.inceptionBy == InceptionBy::monomers && soot.pah.size() != 1)
    throw deck.error("soot.pah", "nuclei of monomers need one PAH, of which two molecules make a nucleus");
  if (soot.pah.empty()) throw deck.error("stochastic", "ensembles need PAH that dimerise: name them in soot.pah");
  return request;
}

}  // namespace lampblack::app
