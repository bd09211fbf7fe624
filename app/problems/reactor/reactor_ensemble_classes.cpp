#include "app/problems/reactor/reactor_ensemble_classes.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "app/run/repeat_columns.hpp"
#include "io/csv.hpp"

namespace lampblack::app {

std::size_t EnsembleClasses::size(const ReactorCase& reactorCase) {
  if (reactorCase.ensemble->classes.empty()) return 0;
  const std::size_t averages = reactorCase.ensemble->make(0)->functionals().size();
  std::size_t size = 0;
  for (const ReactorPopulations::Classes& by : reactorCase.ensemble->classes)
    size += (by.edges.size() + 1) * (1 + averages);
  return size * reactorCase.kind->reactors();
}

EnsembleClasses::EnsembleClasses(const ReactorCase& reactorCase, const ReactorRepeatShape& shape) : rows_(shape.rows) {
  if (reactorCase.ensemble->classes.empty()) return;
  const auto made = reactorCase.ensemble->make(0);
  const std::vector<ParticleFunctional> averages = made->functionals();
  const std::vector<Quantity> sortedBy = made->classedBy();
  averages_ = averages.size();
  std::size_t first = 0;
  for (std::size_t r = 0; r < reactorCase.kind->reactors(); ++r)
    for (const ReactorPopulations::Classes& by : reactorCase.ensemble->classes) {
      const Quantity& quantity = sortedBy[by.by];
      Sorted sorted{reactorCase.kind->prefix(r) + quantity.name, by.edges, first, {}, {}};
      sorted.columns = {reactorCase.kind->placeColumns()[0],
                        {"from", quantity.unit, "lower end of the class, of " + quantity.description},
                        {"to", quantity.unit, "upper end of the class"}};
      addRepeatColumns({"fraction", "1", "part of all particles that is in the class"}, sorted.columns);
      for (const auto& average : averages)
        addRepeatColumns({average.name, average.unit, "mean over the particles of the class of " + average.description},
                         sorted.columns);
      sorted.values.resize(rows_ * (by.edges.size() + 1) * (1 + averages_));
      first += (by.edges.size() + 1) * (1 + averages_);
      all_.push_back(std::move(sorted));
    }
}

void EnsembleClasses::add(const ReactorRepeatNumbers<const double>& repeat) {
  ++repeats_;
  const std::size_t width = 1 + averages_;
  for (Sorted& sorted : all_) {
    const std::size_t classes = sorted.edges.size() + 1;
    for (std::size_t row = 0; row < rows_; ++row) {
      const auto numbers = repeat.classes(row).subspan(sorted.first, classes * width);
      double all = 0;
      for (std::size_t c = 0; c < classes; ++c) all += numbers[c * width];
      for (std::size_t c = 0; c < classes; ++c) {
        RunningRatio* values = &sorted.values[(row * classes + c) * width];
        const double number = numbers[c * width];
        values[0].add(all, number);
        for (std::size_t k = 1; k < width; ++k) values[k].add(number, numbers[c * width + k]);
      }
    }
  }
}

std::vector<double> EnsembleClasses::rowsOf(const Sorted& sorted, const std::vector<double>& places) const {
  std::vector<double> rows;
  if (repeats_ < 2) return rows;
  const RepeatIntervals intervals(repeats_);
  const std::size_t width = 1 + averages_, classes = sorted.edges.size() + 1;
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t c = 0; c < classes; ++c) {
      rows.insert(rows.end(), {places[row], c == 0 ? 0.0 : sorted.edges[c - 1],
                               c + 1 < classes ? sorted.edges[c] : std::numeric_limits<double>::infinity()});
      for (std::size_t k = 0; k < width; ++k) {
        const RunningRatio& value = sorted.values[(row * classes + c) * width + k];
        intervals.append(value.ratio(), value.standardError(), rows);
      }
    }
  return rows;
}

void EnsembleClasses::writeTables(const RunFolder& folder, const std::vector<double>& places) const {
  for (const Sorted& sorted : all_)
    writeFileAtomically(folder.file("classes_" + sorted.name + ".csv"),
                        csvTable(sorted.columns, rowsOf(sorted, places)));
}

void EnsembleClasses::write(ResultsWriter& results, const std::vector<double>& places) const {
  for (const Sorted& sorted : all_) results.table("/classes/" + sorted.name, sorted.columns, rowsOf(sorted, places));
}

}  // namespace lampblack::app
