#include "app/problems/flame/flame_ensemble_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lampblack::app {
namespace {

void writePath(ResultsWriter& results, std::size_t id, const FlameEnsemblePath& path,
               const FlameEnsembleOptions& options, std::span<const double> heights) {
  const std::string group = fmt::format("/stochastic/path_{}/", id);
  const auto& points = path.path.path.points;
  const auto rows = static_cast<std::int64_t>(points.size());
  if (rows == 0) return;
  const std::vector<double>& z = path.path.z;
  std::vector<double> time, temperature;
  for (const GasSample& point : points) {
    time.push_back(point.time);
    temperature.push_back(point.gas.temperature);
  }
  results.dataset(group + "z", {rows}, z, "m", "position", 0);
  results.dataset(group + "time", {rows}, time, "s", "since the start of the path", 0);
  results.dataset(group + "velocity", {rows}, path.path.velocity, "m/s", "of the particles", 0);
  results.dataset(group + "temperature", {rows}, temperature, "K", "of the gas", 0);
  for (std::size_t c = 0; c < path.columns.size(); ++c) {
    const auto& [name, unit, description] = path.columns[c];
    results.dataset(group + name, {rows}, path.values[c].mean, unit, description + ", mean of the repeats", 0);
    results.dataset(group + name + "_error", {rows}, path.values[c].error, unit, "standard error of that mean", 0);
  }
  const std::size_t bins = options.march.bins.count;
  results.dataset(group + "bin_edges", {static_cast<std::int64_t>(bins) + 1}, options.march.bins.edges(), "m",
                  "diameters between the bins", 0);
  std::vector<double> at, mean, error;
  for (const double height : heights) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < z.size(); ++i)
      if (std::abs(z[i] - height) < std::abs(z[best] - height)) best = i;
    at.push_back(z[best]);
    const auto append = [&](std::vector<double>& to, const std::vector<double>& from) {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(best * bins);
      to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(bins));
    };
    append(mean, path.distribution.mean);
    append(error, path.distribution.error);
  }
  const auto count = static_cast<std::int64_t>(at.size()), columns = static_cast<std::int64_t>(bins);
  if (count == 0) return;
  results.dataset(group + "distribution_z", {count}, at, "m", "where the distributions are", 0);
  results.dataset(group + "distribution", {count, columns}, mean, "1/m^3", "dN/dlog10(d), mean of the repeats", 0);
  results.dataset(group + "distribution_error", {count, columns}, error, "1/m^3", "standard error of that mean", 0);
}

}  // namespace

void writeFlameEnsemble(ResultsWriter& results, const std::vector<FlameEnsemblePath>& paths,
                        const FlameEnsembleOptions& options, std::span<const double> heights) {
  for (std::size_t k = 0; k < paths.size(); ++k) writePath(results, k, paths[k], options, heights);
}

}  // namespace lampblack::app
