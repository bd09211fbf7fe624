#include "app/problems/population/population_output.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ranges>

#include "io/table.hpp"

namespace lampblack::app {
namespace {

constexpr std::array<const char*, 4> momentUnits{"1/m^3", "1", "m^3", "m^6"};

std::string momentName(std::size_t k) {
  return fmt::format("M{}", k);
}

// A column a moment; `units`: of the moments, else pure numbers.
template <typename... Of, typename MomentsOf>
void addMoments(TableOf<Of...>& table, const std::string& prefix, bool units, const std::string& what,
                const MomentsOf& momentsOf) {
  for (std::size_t k = 0; k < 4; ++k)
    table.add({fmt::format("{}{}", prefix, momentName(k)), units ? momentUnits[k] : "1",
               fmt::format("{} sum of v^{} per volume of gas", what, k)},
              [k, momentsOf](Of... of) { return momentsOf(of...)[k]; });
}

// Tables over the rows of a history.
using RowTable = TableOf<std::size_t>;

RowTable timeTable(const std::vector<double>& times) {
  return {{{"time", "s", "time"}, [&times](std::size_t r) { return times[r]; }}};
}

void writeRows(ResultsWriter& results, const std::string& path, const RowTable& table, std::size_t rows) {
  table.of(std::views::iota(std::size_t{0}, rows)).write(results, path);
}

void writeHistory(ResultsWriter& results, const std::string& path, const PopulationStatistics& statistics,
                  const MethodStatistics& method) {
  RowTable table = timeTable(statistics.rows);
  for (std::size_t k = 0; k < 4; ++k) {
    table.add({momentName(k), momentUnits[k], fmt::format("mean over the repeats of the sum of v^{}", k)},
              [&method, k](std::size_t r) { return method.mean[r][k]; });
    table.add({momentName(k) + "_error", momentUnits[k], "standard error of the mean"},
              [&method, k](std::size_t r) { return method.error[r][k]; });
  }
  table.add({"geometric_standard_deviation", "1", "of the diameter by number, mean over the repeats"},
            [&method](std::size_t r) { return method.geometricDeviation[r]; });
  table.add({"geometric_standard_deviation_error", "1", "standard error of the mean"},
            [&method](std::size_t r) { return method.geometricDeviationError[r]; });
  table.add({"particles", "1", "numerical particles, sections or moments; mean over the repeats"},
            [&method](std::size_t r) { return method.particles[r]; });
  writeRows(results, path, table, method.mean.size());
}

void writeMoments(ResultsWriter& results, const std::string& path, const std::string& prefix, bool units,
                  const std::string& what, const std::vector<double>& times, const std::vector<FourMoments>& values) {
  RowTable table = timeTable(times);
  addMoments(table, prefix, units, what, [&values](std::size_t r) { return values[r]; });
  writeRows(results, path, table, values.size());
}

void writeRepeats(ResultsWriter& results, const std::string& path, const MethodStatistics& method) {
  const auto of = [&method](auto member) {
    return [&method, member](std::size_t r) { return static_cast<double>(method.repeats[r].*member); };
  };
  RowTable table{{{"repeat", "1", "number of the repeat"}, [](std::size_t r) { return static_cast<double>(r); }}};
  addMoments(table, "", true, "at the end:", [&method](std::size_t r) { return method.repeats[r].moments; });
  addMoments(table, "sigma_", false, "root of the time mean of the squared relative deviation of the",
             [&method](std::size_t r) { return method.repeats[r].sigma; });
  table.add({"mass_error", "1", "largest relative deviation of M1 in time"}, of(&RepeatResult::massError));
  table.add({"particles", "1", "numerical particles at the end"}, of(&RepeatResult::particles));
  table.add({"seconds", "s", "processor time of the computation alone"}, of(&RepeatResult::seconds));
  for (const PopulationCounter& c : populationCounters)
    table.add({c.name, "1", "events of this kind"}, [&method, value = c.value](std::size_t r) {
      return static_cast<double>(method.repeats[r].counters.*value);
    });
  writeRows(results, path, table, method.repeats.size());
}

// The dataset and, where it has one, its error; times x bins.
void writeDistribution(ResultsWriter& results, const std::string& path, const PopulationBins& bins,
                       const std::vector<std::vector<double>>& number, const std::vector<std::vector<double>>* error) {
  if (bins.edges.empty()) return;
  const auto flat = [](const std::vector<std::vector<double>>& values) {
    std::vector<double> all;
    for (const auto& row : values) all.insert(all.end(), row.begin(), row.end());
    return all;
  };
  const auto count = static_cast<std::int64_t>(number.size()), width = static_cast<std::int64_t>(bins.edges.size()) - 1;
  const std::vector<double> times(bins.times.begin(), bins.times.begin() + count);
  results.dataset(path + "/time", {count}, times, "s", "time");
  results.dataset(path + "/bin_edges", {width + 1}, bins.edges, "m^3", "volumes between the bins");
  results.dataset(path + "/number", {count, width}, flat(number), "1/m^3", "number density in each bin");
  if (error != nullptr)
    results.dataset(path + "/number_error", {count, width}, flat(*error), "1/m^3", "standard error of the mean");
}

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string field(double value, const char* format, double factor = 1) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), factor * value) : "-";
}

}  // namespace

