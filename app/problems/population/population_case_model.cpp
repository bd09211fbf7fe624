// The processes of a population balance deck.
#include <cmath>
#include <map>

#include "app/deck/initial_distribution.hpp"
#include "app/problems/population/population_case_parts.hpp"
#include "core/errors.hpp"

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

CollisionKernelOptions readCoagulation(const Deck& deck) {
  const std::string section = "processes.coagulation", kernel = deck.choice(section + ".kernel");
  static const std::map<std::string, CollisionKernelType> types{
      {"constant", CollisionKernelType::constant},
      {"additive", CollisionKernelType::additive},
      {"multiplicative", CollisionKernelType::multiplicative},
      {"free_molecular", CollisionKernelType::freeMolecular},
      {"continuum", CollisionKernelType::continuum},
      {"transition", CollisionKernelType::transition},
      {"transition_fuchs", CollisionKernelType::transitionFuchs},
      {"shear", CollisionKernelType::shear},
      {"gravitational", CollisionKernelType::gravitational}};
  CollisionKernelOptions options;
  options.type = types.at(kernel);
  options.efficiency = deck.number(section + ".efficiency");
  options.enhancement = deck.optionalNumber(section + ".enhancement").value_or(1.0);
  if (deck.has(section + ".efficiency_diameter") != deck.has(section + ".efficiency_exponent"))
    throw deck.error(section, "'efficiency_diameter' and 'efficiency_exponent' belong together: give both or neither");
  options.efficiencyDiameter = deck.optionalQuantity(section + ".efficiency_diameter").value_or(0.0);
  options.efficiencyExponent = deck.optionalNumber(section + ".efficiency_exponent").value_or(0.0);
  const std::string who = "the kernel " + kernel;
  if (kernel == "shear") options.shearRate = needed(deck, section, "shear_rate", who);
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

NucleationOptions readNucleation(const Deck& deck) {
  const std::string section = "processes.nucleation", source = deck.choice(section + ".source");
  const std::string who = "nucleation with the source " + source;
  NucleationOptions options;
  options.volume = readParticleSize(deck, section, "nucleation");
  if (source == "constant") {
    options.source = NucleationOptions::Source::constant;
    options.rate = needed(deck, section, "rate", who);
  } else if (source == "precursor") {
    options.source = NucleationOptions::Source::precursor;
    options.rateConstant = needed(deck, section, "rate_constant", who);
    options.precursor = needed(deck, section, "precursor", who);
  } else {
    options.source = NucleationOptions::Source::table;
    for (const char* key : {"times", "rates"})
      if (!deck.has(section + "." + key)) throw deck.error(section, fmt::format("{} needs the key '{}'", who, key));
    options.times = deck.quantities(section + ".times");
    options.rates = deck.quantities(section + ".rates");
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

// rate (v / reference_volume)^exponent, as a rate at 1 m3.
void readSizeDependent(const Deck& deck, const std::string& section, double& rate, double& exponent) {
  rate = deck.quantity(section + ".rate");
  exponent = deck.number(section + ".exponent");
  if (exponent == 0 && deck.isGiven(section + ".reference_volume"))
    throw deck.error(
        section + ".reference_volume",
        "the rate does not depend on the volume, as its exponent is 0; leave this key out or give an exponent");
  rate /= std::pow(deck.quantity(section + ".reference_volume"), exponent);
  if (!std::isfinite(rate)) throw deck.error(section, "this rate is beyond the range of numbers");
}

BreakageOptions readBreakage(const Deck& deck) {
  BreakageOptions options;
  const std::string section = "processes.breakage";
  readSizeDependent(deck, section, options.rate, options.exponent);
  options.fragments = deck.integer<int>(section + ".fragments");
  if (deck.choice(section + ".daughters") == "uniform") {
    if (options.fragments != 2)
      throw deck.error(section + ".daughters", "uniform daughters are two; expected 'fragments: 2' or 'equal'");
    options.daughters = BreakageOptions::Daughters::uniform;
  }
  return options;
}

GrowthOptions readGrowth(const Deck& deck) {
  GrowthOptions growth;
  const std::string section = "processes.growth";
  if (deck.has("processes.condensation")) growth.condensation = deck.quantity("processes.condensation.rate");
  if (deck.has("processes.surface_growth")) growth.surfaceGrowth = deck.quantity("processes.surface_growth.rate");
  if (deck.has("processes.oxidation")) growth.oxidation = deck.quantity("processes.oxidation.rate");
  if (!deck.has(section)) return growth;
  if (!growth.active() && !deck.has("particles.sintering_time"))
    throw deck.error(
        section,
        "there is no condensation, surface_growth or oxidation, so that nothing grows; leave this section out");
  const std::string treatment = deck.choice(section + ".treatment");
  growth.treatment = treatment == "split"      ? GrowthOptions::Treatment::split
                     : treatment == "deferred" ? GrowthOptions::Treatment::deferred
                                               : GrowthOptions::Treatment::jumps;
  growth.step = deck.optionalQuantity(section + ".step").value_or(0.0);
  growth.smallestVolume = deck.optionalQuantity(section + ".smallest_volume").value_or(0.0);
  if (treatment == "jumps") growth.monomer = needed(deck, section, "monomer", "the treatment jumps");
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
    model.deposition.emplace();
    readSizeDependent(deck, "processes.deposition", model.deposition->rate, model.deposition->exponent);
  }
  model.growth = readGrowth(deck);
  if (deck.has("processes.dilution")) model.dilution = deck.quantity("processes.dilution.rate");
  return model;
}

}  // namespace lampblack::app::populationcase
