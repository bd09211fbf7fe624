#include "app/flow/trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/gather.hpp"
#include "flow/carried_operator.hpp"
#include "flow/streamline.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/ensemble/ensemble_path.hpp"

namespace lampblack::app {
namespace {

// The gas as soot sees it, on the whole domain.
class GasOnPath {
 public:
  GasOnPath(const FlowContext& context, const State& state, const GasProperties& properties,
            const SootModelOptions& soot)
      : pressure_(state.thermodynamicPressure) {
    std::vector<std::size_t> species;
    for (const std::string& name : sootSpecies(soot)) species.push_back(context.mechanism.speciesIndex(name));
    width_ = fixed + static_cast<int>(species.size());
    const int owned = context.mesh.owned;
    std::vector<double> local(static_cast<std::size_t>(owned) * width_);
    std::vector<double> concentrations;
    for (int c = 0; c < owned; ++c) {
      const ParticleGas gas = gasOfCell(context, state, c, properties.viscosity[c], species, concentrations);
      double* out = &local[static_cast<std::size_t>(c) * width_];
      for (double value : {gas.temperature, gas.density, gas.viscosity, gas.meanMolecularWeight}) *out++ = value;
      for (double value : concentrations) *out++ = value;
    }
    fields_ = gatherNatural(context.mesh, local, width_);
  }

  [[nodiscard]] GasSample at(const PathPoint& point) const {
    const auto value = [&](int i) { return point.place.of(fields_, width_, i); };
    GasSample sample{point.time, {value(0), pressure_, value(1), value(2), value(3)}, {}};
    for (int i = fixed; i < width_; ++i) sample.concentrations.push_back(value(i));
    return sample;
  }

 private:
  static constexpr int fixed = 4;
  double pressure_;
  int width_ = 0;
  std::vector<double> fields_;
};

// A path and what became of the particles on it.
struct Trajectory {
  std::vector<PathPoint> places;
  ParticlePath path;
  std::vector<EnsemblePathRecord> records;
};

void writeTrajectory(ResultsWriter& results, std::size_t id, int owner, const Trajectory& trajectory,
                     const EnsemblePathOptions& options) {
  const std::string group = fmt::format("/trajectories/{}/", id);
  const std::vector<EnsemblePathRecord>& records = trajectory.records;
  const auto rows = static_cast<std::int64_t>(records.size());
  const auto column = [&](const std::string& name, const std::string& unit, const std::string& description, auto&& of) {
    std::vector<double> values;
    for (std::size_t i = 0; i < records.size(); ++i) values.push_back(of(i));
    results.dataset(group + name, {rows}, values, unit, description, owner);
  };
  column("time", "s", "time along the path", [&](std::size_t i) { return trajectory.path.points[i].time; });
  column("temperature", "K", "gas temperature",
         [&](std::size_t i) { return trajectory.path.points[i].gas.temperature; });
  column("number_density", "1/m^3", "particles per volume", [&](std::size_t i) { return records[i].totals.number; });
  column("volume_fraction", "1", "particle volume per volume",
         [&](std::size_t i) { return records[i].volumeFraction; });
  column("mean_diameter", "m", "number mean of the diameter",
         [&](std::size_t i) { return records[i].totals.meanDiameter(); });
  column("geometric_standard_deviation", "1", "of the diameter, by number",
         [&](std::size_t i) { return records[i].geometricDeviation; });
  std::vector<double> position;
  std::vector<double> distribution;
  for (std::size_t i = 0; i < records.size(); ++i) {
    position.insert(position.end(), trajectory.places[i].position.begin(), trajectory.places[i].position.end());
    distribution.insert(distribution.end(), records[i].distribution.begin(), records[i].distribution.end());
  }
  const auto bins = static_cast<std::int64_t>(options.bins);
  results.dataset(group + "position", {rows, 2}, position, "m", "radius and axial position (planar: x and y)", owner);
  results.dataset(group + "bin_edges", {bins + 1}, options.binEdges(), "m", "diameters between the bins", owner);
  results.dataset(group + "size_distribution", {rows, bins}, distribution, "1/m^3", "dN/dlog10(d)", owner);
}

// The rank of each path, the longest first, each to the rank with the least to do (Graham 1969).
std::vector<int> shareOut(const std::vector<double>& costs, int ranks) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t id) { return costs[id]; });
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  std::vector<int> owners(costs.size());
  for (const std::size_t id : order) {
    const auto least = std::ranges::min_element(load);
    *least += costs[id];
    owners[id] = static_cast<int>(least - load.begin());
  }
  return owners;
}

// A path of one point ends where it starts.
void warnOfShortPaths(const TrajectoryRequest& request, const std::vector<Trajectory>& trajectories) {
  std::vector<std::string> warnings;
  for (std::size_t id = 0; id < trajectories.size(); ++id)
    if (trajectories[id].places.size() < 2)
      warnings.push_back(fmt::format(
          "trajectory {} from ({:.6g}, {:.6g}) m leaves the domain in its first time step of {:g} s: it has one row, "
          "without particles",
          id, request.starts[id].r, request.starts[id].z, request.timeStep));
  printWarnings(warnings);
}

}  // namespace

void runTrajectories(const FlowContext& context, const FlowCase& flowCase, const State& state,
                     const GasProperties& properties, ResultsWriter& results) {
  const TrajectoryRequest& request = *flowCase.trajectories;
  const Mesh& m = context.mesh;
  const Streamlines streamlines(m, state, properties, waldmannThermophoresis());
  const GasOnPath gas(context, state, properties, request.soot);

  EnsemblePathOptions march;
  march.logDiameterMin = std::log10(request.smallest);
  march.logDiameterMax = std::log10(request.largest);
  march.bins = static_cast<std::size_t>(request.bins);
  EnsembleOptions options;
  options.particles = static_cast<std::size_t>(request.particles);
  options.splitTolerance = request.splitTolerance;
  options.seed = flowCase.seed;
  options.soot = request.soot;

  std::vector<Trajectory> trajectories(request.starts.size());
  std::vector<double> costs;
  collectively(m.comm, [&] {
    for (std::size_t id = 0; id < trajectories.size(); ++id) {
      const TrajectoryStart& start = request.starts[id];
      trajectories[id].places = streamlines.trace({start.r, start.z}, request.timeStep, request.duration);
      costs.push_back(static_cast<double>(trajectories[id].places.size()));
    }
  });
  const std::vector<int> owners = shareOut(costs, m.ranks);
  collectively(m.comm, [&] {
    for (std::size_t id = 0; id < trajectories.size(); ++id) {
      if (owners[id] != m.rank) continue;
      const TrajectoryStart& start = request.starts[id];
      Trajectory& one = trajectories[id];
      for (const PathPoint& place : one.places) one.path.points.push_back(gas.at(place));
      for (std::size_t k = 0; k + 1 < one.places.size(); ++k)
        one.path.divergence.push_back({one.places[k].divergence, one.places[k + 1].divergence});
      options.owner = id;
      try {
        one.records = marchPath(*makeEnsemble(options), one.path, march).records;
      } catch (const NumericsError& error) {
        throw NumericsError(
            fmt::format("trajectory {} from ({:.6g}, {:.6g}) m: {}", id, start.r, start.z, error.what()));
      }
    }
  });
  warnOfShortPaths(request, trajectories);
  for (std::size_t id = 0; id < trajectories.size(); ++id)
    writeTrajectory(results, id, owners[id], trajectories[id], march);
}

}  // namespace lampblack::app
