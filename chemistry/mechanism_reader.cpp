// Mechanism::fromFile: the skeleton of a Cantera YAML file (units, phases, elements, species).
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "chemistry/elements.hpp"
#include "chemistry/mechanism.hpp"
#include "chemistry/reaction_reader.hpp"
#include "chemistry/yaml_access.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack {

namespace {

class MechanismReader {
 public:
  MechanismReader(const std::string& path, const YAML::Node& root) : yaml_(path), root_(root) {}

  Mechanism read() {
    yaml_.requireMap(root_, "mechanism file");
    units_ = FileUnits::read(yaml_, root_["units"]);
    const YAML::Node phase = choosePhase();
    readPhaseSpecies(phase);
    readElements(phase);
    for (std::size_t k = 0; k < speciesNodes_.size(); ++k) species_.push_back(readSpecies(speciesNodes_[k]));
    readReactions(phase);
    std::string description;
    if (root_["description"].IsDefined()) description = yaml_.text(root_["description"], "description");
    return Mechanism(yaml_.file(), description, std::move(elements_), std::move(species_), std::move(reactions_));
  }

 private:
  YAML::Node choosePhase() const {
    const YAML::Node phases = yaml_.member(root_, "phases", "mechanism file");
    yaml_.requireSequence(phases, "phases");
    for (const auto& phase : phases) {
      yaml_.requireMap(phase, "phase");
      if (phase["thermo"].IsDefined() && yaml_.text(phase["thermo"], "phase 'thermo'") == "ideal-gas") return phase;
    }
    yaml_.fail(phases, "no ideal-gas phase; expected one with 'thermo: ideal-gas'");
  }

  void readPhaseSpecies(const YAML::Node& phase) {
    const YAML::Node all = yaml_.member(root_, "species", "mechanism file");
    yaml_.requireSequence(all, "species");
    std::vector<std::string> names;
    std::vector<YAML::Node> nodes;
    for (const auto& node : all) {
      names.push_back(yaml_.text(yaml_.member(node, "name", "species"), "species name"));
      for (std::size_t i = 0; i + 1 < names.size(); ++i)
        if (names[i] == names.back()) yaml_.fail(node, fmt::format("species '{}' is declared twice", names.back()));
      nodes.push_back(node);
    }
    const YAML::Node list = phase["species"];
    if (!list.IsDefined() || (list.IsScalar() && list.Scalar() == "all")) {
      speciesNames_ = names;
      speciesNodes_ = nodes;
      return;
    }
    yaml_.requireSequence(list, "species of the phase");
    const std::vector<std::string_view> views(names.begin(), names.end());
    for (const auto& entry : list) {
      if (entry.IsMap()) yaml_.fail(entry, "species from another file or section are not supported yet");
      const auto name = yaml_.text(entry, "species of the phase");
      bool found = false;
      for (std::size_t i = 0; i < names.size() && !found; ++i) {
        if (names[i] != name) continue;
        speciesNames_.push_back(name);
        speciesNodes_.push_back(nodes[i]);
        found = true;
      }
      if (!found)
        yaml_.fail(entry, fmt::format("species '{}' of the phase is not declared under 'species'; the nearest name is "
                                      "'{}'",
                                      name, closestName(name, views)));
    }
    if (speciesNodes_.empty()) yaml_.fail(phase, "the phase has no species");
  }

  void addElement(const std::string& name, const YAML::Node& where) {
    for (const auto& e : elements_)
      if (e.name == name) return;
    if (const YAML::Node own = root_["elements"]; own.IsDefined()) {
      yaml_.requireSequence(own, "elements");
      for (const auto& node : own)
        if (yaml_.text(yaml_.member(node, "symbol", "element"), "element symbol") == name) {
          const double weight = yaml_.number(yaml_.member(node, "atomic-weight", "element"), "atomic-weight");
          if (!(weight > 0)) yaml_.fail(node, "expected a positive atomic weight");
          elements_.push_back({name, weight * 1e-3});
          return;
        }
    }
    const auto weight = standardAtomicWeight(name);
    if (!weight) yaml_.fail(where, fmt::format("unknown element '{}'", name));
    elements_.push_back({name, *weight});
  }

