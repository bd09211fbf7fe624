// What a flow deck asks to be written, and when.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "app/deck/gas_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr double mostPoints = 100000;  // of a line

// Names become those of files and groups.
void requireFileName(const Deck& deck, const std::string& key, const std::string& name) {
  if (fileNameOf(name) != name)
    throw deck.error(key,
                     fmt::format("the name '{}' is to be that of a file: expected letters, digits, _, - and +", name));
}

Vector3 readPlace(const Deck& deck, const std::string& key, const FlowCase& flowCase) {
  const std::vector<double> given = deck.quantities(key);
  const AxisNames axes = axisNames(flowCase);
  if (given.size() != axes.size())
    throw deck.error(key,
                     fmt::format("expected {} coordinates, found {}: {}", axes.size(), given.size(), axesText(axes)));
  Vector3 place{};
  std::ranges::copy(given, place.begin());
  return place;
}

std::vector<std::size_t> readTableBoundaries(const Deck& deck, const FlowCase& flowCase) {
  const std::string key = "output.boundaries";
  std::vector<std::string> names = deck.strings(key), there;
  for (const BoundaryCondition& boundary : flowCase.boundaries) there.push_back(boundary.name);
  if (names == std::vector<std::string>{"all"} && std::ranges::find(there, "all") == there.end()) names = there;
  std::vector<std::size_t> numbers;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(there, name);
    if (found == there.end())
      throw deck.error(key, fmt::format("'{}' is no boundary of this deck that the gas meets; these are: {}", name,
                                        fmt::join(there, ", ")));
    const auto number = static_cast<std::size_t>(found - there.begin());
    if (std::ranges::find(numbers, number) != numbers.end())
      throw deck.error(key, fmt::format("'{}' is there twice", name));
    for (const std::size_t other : numbers)
      if (fileNameOf(there[other]) == fileNameOf(name))
        throw deck.error(key, fmt::format("the tables of '{}' and '{}' would have one name, boundary_{}.csv; rename "
                                          "one of them",
                                          there[other], name, fileNameOf(name)));
    numbers.push_back(number);
  }
  return numbers;
}

// The mass fractions of a boundary that the section names.
const std::vector<double>& streamNamed(const Deck& deck, const std::string& key, const FlowCase& flowCase) {
  std::vector<std::string> streams;
  for (const BoundaryCondition& boundary : flowCase.boundaries) {
    if (boundary.Y.empty()) continue;
    if (boundary.name == deck.string(key)) return boundary.Y;
    streams.push_back(boundary.name);
  }
  throw deck.error(key, fmt::format("'{}' is no boundary with a gas of its own; these are: {}", deck.string(key),
                                    fmt::join(streams, ", ")));
}

DeckKeys<CheckpointControl> stepsBetweenCheckpoints() {
  DeckKeys<CheckpointControl> keys("checkpoint");
  keys.integer("steps", &CheckpointControl::steps, rules().optional().atLeast(1),
               "Time steps between two checkpoints, from which `lampblack run --restart` continues a run that was "
               "interrupted; absent: checkpoints by wall time and on request only.");
  return keys;
}

}  // namespace

void addStreamKeys(SectionKeys& keys, const std::string& section) {
  keys.text(joinedPath(section, "fuel"), rules(), "Inlet or outlet whose gas has a mixture fraction of one.");
  keys.text(joinedPath(section, "oxidizer"), rules(), "Inlet or outlet whose gas has a mixture fraction of zero.");
}

MixtureFraction readMixtureFraction(const Deck& deck, const std::string& section, const FlowCase& flowCase) {
  const auto& fuel = streamNamed(deck, section + ".fuel", flowCase);
  const auto& oxidizer = streamNamed(deck, section + ".oxidizer", flowCase);
  return deck.at(section, [&] { return MixtureFraction(*flowCase.mechanism, fuel, oxidizer); });
}

std::string fileNameOf(std::string name) {
  for (char& c : name)
    if (const auto byte = static_cast<unsigned char>(c); std::isalnum(byte) == 0 && c != '_' && c != '-' && c != '+')
      c = '_';
  return name;
}

