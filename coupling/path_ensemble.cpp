#include "coupling/path_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"

namespace lampblack::coupling {
namespace {

constexpr std::vector<double> PathExchange::*exchangeParts[] = {&PathExchange::gas, &PathExchange::elements,
                                                                &PathExchange::processes};

// Where the numbers of a repeat stand: its records, what was exchanged between them, what was counted.
struct PathNumbers {
  std::size_t records, columns, bins, exchanged[3], elements, counts;

  [[nodiscard]] std::size_t record() const { return columns + bins; }
  [[nodiscard]] std::size_t exchange() const { return exchanged[0] + exchanged[1] + exchanged[2]; }
  [[nodiscard]] std::size_t firstExchange() const { return records * record(); }
  [[nodiscard]] std::size_t firstContent() const { return firstExchange() + (records - 1) * exchange(); }
  [[nodiscard]] std::size_t firstCount() const { return firstContent() + elements; }
  [[nodiscard]] std::size_t all() const { return firstCount() + counts; }
};

void packPath(const PathResult& result, std::span<double> numbers) {
  auto out = numbers.begin();
  const auto put = [&](const std::vector<double>& values) { out = std::ranges::copy(values, out).out; };
  for (const PathRecord& r : result.records) {
    put(r.values);
    put(r.distribution);
  }
  for (const PathExchange& x : result.exchange)
    for (const auto part : exchangeParts) put(x.*part);
  put(result.content);
  for (const auto& [name, value] : result.counts) *out++ = value;
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

const RepeatedValue& PathEnsemble::valuesOf(const std::string& name) const {
  const auto found = std::ranges::find(columns, material + "_" + name, &Quantity::name);
  return values.at(static_cast<std::size_t>(found - columns.begin()));
}

double PathEnsemble::count(const std::string& name) const {
  const auto found = std::ranges::find(counts, name, [](const auto& count) { return count.first; });
  return found == counts.end() ? 0.0 : found->second;
}

PathEnsemble runPathEnsemble(MPI_Comm comm, const ParticlePath& path, const MakePopulation& make,
                             std::uint64_t firstOwner, std::size_t repeats, const PathMarch& march,
                             const std::string& what) {
  PathEnsemble result;
  PathNumbers at{};
  collectively(comm, [&] {
    if (repeats < 2) throw InputError("stochastic particles: at least 2 repeats are needed");
    const auto population = make(firstOwner);
    result.material = population->material();
    result.columns = population->columns();
    const auto processes = population->processes();
    result.processes.assign(processes.begin(), processes.end());
    result.counts = population->counts();
    for (auto& count : result.counts) count.second = 0;
    at = {march.recorded.empty() ? path.points.size() : march.recorded.size(),
          result.columns.size(),
          march.bins.count,
          {population->species().size(), population->elements().size(), result.processes.size()},
          population->elements().size(),
          result.counts.size()};
  });
  const double start = MPI_Wtime();
  std::vector<double> all = gatherRepeats(comm, 0, repeats, at.all(), [&](std::uint64_t r, std::span<double> numbers) {
    if (const int signal = stopRequest(); signal != 0)
      throw Stopped(signal, "stopped by " + signalName(signal) + " before the end of the path");
    try {
      packPath(marchPath(*make(firstOwner + r), path, march), numbers);
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("{}, repeat {}: {}", what, r, error.what()));
    }
  });
  shareRepeats(comm, all, repeats * at.all());
  const auto meanOf = [&](std::size_t place, double& mean, double& error) {
    summarise(&all[place], repeats, at.all(), mean, error);
  };
  result.values.assign(at.columns, {std::vector<double>(at.records), std::vector<double>(at.records)});
  result.distribution = {std::vector<double>(at.records * at.bins), std::vector<double>(at.records * at.bins)};
  for (std::size_t i = 0; i < at.records; ++i) {
    for (std::size_t c = 0; c < at.columns; ++c)
      meanOf(i * at.record() + c, result.values[c].mean[i], result.values[c].error[i]);
    for (std::size_t b = 0; b < at.bins; ++b)
      meanOf(i * at.record() + at.columns + b, result.distribution.mean[i * at.bins + b],
             result.distribution.error[i * at.bins + b]);
  }
  std::size_t place = at.firstExchange();
  for (std::size_t i = 0; i + 1 < at.records; ++i) {
    PathExchange &mean = result.exchange.emplace_back(), &error = result.exchangeError.emplace_back();
    for (std::size_t part = 0; part < std::size(exchangeParts); ++part) {
      std::vector<double>&means = mean.*exchangeParts[part], &errors = error.*exchangeParts[part];
      means.resize(at.exchanged[part]);
      errors.resize(at.exchanged[part]);
      for (std::size_t k = 0; k < at.exchanged[part]; ++k) meanOf(place++, means[k], errors[k]);
    }
  }
  result.content.resize(at.elements);
  for (std::size_t e = 0; e < at.elements; ++e) {
    double error = 0;
    meanOf(at.firstContent() + e, result.content[e], error);
  }
  for (std::size_t r = 0; r < repeats; ++r)
    for (std::size_t k = 0; k < at.counts; ++k) result.counts[k].second += all[r * at.all() + at.firstCount() + k];
  result.seconds = MPI_Wtime() - start;
  return result;
}

}  // namespace lampblack::coupling
