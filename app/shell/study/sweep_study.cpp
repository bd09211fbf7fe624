#include "app/shell/study/sweep_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "io/deck_keys.hpp"
#include "io/json.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

using Varied = std::vector<std::pair<std::string, std::string>>;

// "rate=2e-6 m^3/s" as a part of a folder's name.
std::string plainName(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' || c == '_';
    if (kept)
      plain += c;
    else if (!plain.empty() && plain.back() != '_')
      plain += '_';
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  return plain;
}

// A deck is known by its file's name, or by its folder's where it is called deck.yaml.
std::string nameOf(const std::filesystem::path& deck) {
  const std::string stem = deck.stem().string();
  if (stem != "deck") return plainName(stem);
  const std::string folder = std::filesystem::absolute(deck).lexically_normal().parent_path().filename().string();
  return plainName(folder.empty() ? stem : folder);
}

// Settings that belong together; a study without variants has one without a name.
struct Variant {
  std::string name;
  std::vector<std::string> settings;
};

std::string nameOf(const std::filesystem::path& deck, const Variant& variant, const Varied& varied) {
  std::string name = nameOf(deck);
  if (!variant.name.empty()) name += fmt::format("_{}", plainName(variant.name));
  for (const auto& [key, value] : varied)
    name += fmt::format("_{}-{}", plainName(key.substr(key.rfind('.') + 1)), plainName(value));
  return name;
}

// What is varied, as a number of runs; a folder is made for each of them.
void refuseTooMany(const Deck& study, std::size_t decks) {
  constexpr double most = 100000;
  double runs = static_cast<double>(decks * std::max<std::size_t>(1, study.size("variants")));
  for (std::size_t i = 0; i < study.size("vary"); ++i)
    runs *= static_cast<double>(study.size(fmt::format("vary[{}].values", i)));
  if (runs > most)
    throw study.error(study.has("vary") ? "vary" : "decks",
                      fmt::format("the study has {:.6g} runs; at most {:.0f} are possible", runs, most));
}

// Two runs of one name would be one folder and two rows that cannot be told apart.
void refuseTwice(const Deck& study, const std::string& key, const std::vector<std::string>& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (std::find(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(i), texts[i]) !=
        texts.begin() + static_cast<std::ptrdiff_t>(i))
      throw study.error(key, fmt::format("'{}' is given twice", texts[i]));
}

// Every combination, the last key fastest.
std::vector<Varied> product(const Deck& study) {
  std::vector<Varied> combinations{{}};
  for (std::size_t i = 0; i < study.size("vary"); ++i) {
    const std::string key = study.string(fmt::format("vary[{}].key", i));
    const std::string valuesKey = fmt::format("vary[{}].values", i);
    const std::vector<std::string> values = study.strings(valuesKey);
    if (values.empty()) throw study.error(valuesKey, "there is nothing to vary over: the list is empty");
    refuseTwice(study, valuesKey, values);
    std::vector<Varied> next;
    for (const Varied& combination : combinations) {
      for (const std::string& value : values) {
        next.push_back(combination);
        next.back().emplace_back(key, value);
      }
    }
    combinations = std::move(next);
  }
  return combinations;
}

// A value as the right side of --set. The study's own quotes are gone: text that would be a map ("H2: 2, O2: 1") gets
// them back.
std::string asInDeck(const std::string& value) {
  const bool isText = value.find(": ") != std::string::npos && value.find_first_of("[{\"'") != 0;
  return isText ? jsonString(value) : value;
}

// The assignments of a list, as --set takes them.
std::vector<std::string> assignments(const Deck& study, const std::string& key) {
  std::vector<std::string> settings = study.strings(key);
  for (std::string& setting : settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw study.error(key, fmt::format("expected assignments such as 'time.end=1 s', found '{}'", setting));
    setting = setting.substr(0, equals + 1) + asInDeck(setting.substr(equals + 1));
  }
  return settings;
}

