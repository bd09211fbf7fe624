#include "app/shell/study/convergence_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "app/problems/population/population_case.hpp"
#include "app/problems/population/population_progress.hpp"
#include "app/run/warnings.hpp"
#include "app/shell/problem.hpp"
#include "app/shell/study/sweep_table.hpp"
#include "core/stop_request.hpp"
#include "io/run_folder.hpp"
#include "numerics/power_law.hpp"
#include "particles/population/comparison/comparison.hpp"

namespace lampblack::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double confidenceFactor = 3.29;  // 99.9 % of a normal distribution

// The case with one of its methods only, at a number of particles and repeats.
PopulationCase oneMethod(const PopulationCase& all, const std::string& name, std::int64_t particles,
                         std::int64_t repeats) {
  PopulationCase one = all;
  std::erase_if(one.methods, [&](const PopulationMethod& method) { return method.name != name; });
  std::get<MonteCarloOptions>(one.methods.at(0).options).particles = static_cast<std::size_t>(particles);
  one.repeats = static_cast<std::uint64_t>(repeats);
  one.bins = {};
  return one;
}

const PopulationMethod& methodOf(const PopulationCase& populationCase, const std::string& name) {
  for (const PopulationMethod& method : populationCase.methods) {
    if (method.name != name) continue;
    if (method.deterministic())
      throw InputError(fmt::format("'{}' is no Monte Carlo method and has no particles", name));
    return method;
  }
  std::string known;
  for (const PopulationMethod& method : populationCase.methods) known += (known.empty() ? "" : ", ") + method.name;
  throw InputError(fmt::format("the deck has no method '{}'; it has: {}", name, known));
}

std::vector<std::string> methodsOf(const PopulationCase& populationCase, const ConvergenceOptions& options) {
  std::vector<std::string> names = options.methods;
  if (names.empty()) {
    for (const PopulationMethod& method : populationCase.methods)
      if (!method.deterministic()) names.push_back(method.name);
  }
  return names;
}

PopulationCase caseOf(const Deck& deck) {
  if (deck.choice("problem") != "population_balance")
    throw deck.error("problem", "a convergence study needs a deck of the problem population_balance");
  return readPopulationCase(deck);
}

// One moment at the rows after time zero.
std::vector<double> column(const std::vector<FourMoments>& rows, std::size_t k) {
  std::vector<double> values;
  for (std::size_t j = 1; j < rows.size(); ++j) values.push_back(rows[j][k]);
  return values;
}

ConvergencePoint pointOf(const MethodStatistics& statistics, const std::vector<FourMoments>& reference,
                         std::int64_t particles, std::int64_t repeats) {
  ConvergencePoint point{statistics.name, particles, repeats, {}, {}, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    const MeanErrors errors =
        meanErrors(column(statistics.mean, k), column(statistics.error, k), column(reference, k), repeats);
    point.error[k] = errors.error;
    point.confidence[k] = errors.confidence;
    point.scatter[k] = errors.scatter;
  }
  return point;
}

std::string shortNumber(double value) {
  return std::isfinite(value) ? fmt::format("{:.8g}", value) : "";
}

