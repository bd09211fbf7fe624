#include "app/deck/ensemble_deck.hpp"

#include <string>
#include <utility>

#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"

namespace lampblack::app {

void addEnsembleKeys(DeckSchema& schema, const std::string& method) {
  schema
      .add(choiceKey("particles.method", {"dsmc", "sammc", "swa", "pairs"},
                     "Monte Carlo method. dsmc: particles of equal weight, doubled when few, reduced when many; sammc: "
                     "particles of different weight, the nearest neighbours in size are merged; swa: stochastic "
                     "weighted algorithm, weights that conserve mass; pairs: as sammc, with pairs drawn in time steps.")
               .byDefault(method)
               .onlyWith(ofEnsembles())
               .onlyWith(ofSoot()))
      .add(choiceKey("particles.shape", {"spheres", "aggregates", "surface_volume"},
                     "What an ensemble knows of a particle. spheres: its volume, particles coalesce when they "
                     "coagulate; aggregates: its primary particles, which stay and touch; surface_volume: volume and "
                     "surface, which collisions add up, growth makes rounder (Patterson, Kraft 2007) and sintering "
                     "takes to the sphere's, dS/dt = -(S - S_sphere)/tau(6V/S) (Koch, Friedlander 1990). Materials "
                     "other than soot have surface_volume alone, and soot does not sinter by it.")
               .byDefault("spheres")
               .byDefault("surface_volume", {ofOtherMaterials()})
               .onlyWith(ofEnsembles()))
      .add(choiceKey(
               "particles.growth_by", {"mean", "events"},
               "How particles grow, take up PAH and are oxidised in a splitting step. mean: all of a size alike, by "
               "the rates; events: by whole events as often as chance has it, so that particles of few atoms differ.")
               .byDefault("mean")
               .onlyWith(ofEnsembles())
               .onlyWith(ofSoot()));
}

EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot) {
  EnsembleRequest request;
  if (deck.has("particles.repeats")) request.repeats = deck.integer<std::size_t>("particles.repeats");
  EnsembleOptions& options = request.soot;
  const std::string method = deck.choice("particles.method");
  options.method = method == "dsmc"    ? EnsembleMethod::dsmc
                   : method == "sammc" ? EnsembleMethod::sammc
                   : method == "swa"   ? EnsembleMethod::swa
                                       : EnsembleMethod::pairs;
  options.particles = readSampleNumber(deck, particleSection, 40);
  if (deck.has("particles.seed")) options.seed = deck.integer<std::uint64_t>("particles.seed");
  options.soot = soot;
  const std::string shape = deck.choice("particles.shape");
  options.shape = shape == "spheres"      ? SootShape::spheres
                  : shape == "aggregates" ? SootShape::aggregates
                                          : SootShape::surfaceVolume;
  options.fractalDimension = deck.optionalNumber("particles.fractal_dimension").value_or(0);
  options.alphaOfPrimaries = deck.choice("particles.active_sites") == "primary";
  options.keepsHydrogen = deck.boolean("particles.keep_hydrogen");
  options.growthByEvents = deck.choice("particles.growth_by") == "events";
  options.splitTolerance = deck.number("particles.split_tolerance");
  request.bins = readSizeBins(deck, particleSection);
  if (soot.inceptionBy == InceptionBy::monomers && soot.pah.size() != 1)
    throw deck.error("particles.pah", "nuclei of monomers need one PAH, of which two molecules make a nucleus");
  if (soot.pah.empty()) throw deck.error("particles.pah", "ensembles need PAH that dimerise");
  return request;
}

}  // namespace lampblack::app
