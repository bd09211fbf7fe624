#include "chemistry/mechanism/species_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

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

// cp = A + B t + C t^2 + D t^3 + E/t^2, h = A t + B t^2/2 + C t^3/3 + D t^4/4 - E/t + F, s = A ln t + B t + C t^2/2 +
// D t^3/3 - E/(2 t^2) + G with t = T/1000 K, in J/mol/K and kJ/mol: NASA-9 polynomials written in another way.
std::array<double, 9> nasa9FromShomate(const std::array<double, 7>& c) {
  constexpr double R = constants::gasConstant;
  return {1e6 * c[4] / R,
          0.0,
          c[0] / R,
          1e-3 * c[1] / R,
          1e-6 * c[2] / R,
          1e-9 * c[3] / R,
          0.0,
          1e3 * c[5] / R,
          (c[6] - c[0] * std::log(1e3)) / R};
}

class ThermoReader {
 public:
  ThermoReader(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node, const std::string& owner,
               Species& species, std::vector<std::string>& warnings)
      : yaml_(yaml), units_(units), map_(yaml, node, owner + ", 'thermo'"), species_(species), warnings_(warnings) {
    if (const auto* own = map_.find("units")) units_ = yaml.units(*own, units_);
  }

  void read() {
    const auto& model = map_.at("model");
    const auto& name = yaml_.text(model, map_.what());
    if (name == "constant-cp") return readConstantCp();
    if (name != "NASA7" && name != "NASA9" && name != "Shomate")
      yaml_.fail(model, fmt::format("{}: model '{}' is not supported; supported are NASA7, NASA9, Shomate and "
                                    "constant-cp",
                                    map_.what(), name));
    map_.warnOfOthers(
        {"model", "units", "temperature-ranges", "data", "note", "reference-pressure", "comment", "reference"},
        warnings_);
    if (name == "NASA7")
      readNasa7();
    else if (name == "NASA9")
      readNasa9();
    else
      readShomate();
  }

 private:
  // What to add to s/R: the standard state is the ideal gas at 1 atm, s(1 atm)/R = s(p)/R + ln(p/1 atm).
  double entropyShift() const {
    const auto* p = map_.find("reference-pressure");
    if (p == nullptr) return 0;
    const double pressure = yaml_.quantity(*p, kPascal, units_.pressure(), map_.what());
    if (!(pressure > 0) || !std::isfinite(pressure))
      yaml_.fail(*p, fmt::format("{}: expected a positive reference pressure", map_.what()));
    return std::log(pressure / constants::oneAtmosphere);
  }

  void requireFinite(std::span<const double> coefficients) const {
    for (const double a : coefficients)
      if (!std::isfinite(a)) yaml_.fail(map_.node(), map_.what() + ": the values are out of range");
  }

  template <std::size_t N>
  Polynomials<N> oneOrTwoRanges() const {
    auto polynomials = readPolynomials<N>(yaml_, map_, "seven");
    if (polynomials.rows.size() > 2)
      yaml_.fail(map_.at("data"), fmt::format("{}: expected one or two ranges of temperature", map_.what()));
    return polynomials;
  }

  void setRange(const std::vector<double>& T) {
    species_.thermo.minTemperature = T.front();
    species_.thermo.midTemperature = T[1];
    species_.thermo.maxTemperature = T.back();
  }

  void readNasa7() {
    auto polynomials = oneOrTwoRanges<7>();
    for (auto& row : polynomials.rows) row[6] += entropyShift();
    species_.thermo.low = polynomials.rows.front();
    species_.thermo.high = polynomials.rows.back();
    setRange(polynomials.temperatures);
  }

  void readNasa9() {
    auto polynomials = readPolynomials<9>(yaml_, map_, "nine");
    for (auto& row : polynomials.rows) row[8] += entropyShift();
    setRange(polynomials.temperatures);
    species_.nasa9 = Nasa9{std::move(polynomials.temperatures), std::move(polynomials.rows)};
  }