  void readElements(const YAML::Node& phase) {
    if (const YAML::Node list = phase["elements"]; list.IsDefined()) {
      yaml_.requireSequence(list, "elements of the phase");
      for (const auto& node : list) {
        if (node.IsMap()) yaml_.fail(node, "elements from another file or section are not supported yet");
        addElement(yaml_.text(node, "element"), node);
      }
      return;
    }
    for (const auto& node : speciesNodes_)
      for (const auto& entry : yaml_.member(node, "composition", "species"))
        addElement(yaml_.text(entry.first, "composition"), entry.first);
  }

  Species readSpecies(const YAML::Node& node) const {
    Species s;
    s.name = yaml_.text(node["name"], "species name");
    s.line = YamlAccess::line(node);
    const auto what = fmt::format("species '{}'", s.name);
    s.atoms.assign(elements_.size(), 0.0);
    const YAML::Node composition = yaml_.member(node, "composition", what);
    yaml_.requireMap(composition, what + ", 'composition'");
    for (const auto& entry : composition) {
      const auto name = yaml_.text(entry.first, what);
      const double count = yaml_.number(entry.second, what + ", 'composition'");
      bool found = false;
      for (std::size_t i = 0; i < elements_.size(); ++i)
        if (elements_[i].name == name) {
          s.atoms[i] = count;
          found = true;
        }
      if (!found) yaml_.fail(entry.first, fmt::format("{}: element '{}' is not declared in the phase", what, name));
      if (count < 0) yaml_.fail(entry.second, fmt::format("{}: expected zero or more atoms", what));
    }
    s.thermo = readThermo(yaml_.member(node, "thermo", what), what);
    if (node["transport"].IsDefined()) s.transport = readTransport(node["transport"], what + ", 'transport'");
    return s;
  }

  Nasa7 readThermo(const YAML::Node& node, const std::string& owner) const {
    const auto what = owner + ", 'thermo'";
    const YAML::Node model = yaml_.member(node, "model", what);
    if (yaml_.text(model, what) != "NASA7")
      yaml_.fail(model, fmt::format("{}: model '{}' is not supported yet; supported is NASA7", what, model.Scalar()));
    yaml_.allowOnly(node, {"model", "temperature-ranges", "data", "note", "reference-pressure"}, what);
    if (const YAML::Node p = node["reference-pressure"]; p.IsDefined()) {
      const auto given = yaml_.text(p, what);
      if (given != "1 atm" && given != "101325" && given != "101325 Pa")
        yaml_.fail(p, fmt::format("{}: reference pressure '{}' is not supported yet; supported is 1 atm", what, given));
    }
    const YAML::Node ranges = yaml_.member(node, "temperature-ranges", what);
    const YAML::Node data = yaml_.member(node, "data", what);
    yaml_.requireSequence(ranges, what + ", 'temperature-ranges'");
    yaml_.requireSequence(data, what + ", 'data'");
    if ((data.size() != 1 && data.size() != 2) || ranges.size() != data.size() + 1)
      yaml_.fail(ranges, what + ": expected one or two ranges of temperature with seven numbers each");
    std::vector<double> T;
    for (const auto& t : ranges) T.push_back(yaml_.number(t, what));
    for (std::size_t i = 0; i + 1 < T.size(); ++i)
      if (!(T[i] < T[i + 1])) yaml_.fail(ranges, what + ": expected rising temperatures");
    Nasa7 thermo;
    thermo.minTemperature = T.front();
    thermo.midTemperature = T[1];
    thermo.maxTemperature = T.back();
    const auto coefficients = [&](const YAML::Node& row) {
      yaml_.requireSequence(row, what + ", 'data'");
      if (row.size() != 7) yaml_.fail(row, what + ": expected seven coefficients");
      std::array<double, 7> a{};
      for (std::size_t i = 0; i < 7; ++i) a[i] = yaml_.number(row[i], what);
      return a;
    };
    thermo.low = coefficients(data[0]);
    thermo.high = data.size() == 2 ? coefficients(data[1]) : thermo.low;
    return thermo;
  }