void writePopulation(ResultsWriter& results, const PopulationCase& populationCase,
                     const PopulationStatistics& statistics) {
  writeMoments(results, "/exact/history", "", true, "exact solution:", statistics.rows, statistics.exact.moments);
  writeDistribution(results, "/exact/distribution", populationCase.bins, statistics.exact.number, nullptr);
  for (std::size_t m = 0; m < populationCase.methods.size(); ++m) {
    const MethodStatistics* method = m < statistics.methods.size() ? &statistics.methods[m] : nullptr;
    const std::string group = "/methods/" + populationCase.methods[m].name;
    static const MethodStatistics nothing{};
    const MethodStatistics& made = method != nullptr ? *method : nothing;
    writeHistory(results, group + "/history", statistics, made);
    writeMoments(results, group + "/sigma", "sigma_", false,
                 "mean over the repeats of the root of the time mean of the squared relative deviation of the",
                 statistics.rows, made.sigma);
    writeRepeats(results, group + "/repeats", made);
    writeDistribution(results, group + "/distribution", populationCase.bins, made.number, &made.numberError);
    results.attribute(group, "type", populationCase.methods[m].type);
  }
}

std::string populationTable(const PopulationStatistics& statistics) {
  std::string text = "method,type,repeats,particles [1],time [s]";
  for (const auto& [name, unit] :
       {std::pair{"", true}, {"error_", true}, {"deviation_", false}, {"z_", false}, {"sigma_", false}})
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format(",{}M{} [{}]", name, k, unit ? momentUnits[k] : "1");
  text += ",geometric_standard_deviation [1],geometric_standard_deviation_error [1],mass_error [1]";
  text += ",seconds_per_repeat [s],events_per_second [1/s]";
  for (const PopulationCounter& c : populationCounters) text += fmt::format(",{} [1]", c.name);
  text += ",verdict\n";
  for (const MethodStatistics& method : statistics.methods) {
    text += fmt::format("{},{},{}", method.name, method.type, method.repeats.size());
    if (method.mean.empty()) {
      text += std::string(2 + 20 + 3, ',');
    } else {
      const std::size_t last = method.mean.size() - 1;
      text += fmt::format(",{},{}", cell(method.particles[last]), statistics.rows[last]);
      for (const FourMoments& values :
           {method.mean[last], method.error[last], method.deviation, method.z, method.sigma[last]})
        for (const double value : values) text += fmt::format(",{}", cell(value));
      text += fmt::format(",{},{},{}", cell(method.geometricDeviation[last]),
                          cell(method.geometricDeviationError[last]), cell(method.massError));
    }
    text += fmt::format(",{},{}", cell(method.secondsPerRepeat), cell(method.eventsPerSecond));
    for (const PopulationCounter& c : populationCounters) text += fmt::format(",{}", method.counters.*c.value);
    text += fmt::format(",\"{}\"\n", method.verdict);
  }
  return text;
}

