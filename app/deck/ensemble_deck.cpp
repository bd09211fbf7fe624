#include "app/deck/ensemble_deck.hpp"

#include <string>
#include <utility>

#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"

namespace lampblack::app {

void addEnsembleKeys(DeckSchema& schema, const std::string& description, const std::string& method,
                     const std::string& number) {
  schema.section("stochastic", Presence::optional, description)
      .add(choiceKey("stochastic.method", {"dsmc", "sammc", "swa", "pairs"},
                     "Monte Carlo method. dsmc: particles of equal weight, doubled when few, reduced when many; sammc: "
                     "particles of different weight, the nearest neighbours in size are merged; swa: stochastic "
                     "weighted algorithm, weights that conserve mass; pairs: as sammc, with pairs drawn in time steps.")
               .byDefault(method))
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
      .add(choiceKey(
               "stochastic.growth", {"mean", "events"},
               "How particles grow, take up PAH and are oxidised in a splitting step. mean: all of a size alike, by "
               "the rates; events: by whole events as often as chance has it, so that particles of few atoms differ.")
               .byDefault("mean"));
  for (DeckKey& key : sootParticleKeys("stochastic")) schema.add(std::move(key));
  schema.add(sampleNumberKey("stochastic", number).formerly("particles"));
  addSplitToleranceKey(schema, "stochastic", "0.01");
  addSizeBinKeys(schema, "stochastic");
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
  options.particles = readSampleNumber(deck, "stochastic", 40);
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
