#include "app/problems/flow/trajectories.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "app/problems/flow/flow_case_parts.hpp"
#include "app/run/warnings.hpp"
#include "core/cell_finder.hpp"
#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/rank_exchange.hpp"
#include "coupling/given_gas.hpp"
#include "flow/paths/path_gas.hpp"
#include "flow/paths/streamline.hpp"
#include "io/csv.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/stochastic/population_path.hpp"

namespace lampblack::app {
namespace {

// A path and what became of the particles on it.
struct Trajectory {
  std::vector<Vector3> places;  // m
  ParticlePath path;
  std::string gasTable;  // of all species; empty: not wanted
  std::vector<PathRecord> records;
};

// `columns`: of the population.
void writeTrajectory(ResultsWriter& results, std::size_t id, int owner, const Mesh& mesh, const Trajectory& trajectory,
                     const std::vector<Quantity>& columns, const SizeBins& bins) {
  const std::string group = fmt::format("/trajectories/{}/", id);
  const std::vector<PathRecord>& records = trajectory.records;
  const auto rows = static_cast<std::int64_t>(records.size());
  const auto column = [&](const std::string& name, const std::string& unit, const std::string& description, auto&& of) {
    std::vector<double> values;
    for (std::size_t i = 0; i < records.size(); ++i) values.push_back(of(i));
    results.dataset(group + name, {rows}, values, unit, description, owner);
  };
  column("time", "s", "time along the path", [&](std::size_t i) { return trajectory.path.points[i].time; });
  column("temperature", "K", "gas temperature",
         [&](std::size_t i) { return trajectory.path.points[i].gas.temperature; });
  for (std::size_t c = 0; c < columns.size(); ++c)
    column(columns[c].name, columns[c].unit, columns[c].description,
           [&](std::size_t i) { return records[i].values[c]; });
  std::vector<double> position;
  std::vector<double> distribution;
  for (std::size_t i = 0; i < records.size(); ++i) {
    position.insert(position.end(), trajectory.places[i].begin(), trajectory.places[i].begin() + mesh.dimension);
    distribution.insert(distribution.end(), records[i].distribution.begin(), records[i].distribution.end());
  }
  const auto count = static_cast<std::int64_t>(bins.count);
  results.dataset(group + "position", {rows, mesh.dimension}, position, "m",
                  fmt::format("coordinates {}", fmt::join(flowcase::axisNames(mesh.geometry, mesh.dimension), ", ")),
                  owner);
  results.dataset(group + "bin_edges", {count + 1}, bins.edges(), "m", "diameters between the bins", owner);
  results.dataset(group + "size_distribution", {rows, count}, distribution, "1/m^3", "dN/dlog10(d)", owner);
}

// Of a path whose gas has all species.
std::string gasTableOf(const Mechanism& mechanism, const ParticlePath& path) {
  std::vector<Quantity> columns{
      {"time", "s", "time along the path"},
      {"temperature", "K", "gas temperature"},
      {"pressure", "Pa", "pressure"},
      {"number_loss_rate", "1/s", "rate at which particles per kg of gas become fewer, until the next row"}};
  const std::size_t n = mechanism.numSpecies();
  for (std::size_t k = 0; k < n; ++k)
    columns.push_back({"X_" + mechanism.speciesName(k), "1", "mole fraction of " + mechanism.speciesName(k)});
  const GasHistory history = historyAlong(path);
  std::vector<double> rows;
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    const double lossRate = i < history.numberLossRate.size() ? history.numberLossRate[i] : 0;
    rows.insert(rows.end(), {history.time[i], history.temperature[i], history.pressure[i], lossRate});
    const auto X = history.fractions.begin() + static_cast<std::ptrdiff_t>(i * n);
    rows.insert(rows.end(), X, X + static_cast<std::ptrdiff_t>(n));
  }
  return csvTable(columns, rows);
}

// The path as particles see it that know these species.
ParticlePath pathOf(ParticlePath all, const std::vector<std::size_t>& species) {
  for (GasSample& point : all.points) {
    std::vector<double> seen;
    for (const std::size_t k : species) seen.push_back(point.concentrations[k]);
    point.concentrations = std::move(seen);
  }
  return all;
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

std::string nameOf(const TrajectoryRequest& request, std::size_t id, const Mesh& mesh) {
  return fmt::format("trajectory {} from {}", id, placeText(request.starts[id], mesh.dimension));
}

// A path of one point ends where it starts; one that meets a wall is not what the user had in mind.
void warnOfEnds(const TrajectoryRequest& request, const FlowContext& context, const std::vector<PathEnd>& ends) {
  std::vector<std::string> warnings;
  for (std::size_t id = 0; id < ends.size(); ++id) {
    const PathEnd& end = ends[id];
    const std::string name = nameOf(request, id, context.mesh);
    const bool meetsWall =
        end.patch >= 0 && context.boundaries[static_cast<std::size_t>(end.patch)].kind == BoundaryKind::Wall;
    if (meetsWall)
      warnings.push_back(fmt::format(
          "{} meets the wall '{}' at {} after {:g} s: it ends there{}", name,
          context.boundaries[static_cast<std::size_t>(end.patch)].name, placeText(end.place, context.mesh.dimension),
          static_cast<double>(end.points - 1) * request.timeStep, end.points < 2 ? ", without particles" : ""));
    else if (end.points < 2)
      warnings.push_back(
          fmt::format("{} leaves the domain in its first time step of {:g} s: it has one row, without particles", name,
                      request.timeStep));
  }
  printWarnings(warnings);
}

// The points of the paths, each with its gas, on the ranks that march them: in the order of time.
class PointsOnPaths {
 public:
  PointsOnPaths(const FlowContext& context, const PathGas& gas, const TracedPaths& traced,
                const std::vector<int>& owners)
      : gas_(gas), width_(first + gas.width()) {
    std::vector<double> sent;
    std::vector<int> ranks;
    for (const PathPoint& point : traced.points) {
      for (const double value : {static_cast<double>(point.path), static_cast<double>(point.step), point.divergence,
                                 point.position[0], point.position[1], point.position[2]})
        sent.push_back(value);
      gas.append(point.place, sent);
      ranks.push_back(owners[static_cast<std::size_t>(point.path)]);
    }
    numbers_ = RankExchange(context.mesh.comm, ranks).send(sent, static_cast<int>(width_));
    for (std::size_t i = 0; i < numbers_.size(); i += width_) rows_.push_back(&numbers_[i]);
    std::ranges::sort(rows_, [](const double* a, const double* b) {
      return std::pair{a[0], a[1]} < std::pair{b[0], b[1]};
    });
  }

  void fill(std::size_t id, double timeStep, Trajectory& trajectory) const {
    const auto ofPath =
        std::ranges::equal_range(rows_, static_cast<double>(id), {}, [](const double* row) { return row[0]; });
    for (const double* row : ofPath) {
      const ParticleGas gas = gas_.gasOf({row + first, gas_.width()});
      trajectory.places.push_back({row[3], row[4], row[5]});
      trajectory.path.points.push_back(
          {row[1] * timeStep, gas, {gas.concentrations.begin(), gas.concentrations.end()}});
    }
    for (std::size_t k = 0; k + 1 < ofPath.size(); ++k)
      trajectory.path.divergence.push_back({ofPath[k][2], ofPath[k + 1][2]});
  }

 private:
  static constexpr std::size_t first = 6;  // number of the gas among those of a point
  const PathGas& gas_;
  std::size_t width_;
  std::vector<double> numbers_;
  std::vector<const double*> rows_;
};

// The outlet that a place in a cell lies on, or null.
const std::string* outletAt(const FlowContext& context, int cell, const Vector3& place) {
  const Mesh& m = context.mesh;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const auto face = static_cast<std::size_t>(m.faceOfCell[i]);
    if (m.high[face] >= 0 || context.boundaryOf(m.faceOfCell[i]).kind != BoundaryKind::Outlet) continue;
    if (dot(difference(place, m.faceCentre[face]), m.normal[face]) > -1e-9 * m.distance[face])
      return &context.boundaryOf(m.faceOfCell[i]).name;
  }
  return nullptr;
}

}  // namespace

