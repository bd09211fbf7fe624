#include "particles/population/comparison/repeat_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "particles/population/gelation_error.hpp"

namespace lampblack::particles {
namespace {

// The run is asked to stop in the middle of a repeat.
struct Cut {};

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::optional<double> RepeatRecord::gelation() const {
  return std::isnan(tail()[1]) ? std::nullopt : std::optional(tail()[1]);
}

PopulationCounters RepeatRecord::counters() const {
  PopulationCounters counters;
  for (std::size_t k = 0; k < numCounters; ++k)
    counters.*populationCounters[k].value = static_cast<std::uint64_t>(tail()[2 + k]);
  return counters;
}

std::size_t RepeatRecord::rows() const {
  std::size_t rows = 0;
  while (rows < shape_.rows && !std::isnan(moment(rows, 0))) ++rows;
  return rows;
}

void runRepeat(const PopulationCase& populationCase, const PopulationMethod& method, std::uint64_t repeat,
               std::optional<double> gelation, const RepeatRecord::Shape& shape, RepeatProgress& progress,
               std::span<double> data) {
  const std::vector<double> rows = populationCase.times.rows();
  const PopulationBins& bins = populationCase.bins;
  std::fill(data.begin(), data.end(), noValue);
  double seconds = 0;
  std::optional<double> gelled;
  const auto numbers = data.subspan(6 * shape.rows);
  const auto tail = numbers.subspan(shape.times * shape.bins);
  try {
    const std::unique_ptr<PopulationSolver> solver = makeSolver(populationCase, method, repeat);
    solver->setCallback([&] {
      if (stopRequest() != 0) throw Cut{};
      progress.at(method, repeat, solver->time());
    });
    // False where the population has gelled before that, and where the run is to stop.
    const auto advance = [&](double time) {
      if (gelled || stopRequest() != 0) return false;
      const double begin = cpuSeconds();
      try {
        if (gelation && time >= *gelation)
          gelled = *gelation;
        else if (time > solver->time())
          solver->advance(time);
      } catch (const GelationError& error) {
        gelled = error.time();
      } catch (const Cut&) {
        return false;
      }
      seconds += cpuSeconds() - begin;
      return !gelled;
    };
    std::size_t next = 0;
    const auto distributionsUntil = [&](double time) {
      for (; next < bins.times.size() && bins.times[next] <= time && advance(bins.times[next]); ++next) {
        const std::vector<double> number = solver->numberInBins(bins.edges);
        std::copy(number.begin(), number.end(), numbers.begin() + static_cast<std::ptrdiff_t>(next * shape.bins));
      }
    };
    for (std::size_t row = 0; row < rows.size(); ++row) {
      distributionsUntil(rows[row]);
      if (!advance(rows[row])) break;
      const auto moments = solver->moments();
      std::copy(moments.begin(), moments.end(), data.begin() + static_cast<std::ptrdiff_t>(6 * row));
      data[6 * row + 4] = solver->geometricDeviation();
      data[6 * row + 5] = static_cast<double>(solver->particles());
    }
    tail[0] = seconds;
    tail[1] = gelled.value_or(noValue);
    for (std::size_t k = 0; k < RepeatRecord::numCounters; ++k)
      tail[2 + k] = static_cast<double>(solver->counters().*populationCounters[k].value);
    progress.repeatEnded();
  } catch (const InputError& error) {
    throw InputError(fmt::format("method {}: {}", method.name, error.what()));
  } catch (const NumericsError& error) {
    throw NumericsError(fmt::format("method {}, repeat {}: {}", method.name, repeat, error.what()));
  }
}

}  // namespace lampblack::particles
