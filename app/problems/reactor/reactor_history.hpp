// The history of a reactor on rank 0: rows at the integrator's steps or at regular points, to history.csv while the run
// goes on and to the results file at its end.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/modules.hpp"
#include "io/history.hpp"

namespace lampblack::app {

class ReactorHistory {
 public:
  using MakeRow = std::function<std::vector<double>(double at, std::span<const double> y)>;

  // Columns of the gas, then of the particles.
  explicit ReactorHistory(std::vector<Quantity> columns, const std::vector<Quantity>& more = {})
      : columns_(std::move(columns)) {
    columns_.insert(columns_.end(), more.begin(), more.end());
  }

  // Rank 0. InputError where the file cannot be made.
  void open(const std::filesystem::path& path);
  void row(std::span<const double> values) { writer_->row(values); }
  // Integrates from the integrator's start to `end` and writes rows: the start, each step (or each `interval`, by
  // interpolation), and the end. `nextStop`: the next kink of the rates after a point, at most `end`; steps end there;
  // empty: none.
  // `afterStep` is called after each step.
  // Ends early where the run is asked to stop; long ones say now and then how far they are.
  void follow(StiffIntegrator& integrator, const std::optional<double>& interval, double end,
              const std::function<double(double at)>& nextStop, const MakeRow& makeRow,
              const std::function<void()>& afterStep);
  // Collective.
  void writeTo(ResultsWriter& results) const;

 private:
  std::vector<Quantity> columns_;
  std::optional<HistoryWriter> writer_;  // of rank 0
};

}  // namespace lampblack::app
