// The processes of a population balance deck.
#include <algorithm>
#include <cmath>

#include "app/deck/initial_distribution.hpp"
#include "app/problems/population/population_case_parts.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::populationcase {
namespace {

const std::vector<std::string> withRate{"constant", "additive", "multiplicative"};

// A quantity whose unit depends on another key. `example` in that unit.
double readDependent(const Deck& deck, const std::string& key, const units::Dimension& dimension,
                     const std::string& who, const std::string& example) {
  const std::string text = deck.string(key);
  double value = 0;
  try {
    value = units::parseQuantity(text, dimension);
  } catch (const InputError& error) {
    throw deck.error(key, fmt::format("{} has this in {} (for instance '{}'): {}", who, units::siUnit(dimension),
                                      example, error.what()));
  }
  if (!(value >= 0)) throw deck.error(key, fmt::format("expected a rate at least 0, found '{}'", text));
  return value;
}

CarrierGas readGas(const Deck& deck, const std::string& kernel) {
  const std::vector<std::string> free{"free_molecular", "continuum", "transition", "transition_fuchs", "gravitational"};
  const std::vector<std::string> slip{"continuum", "transition", "transition_fuchs", "gravitational"};
  const auto value = [&](const char* key, const std::vector<std::string>& kernels) {
    const std::string path = std::string("gas.") + key;
    if (std::find(kernels.begin(), kernels.end(), kernel) == kernels.end()) return 0.0;
    if (!deck.has(path))
      throw deck.error(deck.has("gas") ? "gas" : "processes.coagulation.kernel",
                       fmt::format("the kernel {} needs '{}'", kernel, path));
    return deck.quantity(path);
  };
  return {value("temperature", free), value("pressure", slip), deck.optionalQuantity("gas.density").value_or(0.0),
          value("viscosity", slip), value("mean_molecular_weight", slip)};
}

DeckKeys<CollisionKernelOptions> coagulationKeys() {
  using Options = CollisionKernelOptions;
  using Kernel = CollisionKernelType;
  const auto with = [](std::vector<std::string> kernels) {
    return rules().optional().onlyWith("processes.coagulation.kernel", std::move(kernels));
  };
  DeckKeys<Options> keys("processes.coagulation");
  keys.section(Presence::optional, "Pairs of particles collide and become one.");
  keys.choice("kernel", &Options::type,
              {{"constant", Kernel::constant},
               {"additive", Kernel::additive},
               {"multiplicative", Kernel::multiplicative},
               {"free_molecular", Kernel::freeMolecular},
               {"continuum", Kernel::continuum},
               {"transition", Kernel::transition},
               {"transition_fuchs", Kernel::transitionFuchs},
               {"shear", Kernel::shear},
               {"gravitational", Kernel::gravitational}},
              rules().required(),
              "constant: A, additive: A (u + v), multiplicative: A u v, with the volumes u and v; transition: "
              "harmonic mean of free-molecular and continuum; transition_fuchs: interpolation of Fuchs.");
  keys.text("rate", with(withRate),
            "A of the first three kernels, with its unit: m^3/s (constant), 1/s (additive), 1/(m^3 s) "
            "(multiplicative).");
  keys.number("efficiency", &Options::efficiency, rules().above(0).atMost(1), "Probability that a collision sticks.");
  keys.quantity("efficiency_diameter", units::length, &Options::efficiencyDiameter, rules().optional().above(0),
                "Below about this diameter of the smaller particle collisions stick less: the efficiency is "
                "multiplied by 1 / (1 + (efficiency_diameter / d)^efficiency_exponent).");
  keys.number("efficiency_exponent", &Options::efficiencyExponent, rules().optional().above(0),
              "Exponent in the efficiency of collisions of small particles, 1 / (1 + (efficiency_diameter / "
              "d)^efficiency_exponent): bigger makes a sharper limit.");
  keys.number("enhancement", &Options::enhancement, with({"free_molecular", "transition", "transition_fuchs"}).above(0),
              "Factor by which van der Waals forces enhance free-molecular collisions.");
  keys.quantity("shear_rate", units::frequency, &Options::shearRate, with({"shear"}).above(0),
                "Velocity gradient of the gas.");
  return keys;
}

CollisionKernelOptions readCoagulation(const Deck& deck) {
  const std::string section = "processes.coagulation", kernel = deck.choice(section + ".kernel");
  CollisionKernelOptions options = coagulationKeys().read(deck);
  if (deck.has(section + ".efficiency_diameter") != deck.has(section + ".efficiency_exponent"))
    throw deck.error(section, "'efficiency_diameter' and 'efficiency_exponent' belong together: give both or neither");
  const std::string who = "the kernel " + kernel;
  if (kernel == "shear") needed(deck, section, "shear_rate", who);
  if (std::find(withRate.begin(), withRate.end(), kernel) != withRate.end()) {
    if (!deck.has(section + ".rate")) throw deck.error(section, fmt::format("{} needs the key 'rate'", who));
    options.rate = kernel == "constant" ? readDependent(deck, section + ".rate", units::volumeFlow, who, "1e-6 cm^3/s")
                   : kernel == "additive"
                       ? readDependent(deck, section + ".rate", units::frequency, who, "1 1/s")
                       : readDependent(deck, section + ".rate", units::ratePerVolume, who, "1 1/(m^3 s)");
  }
  options.gas = readGas(deck, kernel);
  return options;
}

DeckKeys<NucleationOptions> nucleationKeys() {
  using Options = NucleationOptions;
  const auto with = [](const char* source) {
    return rules().optional().onlyWith("processes.nucleation.source", {source});
  };
  DeckKeys<Options> keys("processes.nucleation");
  keys.section(Presence::optional, "New particles of one volume.");
  keys.choice("source", &Options::source,
              {{"constant", Options::Source::constant},
               {"precursor", Options::Source::precursor},
               {"table", Options::Source::table}},
              rules(),
              "constant: `rate`; precursor: rate_constant precursor exp(-rate_constant t); table: straight lines "
              "between `rates` at `times`, zero outside.");
  keys.quantity("rate", units::ratePerVolume, &Options::rate, with("constant").above(0), "Nuclei per volume and time.");
  keys.quantity("rate_constant", units::frequency, &Options::rateConstant, with("precursor").above(0),
                "Rate constant of the first-order reaction of the precursor to nuclei.");
  keys.quantity("precursor", units::perVolume, &Options::precursor, with("precursor").above(0),
                "Number density of the precursor at time zero.");
  keys.quantity("times", units::time, &Options::times, with("table"), "Times of the points of the table, rising.");
  keys.quantity("rates", units::ratePerVolume, &Options::rates, with("table").atLeast(0),
                "Nuclei per volume and time at the times of the table.");
  return keys;
}

NucleationOptions readNucleation(const Deck& deck) {
  const std::string section = "processes.nucleation";
  const std::string who = "nucleation with the source " + deck.choice(section + ".source");
  NucleationOptions options = nucleationKeys().read(deck);
  options.volume = readParticleSize(deck, section, "nucleation");
  if (options.source == NucleationOptions::Source::constant) {
    needed(deck, section, "rate", who);
  } else if (options.source == NucleationOptions::Source::precursor) {
    needed(deck, section, "rate_constant", who);
    needed(deck, section, "precursor", who);
  } else {
    for (const char* key : {"times", "rates"})
      if (!deck.has(section + "." + key)) throw deck.error(section, fmt::format("{} needs the key '{}'", who, key));
    if (options.times.size() != options.rates.size() || options.times.size() < 2)
      throw deck.error(section + ".rates", fmt::format("a table needs as many rates as times, at least two; found {} "
                                                       "rates and {} times",
                                                       options.rates.size(), options.times.size()));
    for (std::size_t k = 1; k < options.times.size(); ++k)
      if (!(options.times[k] > options.times[k - 1]))
        throw deck.error(fmt::format("{}.times[{}]", section, k), "the times of a table have to rise");
  }
  return options;
}

// The rate rate (v / reference_volume)^exponent of a process of single particles.
template <typename Options>
void addSizeDependentRate(DeckKeys<Options>& keys, const std::string& what) {
  keys.quantity("rate", units::frequency, &Options::rate, rules().required().atLeast(0),
                what + " of a particle of reference_volume.");
  keys.number("exponent", &Options::exponent, rules(),
              "Exponent e of the volume v in the rate, rate (v / reference_volume)^e.");
  keys.quantity("reference_volume", units::volume, rules().byDefault("1 m^3").above(0),
                "Volume of a particle that has just the rate; of no effect where the exponent is 0.");
}

DeckKeys<BreakageOptions> breakageKeys() {
  using Options = BreakageOptions;
  DeckKeys<Options> keys("processes.breakage");
  keys.section(Presence::optional, "Particles break into pieces.");
  addSizeDependentRate(keys, "Rate of breakage");
  keys.integer("fragments", &Options::fragments, rules().atLeast(2).atMost(1000),
               "Number of pieces that a particle breaks into.");
  keys.choice("daughters", &Options::daughters,
              {{"equal", Options::Daughters::equal}, {"uniform", Options::Daughters::uniform}}, rules(),
              "equal: all pieces alike; uniform (two pieces): every split equally probable.");
  return keys;
}

DeckKeys<DepositionOptions> depositionKeys() {
  DeckKeys<DepositionOptions> keys("processes.deposition");
  keys.section(Presence::optional, "Particles are lost.");
  addSizeDependentRate(keys, "Rate of loss");
  return keys;
}

DeckKeys<GrowthOptions> growthKeys() {
  using Options = GrowthOptions;
  using Treatment = Options::Treatment;
  const auto with = [](std::vector<std::string> treatments) {
    return rules().optional().onlyWith("processes.growth.treatment", std::move(treatments));
  };
  DeckKeys<Options> keys("processes");
  keys.section("condensation", Presence::optional, "dv/dt = rate v; evaporation where it is negative.");
  keys.quantity("condensation.rate", units::frequency, &Options::condensation, rules().required(),
                "Relative rate at which every volume grows, the rate in dv/dt = rate v; negative: evaporation.");
  keys.section("surface_growth", Presence::optional, "dv/dt = rate S, with the surface S of the particle.");
  keys.quantity("surface_growth.rate", units::velocity, &Options::surfaceGrowth, rules().required().above(0),
                "Speed at which the surface of particles grows outwards, the rate in dv/dt = rate S.");
  keys.section("oxidation", Presence::optional, "dv/dt = -rate S.");
  keys.quantity("oxidation.rate", units::velocity, &Options::oxidation, rules().required().above(0),
                "Speed at which the surface of particles recedes, the rate in dv/dt = -rate S.");
  keys.section("growth", Presence::optional, "How condensation, surface growth and oxidation are computed.");
  keys.choice("growth.treatment", &Options::treatment,
              {{"split", Treatment::split}, {"deferred", Treatment::deferred}, {"jumps", Treatment::jumps}}, rules(),
              "Monte Carlo. split: all particles together, in steps between the jumps; deferred: each when it is "
              "looked at, at the latest at the end of a step; jumps: one monomer at a time, as jumps.");
  keys.quantity("growth.step", units::time, &Options::step, with({"split", "deferred"}).above(0),
                "Length of a step; chosen from the rates if not given.");
  keys.quantity("growth.monomer", units::volume, &Options::monomer, with({"jumps"}).above(0), "Volume of a monomer.");
  keys.quantity("growth.smallest_volume", units::volume, &Options::smallestVolume, rules().optional().above(0),
                "Volume below which particles that shrink vanish.");
  return keys;
}

// rate (v / reference_volume)^exponent, as a rate at 1 m3.
void scaleSizeDependent(const Deck& deck, const std::string& section, double& rate, double exponent) {
  if (exponent == 0 && deck.isGiven(section + ".reference_volume"))
    throw deck.error(
        section + ".reference_volume",
        "the rate does not depend on the volume, as its exponent is 0; leave this key out or give an exponent");
  rate /= std::pow(deck.quantity(section + ".reference_volume"), exponent);
  if (!std::isfinite(rate)) throw deck.error(section, "this rate is beyond the range of numbers");
}

BreakageOptions readBreakage(const Deck& deck) {
  BreakageOptions options = breakageKeys().read(deck);
  scaleSizeDependent(deck, breakageKeys().path(), options.rate, options.exponent);
  if (options.daughters == BreakageOptions::Daughters::uniform && options.fragments != 2)
    throw deck.error("processes.breakage.daughters", "uniform daughters are two; expected 'fragments: 2' or 'equal'");
  return options;
}

GrowthOptions readGrowth(const Deck& deck) {
  GrowthOptions growth = growthKeys().read(deck);
  const std::string section = "processes.growth";
  if (!deck.has(section)) return growth;
  if (!growth.active() && !deck.has("particles.sintering_time"))
    throw deck.error(
        section,
        "there is no condensation, surface_growth or oxidation, so that nothing grows; leave this section out");
  if (growth.treatment == GrowthOptions::Treatment::jumps) needed(deck, section, "monomer", "the treatment jumps");
  return growth;
}

// Keys of components: a list over the names.
Components readComponents(const Deck& deck) {
  const std::vector<std::string> names = deck.children("particles.components");
  if (names.empty()) throw deck.error("particles", "particles of type components need the section 'components'");
  std::vector<double> densities, nucleus, condensing;
  for (const std::string& name : names) {
    const std::string section = "particles.components." + name;
    densities.push_back(deck.quantity(section + ".density"));
    nucleus.push_back(deck.number(section + ".nucleus"));
    condensing.push_back(deck.number(section + ".condensing"));
  }
  try {
    return {densities, nucleus, condensing};
  } catch (const InputError& error) {
    throw deck.error("particles.components", error.what());
  }
}

}  // namespace

