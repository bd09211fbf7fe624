// The methods of a population balance deck.
#include <map>

#include "app/problems/population/population_case_parts.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app::populationcase {
namespace {

const std::map<std::string, MonteCarloMethod> monteCarlo{
    {"dsmc", MonteCarloMethod::dsmc},
    {"constant_volume", MonteCarloMethod::constantVolume},
    {"constant_number_mass", MonteCarloMethod::constantNumberByMass},
    {"constant_number_number", MonteCarloMethod::constantNumberByNumber},
    {"mmc", MonteCarloMethod::mmc},
    {"wfmc", MonteCarloMethod::wfmc},
    {"samwfmc", MonteCarloMethod::samwfmc},
    {"sammc", MonteCarloMethod::sammc},
    {"swa", MonteCarloMethod::swa},
    {"pairs", MonteCarloMethod::pairs},
    {"hybrid", MonteCarloMethod::hybrid}};

// Of a numerical particle in the leanest store: volume, weight, and its share of the sums over them.
constexpr double bytesOfParticle = 40;

std::size_t count(const Deck& deck, const std::string& key, std::size_t otherwise) {
  return deck.optionalInteger<std::size_t>(key).value_or(otherwise);
}

void readFraction(const Deck& deck, const std::string& section, MonteCarloOptions& options) {
  const std::string fraction = deck.optionalString(section + ".fraction").value_or("one");
  options.fraction = fraction == "one"           ? FractionFunction::one
                     : fraction == "hyperbolic"  ? FractionFunction::hyperbolic
                     : fraction == "exponential" ? FractionFunction::exponential
                     : fraction == "stepwise"    ? FractionFunction::stepwise
                                                 : FractionFunction::constant;
  if (deck.optionalString(section + ".fraction_of") == "weights") options.fractionOf = FractionOf::weights;
  if (fraction != "constant") return;
  if (!deck.has(section + ".fraction_constant"))
    throw deck.error(section, "a constant fraction needs the key 'fraction_constant'");
  options.fractionConstant = deck.number(section + ".fraction_constant");
}

MonteCarloOptions readMonteCarlo(const Deck& deck, const std::string& section, const std::string& type,
                                 const PopulationCase& populationCase) {
  MonteCarloOptions options;
  options.method = monteCarlo.at(type);
  options.particles = count(deck, section + ".particles", options.particles);
  requireMemory(deck, section + ".particles", fmt::format("a sample of {} particles", options.particles),
                bytesOfParticle * static_cast<double>(options.particles));
  if (deck.optionalString(section + ".rates") == "exact") options.rates = EventRates::exact;
  readFraction(deck, section, options);
  if (deck.optionalString(section + ".merging") == "absolute") options.merging = MergingDifference::absolute;
  const std::string transfer = deck.optionalString(section + ".weight_transfer").value_or("mass");
  options.transfer = transfer == "mass"   ? WeightTransfer::mass
                     : transfer == "half" ? WeightTransfer::half
                                          : WeightTransfer::harmonic;
  for (const char* key : {"nucleation", "nucleus_weight"})
    if (deck.isGiven(section + "." + key) && !populationCase.model.nucleation)
      throw deck.error(section + "." + key, "there is no nucleation that this key could act on; leave it out");
  if (deck.optionalString(section + ".nucleation") == "random") options.nucleation = NucleationSampling::random;
  options.nucleusWeight = deck.optionalQuantity(section + ".nucleus_weight").value_or(0.0);
  const bool empty = populationCase.initial.distribution == InitialPopulation::Distribution::none;
  if (empty && options.method != MonteCarloMethod::pairs && !deck.has(section + ".expected_number"))
    throw deck.error(section, fmt::format("the method {} needs the key 'expected_number' where 'initial' has no "
                                          "particles: the number density at which its sample is full",
                                          type));
  if (!empty && deck.has(section + ".expected_number"))
    throw deck.error(section + ".expected_number",
                     "the number density at the start is that of 'initial'; leave this key out");
  options.expectedNumber = deck.optionalQuantity(section + ".expected_number").value_or(0.0);
  if (deck.optionalString(section + ".initial_weights") == "equal") options.initialWeights = InitialWeights::equal;
  options.pairProbability = deck.optionalNumber(section + ".pair_probability").value_or(options.pairProbability);
  options.splitChange = deck.optionalNumber(section + ".split_change").value_or(options.splitChange);
  options.threshold = count(deck, section + ".threshold", options.threshold);
  requireMemory(deck, section + ".threshold", fmt::format("a threshold of {} sizes", options.threshold),
                bytesOfParticle * static_cast<double>(options.threshold));
  return options;
}

SectionalOptions readSectional(const Deck& deck, const std::string& section) {
  SectionalOptions options;
  options.sections = count(deck, section + ".sections", options.sections);
  options.smallest = needed(deck, section, "smallest", "the method sectional");
  if (deck.has(section + ".spacing") == deck.has(section + ".largest"))
    throw deck.error(section, "the method sectional needs either 'spacing' or 'largest'");
  options.spacing = deck.optionalNumber(section + ".spacing").value_or(0.0);
  options.largest = deck.optionalQuantity(section + ".largest").value_or(0.0);
  if (deck.optionalString(section + ".growth_scheme") == "upwind") options.growth = SectionGrowthScheme::upwind;
  options.overflow = deck.optionalNumber(section + ".overflow").value_or(options.overflow);
  options.relativeTolerance = deck.optionalNumber(section + ".relative_tolerance").value_or(options.relativeTolerance);
  options.absoluteTolerance = deck.optionalNumber(section + ".absolute_tolerance").value_or(options.absoluteTolerance);
  return options;
}

MomentOptions readMoments(const Deck& deck, const std::string& section, const std::string& type) {
  MomentOptions options;
  options.method = type == "qmom" ? MomentMethod::qmom : MomentMethod::momic;
  options.moments = count(deck, section + ".moments", options.moments);
  if (deck.optionalString(section + ".inversion") == "product_difference")
    options.inversion = QuadratureInversion::productDifference;
  options.relativeTolerance = deck.optionalNumber(section + ".relative_tolerance").value_or(options.relativeTolerance);
  return options;
}

// Whether a method keeps M1 to round-off where the processes do.
bool keepsMass(const PopulationMethod& method, const PopulationModel& model) {
  const auto* options = std::get_if<MonteCarloOptions>(&method.options);
  if (options == nullptr) return true;
  switch (options->method) {
    case MonteCarloMethod::constantNumberByNumber:
      return false;
    case MonteCarloMethod::swa:
      return options->transfer == WeightTransfer::mass;
    case MonteCarloMethod::dsmc:
    case MonteCarloMethod::constantVolume:
    case MonteCarloMethod::hybrid:
    case MonteCarloMethod::mmc:
      return !model.breakage;  // more particles than there is room for: some are taken out, or added to others
    default:
      return true;
  }
}

// Names become groups of the results file and cells of tables.
void checkName(const Deck& deck, const std::string& section, const std::string& name) {
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '_' && c != '-')
      throw deck.error(section, "the name of a method may have letters, digits, '_' and '-'");
  }
}

}  // namespace

