#include "app/deck/initial_distribution.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/deck_keys.hpp"
#include "io/table_columns.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

namespace lampblack::app {
namespace {

const std::vector<std::string> spread{"monodisperse", "exponential", "lognormal"};

double sphereVolume(double diameter) {
  return constants::pi / 6 * diameter * diameter * diameter;
}

// Volumes of particles (m3), given as such or by diameters.
std::vector<double> readVolumes(const TextTable& table, const TableColumns& columns, std::size_t column) {
  const std::string& unit = columns.unit(column);
  const bool isVolume = !unit.empty() && unit != "1" && units::parseUnit(unit).dimension == units::volume;
  std::vector<double> sizes = columns.read(column, isVolume ? units::volume : units::length);
  for (std::size_t row = 0; row < sizes.size(); ++row) {
    if (!(sizes[row] > 0))
      throw InputError(
          fmt::format("line {}: expected a size above zero as '{}'", table.lines[row], columns.name(column)));
    if (!isVolume) sizes[row] = sphereVolume(sizes[row]);
  }
  return sizes;
}

// The interval of each size reaches half-way, by the logarithm, to its neighbours, at the ends as far to the other
// side. `unit`: by how much the coordinate of the densities grows where the volume grows by the factor e.
std::vector<SizeInterval> intervalsAround(std::vector<std::pair<double, double>> densities, double unit) {
  if (densities.size() < 2) throw InputError("densities need two sizes at least; one has no width");
  std::ranges::sort(densities);
  const std::size_t last = densities.size() - 1;
  const auto between = [&](std::size_t i) { return std::sqrt(densities[i].first * densities[i + 1].first); };
  std::vector<SizeInterval> intervals;
  for (std::size_t i = 0; i <= last; ++i) {
    const auto [volume, density] = densities[i];
    if (i < last && !(densities[i + 1].first > volume)) throw InputError("two rows have the same size");
    const double from = i > 0 ? between(i - 1) : volume * volume / between(0);
    const double to = i < last ? between(i) : volume * volume / between(last - 1);
    intervals.push_back({from, to, density * unit * std::log(to / from)});
  }
  return intervals;
}

InitialPopulation populationOfTable(const TextTable& table) {
  const TableColumns columns(table);
  const auto from = columns.find({"from"}), to = columns.find({"to"}), number = columns.find({"number"});
  const auto size = columns.find({"diameter", "d", "D", "dp", "volume", "v", "V"});
  const auto decadic = columns.find({"dn/dlogd", "dn/dlogdp", "dn/dlog10d", "dn/dlog10dp", "dn/dlog(d)", "dn/dlog(dp)",
                                     "dn/dlog10(d)", "dn/dlog10(dp)"});
  const auto natural = columns.find({"dn/dlnd", "dn/dlndp", "dn/dln(d)", "dn/dln(dp)"});
  const std::size_t densities = (decadic ? 1 : 0) + (natural ? 1 : 0);
  const bool isBinned = from && to && number;
  if (isBinned == (size && densities > 0) || densities > 1)
    throw InputError(
        "expected columns 'from', 'to' and 'number', or 'diameter' and one of 'dN/dlogd' (to the base 10) and "
        "'dN/dlnd', "
        "with their units: \"from [nm],to [nm],number [1/cm^3]\"");
  if (table.rows.empty()) throw InputError("the table has no rows");
  std::vector<SizeInterval> intervals;
  if (isBinned) {
    const auto lower = readVolumes(table, columns, *from), upper = readVolumes(table, columns, *to);
    const auto numbers = columns.read(*number, units::perVolume);
    for (std::size_t row = 0; row < lower.size(); ++row) intervals.push_back({lower[row], upper[row], numbers[row]});
    std::ranges::sort(intervals, {}, &SizeInterval::from);
    return tabulated(std::move(intervals));
  }
  const auto volumes = readVolumes(table, columns, *size);
  const auto values = columns.read(decadic ? *decadic : *natural, units::perVolume);
  std::vector<std::pair<double, double>> rows;
  for (std::size_t row = 0; row < volumes.size(); ++row) rows.emplace_back(volumes[row], values[row]);
  // The diameter grows by a third of the logarithm of the volume.
  return tabulated(intervalsAround(std::move(rows), decadic ? 1 / (3 * std::log(10.0)) : 1.0 / 3));
}

}  // namespace

void addParticleSize(DeckSchema& schema, const std::string& section, const std::string& what,
                     const std::vector<DeckCondition>& conditions) {
  DeckKey volume = quantityKey(section + ".volume", units::volume, "Volume " + what + "; either this or the diameter.");
  DeckKey diameter = quantityKey(section + ".diameter", units::length,
                                 "Diameter of the sphere of that volume, in place of the volume.");
  for (DeckKey* key : {&volume, &diameter}) {
    key->optional().above(0).conditions = conditions;
    schema.add(*key);
  }
}

double readParticleSize(const Deck& deck, const std::string& section, const std::string& who) {
  if (deck.has(section + ".volume") == deck.has(section + ".diameter"))
    throw deck.error(section, fmt::format("{} needs either 'volume' or 'diameter'", who));
  if (const auto volume = deck.optionalQuantity(section + ".volume")) return *volume;
  return sphereVolume(deck.quantity(section + ".diameter"));
}

void addDistribution(DeckSchema& schema, const std::string& at, Presence presence) {
  SectionKeys keys(at);
  const std::string key = at + ".distribution";
  DeckKey type = choiceKey(key, {"none", "monodisperse", "exponential", "lognormal", "table"},
                           "Distribution of the volumes of the particles at time zero (lognormal: of their diameters); "
                           "table: from a file; none: no particles.")
                     .byDefault("none");
  DeckKey number = quantityKey(at + ".number", units::perVolume, "Number density of the particles at time zero.")
                       .optional()
                       .above(0);
  if (presence == Presence::optional) {
    type = choiceKey(key, {"monodisperse", "exponential", "lognormal", "table", "none"},
                     "Distribution of the volumes of the spheres (lognormal: of their diameters); table: from a file; "
                     "none: no particles. Absent: all are alike, of the units given, or none are there.")
               .optional();
    number.doc = "Number density of the spheres that there are at the start; a table has its own.";
  } else {
    number.onlyWith(key, spread);
  }
  keys.add(type);
  keys.add(number);
  addParticleSize(keys.schema(), at, "of all (monodisperse), mean (exponential) or median by number (lognormal)",
                  {{key, spread}});
  keys.number("geometric_deviation", rules().optional().above(1).atMost(100).onlyWith(key, {"lognormal"}),
              "Geometric standard deviation of the diameter.");
  keys.text("file", rules().optional().onlyWith(key, {"table"}),
            "CSV file, relative to the deck, with columns 'from [nm],to [nm],number [1/cm^3]' or 'diameter "
            "[nm],dN/dlogd [1/cm^3]', the logarithm to the base 10 (dN/dlnd: the natural one). Sizes are diameters, or "
            "volumes where their unit is one; a row's number lies evenly over the logarithm.");
  schema.add(keys.schema());
}

InitialPopulation readDistribution(const Deck& deck, const std::string& section) {
  using Distribution = InitialPopulation::Distribution;
  const std::string type = deck.optionalString(section + ".distribution").value_or("none");
  InitialPopulation initial;
  if (type == "none" && deck.has(section + ".number"))
    throw deck.error(section, "particles at the start need a 'distribution' of their sizes");
  if (type == "none") return initial;
  const std::string who = fmt::format("the initial distribution {}", type);
  const auto require = [&](const char* key) {
    if (!deck.has(section + "." + key)) throw deck.error(section, fmt::format("{} needs the key '{}'", who, key));
    return section + "." + key;
  };
  if (type == "table") {
    if (deck.has(section + ".number"))
      throw deck.error(section + ".number", "the numbers are those of the table; leave this key out");
    const std::string key = require("file");
    return deck.at(key, [&] { return readSizeTable(deck.resolvePath(deck.string(key))); });
  }
  initial.distribution = type == "monodisperse"  ? Distribution::monodisperse
                         : type == "exponential" ? Distribution::exponential
                                                 : Distribution::lognormal;
  initial.number = deck.quantity(require("number"));
  initial.volume = readParticleSize(deck, section, who);
  if (type == "lognormal") initial.geometricDeviation = deck.number(require("geometric_deviation"));
  return initial;
}

void addInitialDistribution(DeckSchema& schema, const std::string& section) {
  addDistribution(schema, section, Presence::defaulted);
  schema.section(
      section + "[]", Presence::defaulted,
      fmt::format("In place of the keys of `{}` a list of maps, one a mode: the particles are their sum.", section));
  addDistribution(schema, section + "[]", Presence::defaulted);
}

std::vector<std::string> itemsOf(const Deck& deck, const std::string& section) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < deck.size(section); ++i) items.push_back(fmt::format("{}[{}]", section, i));
  const bool isMap = !deck.isGiven(section) || !deck.children(section).empty();
  if (items.empty() && isMap) items.push_back(section);
  return items;
}

InitialPopulation readInitialDistribution(const Deck& deck, const std::string& section) {
  std::vector<InitialPopulation> modes;
  for (const std::string& item : itemsOf(deck, section)) modes.push_back(readDistribution(deck, item));
  return sumOf(modes);
}

std::string missedMoments(const InitialPopulation& initial, const std::array<double, 4>& moments) {
  constexpr double largestMiss = 0.1;
  std::vector<std::string> missed;
  for (const std::size_t k : {1U, 2U, 3U}) {
    const double known = initialMoment(initial, static_cast<double>(k)), part = moments[k] / known;
    if (known > 0 && std::abs(part - 1) > largestMiss) missed.push_back(fmt::format("M{} {:.2g}", k, part));
  }
  return fmt::format("{}", fmt::join(missed, ", "));
}

InitialPopulation readSizeTable(const std::filesystem::path& file) {
  const std::string text = readTextFile(file, "a table of sizes");
  try {
    return populationOfTable(readCsv(text));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace lampblack::app
