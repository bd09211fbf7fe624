#include "app/shell/tools/gas_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/gas_input.hpp"
#include "app/deck/mechanism_file_names.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/run/warnings.hpp"
#include "app/shell/tools/gas_output.hpp"
#include "app/shell/tools/gas_report.hpp"
#include "chemistry/mechanism/like_warnings.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"
#include "io/units.hpp"

namespace lampblack::app {
namespace {

struct GasArguments {
  MechanismFileNames files;
  std::string temperature, pressure;
  std::string moleFractions, massFractions;
  std::string fuel, oxidizer;
  std::optional<double> ratio;
  bool equilibrium = false;
  std::string constant;                       // "HP", ... as the option that asks for it; empty if none does
  std::string transport, collisionIntegrals;  // empty: the default
  bool json = false;
  GasTables tables;
};

struct EquilibriumOption {
  const char *name, *constant, *help;
};
constexpr EquilibriumOption equilibriumOptions[] = {
    {"--tp", "TP", "Equilibrium at constant temperature and pressure, as --equilibrium."},
    {"--hp", "HP", "Equilibrium at constant enthalpy and pressure: the adiabatic flame."},
    {"--sp", "SP", "Equilibrium at constant entropy and pressure."},
    {"--tv", "TV", "Equilibrium at constant temperature and volume."},
    {"--uv", "UV", "Equilibrium at constant internal energy and volume: the explosion in a bomb."},
};

double positiveQuantity(const std::string& option, const std::string& text, const units::Dimension& dimension) {
  double value = 0;
  try {
    value = units::parseQuantity(text, dimension);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  if (!(value > 0))
    throw InputError(fmt::format("{}: expected {} above zero, found '{}'", option, units::describe(dimension), text));
  return value;
}

std::vector<double> composition(const Mechanism& mechanism, const char* option, const std::string& text) {
  try {
    return parseComposition(mechanism, text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

// Mole fractions of the gas that the options describe.
std::vector<double> moleFractions(const GasArguments& arguments, const Mechanism& mechanism) {
  const bool byRatio = !arguments.fuel.empty() || !arguments.oxidizer.empty() || arguments.ratio;
  const int ways = (arguments.moleFractions.empty() ? 0 : 1) + (arguments.massFractions.empty() ? 0 : 1) + byRatio;
  if (ways != 1)
    throw InputError(
        fmt::format("the composition is {}; expected one of --X \"CH4:1, O2:2\", --Y, or --fuel with "
                    "--oxidizer and --phi",
                    ways == 0 ? "missing" : "given twice"));
  if (!arguments.moleFractions.empty()) return composition(mechanism, "--X", arguments.moleFractions);
  if (byRatio) {
    if (arguments.fuel.empty() || arguments.oxidizer.empty() || !arguments.ratio)
      throw InputError("--fuel, --oxidizer and --phi belong together; expected all three");
    if (!(*arguments.ratio >= 0) || !std::isfinite(*arguments.ratio))
      throw InputError(fmt::format("--phi: expected a number of at least 0, found {}", *arguments.ratio));
    return mixByEquivalenceRatio(mechanism, composition(mechanism, "--fuel", arguments.fuel),
                                 composition(mechanism, "--oxidizer", arguments.oxidizer), *arguments.ratio);
  }
  const auto Y = composition(mechanism, "--Y", arguments.massFractions);
  std::vector<double> X(Y.size());
  Thermo(mechanism).massToMole(Y, X);
  return X;
}

void chooseConstant(GasArguments& arguments, const EquilibriumOption& option) {
  if (!arguments.constant.empty() && arguments.constant != option.constant)
    throw CLI::ValidationError(option.name,
                               "there is one equilibrium at a time; expected one of --tp, --hp, --sp, "
                               "--tv, --uv");
  arguments.constant = option.constant;
}

struct Answer {
  std::vector<std::string> warnings;
  std::string text;
};

// The gas of the options, brought to the equilibrium they ask for.
Answer answer(const GasArguments& arguments) {
  const Mechanism mechanism = readMechanism(arguments.files);
  const double T = positiveQuantity("--T", arguments.temperature, units::temperature);
  if (const std::string problem = temperatureProblem(T, mechanism, TemperatureUse::properties); !problem.empty())
    throw InputError("--T: " + problem);
  const double p = positiveQuantity("--p", arguments.pressure, units::pressure);
  const auto X = moleFractions(arguments, mechanism);
  const std::string constant = arguments.constant.empty() && arguments.equilibrium ? "TP" : arguments.constant;
  GasTransportChoice transport;
  if (!arguments.transport.empty()) transport.model = transportModel(arguments.transport);
  if (!arguments.collisionIntegrals.empty()) transport.integrals = collisionIntegrals(arguments.collisionIntegrals);
  GasReport gas = constant.empty() ? gasReport(mechanism, T, p, X) : gasAtEquilibrium(mechanism, T, p, X, constant);
  addTransport(mechanism, transport, !arguments.transport.empty() || !arguments.collisionIntegrals.empty(), gas);
  Answer result;
  result.warnings = oneOfEachKind(mechanism.warnings());
  result.warnings.push_back(rangeWarning(mechanism, T));
  if (gas.temperature != T) result.warnings.push_back(rangeWarning(mechanism, gas.temperature));
  std::erase(result.warnings, "");
  result.text = arguments.json ? gasJson(mechanism, gas) : gasText(mechanism, gas, arguments.tables);
  return result;
}

void runGas(const GasArguments& arguments) {
  Answer result;
  collectively(MPI_COMM_WORLD, [&] { result = answer(arguments); });
  printWarnings(result.warnings);
  if (placeOfProcess().rank != 0) return;
  // A reader that has seen enough ("| head") ends the program quietly; PETSc would call it a crash.
  std::signal(SIGPIPE, SIG_DFL);
  std::cout << result.text << std::flush;
}

}  // namespace

void addGasCommand(CLI::App& app, Command& command) {
  const auto arguments = std::make_shared<GasArguments>();
  CLI::App* gas = app.add_subcommand("gas", "Properties, rates and equilibrium of a gas.");
  gas->add_option("mechanism", arguments->files.mechanism, "Mechanism: YAML by its ending, else CHEMKIN.")->required();
  gas->add_option("thermo", arguments->files.thermo, "CHEMKIN thermodynamic data.");
  gas->add_option("transport-data", arguments->files.transport, "CHEMKIN transport data.");
  gas->add_option("--phase", arguments->files.phase, "Phase of a YAML file; without it the first ideal gas.");
  gas->add_flag("--permissive", arguments->files.permissive, permissiveHelp);
  gas->add_option("-T,--T", arguments->temperature, "Temperature: 1500, \"1500 K\".")->required();
  gas->add_option("-p,--p", arguments->pressure, "Pressure: 101325, \"1 atm\".")->default_val("1 atm");
  gas->add_option("-X,--X", arguments->moleFractions, "Mole fractions, scaled to one: \"CH4:1, O2:2, N2:7.52\".");
  gas->add_option("-Y,--Y", arguments->massFractions, "Mass fractions, scaled to one.");
  gas->add_option("--fuel", arguments->fuel, "Mole fractions of a fuel, with --oxidizer and --phi.");
  gas->add_option("--oxidizer", arguments->oxidizer, "Mole fractions of what it burns with: \"O2:1, N2:3.76\".");
  gas->add_option("--phi", arguments->ratio, "Equivalence ratio of the two.");
  gas->add_flag("--equilibrium", arguments->equilibrium, "Equilibrium at this temperature and pressure.");
  for (const EquilibriumOption& option : equilibriumOptions)
    gas->add_flag_callback(
        option.name, [arguments, &option] { chooseConstant(*arguments, option); }, option.help);
  gas->add_option("--transport", arguments->transport, "mixture-averaged (default), multicomponent or unity-lewis.");
  gas->add_option("--collision-integrals", arguments->collisionIntegrals, "monchick-mason (default) or wang.");
  gas->add_flag("--json", arguments->json, "One JSON object (docs/formats.md) in place of tables.");
  gas->add_flag("--all", arguments->tables.allSpecies, "Tables: every species, also those that are not there.");
  gas->add_flag("--reactions", arguments->tables.reactions, "Tables: the rate constants too.");
  gas->callback([arguments, &command] { command = {[arguments] { runGas(*arguments); }}; });
}

}  // namespace lampblack::app
