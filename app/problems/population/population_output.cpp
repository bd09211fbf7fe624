#include "app/problems/population/population_output.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lampblack::app {
namespace {

constexpr std::array<const char*, 4> momentUnits{"1/m^3", "1", "m^3", "m^6"};

std::string momentName(std::size_t k) {
  return fmt::format("M{}", k);
}

void addMoments(std::vector<Quantity>& columns, const std::string& prefix, bool units, const std::string& what) {
  for (std::size_t k = 0; k < 4; ++k)
    columns.push_back({fmt::format("{}{}", prefix, momentName(k)), units ? momentUnits[k] : "1",
                       fmt::format("{} sum of v^{} per volume of gas", what, k)});
}

void writeHistory(ResultsWriter& results, const std::string& path, const PopulationStatistics& statistics,
                  const MethodStatistics* method) {
  std::vector<Quantity> columns{{"time", "s", "time"}};
  for (std::size_t k = 0; k < 4; ++k) {
    columns.push_back({momentName(k), momentUnits[k], fmt::format("mean over the repeats of the sum of v^{}", k)});
    columns.push_back({momentName(k) + "_error", momentUnits[k], "standard error of the mean"});
  }
  columns.push_back({"geometric_standard_deviation", "1", "of the diameter by number, mean over the repeats"});
  columns.push_back({"geometric_standard_deviation_error", "1", "standard error of the mean"});
  columns.push_back({"particles", "1", "numerical particles, sections or moments; mean over the repeats"});
  std::vector<double> rows;
  for (std::size_t r = 0; method != nullptr && r < method->mean.size(); ++r) {
    rows.push_back(statistics.rows[r]);
    for (std::size_t k = 0; k < 4; ++k) rows.insert(rows.end(), {method->mean[r][k], method->error[r][k]});
    rows.insert(rows.end(), {method->geometricDeviation[r], method->geometricDeviationError[r], method->particles[r]});
  }
  results.table(path, columns, rows);
}

void writeMoments(ResultsWriter& results, const std::string& path, const std::string& prefix, bool units,
                  const std::string& what, const std::vector<double>& times, const std::vector<FourMoments>& values) {
  std::vector<Quantity> columns{{"time", "s", "time"}};
  addMoments(columns, prefix, units, what);
  std::vector<double> rows;
  for (std::size_t r = 0; r < values.size(); ++r) {
    rows.push_back(times[r]);
    rows.insert(rows.end(), values[r].begin(), values[r].end());
  }
  results.table(path, columns, rows);
}

void writeRepeats(ResultsWriter& results, const std::string& path, const MethodStatistics* method) {
  std::vector<Quantity> columns{{"repeat", "1", "number of the repeat"}};
  addMoments(columns, "", true, "at the end:");
  addMoments(columns, "sigma_", false, "root of the time mean of the squared relative deviation of the");
  columns.push_back({"mass_error", "1", "largest relative deviation of M1 in time"});
  columns.push_back({"particles", "1", "numerical particles at the end"});
  columns.push_back({"seconds", "s", "processor time of the computation alone"});
  for (const PopulationCounter& c : populationCounters) columns.push_back({c.name, "1", "events of this kind"});
  std::vector<double> rows;
  for (std::size_t r = 0; method != nullptr && r < method->repeats.size(); ++r) {
    const RepeatResult& repeat = method->repeats[r];
    rows.push_back(static_cast<double>(r));
    rows.insert(rows.end(), repeat.moments.begin(), repeat.moments.end());
    rows.insert(rows.end(), repeat.sigma.begin(), repeat.sigma.end());
    rows.insert(rows.end(), {repeat.massError, repeat.particles, repeat.seconds});
    for (const PopulationCounter& c : populationCounters) rows.push_back(static_cast<double>(repeat.counters.*c.value));
  }
  results.table(path, columns, rows);
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
    writeHistory(results, group + "/history", statistics, method);
    writeMoments(results, group + "/sigma", "sigma_", false,
                 "mean over the repeats of the root of the time mean of the squared relative deviation of the",
                 statistics.rows, made.sigma);
    writeRepeats(results, group + "/repeats", method);
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