std::vector<std::unique_ptr<ClosingStage>> closingStages(const FlowCase& flowCase) {
  std::vector<std::unique_ptr<ClosingStage>> stages;
  if (flowCase.trajectories) stages.push_back(std::make_unique<Trajectories>(flowCase));
  return stages;
}

void Trajectories::check(const FlowContext& context) const {
  const TrajectoryRequest& request = *case_.trajectories;
  const Mesh& m = context.mesh;
  const FoundCells found = findCells(m, request.starts);
  const auto item = [](std::size_t i) { return fmt::format("trajectories.start[{}]", i); };
  for (std::size_t i = 0; i < request.starts.size(); ++i) {
    if (found.naturalCell[i] >= 0) continue;
    const std::string where = meshExtentText(m, request.starts[i]);
    raiseTogether(m.comm, request.deck->error(item(i), fmt::format("the start at {} lies outside the mesh: {}",
                                                                   placeText(request.starts[i], m.dimension), where)));
  }
  collectively(m.comm, [&] {
    for (std::size_t i = 0; i < request.starts.size(); ++i) {
      if (found.cell[i] < 0) continue;
      if (const std::string* outlet = outletAt(context, found.cell[i], request.starts[i]))
        throw request.deck->error(item(i), fmt::format("the start lies on the outlet '{}', where the path would leave "
                                                       "at once; expected a place inside the mesh",
                                                       *outlet));
    }
  });
}

