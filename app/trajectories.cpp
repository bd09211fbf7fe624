#include "app/trajectories.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/warnings.hpp"
#include "core/errors.hpp"
#include "core/gather.hpp"
#include "flow/streamline.hpp"
#include "particles/ensemble.hpp"
#include "particles/trajectory_ensemble.hpp"

namespace lampblack {
namespace {

// The gas as soot sees it, on the whole domain.
class GasOnPath {
 public:
  GasOnPath(const FlowContext& context, const State& state, const GasProperties& properties, const SootOperator& soot)
      : pressure_(state.thermodynamicPressure),
        pahCount_(soot.pahSpecies().size()),
        width_(fixed + static_cast<int>(pahCount_)) {
    const int owned = context.mesh.owned;
    std::vector<double> local(static_cast<std::size_t>(owned) * width_);
    std::vector<double> pah;
    for (int c = 0; c < owned; ++c) {
      const SootGasState gas = soot.gasOf(state, c, properties.viscosity[c], pah);
      double* out = &local[static_cast<std::size_t>(c) * width_];
      for (double value : {gas.temperature, gas.density, gas.viscosity, gas.meanMolecularWeight, gas.H, gas.H2, gas.OH,
                           gas.H2O, gas.O2, gas.C2H2})
        *out++ = value;
      for (double value : pah) *out++ = value;
    }
    fields_ = gatherNatural(context.mesh, local, width_);
  }

  [[nodiscard]] TrajectorySample at(const PathPoint& point) const {
    const auto value = [&](int i) { return point.place.of(fields_, width_, i); };
    TrajectorySample sample;
    sample.time = point.time;
    sample.position = {point.position[0], point.position[1], 0.0};
    sample.divergence = point.divergence;
    sample.gas = {value(0), pressure_, value(1), value(2), value(3), value(4),
                  value(5), value(6),  value(7), value(8), value(9), {}};
    for (std::size_t i = 0; i < pahCount_; ++i) sample.pah.push_back(value(fixed + static_cast<int>(i)));
    return sample;
  }

 private:
  static constexpr int fixed = 10;
  double pressure_;
  std::size_t pahCount_;
  int width_;
  std::vector<double> fields_;
};

void writeTrajectory(ResultsWriter& results, std::size_t id, int owner, const std::vector<TrajectorySample>& samples,
                     const std::vector<TrajectoryRecord>& records, const std::vector<double>& binEdges,
                     std::size_t bins) {
  const std::string group = fmt::format("/trajectories/{}/", id);
  const auto rows = static_cast<std::int64_t>(records.size());
  const auto column = [&](const std::string& name, const std::string& unit, const std::string& description, auto&& of) {
    std::vector<double> values;
    for (std::size_t i = 0; i < records.size(); ++i) values.push_back(of(i));
    results.dataset(group + name, {rows}, values, unit, description, owner);
  };
  column("time", "s", "time along the path", [&](std::size_t i) { return records[i].time; });
  column("temperature", "K", "gas temperature", [&](std::size_t i) { return samples[i].gas.temperature; });
  column("number_density", "1/m^3", "particles per volume", [&](std::size_t i) { return records[i].numberDensity; });
  column("volume_fraction", "1", "particle volume per volume",
         [&](std::size_t i) { return records[i].volumeFraction; });
  column("mean_diameter", "m", "number mean of the diameter", [&](std::size_t i) { return records[i].meanDiameter; });
  column("geometric_standard_deviation", "1", "of the diameter, by number",
         [&](std::size_t i) { return records[i].geometricStandardDeviation; });
  std::vector<double> position;
  std::vector<double> distribution;
  for (const TrajectoryRecord& record : records) {
    position.insert(position.end(), {record.position[0], record.position[1]});
    distribution.insert(distribution.end(), record.distribution.begin(), record.distribution.end());
  }
  results.dataset(group + "position", {rows, 2}, position, "m", "radius and axial position (planar: x and y)", owner);
  results.dataset(group + "bin_edges", {static_cast<std::int64_t>(bins) + 1}, binEdges, "m",
                  "diameters between the bins", owner);
  results.dataset(group + "size_distribution", {rows, static_cast<std::int64_t>(bins)}, distribution, "1/m^3",
                  "dN/dlog10(d)", owner);
}

// Collective. A path of one point ends where it starts.
void warnOfShortPaths(const Mesh& m, const TrajectoryRequest& request,
                      const std::vector<std::vector<TrajectorySample>>& samples) {
  std::vector<std::int64_t> points;
  for (const auto& path : samples) points.push_back(static_cast<std::int64_t>(path.size()));
  MPI_Allreduce(MPI_IN_PLACE, points.data(), static_cast<int>(points.size()), MPI_INT64_T, MPI_SUM, m.comm);
  std::vector<std::string> warnings;
  for (std::size_t id = 0; id < points.size(); ++id)
    if (points[id] < 2)
      warnings.push_back(fmt::format(
          "trajectory {} from ({:.6g}, {:.6g}) m leaves the domain in its first time step of {:g} s: it has one row, "
          "without particles",
          id, request.starts[id].r, request.starts[id].z, request.timeStep));
  printWarnings(warnings);
}

}  // namespace

void runTrajectories(const FlowContext& context, const FlowCase& flowCase, const State& state,
                     const GasProperties& properties, const SootOperator& soot, ResultsWriter& results) {
  const TrajectoryRequest& request = *flowCase.trajectories;
  const Mesh& m = context.mesh;
  const Streamlines streamlines(m, state, properties, TwoEquationSoot::thermophoreticCoefficient());
  const GasOnPath gas(context, state, properties, soot);

  TrajectoryOptions options;
  options.logDiameterMin = std::log10(request.smallest);
  options.logDiameterMax = std::log10(request.largest);
  options.bins = static_cast<std::size_t>(request.bins);
  std::vector<double> binEdges;
  for (int b = 0; b <= request.bins; ++b)
    binEdges.push_back(
        std::pow(10.0, options.logDiameterMin + (options.logDiameterMax - options.logDiameterMin) * b / request.bins));

  const std::size_t count = request.starts.size();
  std::vector<std::vector<TrajectorySample>> samples(count);
  std::vector<std::vector<TrajectoryRecord>> records(count);
  collectively(m.comm, [&] {
    for (std::size_t id = static_cast<std::size_t>(m.rank); id < count; id += static_cast<std::size_t>(m.ranks)) {
      for (const PathPoint& point :
           streamlines.trace({request.starts[id].r, request.starts[id].z}, request.timeStep, request.duration))
        samples[id].push_back(gas.at(point));
      EnsembleOptions ensembleOptions;
      ensembleOptions.capacity = static_cast<std::size_t>(request.particles);
      ensembleOptions.seed = flowCase.seed;
      ensembleOptions.owner = id;
      ensembleOptions.soot = *flowCase.soot;
      Ensemble ensemble(ensembleOptions);
      try {
        records[id] = marchTrajectory(ensemble, samples[id], options);
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("trajectory {} from ({:.6g}, {:.6g}) m: {}", id, request.starts[id].r,
                                        request.starts[id].z, error.what()));
      }
    }
  });
  warnOfShortPaths(m, request, samples);
  for (std::size_t id = 0; id < count; ++id)
    writeTrajectory(results, id, static_cast<int>(id % static_cast<std::size_t>(m.ranks)), samples[id], records[id],
                    binEdges, options.bins);
}

}  // namespace lampblack
