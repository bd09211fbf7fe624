#include "coupling/flame_ensemble.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::coupling {
namespace {

// An exchange is nothing but doubles, which makes its mean and its message simple.
static_assert(std::is_trivially_copyable_v<EnsembleExchange> && sizeof(EnsembleExchange) % sizeof(double) == 0);
constexpr std::size_t exchangeWidth = sizeof(EnsembleExchange) / sizeof(double);
constexpr std::size_t values = 8;  // of a point, besides its distribution

void pack(const EnsemblePathResult& result, std::size_t bins, double* out) {
  for (const EnsemblePathRecord& r : result.records) {
    const auto& t = r.totals;
    const double n = t.number;
    for (const double value : {n, r.volumeFraction, t.meanDiameter(), r.geometricDeviation,
                               n > 0 ? t.primaries / n : 0.0, t.carbon, t.hydrogen, t.surface})
      *out++ = value;
    for (std::size_t b = 0; b < bins; ++b) *out++ = r.distribution[b];
  }
  for (const EnsembleExchange& x : result.exchange) {
    const auto* part = reinterpret_cast<const double*>(&x);
    for (std::size_t k = 0; k < exchangeWidth; ++k) *out++ = part[k];
  }
}

// Of `count` values that lie `stride` apart, in the order of the repeats.
void summarise(const double* first, std::size_t count, std::size_t stride, double& mean, double& error) {
  mean = error = 0;
  for (std::size_t r = 0; r < count; ++r) mean += first[r * stride];
  mean /= static_cast<double>(count);
  for (std::size_t r = 0; r < count; ++r) error += (first[r * stride] - mean) * (first[r * stride] - mean);
  error = std::sqrt(error / (static_cast<double>(count) * static_cast<double>(count - 1)));
}

FlameEnsemblePath runPath(MPI_Comm comm, const FlameSootGas& gas, const FlameEnsembleOptions& options,
                          std::size_t index) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  FlameEnsemblePath result;
  result.options = options.paths[index];
  collectively(comm, [&] { result.path = flamePath(gas, result.options); });
  const std::size_t points = result.path.path.points.size();
  if (points == 0) return result;
  const double start = MPI_Wtime();
  const std::size_t bins = options.march.bins, row = values + bins;
  const std::size_t width = points * row + (points - 1) * exchangeWidth;
  // Each repeat is on one rank, zero on the others: sums over the ranks are exact.
  std::vector<double> all(options.repeats * width, 0.0);
  collectively(comm, [&] {
    for (std::size_t r = static_cast<std::size_t>(rank); r < options.repeats; r += static_cast<std::size_t>(ranks)) {
      if (const int signal = stopRequest(); signal != 0)
        throw NumericsError("stochastic soot: stopped by " + signalName(signal));
      EnsembleOptions own = options.soot;
      own.owner = (static_cast<std::uint64_t>(index) << 32) + r;
      try {
        const auto soot = makeEnsemble(own);
        pack(marchPath(*soot, result.path.path, options.march), bins, &all[r * width]);
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("stochastic soot, path {}, repeat {}: {}", index, r, error.what()));
      }
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm);
  RepeatedValue* const named[values] = {
      &result.number,    &result.volumeFraction, &result.meanDiameter, &result.geometricDeviation,
      &result.primaries, &result.carbon,         &result.hydrogen,     &result.surface};
  for (RepeatedValue* value : named) {
    value->mean.resize(points);
    value->error.resize(points);
  }
  result.distribution.mean.resize(points * bins);
  result.distribution.error.resize(points * bins);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t k = 0; k < values; ++k)
      summarise(&all[i * row + k], options.repeats, width, named[k]->mean[i], named[k]->error[i]);
    for (std::size_t b = 0; b < bins; ++b)
      summarise(&all[i * row + values + b], options.repeats, width, result.distribution.mean[i * bins + b],
                result.distribution.error[i * bins + b]);
  }
  result.exchange.resize(points - 1);
  for (std::size_t i = 0; i + 1 < points; ++i) {
    auto* part = reinterpret_cast<double*>(&result.exchange[i]);
    double error = 0;
    for (std::size_t k = 0; k < exchangeWidth; ++k)
      summarise(&all[points * row + i * exchangeWidth + k], options.repeats, width, part[k], error);
  }
  result.seconds = MPI_Wtime() - start;
  return result;
}

}  // namespace

std::vector<FlameEnsemblePath> runFlameEnsemble(MPI_Comm comm, const FlameSootGas& gas,
                                                const FlameEnsembleOptions& options) {
  collectively(comm, [&] {
    if (options.repeats < 2) throw InputError("stochastic soot: at least 2 repeats are needed");
  });
  std::vector<FlameEnsemblePath> results;
  for (std::size_t k = 0; k < options.paths.size(); ++k) results.push_back(runPath(comm, gas, options, k));
  return results;
}

}  // namespace lampblack::coupling