void Trajectories::run(const FlowContext& context, const State& state, const GasProperties& properties,
                       ResultsWriter& results, const RunFolder* folder) const {
  const TrajectoryRequest& request = *case_.trajectories;
  const Mesh& m = context.mesh;
  const auto kind = request.make(0);
  const std::vector<std::size_t>& species = kind->species();
  const Streamlines streamlines(context, state, properties, waldmannThermophoresis());
  const TracedPaths traced = streamlines.trace(request.starts, request.timeStep, request.duration);
  const bool hasTables = request.gasTables && folder != nullptr;
  std::vector<std::size_t> carried = species;
  if (hasTables) {
    carried.resize(context.mechanism.numSpecies());
    std::iota(carried.begin(), carried.end(), std::size_t{0});
  }
  const PathGas gas(context, state, properties, carried);

  PathMarch march;
  march.bins = request.bins;

  std::vector<Trajectory> trajectories(request.starts.size());
  std::vector<double> costs;
  for (const PathEnd& end : traced.ends) costs.push_back(static_cast<double>(end.points));
  const std::vector<int> owners = shareOut(costs, m.ranks);
  const PointsOnPaths points(context, gas, traced, owners);
  collectively(m.comm, [&] {
    for (std::size_t id = 0; id < trajectories.size(); ++id) {
      if (owners[id] != m.rank) continue;
      Trajectory& one = trajectories[id];
      points.fill(id, request.timeStep, one);
      if (hasTables) {
        one.gasTable = gasTableOf(context.mechanism, one.path);
        one.path = pathOf(std::move(one.path), species);
      }
      try {
        one.records = marchPath(*request.make(id), one.path, march).records;
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("{}: {}", nameOf(request, id, m), error.what()));
      }
    }
  });
  warnOfEnds(request, context, traced.ends);
  if (hasTables)
    collectively(m.comm, [&] {
      folder->makeTableFolder();
      for (std::size_t id = 0; id < trajectories.size(); ++id)
        if (owners[id] == m.rank)
          writeFileAtomically(folder->table(fmt::format("streamline_{}", id)), trajectories[id].gasTable);
    });
  for (std::size_t id = 0; id < trajectories.size(); ++id)
    writeTrajectory(results, id, owners[id], m, trajectories[id], kind->columns(), request.bins);
}

}  // namespace lampblack::app
