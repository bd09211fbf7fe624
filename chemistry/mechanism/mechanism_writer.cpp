#include "chemistry/mechanism/mechanism_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "chemistry/mechanism/elements.hpp"
#include "chemistry/mechanism/equation_text.hpp"
#include "chemistry/mechanism/reaction_writer.hpp"
#include "chemistry/mechanism/yaml_text.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

std::string_view shapeName(MoleculeShape shape) {
  switch (shape) {
    case MoleculeShape::Atom:
      return "atom";
    case MoleculeShape::Linear:
      return "linear";
    case MoleculeShape::Nonlinear:
      break;
  }
  return "nonlinear";
}

class MechanismWriter {
 public:
  explicit MechanismWriter(const Mechanism& mechanism) : mechanism_(mechanism) {}

  std::string write() {
    if (!mechanism_.description().empty())
      out_ += fmt::format("description: {}\n", yamlBlock(mechanism_.description()));
    out_ += "units: {length: m, quantity: mol, activation-energy: K}\n";
    writePhase();
    writeElements();
    out_ += "\nspecies:\n";
    for (const auto& species : mechanism_.allSpecies()) writeSpecies(species);
    if (mechanism_.numReactions() > 0) out_ += "\nreactions:\n";
    for (const auto& reaction : mechanism_.reactions()) out_ += reactionYaml(reaction, mechanism_);
    return std::move(out_);
  }

 private:
  void writePhase() {
    std::vector<std::string> elements, species;
    for (std::size_t i = 0; i < mechanism_.numElements(); ++i) elements.push_back(yamlName(mechanism_.elementName(i)));
    bool transport = true;
    for (const auto& s : mechanism_.allSpecies()) {
      species.push_back(yamlName(s.name));
      transport = transport && s.transport;
    }
    out_ += "\nphases:\n- name: gas\n  thermo: ideal-gas\n";
    out_ += fmt::format("  elements: {}\n", yamlList(elements, 4));
    out_ += fmt::format("  species: {}\n", yamlList(species, 4));
    if (mechanism_.numReactions() > 0) out_ += "  kinetics: gas\n  reactions: all\n";
    if (transport) out_ += "  transport: mixture-averaged\n";
    out_ += "  state: {T: 300.0, P: 1 atm}\n";
  }

  // Weights that are not the standard ones.
  void writeElements() {
    std::string own;
    for (std::size_t i = 0; i < mechanism_.numElements(); ++i) {
      const double weight = mechanism_.atomicWeight(i);
      if (standardAtomicWeight(mechanism_.elementName(i)) == weight) continue;
      own += fmt::format("- symbol: {}\n  atomic-weight: {}\n", yamlName(mechanism_.elementName(i)),
                         yamlNumber(weight, 1e-3));
    }
    if (!own.empty()) out_ += fmt::format("\nelements:\n{}", own);
  }

  void writeSpecies(const Species& species) {
    std::string composition;
    for (std::size_t i = 0; i < species.atoms.size(); ++i)
      if (species.atoms[i] != 0)
        composition += fmt::format("{}{}: {}", composition.empty() ? "" : ", ", yamlName(mechanism_.elementName(i)),
                                   yamlNumber(species.atoms[i]));
    out_ += fmt::format("- name: {}\n  composition: {{{}}}\n  thermo:\n", yamlName(species.name), composition);
    if (species.nasa9)
      writeNasa9(*species.nasa9);
    else
      writeNasa7(species.thermo);
    if (species.transport) writeTransport(*species.transport);
  }

  void writePolynomials(std::string_view model, std::span<const double> temperatures) {
    out_ += fmt::format("    model: {}\n    temperature-ranges: {}\n    data:\n", model, numbers(temperatures, 6));
  }

  static std::string numbers(std::span<const double> values, std::size_t indent) {
    std::vector<std::string> words;
    for (const double value : values) words.push_back(yamlNumber(value));
    return yamlList(words, indent);
  }

  void writeNasa7(const Nasa7& thermo) {
    // A single range, as the reader makes it of a file with one.
    const bool single = thermo.low == thermo.high && thermo.midTemperature == thermo.maxTemperature;
    if (single)
      writePolynomials("NASA7", std::array{thermo.minTemperature, thermo.maxTemperature});
    else
      writePolynomials("NASA7", std::array{thermo.minTemperature, thermo.midTemperature, thermo.maxTemperature});
    out_ += fmt::format("    - {}\n", numbers(thermo.low, 6));
    if (!single) out_ += fmt::format("    - {}\n", numbers(thermo.high, 6));
  }

  void writeNasa9(const Nasa9& thermo) {
    writePolynomials("NASA9", thermo.temperatures);
    for (const auto& range : thermo.ranges) out_ += fmt::format("    - {}\n", numbers(range, 6));
  }

  void writeTransport(const TransportData& t) {
    out_ += fmt::format("  transport:\n    model: gas\n    geometry: {}\n    well-depth: {}\n    diameter: {}\n",
                        shapeName(t.shape), yamlNumber(t.wellDepth), yamlNumber(t.diameter, 1e-10));
    const auto optional = [&](std::string_view key, double value, double factor) {
      if (value != 0) out_ += fmt::format("    {}: {}\n", key, yamlNumber(value, factor));
    };
    optional("dipole", t.dipole, constants::debye);
    optional("polarizability", t.polarizability, 1e-30);
    optional("rotational-relaxation", t.rotationalRelaxation, 1);
  }

  const Mechanism& mechanism_;
  std::string out_;
};

}  // namespace

std::string mechanismYaml(const Mechanism& mechanism) {
  return MechanismWriter(mechanism).write();
}

void writeMechanism(const Mechanism& mechanism, const std::string& path) {
  const std::string part = path + ".part";
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file << mechanismYaml(mechanism);
    file.close();
    if (!file) throw InputError(fmt::format("{}: cannot write the mechanism file", part));
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) throw InputError(fmt::format("{}: cannot rename {} to it: {}", path, part, error.message()));
}

}  // namespace lampblack::chemistry