  TransportData readTransport(const YAML::Node& node, const std::string& what) const {
    const YAML::Node model = yaml_.member(node, "model", what);
    if (yaml_.text(model, what) != "gas")
      yaml_.fail(model, fmt::format("{}: model '{}' is not supported yet; supported is gas", what, model.Scalar()));
    yaml_.allowOnly(node,
                    {"model", "geometry", "well-depth", "diameter", "dipole", "polarizability", "rotational-relaxation",
                     "acentric-factor", "dispersion-coefficient", "quadrupole-polarizability", "note"},
                    what);
    TransportData t;
    const YAML::Node geometry = yaml_.member(node, "geometry", what);
    const auto shape = yaml_.text(geometry, what);
    if (shape == "atom")
      t.shape = MoleculeShape::Atom;
    else if (shape == "linear")
      t.shape = MoleculeShape::Linear;
    else if (shape == "nonlinear")
      t.shape = MoleculeShape::Nonlinear;
    else
      yaml_.fail(geometry, fmt::format("{}: expected atom, linear or nonlinear, found '{}'", what, shape));
    t.wellDepth = yaml_.number(yaml_.member(node, "well-depth", what), what);
    t.diameter = 1e-10 * yaml_.number(yaml_.member(node, "diameter", what), what);
    const auto optional = [&](const char* key, double factor) {
      return node[key].IsDefined() ? factor * yaml_.number(node[key], what) : 0.0;
    };
    t.dipole = optional("dipole", constants::debye);
    t.polarizability = optional("polarizability", 1e-30);
    t.rotationalRelaxation = optional("rotational-relaxation", 1.0);
    if (!(t.wellDepth > 0) || !(t.diameter > 0)) yaml_.fail(node, what + ": expected positive well-depth and diameter");
    if (t.dipole < 0 || t.polarizability < 0 || t.rotationalRelaxation < 0)
      yaml_.fail(node, what + ": expected dipole, polarizability and rotational-relaxation of zero or more");
    return t;
  }

  void readReactions(const YAML::Node& phase) {
    if (const YAML::Node list = phase["reactions"]; list.IsDefined()) {
      const bool plain = list.IsScalar() && (list.Scalar() == "all" || list.Scalar() == "none");
      if (!plain)
        yaml_.fail(list, "reactions from another file or section are not supported yet; expected all or none");
      if (list.Scalar() == "none") return;
    }
    const YAML::Node reactions = root_["reactions"];
    if (!reactions.IsDefined()) return;
    yaml_.requireSequence(reactions, "reactions");
    const SpeciesFinder find = [this](std::string_view name) -> std::optional<std::size_t> {
      for (std::size_t k = 0; k < speciesNames_.size(); ++k)
        if (speciesNames_[k] == name) return k;
      return std::nullopt;
    };
    for (const auto& node : reactions) reactions_.push_back(readReaction(yaml_, units_, node, find));
  }

  YamlAccess yaml_;
  const YAML::Node& root_;
  FileUnits units_;
  std::vector<std::string> speciesNames_;
  std::vector<YAML::Node> speciesNodes_;
  std::vector<Element> elements_;
  std::vector<Species> species_;
  std::vector<Reaction> reactions_;
};

}  // namespace

Mechanism Mechanism::fromFile(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw InputError(fmt::format("{}: cannot open the mechanism file", path));
  std::ostringstream content;
  if (stream.peek() != std::ifstream::traits_type::eof()) content << stream.rdbuf();
  if (!stream || content.str().empty())
    throw InputError(fmt::format("{}: cannot read the mechanism file, or it is empty", path));
  try {
    const YAML::Node root = YAML::Load(content.str());
    return MechanismReader(path, root).read();
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}: not valid YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

}  // namespace lampblack
