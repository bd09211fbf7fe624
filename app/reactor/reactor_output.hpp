// The tables of a reactor run: their columns and rows, and what the sensitivities leave.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/reactor/reactor_case.hpp"
#include "chemistry/reactor/ignition_sensitivity.hpp"
#include "core/modules.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// The columns of the chosen species, and their values at mass fractions Y.
std::vector<Quantity> speciesColumns(const Mechanism& mechanism, const ReactorOutput& output);
void appendSpecies(const Mechanism& mechanism, const ReactorOutput& output, std::span<const double> Y,
                   std::vector<double>& row);

// Columns of a closed reactor's history, and a row at a time (s) of it.
std::vector<Quantity> closedColumns(const ReactorCase& reactorCase);
std::vector<double> closedRow(const ReactorCase& reactorCase, ClosedReactor& reactor, double time,
                              std::span<const double> y);

// sensitivities.csv: a row for each reaction, a column for each criterion that was met.
void writeSensitivityTable(const std::filesystem::path& path, const ReactorCase& reactorCase,
                           const IgnitionSensitivities& sensitivities);

// The groups /ignition and /sensitivity. Collective; rank 0 has the values.
void writeIgnition(ResultsWriter& results, const ReactorCase& reactorCase,
                   const std::vector<std::optional<IgnitionEvent>>& events);
void writeSensitivities(ResultsWriter& results, const ReactorCase& reactorCase,
                        const IgnitionSensitivities& sensitivities);

// "largest dT/dt": a criterion in words.
std::string describe(const IgnitionCriterion& criterion, const Mechanism& mechanism);

}  // namespace lampblack::app
