#include "app/problems/reactor/reactor_history.hpp"

#include <fmt/format.h>

#include "core/stop_request.hpp"
#include "io/progress.hpp"

namespace lampblack::app {

void ReactorHistory::open(const std::filesystem::path& path) {
  writer_.emplace(MPI_COMM_SELF, path, columns_);
}

void ReactorHistory::follow(StiffIntegrator& integrator, const std::optional<double>& interval, double end,
                            const std::function<double(double at)>& nextStop, const MakeRow& makeRow,
                            const std::function<void()>& afterStep) {
  std::vector<double> y(integrator.state().begin(), integrator.state().end());
  double last = integrator.time();
  std::size_t rows = 0;
  const auto row = [&](double at, std::span<const double> state) {
    writer_->row(makeRow(at, state));
    last = at;
    ++rows;
  };
  row(last, y);
  Progress progress(MPI_COMM_SELF, last, end, Progress::logInterval);
  while (integrator.time() < end && stopRequest() == 0) {
    if (nextStop) integrator.stopAt(nextStop(integrator.time()));
    integrator.step();
    afterStep();
    if (progress.due())
      progress.say(fmt::format("step {}  {} {:.4g} {}", integrator.statistics().steps, columns_[0].name,
                               integrator.time(), columns_[0].unit),
                   integrator.time());
    if (interval) {
      for (double next = static_cast<double>(rows) * *interval; next <= integrator.time();
           next = static_cast<double>(rows) * *interval) {
        integrator.interpolate(next, y);
        row(next, y);
      }
      if (integrator.time() < end || last >= end) continue;
    }
    row(integrator.time(), integrator.state());
  }
  progress.finish();
}

void ReactorHistory::writeTo(ResultsWriter& results) const {
  if (writer_)
    writer_->writeTo(results);
  else
    results.table("/history", columns_, {});
}

}  // namespace lampblack::app
