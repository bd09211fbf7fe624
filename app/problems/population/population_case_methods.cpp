// The methods of a population balance deck.
#include <algorithm>
#include <optional>
#include <utility>

#include "app/problems/population/population_case_parts.hpp"
#include "io/deck_keys.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app::populationcase {
namespace {

const std::vector<std::pair<std::string, MonteCarloMethod>> monteCarlo{
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

// All that the keys of a method say.
struct MethodInput {
  std::string type;
  MonteCarloOptions monteCarlo;
  SectionalOptions sections;
  MomentOptions moments;
  std::vector<std::size_t> unbiased{0, 1, 2, 3};
  std::optional<bool> conservesMass;
  std::optional<double> relativeTolerance;  // of sections or moments
};

DeckKeys<MethodInput> inputKeys() {
  using Mc = MonteCarloOptions;
  using Sections = SectionalOptions;
  constexpr auto mc = [](auto member) { return inner(&MethodInput::monteCarlo, member); };
  constexpr auto sections = [](auto member) { return inner(&MethodInput::sections, member); };
  constexpr auto moments = [](auto member) { return inner(&MethodInput::moments, member); };
  const auto optional = [](std::vector<std::string> types) {
    return rules().optional().onlyWith("methods.*.type", std::move(types));
  };
  const std::vector<std::string> weighted{"mmc", "wfmc", "samwfmc", "sammc", "swa", "pairs"};
  std::vector<std::string> types, jumping;
  for (const auto& [type, method] : monteCarlo) {
    types.push_back(type);
    if (method != MonteCarloMethod::pairs) jumping.push_back(type);
  }
  std::vector<std::string> all = jumping;
  all.emplace_back("pairs");
  types.insert(types.end(), {"sectional", "qmom", "momic"});

  DeckKeys<MethodInput> keys("methods.*");
  keys.word("type", &MethodInput::type, types, rules().required(),
            "Equal weights: dsmc, constant_volume (stepwise), constant_number_mass, constant_number_number; "
            "different weights: mmc, wfmc, samwfmc, sammc, swa; pairs: different weights, pairs drawn in time "
            "steps; hybrid: small particles as numbers; sections "
            "and moments: sectional, qmom, momic.");
  keys.choice("unbiased_moments", &MethodInput::unbiased, {{"M0", 0}, {"M1", 1}, {"M2", 2}, {"M3", 3}},
              rules().formerly("claims").byDefault("[M0, M1, M2, M3]"),
              "Moments in which the method has to show no bias; [] where it is known to have one.");
  keys.choice("mass", &MethodInput::conservesMass, {{"conserved", true}, {"mean", false}}, rules(),
              "What is asked of M1 where the processes conserve it: the same in every repeat to 1e-11, or only "
              "in the mean. If not given: mean for constant_number_number, for swa but with the weight transfer "
              "mass, and for dsmc, constant_volume, hybrid and mmc where particles break.");
  keys.integer("particles", mc(&Mc::particles), optional(all).atLeast(2).atMost(1e9),
               "Numerical particles; 2000 if not given.");
  keys.choice("rates", mc(&Mc::rates), {{"majorant", EventRates::majorant}, {"exact", EventRates::exact}},
              optional(jumping),
              "How events are drawn: majorant: from upper bounds of the rates, with fictitious jumps, fast; "
              "exact: from the sums of all rates, at a cost that goes with the number of particles.");
  keys.choice("fraction", mc(&Mc::fraction),
              {{"one", FractionFunction::one},
               {"hyperbolic", FractionFunction::hyperbolic},
               {"exponential", FractionFunction::exponential},
               {"stepwise", FractionFunction::stepwise},
               {"constant", FractionFunction::constant}},
              optional({"wfmc", "samwfmc", "sammc"}),
              "Fraction function of coagulation alpha: the part of the smaller weight that coagulates in an "
              "event (Wang 2025, eqs. 4-11 to 4-14).");
  keys.choice("fraction_of", mc(&Mc::fractionOf), {{"volumes", FractionOf::volumes}, {"weights", FractionOf::weights}},
              rules().optional().onlyWith("methods.*.fraction", {"hyperbolic", "exponential", "stepwise"}),
              "What of the two particles the fraction function compares: volumes or weights.");
  keys.number("fraction_constant", mc(&Mc::fractionConstant),
              rules().optional().above(0).atMost(1).onlyWith("methods.*.fraction", {"constant"}),
              "The constant value of the fraction function alpha.");
  keys.choice("merging", mc(&Mc::merging),
              {{"absolute", MergingDifference::absolute}, {"relative", MergingDifference::relative}},
              optional({"sammc", "swa"}), "Which difference of the volumes of neighbours is to be smallest.");
  keys.choice("weight_transfer", mc(&Mc::transfer),
              {{"mass", WeightTransfer::mass}, {"half", WeightTransfer::half}, {"harmonic", WeightTransfer::harmonic}},
              optional({"swa"}),
              "Weight transfer function gamma of the stochastic weighted algorithm: the weight of the particle "
              "that two make (Patterson, Wagner, Kraft 2011).");
  keys.choice("nucleation", mc(&Mc::nucleation),
              {{"even", NucleationSampling::even}, {"random", NucleationSampling::random}}, optional(jumping),
              "Nuclei evenly spaced in the integral of their rate (hardly any noise) or at random.");
  keys.choice("initial_weights", mc(&Mc::initialWeights),
              {{"moments", InitialWeights::moments}, {"equal", InitialWeights::equal}}, optional(weighted),
              "What the particles of the initial distribution stand for: moments (if not given): the large ones "
              "for fewer real ones, so that none holds more than 4/particles of any of M0 to M3; equal: all for "
              "as many.");
  keys.quantity("nucleus_weight", units::perVolume, mc(&Mc::nucleusWeight), optional(weighted).above(0),
                "Number density of real particles that a new numerical particle (nucleus) stands for: smaller "
                "is more accurate and slower. pairs: most that a nucleus stands for, three times the mean if not "
                "given.");
  keys.quantity("expected_number", units::perVolume, mc(&Mc::expectedNumber), optional(jumping).above(0),
                "Monte Carlo that starts without particles: number density at which the sample is full.");
  keys.number("pair_probability", mc(&Mc::pairProbability), optional({"pairs"}).above(0).atMost(1),
              "Probability that a candidate pair is to happen with at most, 0.2 if not given: higher draws "
              "fewer pairs, and pairs that would be above 1 collide too seldom (counted as limited).");
  keys.number("split_change", mc(&Mc::splitChange), optional({"pairs"}).above(0).atMost(1),
              "Part by which coagulation or another process may change the population in a step where there "
              "are several, 0.1 if not given: the error of splitting goes with its square.");
  keys.integer("threshold", mc(&Mc::threshold), optional({"hybrid"}).atLeast(1),
               "Largest size, in nuclei, of particles that are kept as a number of each size; larger ones are "
               "kept one by one.");
  keys.integer("sections", sections(&Sections::sections), optional({"sectional"}).atLeast(20).atMost(400),
               "Number of sections of mass: more of them reach larger particles.");
  keys.quantity("smallest", units::volume, sections(&Sections::smallest), optional({"sectional"}).above(0),
                "Volume of the first pivot.");
  keys.quantity("largest", units::volume, sections(&Sections::largest), optional({"sectional"}).above(0),
                "Volume of the last pivot.");
  keys.number("spacing", sections(&Sections::spacing), optional({"sectional"}).above(1),
              "Ratio of the volumes of neighbouring pivots.");
  keys.choice("growth_scheme", sections(&Sections::growth),
              {{"limited", SectionGrowthScheme::limited}, {"upwind", SectionGrowthScheme::upwind}},
              optional({"sectional"}),
              "Flux of growing particles; limited (if not given) is of second order, upwind of first.");
  keys.number("overflow", sections(&Sections::overflow), optional({"sectional"}).above(0).atMost(1),
              "Part of the volume that may pass the last pivot before that is an error; 1e-6 if not "
              "given.");
  keys.integer("moments", moments(&MomentOptions::moments), optional({"qmom", "momic"}).atLeast(2).atMost(20),
               "qmom (even), momic: number of moments.");
  keys.choice(
      "inversion", moments(&MomentOptions::inversion),
      {{"wheeler", QuadratureInversion::wheeler}, {"product_difference", QuadratureInversion::productDifference}},
      optional({"qmom"}), "Algorithm that finds nodes and weights of the quadrature from the moments.");
  keys.number("relative_tolerance", &MethodInput::relativeTolerance,
              optional({"sectional", "qmom", "momic"}).above(0).below(1),
              "Relative tolerance of the integrator: smaller is more accurate and slower.");
  keys.number("absolute_tolerance", sections(&Sections::absoluteTolerance), optional({"sectional"}).above(0).below(1),
              "Absolute tolerance of the integrator, as part of the number of particles of a section that would "
              "hold all "
              "of any of M0 to M3; 1e-12 if not given.");
  return keys;
}

void checkMonteCarlo(const Deck& deck, const std::string& section, const MethodInput& input,
                     const PopulationCase& populationCase) {
  const MonteCarloOptions& options = input.monteCarlo;
  requireMemory(deck, section + ".particles", fmt::format("a sample of {} particles", options.particles),
                bytesOfParticle * static_cast<double>(options.particles));
  if (options.fraction == FractionFunction::constant && !deck.has(section + ".fraction_constant"))
    throw deck.error(section, "a constant fraction needs the key 'fraction_constant'");
  for (const char* key : {"nucleation", "nucleus_weight"})
    if (deck.isGiven(section + "." + key) && !populationCase.model.nucleation)
      throw deck.error(section + "." + key, "there is no nucleation that this key could act on; leave it out");
  const bool empty = populationCase.initial.distribution == InitialPopulation::Distribution::none;
  if (empty && options.method != MonteCarloMethod::pairs && !deck.has(section + ".expected_number"))
    throw deck.error(section, fmt::format("the method {} needs the key 'expected_number' where 'initial' has no "
                                          "particles: the number density at which its sample is full",
                                          input.type));
  if (!empty && deck.has(section + ".expected_number"))
    throw deck.error(section + ".expected_number",
                     "the number density at the start is that of 'initial'; leave this key out");
  requireMemory(deck, section + ".threshold", fmt::format("a threshold of {} sizes", options.threshold),
                bytesOfParticle * static_cast<double>(options.threshold));
}

void checkSectional(const Deck& deck, const std::string& section) {
  needed(deck, section, "smallest", "the method sectional");
  if (deck.has(section + ".spacing") == deck.has(section + ".largest"))
    throw deck.error(section, "the method sectional needs either 'spacing' or 'largest'");
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

DeckSchema methodKeys() {
  DeckSchema schema = inputKeys().schema();
  schema.section("methods", Presence::required, "Named methods: all are run and compared.");
  return schema;
}

std::vector<PopulationMethod> readMethods(const Deck& deck, const PopulationCase& populationCase) {
  const DeckKeys<MethodInput> keys = inputKeys();
  std::vector<PopulationMethod> methods;
  for (const std::string& name : deck.children("methods")) {
    const std::string section = "methods." + name;
    MethodInput input = keys.read(deck, section);
    checkName(deck, section, name);
    const bool spheres = std::holds_alternative<Sphere>(populationCase.particles);
    const auto found = std::ranges::find(monteCarlo, input.type, &decltype(monteCarlo)::value_type::first);
    if (found == monteCarlo.end() && !spheres)
      throw deck.error(section + ".type", fmt::format("the method {} is for particles of type volume; these are {}",
                                                      input.type, deck.choice("particles.type")));
    PopulationMethod method;
    method.name = name;
    method.type = input.type;
    if (found != monteCarlo.end()) {
      input.monteCarlo.method = found->second;
      checkMonteCarlo(deck, section, input, populationCase);
      method.options = input.monteCarlo;
    } else if (input.type == "sectional") {
      checkSectional(deck, section);
      input.sections.relativeTolerance = input.relativeTolerance.value_or(input.sections.relativeTolerance);
      method.options = input.sections;
    } else {
      input.moments.method = input.type == "qmom" ? MomentMethod::qmom : MomentMethod::momic;
      input.moments.relativeTolerance = input.relativeTolerance.value_or(input.moments.relativeTolerance);
      method.options = input.moments;
    }
    method.unbiased.fill(false);
    for (const std::size_t moment : input.unbiased) method.unbiased[moment] = true;
    method.conservesMass = input.conservesMass.value_or(keepsMass(method, populationCase.model));
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace lampblack::app::populationcase
