#include "app/problems/flame/flame_stochastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include "app/problems/flame/flame_ensemble_output.hpp"
#include "core/errors.hpp"
#include "io/table.hpp"

namespace lampblack::app {
namespace {

std::string stepLine(std::size_t k, const FlameCouplingStep& s, const std::string& watched) {
  return fmt::format(
      "stochastic, iteration {:<3} {:>5} points  f_v {:.4e} +- {:.1f} %  changes: f_v {:.1e}, T {:.1e}, {} {:.1e}\n", k,
      s.points, s.volumeFraction, 100 * s.noise, s.volumeFractionChange, s.temperatureChange, watched, s.speciesChange);
}

// Where it is largest.
std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
}

}  // namespace

StochasticFlame runStochasticFlame(MPI_Comm comm, const Mechanism& mechanism, double pressure, FlameSolver& solver,
                                   CarriedModel* carried, FlameSolution& solution, const StochasticRequest& request) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  StochasticFlame result;
  const FlameEnsembleOptions& ensemble = request.coupling.ensemble;
  if (!request.twoWay) {
    GasOfFlame gas;
    collectively(comm, [&] { gas = gasOfFlame(solution.profile, mechanism, pressure, *ensemble.make(0)); });
    result.paths = runFlameEnsemble(comm, gas, ensemble);
    return result;
  }
  std::size_t k = 0;
  FlameCoupling coupling = coupleFlame(comm, mechanism, pressure, solver, carried, std::move(solution),
                                       request.coupling, [&](const FlameCouplingStep& step) {
                                         if (rank == 0) fmt::print("{}", stepLine(k, step, request.watched));
                                         std::fflush(stdout);
                                         ++k;
                                       });
  solution = std::move(coupling.solution);
  result.paths = std::move(coupling.paths);
  result.steps = std::move(coupling.steps);
  result.converged = coupling.converged;
  return result;
}

void writeStochasticFlame(ResultsWriter& results, const StochasticRequest& request, const StochasticFlame& flame) {
  writeFlameEnsemble(results, flame.paths, request.coupling.ensemble, request.heights);
  if (flame.steps.empty()) return;
  using Step = FlameCouplingStep;
  TableOf<const Step&> table{
      {{"points", "1", "of the flame"}, [](const Step& s) { return static_cast<double>(s.points); }},
      {{"volume_fraction", "1", "the largest"}, [](const Step& s) { return s.volumeFraction; }},
      {{"noise", "1", "standard error of it, relative"}, [](const Step& s) { return s.noise; }},
      {{"volume_fraction_change", "1", "largest change since the last iteration, over the largest value"},
       [](const Step& s) { return s.volumeFractionChange; }},
      {{"temperature_change", "1", "the same of the temperature"}, [](const Step& s) { return s.temperatureChange; }},
      {{"species_change", "1", "the same of the mass fraction of " + request.watched},
       [](const Step& s) { return s.speciesChange; }}};
  for (std::size_t e = 0; e < request.elements.size(); ++e) {
    const std::string& element = request.elements[e];
    table.add({element + "_taken", "kg/m^2/s",
               "of the element " + element + ", that the ensemble takes from the gas along its paths"},
              [e](const Step& s) { return s.taken[e]; });
    table.add({element + "_leaving", "kg/m^2/s", "the same with which particles leave at the ends of paths"},
              [e](const Step& s) { return s.leaving[e]; });
  }
  table.add({"seconds", "s", "of the iteration"}, [](const Step& s) { return s.seconds; });
  table.of(flame.steps).write(results, "/stochastic/iterations");
}

void recordStochasticFlame(JsonWriter& json, const StochasticFlame& flame) {
  json.key("stochastic").beginObject();
  double most = 0, error = 0;
  for (const FlameEnsemblePath& path : flame.paths) {
    if (path.path.z.empty()) continue;
    const RepeatedValue& fraction = path.valuesOf("volume_fraction");
    const std::size_t k = largest(fraction.mean);
    if (fraction.mean[k] <= most) continue;
    most = fraction.mean[k];
    error = fraction.error[k];
  }
  json.field("maximum_volume_fraction", most).field("maximum_volume_fraction_error", error);
  double seconds = 0;
  for (const FlameEnsemblePath& path : flame.paths) seconds += path.seconds;
  json.field("seconds", seconds);
  json.field("iterations", static_cast<std::uint64_t>(flame.steps.size())).field("converged", flame.converged);
  json.endObject();
}

std::string stochasticFlameReport(const StochasticFlame& flame) {
  std::string text = "\nStochastic particles\n";
  for (const FlameEnsemblePath& path : flame.paths) {
    const auto& points = path.path.path.points;
    if (points.empty()) {
      text += fmt::format("  from the {}: particles do not move into the flame\n",
                          path.options.fromRight ? "right" : "left");
      continue;
    }
    const RepeatedValue& fraction = path.valuesOf("volume_fraction");
    const std::size_t k = largest(fraction.mean);
    text += fmt::format(
        "  from z = {:.4g} mm to {:.4g} mm ({}), {:.3g} ms: volume fraction up to {:.4e} +- {:.1e} at {:.4g} mm, "
        "number "
        "{:.3e} 1/m^3, mean diameter {:.3g} nm\n",
        1e3 * path.path.z.front(), 1e3 * path.path.z.back(),
        path.path.stagnates ? "near the stagnation plane" : "the end of the flame", 1e3 * points.back().time,
        fraction.mean[k], fraction.error[k], 1e3 * path.path.z[k], path.valuesOf("number_density").mean[k],
        1e9 * path.valuesOf("mean_diameter").mean[k]);
  }
  if (flame.steps.empty()) return text;
  const FlameCouplingStep& s = flame.steps.back();
  text += fmt::format("  {} after {} iterations; taken from the gas {:.6e}, leaving with particles {:.6e} kg/m2/s\n",
                      flame.converged ? "settled" : "NOT settled", flame.steps.size(),
                      std::accumulate(s.taken.begin(), s.taken.end(), 0.0),
                      std::accumulate(s.leaving.begin(), s.leaving.end(), 0.0));
  return text;
}

}  // namespace lampblack::app