TextTable pointTable(const std::vector<ConvergencePoint>& points) {
  TextTable table{{"method", "particles", "repeats"}, {}};
  for (std::size_t k = 0; k < 4; ++k)
    for (const char* what : {"error", "confidence", "scatter"}) table.columns.push_back(fmt::format("{}_M{}", what, k));
  for (const ConvergencePoint& point : points) {
    std::vector<std::string> row{point.method, std::to_string(point.particles), std::to_string(point.repeats)};
    for (std::size_t k = 0; k < 4; ++k)
      for (const double value : {point.error[k], point.confidence[k], point.scatter[k]})
        row.push_back(shortNumber(value));
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Slopes of error and scatter for each method and moment.
TextTable slopeTable(const std::vector<ConvergencePoint>& points, const std::vector<std::string>& methods) {
  TextTable table{{"method", "moment", "error_slope", "error_slope_standard_error", "scatter_slope",
                   "scatter_slope_standard_error"},
                  {}};
  for (const std::string& method : methods) {
    for (std::size_t k = 0; k < 4; ++k) {
      std::vector<double> particles, error, scatter;
      for (const ConvergencePoint& point : points) {
        if (point.method != method) continue;
        particles.push_back(static_cast<double>(point.particles));
        error.push_back(point.error[k]);
        scatter.push_back(point.scatter[k]);
      }
      const FittedLine errorLine = fitPowerLaw(particles, error), scatterLine = fitPowerLaw(particles, scatter);
      table.rows.push_back({method, fmt::format("M{}", k), shortNumber(errorLine.slope),
                            shortNumber(errorLine.slopeError), shortNumber(scatterLine.slope),
                            shortNumber(scatterLine.slopeError)});
    }
  }
  return table;
}

void addHistory(TextTable& table, const MethodStatistics& statistics, const PopulationStatistics& frame,
                const std::vector<FourMoments>& reference, std::int64_t particles) {
  for (std::size_t j = 0; j < statistics.mean.size(); ++j) {
    std::vector<std::string> row{statistics.name, std::to_string(particles), shortNumber(frame.rows[j])};
    for (std::size_t k = 0; k < 4; ++k) {
      row.push_back(shortNumber(statistics.mean[j][k]));
      row.push_back(shortNumber(confidenceFactor * statistics.error[j][k]));
      row.push_back(j < reference.size() ? shortNumber(reference[j][k]) : "");
    }
    table.rows.push_back(std::move(row));
  }
}

}  // namespace

MeanErrors meanErrors(std::span<const double> mean, std::span<const double> standardError,
                      std::span<const double> reference, std::int64_t repeats) {
  MeanErrors sums;
  const std::size_t count = std::min({mean.size(), standardError.size(), reference.size()});
  if (count == 0) return {nan, nan, nan};
  const auto n = static_cast<double>(count);
  for (std::size_t j = 0; j < count; ++j) {
    sums.error += std::abs(mean[j] - reference[j]) / std::abs(reference[j]) / n;
    const double relative = standardError[j] / std::abs(reference[j]) / n;
    sums.confidence += confidenceFactor * relative;
    sums.scatter += relative * std::sqrt(static_cast<double>(repeats));
  }
  return sums;
}

void checkConvergence(MPI_Comm comm, const Deck& study, const ConvergenceOptions& options) {
  const Deck deck = Deck::load(options.deck, options.overrides, deckKinds(), comm);
  printWarnings(deck.notes());
  collectively(comm, [&] {
    const PopulationCase all = caseOf(deck);
    const auto checkMethod = [&](const std::string& key, const std::string& name) {
      try {
        static_cast<void>(methodOf(all, name));
      } catch (const InputError& error) {
        throw study.error(key, error.what());
      }
    };
    std::set<std::string> named;
    for (const std::string& name : methodsOf(all, options)) {
      checkMethod("convergence.methods", name);
      if (!named.insert(name).second)
        throw study.error("convergence.methods", fmt::format("'{}' is named twice", name));
    }
    if (named.empty()) throw study.error("convergence.deck", "the deck has no Monte Carlo method");
    if (!options.exact) checkMethod("convergence.reference.method", options.referenceMethod);
    if (options.exact && !exactSolution(all))
      throw study.error("convergence.reference",
                        "no exact solution of this deck is known; give a reference of type run");
    if (all.times.first > 0)
      throw study.error("convergence.deck",
                        "the errors are averaged over equidistant times; the deck has logarithmic ones");
  });
}

void runConvergence(MPI_Comm comm, const ConvergenceOptions& options, const std::filesystem::path& folder) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const Deck deck = Deck::load(options.deck, options.overrides, deckKinds(), comm);
  PopulationCase all;
  std::vector<std::string> methods;
  collectively(comm, [&] {
    all = caseOf(deck);
    methods = methodsOf(all, options);
  });

  std::vector<FourMoments> reference;
  if (!options.exact) {
    PopulationCase one = oneMethod(all, options.referenceMethod, options.referenceParticles, options.referenceRepeats);
    one.seed = all.seed + 1;  // independent of the runs it is compared with
    const PopulationStatistics statistics = runAndTell(comm, one);
    if (statistics.stop != 0)
      raiseStopped(comm, statistics.stop, "in the middle of a convergence study: nothing of it is kept");
    if (rank == 0) reference = statistics.methods.at(0).mean;
  }

  std::vector<ConvergencePoint> points;
  TextTable history{{"method", "particles", "time"}, {}};
  for (std::size_t k = 0; k < 4; ++k)
    for (const char* what : {"M{}", "M{}_confidence", "M{}_reference"})
      history.columns.push_back(fmt::format(fmt::runtime(what), k));
  for (const std::string& method : methods) {
    for (const std::int64_t particles : options.particles) {
      const std::int64_t repeats = options.product / particles;
      const PopulationStatistics statistics = runAndTell(comm, oneMethod(all, method, particles, repeats));
      if (statistics.stop != 0)
        raiseStopped(comm, statistics.stop, "in the middle of a convergence study: nothing of it is kept");
      collectively(comm, [&] {
        if (rank != 0) return;
        if (options.exact) reference = statistics.exact.moments;
        points.push_back(pointOf(statistics.methods.at(0), reference, particles, repeats));
        addHistory(history, statistics.methods.at(0), statistics, reference, particles);
        fmt::print("convergence: {}, {} particles, {} repeats\n", method, particles, repeats);
        std::fflush(stdout);
      });
    }
  }

  collectively(comm, [&] {
    if (rank != 0) return;
    const TextTable table = pointTable(points), slopes = slopeTable(points, methods);
    writeFileAtomically(folder / "convergence.csv", csvText(table));
    writeFileAtomically(folder / "convergence_slopes.csv", csvText(slopes));
    writeFileAtomically(folder / "convergence_history.csv", csvText(history));
    fmt::print("\nRelative errors of the moments, particles x repeats = {} (99.9 % confidence)\n{}\n", options.product,
               alignedText(table));
    fmt::print("Slopes of log(error) and log(scatter of a repeat) over log(particles)\n{}", alignedText(slopes));
  });
}

}  // namespace lampblack::app
