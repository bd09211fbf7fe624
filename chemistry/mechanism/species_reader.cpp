#include "chemistry/mechanism/species_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lampblack {

namespace {

constexpr MechanismUnit kKelvin{1.0, {0, 0, 0, 1, 0}};
constexpr MechanismUnit kPascal{1.0, {1, -1, -2, 0, 0}};
constexpr MechanismUnit kMetre{1.0, {0, 1, 0, 0, 0}};
constexpr MechanismUnit kCubicMetre{1.0, {0, 3, 0, 0, 0}};

void readComposition(const YamlAccess& yaml, const YAML::Node& node, const std::string& owner,
                     std::span<const Element> elements, Species& species) {
  const YamlMap composition(yaml, node, owner + ", 'composition'");
  species.atoms.assign(elements.size(), 0.0);
  for (const auto& entry : composition.entries()) {
    const auto found =
        std::find_if(elements.begin(), elements.end(), [&](const auto& e) { return e.name == entry.key; });
    if (found == elements.end())
      yaml.fail(entry.keyNode, fmt::format("{}: element '{}' is not declared in the phase", owner, entry.key));
    const double count = yaml.number(entry.value, composition.what());
    if (count < 0 && entry.key != "E")  // a cation lacks electrons
      yaml.fail(entry.value, fmt::format("{}: expected zero or more atoms", owner));
    species.atoms[static_cast<std::size_t>(found - elements.begin())] = count;
  }
}

// The ranges and rows of coefficients of a NASA polynomial.
template <std::size_t N>
struct Polynomials {
  std::vector<double> temperatures;
  std::vector<std::array<double, N>> rows;
};

template <std::size_t N>
Polynomials<N> readPolynomials(const YamlAccess& yaml, const YamlMap& map, std::string_view expected) {
  Polynomials<N> result;
  const auto &ranges = map.at("temperature-ranges"), &data = map.at("data");
  yaml.requireSequence(ranges, map.what() + ", 'temperature-ranges'");
  yaml.requireSequence(data, map.what() + ", 'data'");
  for (const auto& bound : ranges) result.temperatures.push_back(yaml.quantity(bound, kKelvin, 1.0, map.what()));
  for (const auto& row : data) {
    yaml.requireSequence(row, map.what() + ", 'data'");
    if (row.size() != N) yaml.fail(row, fmt::format("{}: expected {} coefficients", map.what(), expected));
    std::array<double, N> a{};
    std::size_t i = 0;
    for (const auto& value : row) a[i++] = yaml.number(value, map.what());
    result.rows.push_back(a);
  }
  const auto& T = result.temperatures;
  if (result.rows.empty() || T.size() != result.rows.size() + 1)
    yaml.fail(ranges,
              fmt::format("{}: expected one temperature more than ranges of {} coefficients", map.what(), expected));
  if (!(T.front() >= 0) || std::adjacent_find(T.begin(), T.end(), std::greater_equal<>()) != T.end())
    yaml.fail(ranges, fmt::format("{}: expected rising temperatures", map.what()));
  return result;
}

void readThermo(const YamlAccess& yaml, UnitSystem units, const YAML::Node& node, const std::string& owner,
                Species& species) {
  const YamlMap map(yaml, node, owner + ", 'thermo'");
  if (const auto* own = map.find("units")) units = yaml.units(*own, units);
  const auto& model = map.at("model");
  const auto& name = yaml.text(model, map.what());
  if (name != "NASA7" && name != "NASA9")
    yaml.fail(model, fmt::format("{}: model '{}' is not supported; supported are NASA7 and NASA9", map.what(), name));
  map.allowOnly({"model", "units", "temperature-ranges", "data", "note", "reference-pressure", "comment", "reference"});
  // The standard state is the ideal gas at 1 atm: s(1 atm)/R = s(p)/R + ln(p/1 atm).
  double shift = 0;
  if (const auto* p = map.find("reference-pressure")) {
    const double pressure = yaml.quantity(*p, kPascal, units.pressure(), map.what());
    if (!(pressure > 0) || !std::isfinite(pressure))
      yaml.fail(*p, fmt::format("{}: expected a positive reference pressure", map.what()));
    shift = std::log(pressure / constants::oneAtmosphere);
  }
  auto& thermo = species.thermo;
  std::vector<double> T;
  if (name == "NASA7") {
    auto polynomials = readPolynomials<7>(yaml, map, "seven");
    if (polynomials.rows.size() > 2)
      yaml.fail(map.at("data"), fmt::format("{}: expected one or two ranges of temperature", map.what()));
    for (auto& row : polynomials.rows) row[6] += shift;
    thermo.low = polynomials.rows.front();
    thermo.high = polynomials.rows.back();
    T = std::move(polynomials.temperatures);
  } else {
    auto polynomials = readPolynomials<9>(yaml, map, "nine");
    for (auto& row : polynomials.rows) row[8] += shift;
    T = polynomials.temperatures;
    species.nasa9 = Nasa9{std::move(polynomials.temperatures), std::move(polynomials.rows)};
  }
  thermo.minTemperature = T.front();
  thermo.midTemperature = T[1];
  thermo.maxTemperature = T.back();
}

// Numbers that stand alone are in Angstrom, Debye and K, whatever the units of the file: so the format has it.
TransportData readTransport(const YamlAccess& yaml, const YAML::Node& node, const std::string& owner) {
  const YamlMap map(yaml, node, owner + ", 'transport'");
  const auto& model = map.at("model");
  if (yaml.text(model, map.what()) != "gas")
    yaml.fail(model, fmt::format("{}: model '{}' is not supported; supported is gas", map.what(), model.Scalar()));
  map.allowOnly({"model", "geometry", "well-depth", "diameter", "dipole", "polarizability", "rotational-relaxation",
                 "acentric-factor", "dispersion-coefficient", "quadrupole-polarizability", "note", "comment",
                 "reference"});
  TransportData t;
  const auto& geometry = map.at("geometry");
  const auto& shape = yaml.text(geometry, map.what());
  if (shape == "atom")
    t.shape = MoleculeShape::Atom;
  else if (shape == "linear")
    t.shape = MoleculeShape::Linear;
  else if (shape == "nonlinear")
    t.shape = MoleculeShape::Nonlinear;
  else
    yaml.fail(geometry, fmt::format("{}: expected atom, linear or nonlinear, found '{}'", map.what(), shape));
  t.wellDepth = yaml.quantity(map.at("well-depth"), kKelvin, 1.0, map.what());
  t.diameter = yaml.quantity(map.at("diameter"), kMetre, 1e-10, map.what());
  t.dipole = constants::debye * map.number("dipole", 0.0);
  if (const auto* volume = map.find("polarizability"))
    t.polarizability = yaml.quantity(*volume, kCubicMetre, 1e-30, map.what());
  t.rotationalRelaxation = map.number("rotational-relaxation", 0.0);
  if (!(t.wellDepth > 0) || !(t.diameter > 0))
    yaml.fail(node, map.what() + ": expected positive well-depth and diameter");
  if (t.dipole < 0 || t.polarizability < 0 || t.rotationalRelaxation < 0)
    yaml.fail(node, map.what() + ": expected dipole, polarizability and rotational-relaxation of zero or more");
  return t;
}

}  // namespace

Species readSpecies(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node,
                    std::span<const Element> elements) {
  YamlMap map(yaml, node, "species");
  Species species;
  species.name = yaml.text(map.at("name"), "species name");
  species.line = YamlAccess::line(node);
  const auto what = fmt::format("species '{}'", species.name);
  map.rename(what);
  // The equation of state and the critical data are for real gases; an ideal-gas phase does not use them.
  map.allowOnly({"name", "composition", "thermo", "transport", "units", "note", "equation-of-state",
                 "critical-parameters", "comment", "reference"});
  const auto* own = map.find("units");
  readComposition(yaml, map.at("composition"), what, elements, species);
  readThermo(yaml, own != nullptr ? yaml.units(*own, units) : units, map.at("thermo"), what, species);
  if (const auto* transport = map.find("transport")) species.transport = readTransport(yaml, *transport, what);
  return species;
}

}  // namespace lampblack
