#include "app/gas_command.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "app/gas_output.hpp"
#include "app/gas_properties.hpp"
#include "chemistry/thermo.hpp"
#include "core/errors.hpp"
#include "io/units.hpp"

namespace lampblack {
namespace {

struct Arguments {
  std::string mechanism;
  std::string temperature, pressure;
  std::string moleFractions, massFractions;
  bool json = false;
  GasTables tables;
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
std::vector<double> moleFractions(const Arguments& arguments, const Mechanism& mechanism) {
  if (!arguments.moleFractions.empty()) return composition(mechanism, "--X", arguments.moleFractions);
  if (arguments.massFractions.empty())
    throw InputError("the composition is missing: expected --X \"CH4:1, O2:2\" or --Y");
  const auto Y = composition(mechanism, "--Y", arguments.massFractions);
  std::vector<double> X(Y.size());
  Thermo(mechanism).massToMole(Y, X);
  return X;
}

struct Answer {
  std::string warning, text;
};

Answer answer(const Arguments& arguments) {
  const double T = positiveQuantity("--T", arguments.temperature, units::temperature);
  const double p = positiveQuantity("--p", arguments.pressure, units::pressure);
  const Mechanism mechanism = Mechanism::fromFile(arguments.mechanism);
  auto gas = gasProperties(mechanism, T, p, moleFractions(arguments, mechanism));
  return {rangeWarning(mechanism, gas.temperature),
          arguments.json ? gasJson(mechanism, gas) : gasText(mechanism, gas, arguments.tables)};
}

void run(const Arguments& arguments) {
  Answer result;
  collectively(PETSC_COMM_WORLD, [&] { result = answer(arguments); });
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != 0) return;
  if (!result.warning.empty()) std::cerr << "lampblack: warning: " << result.warning << std::endl;
  std::cout << result.text << std::flush;
}

}  // namespace

void addGasCommand(CLI::App& app, std::function<void()>& command) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* gas = app.add_subcommand("gas", "Properties, rates and equilibrium of a gas.");
  gas->add_option("mechanism", arguments->mechanism, "Mechanism file (YAML).")->required();
  gas->add_option("-T,--T", arguments->temperature, "Temperature: 1500, \"1500 K\".")->required();
  gas->add_option("-p,--p", arguments->pressure, "Pressure: 101325, \"1 atm\".")->default_val("1 atm");
  CLI::Option* byMole =
      gas->add_option("-X,--X", arguments->moleFractions, "Mole fractions, scaled to one: \"CH4:1, O2:2, N2:7.52\".");
  gas->add_option("-Y,--Y", arguments->massFractions, "Mass fractions, scaled to one.")->excludes(byMole);
  gas->add_flag("--json", arguments->json, "One JSON object (docs/formats.md) in place of tables.");
  gas->add_flag("--all", arguments->tables.allSpecies, "Tables: every species, also those that are not there.");
  gas->add_flag("--reactions", arguments->tables.reactions, "Tables: the rate constants too.");
  gas->callback([arguments, &command] { command = [arguments] { run(*arguments); }; });
}

}  // namespace lampblack