std::vector<Variant> readVariants(const Deck& study) {
  std::vector<Variant> variants;
  for (std::size_t i = 0; i < study.size("variants"); ++i) {
    const std::string item = fmt::format("variants[{}]", i);
    variants.push_back({study.string(item + ".name"), assignments(study, item + ".set")});
    if (plainName(variants.back().name).empty())
      throw study.error(item + ".name", "expected a name with letters or digits");
  }
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  refuseTwice(study, "variants", names);
  if (variants.empty()) variants.emplace_back();
  return variants;
}

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

ConvergenceOptions readConvergence(const Deck& study, const std::vector<std::string>& settings) {
  ConvergenceOptions options;
  options.deck = study.resolvePath(study.string("convergence.deck"));
  options.overrides = joined(assignments(study, "convergence.set"), settings);
  options.methods = study.strings("convergence.methods");
  options.particles = study.integers("convergence.particles");
  options.product = study.integer("convergence.product");
  if (options.particles.size() < 2)
    throw study.error("convergence.particles", "a slope needs at least two numbers of particles");
  for (const std::int64_t particles : options.particles) {
    if (particles < 2 || particles > options.product / 2)
      throw study.error(
          "convergence.particles",
          fmt::format("expected numbers from 2 to half of the product ({}), so that there are two repeats "
                      "at least; found {}",
                      options.product, particles));
  }
  const std::int64_t largest = *std::max_element(options.particles.begin(), options.particles.end());
  requireMemory(study, "convergence.particles", fmt::format("a sample of {} particles", largest),
                40 * static_cast<double>(largest));
  std::vector<std::int64_t> sorted = options.particles;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw study.error("convergence.particles", "a number is given twice");
  options.exact = study.choice("convergence.reference.type") == "exact";
  if (options.exact) return options;
  for (const char* key : {"method", "particles", "repeats"}) {
    if (!study.isGiven(fmt::format("convergence.reference.{}", key)))
      throw study.error("convergence.reference", fmt::format("a reference of type run needs the key '{}'", key));
  }
  options.referenceMethod = study.string("convergence.reference.method");
  options.referenceParticles = study.integer("convergence.reference.particles");
  options.referenceRepeats = study.integer("convergence.reference.repeats");
  return options;
}

}  // namespace