std::vector<PopulationMethod> readMethods(const Deck& deck, const PopulationCase& populationCase) {
  std::vector<PopulationMethod> methods;
  for (const std::string& name : deck.children("methods")) {
    const std::string section = "methods." + name, type = deck.choice(section + ".type");
    checkName(deck, section, name);
    const bool spheres = std::holds_alternative<Sphere>(populationCase.particles);
    if (!monteCarlo.contains(type) && !spheres)
      throw deck.error(section + ".type", fmt::format("the method {} is for particles of type volume; these are {}",
                                                      type, deck.choice("particles.type")));
    PopulationMethod method;
    method.name = name;
    method.type = type;
    if (type == "sectional")
      method.options = readSectional(deck, section);
    else if (type == "qmom" || type == "momic")
      method.options = readMoments(deck, section, type);
    else
      method.options = readMonteCarlo(deck, section, type, populationCase);
    method.unbiased.fill(false);
    for (const std::string& moment : deck.strings(section + ".unbiased_moments"))
      method.unbiased[static_cast<std::size_t>(moment[1] - '0')] = true;
    const auto mass = deck.optionalString(section + ".mass");
    method.conservesMass = mass ? *mass == "conserved" : keepsMass(method, populationCase.model);
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace lampblack::app::populationcase
