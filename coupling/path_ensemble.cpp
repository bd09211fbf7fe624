#include "coupling/path_ensemble.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"

namespace lampblack::coupling {
namespace {

// An exchange is nothing but doubles, which makes its mean and its message simple; counts are below 2^53.
static_assert(std::is_trivially_copyable_v<EnsembleExchange> && sizeof(EnsembleExchange) % sizeof(double) == 0);
constexpr std::size_t exchangeWidth = sizeof(EnsembleExchange) / sizeof(double);
constexpr std::size_t counters = std::size(populationCounters);
constexpr std::size_t values = 13;  // of a record, besides its distribution

void pack(const EnsemblePathResult& result, std::size_t bins, double* out) {
  for (const EnsemblePathRecord& r : result.records) {
    const auto& t = r.totals;
    const double n = t.number;
    for (const double value :
         {n, r.volumeFraction, t.meanDiameter(), r.geometricDeviation, n > 0 ? t.primaries / n : 0.0, t.carbon,
          t.hydrogen, t.surface, t.mass(), n > 0 ? std::cbrt(6 / constants::pi * r.volumeFraction / n) : 0.0,
          r.massSquared, r.massCubed, static_cast<double>(r.coagulations)})
      *out++ = value;
    for (std::size_t b = 0; b < bins; ++b) *out++ = r.distribution[b];
  }
  for (const EnsembleExchange& x : result.exchange) {
    const auto* part = reinterpret_cast<const double*>(&x);
    for (std::size_t k = 0; k < exchangeWidth; ++k) *out++ = part[k];
  }
  for (const PopulationCounter& counter : populationCounters)
    *out++ = static_cast<double>(result.counters.*counter.value);
}

// Of `count` values that lie `stride` apart, in the order of the repeats.
void summarise(const double* first, std::size_t count, std::size_t stride, double& mean, double& error) {
  mean = error = 0;
  for (std::size_t r = 0; r < count; ++r) mean += first[r * stride];
  mean /= static_cast<double>(count);
  for (std::size_t r = 0; r < count; ++r) error += (first[r * stride] - mean) * (first[r * stride] - mean);
  error = std::sqrt(error / (static_cast<double>(count) * static_cast<double>(count - 1)));
}

}  // namespace

PathEnsemble runPathEnsemble(MPI_Comm comm, const ParticlePath& path, const EnsembleOptions& options,
                             std::size_t repeats, const EnsemblePathOptions& march, const std::string& what) {
  collectively(comm, [&] {
    if (repeats < 2) throw InputError("stochastic soot: at least 2 repeats are needed");
  });
  PathEnsemble result;
  const double start = MPI_Wtime();
  const std::size_t records = march.recorded.empty() ? path.points.size() : march.recorded.size();
  const std::size_t bins = march.bins.count, row = values + bins;
  const std::size_t width = records * row + (records - 1) * exchangeWidth + counters;
  std::vector<double> all = gatherRepeats(comm, 0, repeats, width, [&](std::uint64_t r, std::span<double> record) {
    if (const int signal = stopRequest(); signal != 0)
      throw Stopped(signal, "stopped by " + signalName(signal) + " before the end of the path");
    EnsembleOptions own = options;
    own.owner = options.owner + r;
    try {
      const auto soot = makeEnsemble(own);
      pack(marchPath(*soot, path, march), bins, record.data());
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("{}, repeat {}: {}", what, r, error.what()));
    }
  });
  shareRepeats(comm, all, repeats * width);
  RepeatedValue* const named[values] = {
      &result.number,      &result.volumeFraction, &result.meanDiameter, &result.geometricDeviation,
      &result.primaries,   &result.carbon,         &result.hydrogen,     &result.surface,
      &result.mass,        &result.volumeDiameter, &result.massSquared,  &result.massCubed,
      &result.coagulations};
  for (RepeatedValue* value : named) {
    value->mean.resize(records);
    value->error.resize(records);
  }
  result.distribution.mean.resize(records * bins);
  result.distribution.error.resize(records * bins);
  for (std::size_t i = 0; i < records; ++i) {
    for (std::size_t k = 0; k < values; ++k)
      summarise(&all[i * row + k], repeats, width, named[k]->mean[i], named[k]->error[i]);
    for (std::size_t b = 0; b < bins; ++b)
      summarise(&all[i * row + values + b], repeats, width, result.distribution.mean[i * bins + b],
                result.distribution.error[i * bins + b]);
  }
  result.exchange.resize(records - 1);
  result.exchangeError.resize(records - 1);
  for (std::size_t i = 0; i + 1 < records; ++i) {
    auto* mean = reinterpret_cast<double*>(&result.exchange[i]);
    auto* error = reinterpret_cast<double*>(&result.exchangeError[i]);
    for (std::size_t k = 0; k < exchangeWidth; ++k)
      summarise(&all[records * row + i * exchangeWidth + k], repeats, width, mean[k], error[k]);
  }
  for (std::size_t k = 0; k < counters; ++k)
    for (std::size_t r = 0; r < repeats; ++r)
      result.counters.*populationCounters[k].value += static_cast<std::uint64_t>(all[r * width + width - counters + k]);
  result.seconds = MPI_Wtime() - start;
  return result;
}

}  // namespace lampblack::coupling