DeckSchema studySchema() {
  SectionKeys keys("");
  keys.text("study", rules(), "Name of the study, for its table.");
  keys.text("decks", rules().list().byDefault("[]"), "Decks to run, relative to this file.");
  keys.text("deck", rules().optional(), "One deck, in place of a list of decks.");
  keys.section("vary", Presence::optional, "What is varied in every deck; all combinations are run.");
  keys.text("vary[].key", rules(), "Key of the deck that is varied: initial.temperature.");
  keys.text("vary[].values", rules().list(), "Values of the key, as they would stand in the deck: [900 K, 1000 K].");
  keys.section("variants", Presence::optional,
               "Variants of every deck, each with several settings at once; combined with what is varied.");
  keys.text("variants[].name", rules(), "Name of the variant: part of the run's name, and a column of the table.");
  keys.text("variants[].set", rules().list(),
            "Assignments to keys of the deck that make this variant: [left.velocity=25 cm/s, right.velocity=25 cm/s].");
  keys.text("set", rules().list().byDefault("[]"),
            "Assignments applied to every deck before what is varied: [time.end=1 s, repeats=10].");
  keys.integer("ranks_per_run", rules().optional().atLeast(1),
               "Ranks that share a run; so many runs go on side by side as fit. All ranks work on one run after "
               "another if this is not given, which suits problems that spread over ranks by themselves.");
  keys.integer("chain", rules().byDefault("1").atLeast(1),
               "One-dimensional flames and flows: so many runs follow each other on the same ranks, each starting from "
               "the end of the one before it (key initial, initial.flow); the first, and one after a failure, from the "
               "deck's own start. Of steady states that follows a branch over a parameter.");
  keys.text("collect.results", rules().list().byDefault("[all]"),
            "Which of a run's results (the object \"results\" of run.json, its parts joined by dots) become columns of "
            "the study's table; all takes every one.");
  keys.text("collect.tables", rules().list().byDefault("[table.csv]"),
            "CSV tables of the runs that are put below each other, the name of the run in front; a run without such a "
            "file is skipped.");
  keys.text("collect.columns", rules().list().byDefault("[all]"),
            "Columns of those tables to show on the console, by name without unit.");
  keys.section("convergence", Presence::optional,
               "Error of Monte Carlo methods against the number of particles, particles times repeats kept constant.");
  keys.text("convergence.deck", rules(), "A deck of problem population_balance, relative to this file.");
  keys.text("convergence.set", rules().list().byDefault("[]"), "Assignments to keys of that deck: [time.end=1 s].");
  keys.text("convergence.methods", rules().list().byDefault("[]"),
            "Methods of the deck by name; none named: all Monte Carlo methods.");
  keys.integer("convergence.particles", rules().list().atLeast(2), "Numbers of particles: [512, 1024, 2048].");
  keys.integer("convergence.product", rules().byDefault("131072").atLeast(4),
               "Particles times repeats, the same for every number of particles.");
  keys.choice("convergence.reference.type", {"exact", "run"}, rules().byDefault("exact"),
              "What the error is counted from: the exact solution, or a run with many particles.");
  keys.text("convergence.reference.method", rules().optional(),
            "With type run: the method of the reference, by its name in the deck.");
  keys.integer("convergence.reference.particles", rules().optional().atLeast(2),
               "With type run: the number of particles of the reference.");
  keys.integer("convergence.reference.repeats", rules().optional().atLeast(1),
               "With type run: the number of repeats of the reference.");
  return keys.schema();
}

SweepStudy readStudy(const Deck& study, const std::vector<std::string>& settings) {
  SweepStudy sweep;
  sweep.name = study.string("study");
  sweep.chain = study.integer<std::size_t>("chain");
  sweep.ranksPerRun = study.optionalInteger<int>("ranks_per_run");
  sweep.results = study.strings("collect.results");
  sweep.tables = study.strings("collect.tables");
  sweep.columns = study.strings("collect.columns");
  const std::vector<std::string> common = assignments(study, "set");

  std::vector<std::string> decks = study.strings("decks");
  if (const auto deck = study.optionalString("deck")) decks.push_back(*deck);
  if (decks.empty() && !study.has("convergence"))
    throw study.error("decks", "there is nothing to run: expected decks, or a section convergence");
  refuseTwice(study, "decks", decks);
  refuseTooMany(study, decks.size());
  const std::vector<Varied> combinations = product(study);
  const std::vector<Variant> variants = readVariants(study);
  std::map<std::string, int> used;
  for (const std::string& deck : decks) {
    for (std::size_t i = 0; i < variants.size() * combinations.size(); ++i) {
      const Variant& variant = variants[i / combinations.size()];
      const Varied& varied = combinations[i % combinations.size()];
      SweepRun run;
      run.deck = study.resolvePath(deck);
      if (!variant.name.empty()) run.varied.emplace_back("variant", variant.name);
      run.varied.insert(run.varied.end(), varied.begin(), varied.end());
      run.overrides = joined(common, variant.settings);
      for (const auto& [key, value] : varied) run.overrides.push_back(fmt::format("{}={}", key, asInDeck(value)));
      run.overrides = joined(run.overrides, settings);
      run.name = nameOf(run.deck, variant, varied);
      if (const int before = used[run.name]++; before > 0) run.name += fmt::format("_{}", before + 1);
      sweep.runs.push_back(std::move(run));
    }
  }
  if (study.has("convergence")) sweep.convergence = readConvergence(study, settings);
  return sweep;
}

}  // namespace lampblack::app
