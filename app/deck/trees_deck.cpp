#include "app/deck/trees_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/deck/initial_distribution.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/tree_material_deck.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"
#include "io/request_limits.hpp"
#include "particles/trees/tree_population.hpp"

namespace lampblack::app {
namespace {

void addProcesses(DeckSchema& schema) {
  SectionKeys keys("particles");
  keys.number("sintering.tolerance", rules().byDefault("1e-3").atLeast(0).atMost(0.1),
              "Largest relative change of a contact's surface for which a tree may wait before it is sintered.");
  keys.choice("kernel", {"transition", "free_molecular", "continuum"},
              rules().byDefault("transition").onlyWith(ofEqualWeights()),
              "Collision rates: harmonic mean of the two limits, or one of them.");
  keys.choice("inception_kernel", {"coagulation", "free_molecular"},
              rules().byDefault("coagulation").onlyWith(ofOtherMaterials()),
              "Collision rate of two molecules that become a particle: coagulation, by the kernel of particles with "
              "their enhancement; free_molecular, without enhancement (Shekar et al. 2011, eq. 25).");
  keys.choice("collision_size", {"primaries", "volume_to_surface", "shadow"},
              rules().byDefault("primaries").byDefault("volume_to_surface", {ofSoot()}).onlyWith(ofTrees()),
              "Length that a power of the number of primaries multiplies to a diameter of collision: mean diameter of "
              "primaries (Shekar et al. 2011, eqs. 17, 18), or 6 V/S of the particle, by which a particle that has "
              "become a sphere has its diameter. shadow, with 'geometry: spheres': of the sphere with the mean shadow "
              "of the particle along three lines at right angles.");
  schema.add(keys.schema());
}

void addGeometry(DeckSchema& schema) {
  schema.add(choiceKey("particles.geometry", {"shared_surface", "spheres"},
                       "What primaries that touch are: two that share surface (Shekar et al. 2011); or overlapping "
                       "spheres with places in space, which collide on straight lines, grow on their free surface and "
                       "sinter by the approach of their centres (Lindberg et al. 2019).")
                 .byDefault("shared_surface")
                 .onlyWith(ofTrees()));
}

constexpr const char* initial = "particles.initial";

DeckKey tablesAt() {
  return quantityKey("particles.tables_at", units::time,
                     "Times at which every particle of the first repeat is written to results.h5, with its primaries "
                     "and necks; the history has a row there. Some 1000 bytes for a particle of ten primaries.")
      .list()
      .optional()
      .atLeast(0)
      .onlyWith(ofPrimaries());
}

void addClasses(DeckSchema& schema) {
  SectionKeys part("particles.classes");
  part.quantity("collision_diameter", units::length, rules().list().optional().above(0),
                "Diameters of collision between which particles are classes with averages of their own: "
                "classes_collision_diameter.csv, such as [50 nm, 200 nm] for three classes.");
  part.number("primaries", rules().list().optional().above(0),
              "Numbers of primaries between which particles are classes with averages of their own: "
              "classes_primaries.csv; a particle of as many belongs to the class above.");
  schema.add(part.schema(), ofEqualWeights());
}

// Ends of classes, rising.
std::vector<double> risingEdges(const Deck& deck, const std::string& key, std::vector<double> edges) {
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (!(edges[k] > edges[k - 1])) throw deck.error(key, "expected numbers that rise");
  return edges;
}

bool isAlong(const Deck& deck) {
  return deck.choice("problem") == "prescribed_gas";
}

// Where particles are along paths of a gas, without tables and classes, in the gas's own viscosity.
bool hasNoTables(const Deck& deck) {
  const std::string problem = deck.choice("problem");
  return problem == "flame1d" || problem == "engine";
}

bool isPlugFlow(const Deck& deck) {
  return deck.choice("problem") == "reactor" && deck.choice("reactor.type") == "plug_flow";
}

std::string tablesKey(const Deck& deck) {
  return isPlugFlow(deck) ? "particles.tables_at_place" : "particles.tables_at";
}

// Rising, each once, none beyond the end of the run.
std::vector<double> readTablesAt(const Deck& deck) {
  const std::string key = tablesKey(deck);
  const std::string last = isPlugFlow(deck) ? "reactor.length" : "time.end";
  if (!deck.has(key)) return {};
  std::vector<double> all = deck.quantities(key);
  if (all.empty()) return all;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (isAlong(deck)) return all;  // the gas says when the run ends
  if (const auto end = deck.optionalQuantity(last); end && all.back() > *end)
    throw deck.error(key, fmt::format("expected nothing beyond {}", last));
  return all;
}

}  // namespace

void addTreeKeys(DeckSchema& schema) {
  addTreeMaterialKeys(schema);
  addGeometry(schema);
  addProcesses(schema);
}

void addStartKeys(DeckSchema& schema, const std::vector<DeckCondition>& conditions) {
  schema.section(initial, Presence::defaulted, "The particles that are there at the start.", conditions);
  for (const std::string& at : {std::string(initial), std::string(initial) + "[]"}) {
    addDistribution(schema, at, Presence::optional);
    schema.add(numberKey(at + ".units",
                         "Units of each component in one of them: Si, O, OH of silica; atoms C, H of soot. With a "
                         "distribution their proportions.")
                   .list()
                   .optional()
                   .atLeast(0)
                   .onlyWith(ofTreesOrOtherMaterials()));
  }
  schema.section(std::string(initial) + "[]", Presence::defaulted,
                 "In place of the keys of `particles.initial` a list of maps, one a mode: all of them are there.");
}

void addTreeRunKeys(DeckSchema& schema) {
  addStartKeys(schema, {ofTreesOrOtherMaterials()});
  schema.add(quantityKey(
                 "particles.expected_number", units::perVolume,
                 "Expected largest number density: an empty sample is full when it first reaches this density. A value "
                 "far too large leaves the sample small and noisy, which the report says; with a value far too "
                 "small particles are removed at random, which is right in the mean.")
                 .formerly("full_at")
                 .byDefault("1e18 1/m^3")
                 .above(0)
                 .onlyWith(ofEqualWeights()));
}

void addTreeReactorKeys(DeckSchema& schema) {
  SectionKeys keys("particles");
  keys.choice("viscosity", {"air", "transport"},
              rules().byDefault("transport").byDefault("air", {ofOtherMaterials()}).onlyWith(ofEqualWeights()),
              "Viscosity of the gas. air: Sutherland's law of air, for mechanisms without transport data; transport: "
              "from these data.");
  keys.add(tablesAt().onlyWith("reactor.type", {"constant_pressure", "constant_volume", "stirred"}));
  keys.quantity("tables_at_place", units::length,
                rules().list().optional().atLeast(0).onlyWith("reactor.type", {"plug_flow"}).onlyWith(ofPrimaries()),
                "The same by places along a plug flow.");
  addTreeRunKeys(keys.schema());
  addClasses(keys.schema());
  schema.add(keys.schema());
}

void addTreePrescribedGasKeys(DeckSchema& schema) {
  schema.add(tablesAt());
  addTreeRunKeys(schema);
  addClasses(schema);
}

CollisionKernelOptions readCollisions(const Deck& deck) {
  CollisionKernelOptions options;
  const std::string kernel = deck.choice("particles.kernel");
  options.type = kernel == "transition"       ? CollisionKernelType::transition
                 : kernel == "free_molecular" ? CollisionKernelType::freeMolecular
                                              : CollisionKernelType::continuum;
  options.enhancement = deck.number("particles.van_der_waals");
  options.slip = deck.choice("particles.slip") == "air" ? SlipLaw::air : SlipLaw::davies;
  return options;
}

namespace {

CollisionSize readCollisionSize(const Deck& deck, TreeShape shape) {
  const std::string name = deck.choice("particles.collision_size");
  if (name != "shadow") return name == "primaries" ? CollisionSize::primaries : CollisionSize::volumeToSurface;
  if (shape != TreeShape::spheres)
    throw deck.error("particles.collision_size", "only particles with 'geometry: spheres' have a shadow");
  return CollisionSize::shadow;
}

// What the law of sintering of spheres in space does not have.
void requireSpheres(const Deck& deck, const SinteringLaw& law) {
  if (law.between == SinteringLaw::Between::parts)
    throw deck.error("particles.sintering.between", "with 'geometry: spheres' sinter 'neighbours'");
  if (law.size != SinteringLaw::Size::smaller)
    throw deck.error("particles.sintering.size", "with 'geometry: spheres' the size is that of the 'smaller'");
}

}  // namespace

TreeOptions readTreeOptions(const Deck& deck, const Mechanism& mechanism) {
  TreeOptions options;
  options.material = readTreeMaterial(deck, mechanism);
  const SootReactions* soot = options.material.soot();
  options.sinteringTolerance = deck.number("particles.sintering.tolerance");
  options.coagulation = deck.boolean("particles.coagulation");
  if (deck.choice(descriptionKey) == "ensemble") options.shape = TreeShape::surfaceVolume;
  if (deck.has("particles.geometry") && deck.choice("particles.geometry") == "spheres") {
    options.shape = TreeShape::spheres;
    requireSpheres(deck, options.material.sintering);
  }
  options.kernel = readCollisions(deck);
  if (soot == nullptr)
    options.material.siteReactions().freeMolecularInception =
        deck.choice("particles.inception_kernel") == "free_molecular";
  options.size = readCollisionSize(deck, options.shape);
  options.particles = readSampleNumber(deck, "particles", 1000);  // some ten primaries each
  options.splitTolerance = deck.number("particles.split_tolerance");
  return options;
}

namespace {

TreeStart readStart(const Deck& deck, const std::string& at, const TreeMaterial& material) {
  TreeStart start;
  const bool hasSizes = deck.has(at + ".distribution");
  if (!deck.has(at + ".units") || (!hasSizes && !deck.has(at + ".number")))
    throw deck.error(
        at, fmt::format("particles at the start need both '{}' and 'units'", hasSizes ? "distribution" : "number"));
  if (hasSizes)
    start.sizes = readDistribution(deck, at);
  else
    start.number = deck.quantity(at + ".number");
  const std::vector<double> units = deck.numbers(at + ".units");
  if (units.size() != material.components.size())
    throw deck.error(at + ".units", fmt::format("{} numbers for {} components of {}", units.size(),
                                                material.components.size(), material.name));
  std::copy(units.begin(), units.end(), start.units.begin());
  return start;
}

// Trees have equal weights: a wide distribution may have its higher moments in fewer than one of them.
void warnOfMisses(const TreeOptions& options, const std::vector<TreeStart>& starts) {
  const TreeMaterial& material = options.material;
  std::vector<InitialPopulation> modes;
  for (const TreeStart& start : starts)
    modes.push_back(start.sizes.number > 0 ? start.sizes
                                           : InitialPopulation{InitialPopulation::Distribution::monodisperse,
                                                               start.number, material.volume(start.units)});
  const auto population = std::make_unique<TreePopulation>(options);
  population->fill(starts);
  std::array<double, 4> moments{};
  population->forEachTree([&](const Tree& tree, double weight) {
    const double volume = material.volume(tree.head().units);
    for (double& moment : moments) {
      moment += weight;
      weight *= volume;
    }
  });
  if (const std::string missed = missedMoments(sumOf(modes), moments); !missed.empty())
    printWarnings({fmt::format(
        "particles.initial: the {} numerical particles of the first sample miss what a few large ones hold: {} times "
        "that of the initial distribution, and the intervals of the results do not know of it; take more of them",
        options.particles, missed)});
}

}  // namespace

std::vector<TreeStart> readTreeStart(const Deck& deck, const TreeOptions& options) {
  std::vector<TreeStart> starts;
  for (const std::string& at : itemsOf(deck, initial)) {
    const bool hasSizes = deck.has(at + ".distribution");
    if (hasSizes && deck.choice(at + ".distribution") == "none") continue;
    if (!hasSizes && !deck.has(at + ".number") && !deck.has(at + ".units") && !at.ends_with(']')) continue;
    starts.push_back(readStart(deck, at, options.material));
  }
  if (!starts.empty()) deck.at("particles", [&] { warnOfMisses(options, starts); });
  return starts;
}

PopulationRun readPopulationRun(const Deck& deck, bool isSoot, std::size_t particles) {
  PopulationRun run;
  run.repeats = deck.integer<std::size_t>("particles.repeats");
  run.bins = readSizeBins(deck, "particles");
  if (hasNoTables(deck)) return run;
  const bool isAir = isAlong(deck)
                         ? deck.optionalString("gas.viscosity").value_or(isSoot ? "transport" : "air") == "air"
                         : deck.choice("particles.viscosity") == "air";
  run.viscosity = isAir ? GasViscosity::air : GasViscosity::transport;
  run.tablesAt = readTablesAt(deck);
  if (const std::string key = "particles.classes.collision_diameter"; deck.has(key))
    run.classesByDiameter = risingEdges(deck, key, deck.quantities(key));
  if (const std::string key = "particles.classes.primaries"; deck.has(key))
    run.classesByPrimaries = risingEdges(deck, key, deck.numbers(key));
  if (const std::size_t tables = run.tablesAt.size(); tables > 0)
    requireMemory(deck, tablesKey(deck), fmt::format("{} tables of {} particles", tables, particles),
                  1000 * static_cast<double>(tables) * static_cast<double>(particles));
  return run;
}

TreeRequest readTrees(const Deck& deck, const Mechanism& mechanism) {
  TreeRequest request;
  TreeOptions& options = request.options = readTreeOptions(deck, mechanism);
  options.fullAt = deck.quantity("particles.expected_number");
  options.seed = deck.integer<std::uint64_t>("particles.seed");
  request.start = readTreeStart(deck, options);
  static_cast<PopulationRun&>(request) = readPopulationRun(deck, options.material.soot() != nullptr, options.particles);
  return request;
}

}  // namespace lampblack::app
