// The history of a gas from a CSV file.
#pragma once

#include <filesystem>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/given_gas.hpp"

namespace lampblack::app {

// Columns "time" (or "t"), "temperature" ("T"), "pressure" ("p") and a mole fraction "X_<species>" for any species of
// the mechanism, each with a unit in brackets or in SI; there may be "number_loss_rate" (1/s), the rate at which
// particles per kg of gas become fewer, until the next row, or by its former name "thinning"; species without a column
// are not in the gas. What is no species of the mechanism is left out with a warning, and so are other columns, but for
// mass fractions "Y_<species>" of species without a mole fraction, which would be lost: InputError. InputError, naming
// the file, for what is no such table.
[[nodiscard]] GasHistory readGasTable(const std::filesystem::path& file, const Mechanism& mechanism);

}  // namespace lampblack::app