  void readShomate() {
    auto polynomials = oneOrTwoRanges<7>();
    setRange(polynomials.temperatures);
    species_.nasa9 = Nasa9{std::move(polynomials.temperatures), {}};
    for (const auto& row : polynomials.rows) {
      species_.nasa9->ranges.push_back(nasa9FromShomate(row));
      species_.nasa9->ranges.back()[8] += entropyShift();
      requireFinite(species_.nasa9->ranges.back());
    }
  }

  double valueOf(std::string_view key, const MechanismUnit& unit, double factor, double standard) const {
    const auto* node = map_.find(key);
    return node == nullptr ? standard : yaml_.quantity(*node, unit, factor, fmt::format("{}, '{}'", map_.what(), key));
  }

  // h = h0 + cp0 (T - T0), s = s0 + cp0 ln(T/T0): a NASA-7 polynomial of one range.
  void readConstantCp() {
    map_.warnOfOthers({"model", "units", "T0", "h0", "s0", "cp0", "T-min", "T-max", "note", "reference-pressure",
                       "comment", "reference"},
                      warnings_);
    constexpr double R = constants::gasConstant;
    constexpr MechanismUnit joule{1.0, {1, 2, -2, 0, -1}}, joulePerKelvin{1.0, {1, 2, -2, -1, -1}};
    const double T0 = valueOf("T0", kKelvin, 1.0, 298.15);
    const double cp = valueOf("cp0", joulePerKelvin, units_.molarEnergy(), 0.0) / R;
    const double h = valueOf("h0", joule, units_.molarEnergy(), 0.0) / R;
    const double s = valueOf("s0", joulePerKelvin, units_.molarEnergy(), 0.0) / R;
    const double least = valueOf("T-min", kKelvin, 1.0, 0.0);
    const double largest = valueOf("T-max", kKelvin, 1.0, std::numeric_limits<double>::max());
    if (!(T0 > 0)) yaml_.fail(map_.node(), map_.what() + ": expected a positive 'T0'");
    if (!(least >= 0 && least < largest))
      yaml_.fail(map_.node(), map_.what() + ": expected 'T-min' of zero or more below 'T-max'");
    auto& thermo = species_.thermo;
    thermo.low = {cp, 0, 0, 0, 0, h - cp * T0, s - cp * std::log(T0) + entropyShift()};
    requireFinite(thermo.low);
    thermo.high = thermo.low;
    setRange({least, largest});
  }

  const YamlAccess& yaml_;
  UnitSystem units_;
  YamlMap map_;
  Species& species_;
  std::vector<std::string>& warnings_;
};

// Numbers that stand alone are in Angstrom, Debye and K, whatever the units of the file: so the format has it.
TransportData readTransport(const YamlAccess& yaml, const YAML::Node& node, const std::string& owner,
                            std::vector<std::string>& warnings) {
  const YamlMap map(yaml, node, owner + ", 'transport'");
  const auto& model = map.at("model");
  if (yaml.text(model, map.what()) != "gas")
    yaml.fail(model, fmt::format("{}: model '{}' is not supported; supported is gas", map.what(), model.Scalar()));
  map.warnOfOthers(
      {"model", "geometry", "well-depth", "diameter", "dipole", "polarizability", "rotational-relaxation",
       "acentric-factor", "dispersion-coefficient", "quadrupole-polarizability", "note", "comment", "reference"},
      warnings);
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
                    std::span<const Element> elements, std::vector<std::string>& warnings) {
  YamlMap map(yaml, node, "species");
  Species species;
  species.name = yaml.text(map.at("name"), "species name");
  species.line = YamlAccess::line(node);
  const auto what = fmt::format("species '{}'", species.name);
  map.rename(what);
  // The equation of state and the critical data are for real gases; an ideal-gas phase does not use them.
  map.warnOfOthers({"name", "composition", "thermo", "transport", "units", "note", "equation-of-state",
                    "critical-parameters", "comment", "reference"},
                   warnings);
  const auto* own = map.find("units");
  readComposition(yaml, map.at("composition"), what, elements, species);
  ThermoReader(yaml, own != nullptr ? yaml.units(*own, units) : units, map.at("thermo"), what, species, warnings)
      .read();
  if (const auto* transport = map.find("transport"))
    species.transport = readTransport(yaml, *transport, what, warnings);
  return species;
}

}  // namespace lampblack::chemistry