void recordPopulation(JsonWriter& json, const PopulationStatistics& statistics) {
  const auto moments = [&](const char* name, const FourMoments& values) {
    json.key(name).beginArray();
    for (const double value : values) json.value(value);
    json.endArray();
  };
  json.key("exact_solution");
  if (statistics.exact.name.empty())
    json.null();
  else
    json.value(statistics.exact.name);
  json.key("methods").beginObject();
  for (const MethodStatistics& method : statistics.methods) {
    json.key(method.name).beginObject();
    json.field("type", method.type).field("repeats", static_cast<std::uint64_t>(method.repeats.size()));
    if (!method.mean.empty()) {
      moments("moments", method.mean.back());
      moments("standard_errors", method.error.back());
      moments("relative_deviations", method.deviation);
      moments("z", method.z);
      moments("sigma", method.sigma.back());
      json.field("mass_error", method.massError);
    }
    json.field("seconds_per_repeat", method.secondsPerRepeat).field("events_per_second", method.eventsPerSecond);
    for (const PopulationCounter& c : populationCounters) json.field(c.name, method.counters.*c.value);
    json.field("verdict", method.verdict);
    json.endObject();
  }
  json.endObject();
}

std::string populationSummary(const PopulationCase& populationCase, const PopulationStatistics& statistics) {
  const bool known = !statistics.exact.name.empty();
  std::string text = fmt::format("exact solution: {}\n", known ? statistics.exact.name : "none known");
  std::size_t width = 6;
  for (const MethodStatistics& method : statistics.methods) width = std::max(width, method.name.size());
  const std::string when = statistics.gelation() ? "at the last row before the gelation"
                                                 : fmt::format("at t = {:g} s", populationCase.times.end);
  bool stochastic = false, deterministic = false;
  for (const MethodStatistics& method : statistics.methods) (method.deterministic ? deterministic : stochastic) = true;
  if (stochastic) {
    text += fmt::format("{}, {} repeats: z scores of the mean, errors sigma in %, largest error of M1\n\n", when,
                        populationCase.repeats);
    text += fmt::format("{:<{}} {:>9} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9} {:>10}  {}\n", "method",
                        width, "particles", "z M0", "z M1", "z M2", "z M3", "sig M0", "sig M2", "sig M3", "M1",
                        "s/repeat", "events/s", "verdict");
    for (const MethodStatistics& method : statistics.methods) {
      if (method.deterministic) continue;
      const double none = std::nan("");
      const FourMoments sigma = method.sigma.empty() ? FourMoments{none, none, none, none} : method.sigma.back();
      text += fmt::format("{:<{}} {:>9}", method.name, width,
                          field(method.particles.empty() ? none : method.particles.back(), "{:.0f}"));
      for (const double z : method.z) text += fmt::format(" {:>7}", field(z, "{:.2f}"));
      for (const std::size_t k : {0U, 2U, 3U}) text += fmt::format(" {:>8}", field(sigma[k], "{:.4g}", 100));
      text += fmt::format(" {:>8} {:>9} {:>10}  {}\n", field(method.massError, "{:.1e}"),
                          field(method.secondsPerRepeat, "{:.3g}"), field(method.eventsPerSecond, "{:.3g}"),
                          method.verdict);
    }
  }
  if (!deterministic) return text;
  text += fmt::format("{}{} {}\n\n", stochastic ? "\n" : "", known ? "relative deviations" : "moments", when);
  text += fmt::format("{:<{}} {:>9} {:>10} {:>10} {:>10} {:>10} {:>9}  {}\n", "method", width, "unknowns", "M0", "M1",
                      "M2", "M3", "s", "verdict");
  for (const MethodStatistics& method : statistics.methods) {
    if (!method.deterministic) continue;
    text += fmt::format("{:<{}} {:>9}", method.name, width, method.mean.empty() ? 0 : method.particles.back());
    const double none = std::nan("");
    const FourMoments values = method.mean.empty() ? FourMoments{none, none, none, none}
                               : known             ? method.deviation
                                                   : method.mean.back();
    for (const double value : values) text += fmt::format(" {:>10}", field(value, known ? "{:.2e}" : "{:.4e}"));
    text += fmt::format(" {:>9}  {}\n", field(method.secondsPerRepeat, "{:.3g}"), method.verdict);
  }
  return text;
}

}  // namespace lampblack::app