PopulationParticles readParticles(const Deck& deck, PopulationModel& model) {
  const std::string section = "particles", type = deck.choice("particles.type");
  const double density = model.density;
  const double dimension = deck.optionalNumber("particles.fractal_dimension").value_or(1.8);
  if (type == "fractal")
    return FractalAggregate(density, needed(deck, section, "primary_diameter", "the type fractal"), dimension);
  if (type == "components") return readComponents(deck);
  if (type == "volume") return Sphere(density);
  const auto sintering = deck.optionalQuantity("particles.sintering_time");
  if (!sintering) return SurfaceVolume(density, dimension);
  model.growth.always = true;
  if (!(model.growth.step > 0))
    throw deck.error("particles.sintering_time", "sintering needs the key 'processes.growth.step'");
  if (model.growth.treatment == GrowthOptions::Treatment::jumps)
    throw deck.error("particles.sintering_time", "sintering needs the treatment split or deferred of growth");
  return SurfaceVolume(density, dimension, *sintering);
}

void addProcessKeys(DeckSchema& schema) {
  SectionKeys keys("processes");
  keys.schema().add(coagulationKeys().schema());
  keys.schema().add(nucleationKeys().schema());
  addParticleSize(keys.schema(), nucleationKeys().path(), "of a nucleus");
  keys.schema().add(breakageKeys().schema());
  keys.schema().add(growthKeys().schema());
  keys.schema().add(depositionKeys().schema());
  keys.section("dilution", Presence::optional,
               "All number densities fall at this rate, as where the gas expands; negative: compression.");
  keys.quantity(
      "dilution.rate", units::frequency, rules(),
      "Relative rate at which all number densities fall as the gas expands, dn/dt = -rate n; negative: compression.");
  schema.add(keys.schema());
}

PopulationModel readModel(const Deck& deck) {
  PopulationModel model;
  model.density = deck.quantity("particles.density");
  if (deck.has("processes.coagulation"))
    model.coagulation = readCoagulation(deck);
  else if (deck.has("gas"))
    throw deck.error("gas", "only coagulation needs the gas, and there is none; leave this section out");
  if (deck.has("processes.nucleation")) model.nucleation = readNucleation(deck);
  if (deck.has("processes.breakage")) model.breakage = readBreakage(deck);
  if (deck.has("processes.deposition")) {
    model.deposition = depositionKeys().read(deck);
    scaleSizeDependent(deck, "processes.deposition", model.deposition->rate, model.deposition->exponent);
  }
  model.growth = readGrowth(deck);
  if (deck.has("processes.dilution")) model.dilution = deck.quantity("processes.dilution.rate");
  return model;
}

}  // namespace lampblack::app::populationcase
