#include "app/deck/ensemble_deck.hpp"

#include <string>
#include <utility>

#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

namespace {

DeckKeys<EnsembleOptions> ensembleKeys(const std::string& method) {
  using Options = EnsembleOptions;
  DeckKeys<EnsembleOptions> keys("particles");
  keys.choice("method", &Options::method,
              {{"dsmc", EnsembleMethod::dsmc},
               {"sammc", EnsembleMethod::sammc},
               {"swa", EnsembleMethod::swa},
               {"pairs", EnsembleMethod::pairs}},
              rules().byDefault(method).onlyWith(ofEnsembles()).onlyWith(ofSoot()),
              "Monte Carlo method. dsmc: particles of equal weight, doubled when few, reduced when many; sammc: "
              "particles of different weight, the nearest neighbours in size are merged; swa: stochastic weighted "
              "algorithm, weights that conserve mass; pairs: as sammc, with pairs drawn in time steps.");
  keys.choice("shape", &Options::shape,
              {{"spheres", SootShape::spheres},
               {"aggregates", SootShape::aggregates},
               {"surface_volume", SootShape::surfaceVolume}},
              rules().byDefault("spheres").byDefault("surface_volume", {ofOtherMaterials()}).onlyWith(ofEnsembles()),
              "What an ensemble knows of a particle. spheres: its volume, particles coalesce when they coagulate; "
              "aggregates: its primary particles, which stay and touch; surface_volume: volume and surface, which "
              "collisions add up, growth makes rounder (Patterson, Kraft 2007) and sintering takes to the sphere's, "
              "dS/dt = -(S - S_sphere)/tau(6V/S) (Koch, Friedlander 1990). Materials other than soot have "
              "surface_volume alone, and soot does not sinter by it.");
  keys.choice("growth_by", &Options::growthByEvents, {{"mean", false}, {"events", true}},
              rules().byDefault("mean").onlyWith(ofEnsembles()).onlyWith(ofSoot()),
              "How particles grow, take up PAH and are oxidised in a splitting step. mean: all of a size alike, by the "
              "rates; events: by whole events as often as chance has it, so that particles of few atoms differ.");
  return keys;
}

}  // namespace

void addEnsembleKeys(DeckSchema& schema, const std::string& method) {
  schema.add(ensembleKeys(method).schema());
}

EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot) {
  EnsembleRequest request;
  if (deck.has("particles.repeats")) request.repeats = deck.integer<std::size_t>("particles.repeats");
  EnsembleOptions& options = request.soot;
  ensembleKeys("dsmc").read(deck, options, particleSection);
  options.particles = readSampleNumber(deck, particleSection, 40);
  if (deck.has("particles.seed")) options.seed = deck.integer<std::uint64_t>("particles.seed");
  options.soot = soot;
  options.fractalDimension = deck.optionalNumber("particles.fractal_dimension").value_or(0);
  options.alphaOfPrimaries = deck.choice("particles.active_sites") == "primary";
  options.keepsHydrogen = deck.boolean("particles.keep_hydrogen");
  options.splitTolerance = deck.number("particles.split_tolerance");
  request.bins = readSizeBins(deck, particleSection);
  if (soot.inceptionBy == InceptionBy::monomers && soot.pah.size() != 1)
    throw deck.error("particles.pah", "nuclei of monomers need one PAH, of which two molecules make a nucleus");
  if (soot.pah.empty()) throw deck.error("particles.pah", "ensembles need PAH that dimerise");
  return request;
}

}  // namespace lampblack::app
