#include "app/deck/trees_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/deck/size_bins_deck.hpp"
#include "core/errors.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

void addMaterial(DeckSchema& schema, const std::string& description) {
  schema.section("particles", Presence::optional, description)
      .add(choiceKey("particles.material", {"silica"},
                     "What primaries are made of. silica: Si, O and OH from H4O4SI, which is Si(OH)4, giving back H2O "
                     "(Shekar, Smith, Kraft, Wagner 2011). Its constants are those below where they are not given; "
                     "rates of sintering and of the surface reaction "
                     "as in the input of the program MOpS.")
               .byDefault("silica"))
      .add(quantityKey("particles.density", units::density, "Density of primaries; silica: 2200 kg/m^3.")
               .optional()
               .above(0))
      .add(numberKey("particles.fractal_dimension",
                     "Fractal dimension of aggregates, for their diameter of collision; silica: 1.8.")
               .optional()
               .atLeast(1)
               .atMost(3))
      .add(quantityKey("particles.growth_rate", units::volume / units::amount / units::time,
                       "Rate constant of the surface reaction for each site; silica: 1e13 cm^3/mol/s.")
               .optional()
               .atLeast(0))
      .add(quantityKey("particles.growth_energy", units::molarEnergy, "Activation energy of the surface reaction.")
               .byDefault("0 J/mol")
               .atLeast(0))
      .add(
          numberKey("particles.smoothing",
                    "Surface that the contacts of a primary gain as it grows: 0 none, so that it rounds off, 2 as much "
                    "as keeps its shape.")
              .byDefault("1")
              .atLeast(0)
              .atMost(2))
      .add(booleanKey("particles.intra_particle",
                      "Whether pairs of OH react within particles, so that these tend to SiO2 (Shekar et al. 2011, eq. "
                      "59, bounded at zero).")
               .byDefault("true"));
}

void addProcesses(DeckSchema& schema) {
  schema
      .add(choiceKey(
               "particles.sintering.mechanism",
               {"viscous_flow", "grain_boundary", "volume_diffusion", "constant", "none"},
               "Characteristic time of sintering: A d, A d^4 T, A d^3 T, each times exp(E/T (1 - d_crit/d)); A; or "
               "no sintering.")
               .byDefault("viscous_flow"))
      .add(numberKey("particles.sintering.prefactor",
                     "The factor A in SI units: s/m, s/m^4/K, s/m^3/K or s; viscous flow of silica: 1.1e-16 s/m.")
               .byDefault("1.1e-16")
               .above(0))
      .add(quantityKey("particles.sintering.temperature", units::temperature,
                       "Activation energy E of sintering over the gas constant.")
               .byDefault("1.2e5 K")
               .atLeast(0))
      .add(quantityKey("particles.sintering.critical_diameter", units::length,
                       "Diameter d_crit below which primaries are as liquid.")
               .byDefault("4.4 nm")
               .atLeast(0))
      .add(choiceKey(
               "particles.sintering.size", {"smaller", "volume_to_surface"},
               "The size d in the law: that of the smaller of two neighbours (Shekar et al. 2011), or 6 V/S of what "
               "sinters.")
               .byDefault("smaller"))
      .add(choiceKey("particles.sintering.between", {"neighbours", "parts"},
                     "What sinters: pairs of neighbours (Shekar et al. 2011, eq. 40); or the two parts of an aggregate "
                     "that a collision joined, with the whole volume and surface of both, as the program MOpS does.")
               .byDefault("neighbours"))
      .add(numberKey("particles.sintering.tolerance",
                     "Largest relative change of a contact's surface for which a tree may wait before it is sintered.")
               .byDefault("1e-3")
               .atLeast(0)
               .atMost(0.1))
      .add(booleanKey("particles.coagulation", "Whether particles collide and stick.").byDefault("true"))
      .add(choiceKey("particles.kernel", {"transition", "free_molecular", "continuum"},
                     "Collision rates: harmonic mean of the two limits, or one of them.")
               .byDefault("transition"))
      .add(numberKey("particles.enhancement", "Factor of free-molecular collisions by van der Waals forces.")
               .byDefault("2.2")
               .above(0))
      .add(choiceKey(
               "particles.slip", {"air", "davies"},
               "Slip correction. air: 1 + 1.257 Kn, Kn that of air at the gas's temperature and pressure (Shekar et "
               "al. 2011, eqs. 37, 38); davies: Davies (1945), by the gas's mean free path.")
               .byDefault("air"))
      .add(choiceKey(
               "particles.collision_size", {"primaries", "volume_to_surface"},
               "Length that a power of the number of primaries multiplies to a diameter of collision: mean diameter "
               "of primaries (Shekar et al. 2011, eqs. 17, 18), or 6 V/S of the particle.")
               .byDefault("primaries"));
}

