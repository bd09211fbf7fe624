#include "app/deck/pah_rates_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lampblack::app {
namespace {

// Those that are the surface's of soot, as particles.surface has them.
struct EdgeRateKey {
  const char *name, *description;
  RateConstant SurfaceRateConstants::*value;
};
constexpr EdgeRateKey edgeRateKeys[] = {
    {"open_by_h", "H opens a C-H of the edge", &SurfaceRateConstants::openByH},
    {"close_by_h2", "H2 closes a radical of the edge", &SurfaceRateConstants::closeByH2},
    {"open_by_oh", "OH opens a C-H of the edge", &SurfaceRateConstants::openByOH},
    {"close_by_h2o", "H2O closes a radical of the edge", &SurfaceRateConstants::closeByH2O},
    {"close_by_h", "H closes a radical of the edge", &SurfaceRateConstants::closeByH},
    {"growth_armchair", "C2H2 + radical armchair: a ring grows", &SurfaceRateConstants::growth}};

std::string textOf(const RateSum& sum) {
  std::string text;
  for (const RateConstant& k : sum) text += fmt::format("{}{}, {}, {}", text.empty() ? "" : ", ", k.A, k.n, k.E);
  return "[" + text + "]";
}

// With the prefix "rates." in a deck, without in a file.
DeckSchema rateTable(const std::string& prefix) {
  DeckSchema schema;
  const PahRateConstants published;
  const std::string law = ": A T^n exp(-E/(R T)) as [A, n, E], cm^3, mol, s and kcal";
  for (const EdgeRateKey& key : edgeRateKeys)
    schema.add(numberKey(prefix + key.name, std::string(key.description) + law + ".")
                   .list(3)
                   .byDefault(textOf({published.surface.*key.value})));
  for (const PahRateName& name : pahRateNames)
    schema.add(
        numberKey(prefix + name.name, std::string(name.description) + law + "; more threes are channels that add up.")
            .list()
            .byDefault(textOf(published.*name.value)));
  schema.add(numberKey(prefix + "five_equilibrium",
                       "Equilibrium constant of five_add_h, by which its reverse (1/s) follows" + law + ".")
                 .list(3)
                 .byDefault(textOf({published.fiveEquilibrium})));
  for (const PahFactorName& name : pahFactorNames)
    schema.add(numberKey(prefix + name.name, std::string(name.description) + ".")
                   .byDefault(fmt::format("{}", published.*name.value))
                   .above(0));
  return schema;
}

RateSum readSum(const Deck& deck, const std::string& key) {
  const std::vector<double> numbers = deck.numbers(key);
  if (numbers.empty() || numbers.size() % 3 != 0)
    throw deck.error(key, fmt::format("expected three numbers A, n, E for each channel, found {}", numbers.size()));
  RateSum sum;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    if (!(numbers[i] >= 0)) throw deck.error(key, "expected a factor A of zero or more");
    sum.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return sum;
}

// What this deck gives.
void readTable(const Deck& deck, const std::string& prefix, PahRateConstants& constants) {
  const auto given = [&](const char* name) { return deck.isGiven(prefix + name); };
  for (const EdgeRateKey& key : edgeRateKeys)
    if (given(key.name)) constants.surface.*key.value = readSum(deck, prefix + key.name)[0];
  for (const PahRateName& name : pahRateNames)
    if (given(name.name)) constants.*name.value = readSum(deck, prefix + name.name);
  if (given("five_equilibrium")) {
    const std::string key = prefix + "five_equilibrium";
    constants.fiveEquilibrium = readSum(deck, key)[0];
    if (!(constants.fiveEquilibrium.A > 0)) throw deck.error(key, "expected a factor A above zero");
  }
  for (const PahFactorName& name : pahFactorNames)
    if (given(name.name)) constants.*name.value = deck.number(prefix + name.name);
}

}  // namespace

void addPahRateKeys(DeckSchema& schema, const std::string& section) {
  schema.section(section, Presence::defaulted,
                 "Rate constants of the processes; the defaults and their sources are those of docs/theory/pah.md.");
  schema.add(stringKey(section + ".file",
                       "YAML file of rate constants by the names below, relative to the deck; those that it leaves out "
                       "have their defaults, those that the deck has too are the deck's.")
                 .optional());
  schema.add(rateTable(section + "."));
}

PahRateConstants readPahRates(const Deck& deck, const std::string& section) {
  PahRateConstants constants;
  if (const std::string file = section + ".file"; deck.has(file))
    deck.at(file, [&] {
      const Deck table = Deck::load(deck.resolvePath(deck.string(file)), {}, rateTable(""));
      readTable(table, "", constants);
      return 0;
    });
  readTable(deck, section + ".", constants);
  return constants;
}

std::vector<std::string> pahProcessNames() {
  std::vector<std::string> names;
  for (const PahProcessRow& process : pahProcesses) names.emplace_back(process.name);
  return names;
}

std::array<bool, pahProcessCount> readPahProcesses(const Deck& deck, const std::string& key) {
  std::array<bool, pahProcessCount> active{};
  if (!deck.has(key)) {
    active.fill(true);
    return active;
  }
  for (const std::string& name : deck.strings(key))
    active[static_cast<std::size_t>(
        std::ranges::find(pahProcesses, name, [](const PahProcessRow& row) { return std::string(row.name); }) -
        pahProcesses.begin())] = true;
  return active;
}

}  // namespace lampblack::app
