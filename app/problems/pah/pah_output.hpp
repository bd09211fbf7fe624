// What a run of molecules writes: rows of the history, mass spectra, rates, and the rings of some molecules.
#pragma once

#include <vector>

#include "app/problems/pah/growth_sums.hpp"
#include "app/problems/pah/pah_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

struct PahTable {
  std::vector<Quantity> columns;
  std::vector<double> rows;  // row-major
};

// Of rank 0, which has the sums of all.
[[nodiscard]] PahTable pahHistory(const PahCase& pah, const GrowthSums& sums);
// A row for each formula at each time with a spectrum.
[[nodiscard]] PahTable pahSpectrum(const PahCase& pah, const GrowthSums& sums);
// Rates of the processes per site at the times of the rows.
[[nodiscard]] PahTable pahRateTable(const PahCase& pah);

// Collective. The rings of these molecules at the end, repeats 0, 1, ...
void writeMolecules(ResultsWriter& results, const std::vector<Molecule>& molecules);

void recordPah(JsonWriter& json, const PahCase& pah, const GrowthSums& sums, const PahTable& history);

}  // namespace lampblack::app
