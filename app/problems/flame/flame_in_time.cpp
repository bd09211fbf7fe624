#include "app/problems/flame/flame_in_time.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/problems/flame/flame_soot_output.hpp"
#include "core/errors.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_fields.hpp"
#include "io/progress.hpp"

namespace lampblack::app {
namespace {

std::vector<double> outputTimes(const FlameUnsteady& unsteady) {
  std::vector<double> times;
  const double interval = unsteady.interval.value_or(unsteady.options.end / 100);
  const auto count = static_cast<std::size_t>(std::floor(unsteady.options.end / interval * (1 + 1e-12)));
  for (std::size_t i = 0; i <= count; ++i)
    times.push_back(std::min(static_cast<double>(i) * interval, unsteady.options.end));
  if (times.back() < unsteady.options.end * (1 - 1e-12)) times.push_back(unsteady.options.end);
  return times;
}

std::vector<double> historyRow(const FlameCase& flame, double time, const FlameProfile& profile) {
  const FlameFields fields = flameFields(*flame.mechanism, flame.problem, profile);
  const FlameSummary summary = flameSummary(flame.problem, profile, fields);
  std::vector<double> row{time,
                          profile.global(load),
                          summary.maximumTemperature,
                          summary.positionOfMaximum,
                          summary.heatRelease,
                          summary.stagnationPlane.value_or(std::nan(""))};
  if (flame.soot)
    for (const NamedNumber& number : namedSootNumbers(
             fields, flameSootFields(*flame.mechanism, flame.problem.pressure, *flame.soot, profile, fields)))
      row.push_back(number.value);
  return row;
}

}  // namespace

std::vector<Quantity> flameHistoryColumns(const FlameCase& flame) {
  std::vector<Quantity> columns{{"time", "s", "time"},
                                {"load", "1", "factor on the strain"},
                                {"maximum_temperature", "K", "largest temperature"},
                                {"position_of_maximum_temperature", "m", "its place"},
                                {"heat_release", "W/m^2", "heat release, integrated over z"},
                                {"stagnation_plane", "m", "where the velocity changes sign; NaN where nowhere"}};
  if (flame.soot)
    for (const auto& [name, unit] : {std::pair{"maximum_volume_fraction", "1"},
                                     {"position_of_maximum_volume_fraction", "m"},
                                     {"integrated_volume_fraction", "m"},
                                     {"maximum_number_density", "1/m^3"},
                                     {"mean_diameter_at_maximum_volume_fraction", "m"}})
      columns.push_back({name, unit, "of the soot"});
  return columns;
}

FlameInTime flameInTime(MPI_Comm comm, FlameCase& flame, FlameProfile& start, HistoryWriter& history) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const FlameUnsteady& unsteady = *flame.unsteady;
  UnsteadyOptions options = unsteady.options;
  options.outputTimes = outputTimes(unsteady);
  if (unsteady.amplitude > 0)
    options.load = [a = unsteady.amplitude, f = unsteady.frequency](double time) {
      return 1 + a * std::sin(2 * std::numbers::pi * f * time);
    };
  FlameEquations equations(comm, flame.mechanism, flame.problem, flame.soot.get(), flame.solver.tolerances);
  equations.setGrid(start.z);
  if (rank == 0) fmt::print("\nin time, to {:g} s\n", options.end);
  Progress progress(comm, 0, options.end);
  FlameInTime course;
  try {
    course.report = integrateInTime(equations, start.x, options, [&](double time, std::span<const double> x) {
      FlameProfile profile{start.layout, start.z, {x.begin(), x.end()}};
      const auto row = historyRow(flame, time, profile);
      history.row(row);
      const double since = course.times.empty() ? 0 : time - course.times.back();
      progress.update(static_cast<std::int64_t>(course.times.size()), time, since,
                      fmt::format("Tmax {:.1f} K", row[2]));
      course.times.push_back(time);
      course.profiles.push_back(std::move(profile));
    });
  } catch (const NumericsError& error) {
    course.failure = error.what();
  } catch (const Stopped& stop) {
    course.failure = stop.what();
  }
  if (!course.failure.empty() && !course.profiles.empty()) start = course.profiles.back();
  progress.finish();
  return course;
}

void writeFlameInTime(ResultsWriter& results, const FlameCase& flame, const FlameInTime& course) {
  if (course.profiles.empty()) return;
  const auto times = static_cast<std::int64_t>(course.times.size());
  const auto points = static_cast<std::int64_t>(course.profiles[0].points());
  const auto species = static_cast<std::int64_t>(flame.mechanism->numSpecies());
  std::vector<double> temperature, velocity, heatRelease, X, fraction;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const FlameProfile& profile : course.profiles) {
    const FlameFields fields = flameFields(*flame.mechanism, flame.problem, profile);
    append(temperature, fields.temperature);
    append(velocity, fields.velocity);
    append(heatRelease, fields.heatRelease);
    append(X, fields.X);
    if (flame.soot)
      append(fraction, flameSootFields(*flame.mechanism, flame.problem.pressure, *flame.soot, profile, fields)
                           .property("volume_fraction")
                           .values);
  }
  const std::string group = "/unsteady/";
  results.dataset(group + "time", {times}, course.times, "s", "output times");
  results.dataset(group + "z", {points}, course.profiles[0].z, "m", "grid, the same at all times");
  results.dataset(group + "temperature", {times, points}, temperature, "K", "gas temperature");
  results.dataset(group + "velocity", {times, points}, velocity, "m/s", "axial velocity");
  results.dataset(group + "heat_release", {times, points}, heatRelease, "W/m^3", "by the gas reactions");
  results.dataset(group + "X", {times, points, species}, X, "1", "mole fractions, in the order of /unsteady/species");
  std::vector<std::string> names;
  for (const Species& one : flame.mechanism->allSpecies()) names.push_back(one.name);
  results.texts(group + "species", names, "names of the species");
  if (flame.soot)
    results.dataset(group + "soot_volume_fraction", {times, points}, fraction, "1", "soot volume per volume of gas");
}

}  // namespace lampblack::app
