#include "app/shell/tools/mechanism_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/deck/mechanism_file_names.hpp"
#include "app/run/warnings.hpp"
#include "chemistry/mechanism/like_warnings.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/mechanism/mechanism_writer.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"

namespace lampblack::app {
namespace {

struct MechanismArguments {
  MechanismFileNames files;
  std::string output;        // empty if not given
  bool allWarnings = false;  // in place of one of each kind
};

void checkOutput(const MechanismArguments& arguments) {
  if (arguments.output.empty()) return;
  if (!isYaml(arguments.output))
    throw InputError(fmt::format("-o: expected a name that ends with .yaml or .yml, found '{}'", arguments.output));
  std::error_code error;
  for (const auto& input : {arguments.files.mechanism, arguments.files.thermo, arguments.files.transport})
    if (!input.empty() && std::filesystem::equivalent(input, arguments.output, error))
      throw InputError(fmt::format("-o: expected another file than the input '{}'", input));
}

// "2: AR, N2"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 10;
  std::string text = fmt::format("{}", names.size());
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? ": " : ", ", names[i]);
  return names.size() > most ? text + ", ..." : text;
}

std::string summary(const Mechanism& mechanism) {
  using Type = Reaction::Type;
  std::vector<std::string> elements, withoutTransport;
  for (std::size_t i = 0; i < mechanism.numElements(); ++i) elements.push_back(mechanism.elementName(i));
  for (const auto& species : mechanism.allSpecies())
    if (!species.transport) withoutTransport.push_back(species.name);
  const auto reactions = mechanism.reactions();
  const auto count = [&](auto&& is) { return std::ranges::count_if(reactions, is); };
  std::string text = mechanism.fileName() + "\n";
  const auto line = [&](std::string_view what, const auto& value) { text += fmt::format("{:<36}{}\n", what, value); };
  line("  elements", listed(elements));
  line("  species", mechanism.numSpecies());
  line("    without transport data", listed(withoutTransport));
  line("  reactions", reactions.size());
  constexpr std::pair<Type, std::string_view> names[] = {
      {Type::Elementary, "    elementary"},
      {Type::ThreeBody, "    three-body"},
      {Type::Falloff, "    fall-off"},
      {Type::ChemicallyActivated, "    chemically activated"},
      {Type::PressureLog, "    tabulated over pressure (PLOG)"},
      {Type::Chebyshev, "    Chebyshev"},
      {Type::LinearBurke, "    linear mixture rule (linear-Burke)"},
  };
  for (const auto& [type, name] : names)
    if (const auto n = count([&](const Reaction& r) { return r.type == type; }); n > 0) line(name, n);
  line("  of these irreversible", count([](const Reaction& r) { return !r.reversible; }));
  line("  of these marked as duplicates", count([](const Reaction& r) { return r.duplicate; }));
  return text;
}

void runMechanism(const MechanismArguments& arguments) {
  const int rank = placeOfProcess().rank;
  std::vector<std::string> warnings;
  std::string text;
  collectively(MPI_COMM_WORLD, [&] {
    checkOutput(arguments);
    const Mechanism mechanism = readMechanism(arguments.files);
    warnings = arguments.allWarnings ? mechanism.warnings() : oneOfEachKind(mechanism.warnings());
    text = summary(mechanism);
    if (rank == 0 && !arguments.output.empty()) writeMechanism(mechanism, arguments.output);
  });
  printWarnings(warnings);
  if (rank != 0) return;
  std::cout << text;
  if (!arguments.output.empty()) std::cout << "written to " << arguments.output << '\n';
  std::cout << std::flush;
}

}  // namespace

void addMechanismCommand(CLI::App& app, Command& command) {
  const auto arguments = std::make_shared<MechanismArguments>();
  CLI::App* mechanism = app.add_subcommand("mechanism", "Check a mechanism and convert CHEMKIN files to YAML.");
  mechanism->add_option("mechanism", arguments->files.mechanism, "CHEMKIN mechanism (chem.inp), or YAML by its ending.")
      ->required();
  mechanism->add_option("thermo", arguments->files.thermo, "CHEMKIN thermodynamic data (therm.dat).");
  mechanism->add_option("transport", arguments->files.transport, "CHEMKIN transport data (tran.dat).");
  mechanism->add_option("--phase", arguments->files.phase, "Phase of a YAML file; without it the first ideal gas.");
  mechanism->add_option("-o,--output", arguments->output, "YAML file to write; without it, check and summarise only.");
  mechanism->add_flag("--permissive", arguments->files.permissive, permissiveHelp);
  mechanism->add_flag("--all-warnings", arguments->allWarnings,
                      "Every warning; without it one of each kind and a count.");
  mechanism->callback([arguments, &command] { command = {[arguments] { runMechanism(*arguments); }}; });
}

}  // namespace lampblack::app