void addNumbers(DeckSchema& schema, const std::string& particles) {
  schema
      .add(integerKey("particles.number", "Number of numerical particles: more have less noise and cost more.")
               .byDefault(particles)
               .atLeast(8)
               .atMost(100000000))
      .add(numberKey(
               "particles.split_tolerance",
               "Largest relative change of the population in a splitting step: smaller is more accurate and slower.")
               .byDefault("0.05")
               .above(0)
               .atMost(1));
}

void addRuns(DeckSchema& schema) {
  schema
      .add(quantityKey("particles.initial.number", units::perVolume,
                       "Number of equal spheres that there are at the start; with particles.initial.units.")
               .optional()
               .above(0))
      .add(numberKey("particles.initial.units", "Units of each component in one of them: Si, O, OH of silica.")
               .list(3)
               .optional()
               .atLeast(0))
      .add(choiceKey("particles.viscosity", {"air", "transport"},
                     "Viscosity of the gas. air: Sutherland's law of air, for mechanisms without transport data; "
                     "transport: from these data.")
               .byDefault("air"))
      .add(
          quantityKey("particles.full_at", units::perVolume,
                      "Number density at which an empty sample is full first; at least the largest that there will be, "
                      "or particles are removed at random.")
              .byDefault("1e18 1/m^3")
              .above(0))
      .add(integerKey("particles.repeats", "Number of independent repeats, from which mean and confidence follow.")
               .byDefault("8")
               .atLeast(2)
               .atMost(100000))
      .add(integerKey("particles.seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0))
      .add(numberKey(
               "particles.coupling_change",
               "Steps in which gas and particles change in turn are so long that a concentration which the particles "
               "see changes by about this part of itself.")
               .byDefault("0.05")
               .above(0)
               .atMost(1));
  addSizeBinKeys(schema, "particles");
  schema
      .add(quantityKey("particles.tables_at", units::time,
                       "Times at which every particle of the first repeat is written to results.h5, with its primaries "
                       "and necks; the history has a row there. Some 1000 bytes for a particle of ten primaries.")
               .list()
               .optional()
               .atLeast(0)
               .onlyWith("reactor.type", {"constant_pressure", "constant_volume", "stirred"}))
      .add(quantityKey("particles.tables_at_place", units::length, "The same by places along a plug flow.")
               .list()
               .optional()
               .atLeast(0)
               .onlyWith("reactor.type", {"plug_flow"}));
}

bool isPlugFlow(const Deck& deck) {
  return deck.choice("reactor.type") == "plug_flow";
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
  if (const auto end = deck.optionalQuantity(last); end && all.back() > *end)
    throw deck.error(key, fmt::format("expected nothing beyond {}", last));
  return all;
}

SinteringMechanism mechanismOf(const std::string& name) {
  if (name == "viscous_flow") return SinteringMechanism::viscousFlow;
  if (name == "grain_boundary") return SinteringMechanism::grainBoundary;
  if (name == "volume_diffusion") return SinteringMechanism::volumeDiffusion;
  if (name == "constant") return SinteringMechanism::constant;
  return SinteringMechanism::none;
}

}  // namespace

void addTreeKeys(DeckSchema& schema, const std::string& description, const std::string& particles) {
  addMaterial(schema, description);
  addProcesses(schema);
  addNumbers(schema, particles);
}

void addTreeReactorKeys(DeckSchema& schema) {
  addTreeKeys(schema,
              "Particles as trees of primaries that share surface, by Monte Carlo; coupled with the gas both ways. "
              "Every repeat is a reactor of its own. The temperature has to be given.",
              "8192");
  addRuns(schema);
}

TreeOptions readTreeOptions(const Deck& deck) {
  TreeOptions options;
  TreeMaterial& m = options.material = silica();
  if (const auto density = deck.optionalQuantity("particles.density")) m.density = *density;
  if (deck.has("particles.fractal_dimension")) m.fractalDimension = deck.number("particles.fractal_dimension");
  if (const auto rate = deck.optionalQuantity("particles.growth_rate")) m.prefactor = *rate;
  m.energy = deck.quantity("particles.growth_energy");
  m.smoothing = deck.number("particles.smoothing");
  m.condenses = deck.boolean("particles.intra_particle");
  m.sintering = {mechanismOf(deck.choice("particles.sintering.mechanism")),
                 deck.number("particles.sintering.prefactor"),
                 deck.quantity("particles.sintering.temperature"),
                 deck.quantity("particles.sintering.critical_diameter"),
                 deck.choice("particles.sintering.size") == "smaller" ? SinteringLaw::Size::smaller
                                                                      : SinteringLaw::Size::volumeToSurface,
                 deck.choice("particles.sintering.between") == "neighbours" ? SinteringLaw::Between::neighbours
                                                                            : SinteringLaw::Between::parts};
  if (m.sintering.between == SinteringLaw::Between::parts && m.sintering.size == SinteringLaw::Size::smaller)
    throw deck.error("particles.sintering.size", "parts of an aggregate sinter by 'volume_to_surface'");
  options.sinteringTolerance = deck.number("particles.sintering.tolerance");
  options.coagulation = deck.boolean("particles.coagulation");
  const std::string kernel = deck.choice("particles.kernel");
  options.kernel.type = kernel == "transition"       ? CollisionKernelType::transition
                        : kernel == "free_molecular" ? CollisionKernelType::freeMolecular
                                                     : CollisionKernelType::continuum;
  options.kernel.enhancement = deck.number("particles.enhancement");
  options.kernel.slip = deck.choice("particles.slip") == "air" ? SlipLaw::air : SlipLaw::davies;
  options.size = deck.choice("particles.collision_size") == "primaries" ? CollisionSize::primaries
                                                                        : CollisionSize::volumeToSurface;
  options.particles = deck.integer<std::size_t>("particles.number");
  requireMemory(deck, "particles.number", fmt::format("a sample of {} particles", options.particles),
                1000 * static_cast<double>(options.particles));  // some ten primaries each
  options.splitTolerance = deck.number("particles.split_tolerance");
  return options;
}

TreeRequest readTrees(const Deck& deck) {
  TreeRequest request;
  TreeOptions& options = request.options = readTreeOptions(deck);
  request.viscosity = deck.choice("particles.viscosity") == "air" ? GasViscosity::air : GasViscosity::transport;
  options.fullAt = deck.quantity("particles.full_at");
  options.seed = deck.integer<std::uint64_t>("particles.seed");
  if (deck.has("particles.initial.number") != deck.has("particles.initial.units"))
    throw deck.error("particles.initial", "particles at the start need both 'number' and 'units'");
  if (const auto number = deck.optionalQuantity("particles.initial.number")) {
    const std::vector<double> units = deck.numbers("particles.initial.units");
    request.start = {{units[0], units[1], units[2]}, *number};
  }
  request.repeats = deck.integer<std::size_t>("particles.repeats");
  request.bins = readSizeBins(deck, "particles");
  request.tablesAt = readTablesAt(deck);
  if (const std::size_t tables = request.tablesAt.size(); tables > 0)
    requireMemory(deck, tablesKey(deck), fmt::format("{} tables of {} particles", tables, options.particles),
                  1000 * static_cast<double>(tables) * static_cast<double>(options.particles));
  return request;
}

}  // namespace lampblack::app
