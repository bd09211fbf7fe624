// What a run of molecules writes: rows of the history, mass spectra, rates, and the rings of some molecules.
#pragma once

#include <vector>

#include "app/problems/pah/pah_case.hpp"
#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "io/table.hpp"
#include "particles/pah/growth_sums.hpp"

namespace lampblack::app {

// Of rank 0, which has the sums of all.
[[nodiscard]] Table pahHistory(const PahCase& pah, const GrowthSums& sums);
// A row for each formula at each time with a spectrum.
[[nodiscard]] Table pahSpectrum(const PahCase& pah, const GrowthSums& sums);
// Rates of the processes per site at the times of the rows.
[[nodiscard]] Table pahRateTable(const PahCase& pah);

// Collective. The rings of these molecules at the end, repeats 0, 1, ...
void writeMolecules(ResultsWriter& results, const std::vector<Molecule>& molecules);

}  // namespace lampblack::app