void addOutputKeys(DeckSchema& schema) {
  SectionKeys keys("output");
  keys.quantity("interval", units::time, rules().optional().above(0).onlyWith("time.mode", {"transient"}),
                "Time between field outputs; the last state is always written.");
  keys.integer("history_steps", rules().byDefault("1").atLeast(1),
               "Number of time steps, and of iterations, between two rows of the history.");
  keys.text("species", rules().list().byDefault("[all]"),
            "Species whose mole fractions are written; 'all' writes every one.");
  keys.boolean("wall_distance", rules().byDefault("false"),
               "Whether the distance of each cell's centre from the nearest wall is a field of the results, "
               "wall_distance. Boundaries of the type wall count.");
  keys.section("mixture_fraction", Presence::optional,
               "Bilger's mixture fraction as a field of the results, mixture_fraction, by two streams of the deck.");
  addStreamKeys(keys, "mixture_fraction");
  keys.integer(
      "compression", rules().byDefault("0").atLeast(0).atMost(FileStorage::mostCompression),
      "How hard the fields of results.h5 are compressed, from 1, fast, to 9, small; 0: not at all. No value changes.");
  keys.integer("writers", rules().optional().atLeast(1),
               "Number of ranks that collect the fields of the others and write them to results.h5, at most as many as "
               "there are; few are better for some parallel file systems. Absent: each rank writes a share.");
  keys.section("probes.*", Presence::optional,
               "A place whose gas is written with each row of the history, to the table tables/probe_<name>.csv.");
  keys.quantity("probes.*.at", units::length, rules().list(),
                "Coordinates of the probe, '[10 mm, 5 mm]', in space three.");
  keys.section(
      "lines.*", Presence::optional,
      "A straight line along which the gas is written with each field output, to the table tables/line_<name>.csv.");
  keys.quantity("lines.*.from", units::length, rules().list(), "Coordinates of the first point of the line.");
  keys.quantity("lines.*.to", units::length, rules().list(), "Coordinates of the last point of the line.");
  keys.integer("lines.*.points", rules().byDefault("101").atLeast(2).atMost(mostPoints),
               "Number of points of the line, at even distances, both ends among them.");
  keys.text(
      "quantities", rules().list().byDefault("[]"),
      "Fields that probes and lines have, by their names in the results (velocity: all of its components); empty: "
      "temperature, velocity, density, pressure, mole fractions of output.species and the soot's volume fraction.");
  keys.text("boundaries", rules().list().byDefault("[]"),
            "Boundaries of which mass flow, heat, forces and what walls take of the particles are written with each "
            "row of the history, to the tables tables/boundary_<name>.csv, in whose names a character that is no "
            "letter, digit, _, - or + becomes _; 'all': all but periodic ones. With each field output "
            "tables/wall_<name>.csv has friction, heat flux and y+ of each face of a wall without slip, "
            "tables/deposit_<name>.csv what each face of a wall that takes particles has taken.");
  schema.add(keys.schema()).add(stepsBetweenCheckpoints().schema()).add(checkpointKeys("a later end").schema());
}

void readOutput(const Deck& deck, FlowCase& flowCase) {
  OutputControl& output = flowCase.output;
  output.interval = deck.optionalQuantity("output.interval").value_or(flowCase.time.end);
  output.historySteps = deck.integer<int>("output.history_steps");
  output.wallDistance = deck.boolean("output.wall_distance");
  if (output.wallDistance && std::ranges::none_of(flowCase.boundaries, [](const BoundaryCondition& boundary) {
        return boundary.kind == BoundaryKind::Wall;
      }))
    throw deck.error("output.wall_distance", "no boundary of this deck is a wall; expected false");
  if (output.wallDistance && flowCase.turbulence.ignoresWalls)
    throw deck.error("output.wall_distance", "expected false where 'turbulence.wall_distance' is infinite");
  const std::string mixture = "output.mixture_fraction";
  if (deck.has(mixture)) flowCase.output.mixtureFraction = readMixtureFraction(deck, mixture, flowCase);
  output.storage = {deck.integer<int>("output.compression"), deck.optionalInteger<int>("output.writers").value_or(0)};
  output.species = readSpeciesList(deck, "output.species", *flowCase.mechanism);
  static_cast<CheckpointTimes&>(flowCase.checkpoint) = checkpointKeys("a later end").read(deck);
  stepsBetweenCheckpoints().read(deck, flowCase.checkpoint, "checkpoint");
  OutputTables& tables = output.tables;
  tables.deck = deck;
  tables.quantities = deck.strings("output.quantities");
  tables.boundaries = readTableBoundaries(deck, flowCase);
  for (const std::string& name : deck.children("output.probes")) {
    const std::string section = "output.probes." + name;
    requireFileName(deck, section, name);
    tables.probes.push_back({name, readPlace(deck, section + ".at", flowCase)});
  }
  for (const std::string& name : deck.children("output.lines")) {
    const std::string section = "output.lines." + name;
    requireFileName(deck, section, name);
    const OutputTables::Line line{name, readPlace(deck, section + ".from", flowCase),
                                  readPlace(deck, section + ".to", flowCase), deck.integer<int>(section + ".points")};
    if (line.from == line.to) throw deck.error(section, "expected two ends that differ");
    tables.lines.push_back(line);
  }
  for (const std::string& name : deck.children("particles.regions")) {
    const std::string section = "particles.regions." + name;
    requireFileName(deck, section, name);
    const OutputTables::Region region{name, readPlace(deck, section + ".from", flowCase),
                                      readPlace(deck, section + ".to", flowCase)};
    for (std::size_t axis = 0; axis < axisNames(flowCase).size(); ++axis)
      if (!(region.from[axis] < region.to[axis]))
        throw deck.error(section + ".to", fmt::format("expected more than 'from' along {}", axisNames(flowCase)[axis]));
    tables.regions.push_back(region);
  }
}

}  // namespace lampblack::app::flowcase
