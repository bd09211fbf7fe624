#include "app/problems/pah/pah_output.hpp"

#include <cmath>
#include <limits>

#include "app/run/repeat_columns.hpp"

namespace lampblack::app {
namespace {

constexpr double notCounted = std::numeric_limits<double>::quiet_NaN();
constexpr double carbonWeight = 12.011, hydrogenWeight = 1.008;  // g/mol

double leftBy(const PahCase& pah, const GrowthSums& sums, std::size_t row) {
  return 1 - static_cast<double>(sums.count(row)) / static_cast<double>(pah.repeats);
}

}  // namespace

Table pahHistory(const PahCase& pah, const GrowthSums& sums) {
  Table table{{{"time", "s", "time"},
               {"temperature", "K", "gas temperature"},
               {"left", "1", "part of the molecules that have more rings than molecule.most_rings"}},
              {}};
  const std::vector<Quantity>& quantities = growthQuantities();
  for (const Quantity& quantity : quantities) addRepeatColumns(quantity, table.columns);
  for (std::size_t row = 0; row < pah.recorded.size(); ++row) {
    table.rows.insert(table.rows.end(),
                      {pah.timeOf(row), pah.path.points[pah.recorded[row]].gas.temperature, leftBy(pah, sums, row)});
    const std::uint64_t count = sums.count(row);
    const RepeatIntervals intervals(std::max<std::uint64_t>(count, 2));
    for (std::size_t q = 0; q < quantities.size(); ++q)
      if (pah.closure && !isCounted(q))
        intervals.append(notCounted, notCounted, table.rows);
      else
        intervals.append(sums.mean(row, q), sums.standardError(row, q), table.rows);
  }
  return table;
}

Table pahSpectrum(const PahCase& pah, const GrowthSums& sums) {
  Table table{{{"time", "s", "time"},
               {"carbon", "1", "carbon atoms"},
               {"hydrogen", "1", "hydrogen atoms"},
               {"mass", "kg/mol", "molar mass"},
               {"rings", "1", "rings of six and of five"},
               {"molecules", "1", "number of molecules of this formula"},
               {"fraction", "1", "part of all molecules, those that have left among them"},
               {"fraction_error", "1", "standard error of that part"}},
              {}};
  const auto repeats = static_cast<double>(pah.repeats);
  for (const auto& [formula, count] : sums.formulas()) {
    const auto carbon = static_cast<double>(formula.carbon), hydrogen = static_cast<double>(formula.hydrogen);
    const double fraction = static_cast<double>(count) / repeats;
    table.rows.insert(table.rows.end(),
                      {pah.timeOf(formula.row), carbon, hydrogen,
                       1e-3 * (carbonWeight * carbon + hydrogenWeight * hydrogen), (carbon - hydrogen) / 2 + 1,
                       static_cast<double>(count), fraction, std::sqrt(fraction * (1 - fraction) / (repeats - 1))});
  }
  return table;
}

Table pahRateTable(const PahCase& pah) {
  Table table{{{"time", "s", "time"}, {"temperature", "K", "gas temperature"}}, {}};
  for (const PahProcessRow& row : pahProcesses)
    table.columns.push_back({row.name, "1/s", std::string("rate per site at which ") + row.description});
  for (std::size_t row = 0; row < pah.recorded.size(); ++row) {
    const GasSample& sample = pah.path.points[pah.recorded[row]];
    table.rows.insert(table.rows.end(), {sample.time, sample.gas.temperature});
    const PahRates rates = pahRates(pah.constants, sample.gas.temperature, sample.concentrations);
    table.rows.insert(table.rows.end(), rates.begin(), rates.end());
  }
  return table;
}

void writeMolecules(ResultsWriter& results, const std::vector<Molecule>& molecules) {
  for (const bool five : {false, true}) {
    std::vector<std::int64_t> numbers;
    for (std::size_t m = 0; m < molecules.size(); ++m)
      for (const LatticeCell& cell : molecules[m].cells(five))
        numbers.insert(numbers.end(), {static_cast<std::int64_t>(m), cell.q, cell.r});
    results.dataset(five ? "/molecules/five_rings" : "/molecules/six_rings",
                    {static_cast<std::int64_t>(numbers.size() / 3), 3}, numbers, "1",
                    five ? "repeat and cell (q, r) of each ring of five at the end"
                         : "repeat and cell (q, r) of each ring of six at the end");
  }
  std::vector<double> formulas;
  for (const Molecule& molecule : molecules)
    formulas.insert(formulas.end(), {static_cast<double>(molecule.carbon()), static_cast<double>(molecule.hydrogen())});
  results.table("/molecules/formulas",
                {{"carbon", "1", "carbon atoms of repeat 0, 1, ..."}, {"hydrogen", "1", "hydrogen atoms"}}, formulas);
}

}  // namespace lampblack::app
