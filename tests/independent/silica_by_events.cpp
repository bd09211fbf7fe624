// Silica particles from Si(OH)4 in a gas whose history is given: a Monte Carlo calculation that shares nothing with
// Lampblack, to decide between it and another program. Every process is a jump at its own time, by thinning of bounds
// (Lewis and Shedler 1979), and each particle sinters by an ordinary differential equation between its jumps, with
// control of the error: there is no splitting step. SI units. README.md says what it is for and what came out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "silica_sample.hpp"
#include "silica_verify.hpp"

namespace silica {
namespace {

std::vector<std::vector<double>> table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

// Columns: time in s, mol/m3 of Si(OH)4, mol/m3 of Si that has left all other species of the gas until then.
Gas read_gas(const std::string& path) {
  Gas gas;
  for (const auto& row : table(path)) {
    gas.time.push_back(row.at(0));
    gas.molar.push_back(row.at(1));
    gas.source.push_back(options.given ? 0.0 : row.at(2));
  }
  return gas;
}

// The times of MOpS's table, each interval in so many parts.
std::vector<double> times_of_looks(double parts) {
  std::vector<double> times;
  const auto add = [&](double from, double to, double step) {
    const long n = std::lround((to - from) / step * parts);
    for (long i = 1; i <= n; ++i) times.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(n));
  };
  add(0, 0.02, 0.001);
  add(0.02, 0.1, 0.005);
  add(0.1, 0.8, 0.025);
  return times;
}

// Whether all Si that was taken is there, and no pair was above the bound of its rate.
bool run(const Gas& gas, const std::vector<double>& rows) {
  std::vector<std::vector<double>> sum(rows.size(), std::vector<double>(names.size())), squares = sum;
  double worst = 0;
  for (int s = 0; s < options.seeds; ++s) {
    Sample sample(gas, static_cast<unsigned long>(options.first_seed + s));
    if (options.spheres) {
      Particle p;
      p.nodes.resize(1);
      p.nodes[0].si = 2107;
      p.nodes[0].o = 3960;
      p.nodes[0].oh = 398;
      derive(p);
      for (int i = 0; i < options.capacity; ++i) sample.add(p);
      sample.taken = means(sample)[6];
    }
    std::map<double, int> stops;  // 0: interval of the gas's table, 1: look at all, 2: row
    for (double t : gas.time) stops[t] = 0;
    if (options.frozen)
      for (double t : times_of_looks(options.looks)) stops[t] = 1;
    else if (options.slip)  // sizes of before a look are the room that the bound leaves
      for (double t = 0; t < options.end; t += 1e-3) stops[t] = 1;
    for (double t : rows) stops[t] = 2;
    double t = 0;
    size_t k = 0, row = 0;
    for (const auto& [end, what] : stops) {
      if (end <= 0 || end > options.end * (1 + 1e-12)) continue;
      while (k + 2 < gas.time.size() && gas.time[k + 1] <= t * (1 + 1e-12)) ++k;
      sample.advance(t, end, k);
      if (what > 0) sample.look_at_all(t);
      if (what == 2) {
        const auto m = means(sample);
        for (size_t i = 0; i < m.size(); ++i) {
          sum[row][i] += m[i];
          squares[row][i] += m[i] * m[i];
        }
        worst = std::max(worst, std::abs(m[6] / sample.taken - 1));
        ++row;
      }
    }
    std::fprintf(stderr, "seed %d: %zu particles, %ld looks, %ld fusions\n", options.first_seed + s,
                 sample.particles.size(), looks_done, fusions);
  }
  const double n = options.seeds;
  std::printf("time");
  for (const auto& name : names) std::printf(",%s,%s_error", name.c_str(), name.c_str());
  std::printf("\n");
  for (size_t r = 0; r < rows.size(); ++r) {
    std::printf("%g", rows[r]);
    for (size_t i = 0; i < names.size(); ++i) {
      const double mean = sum[r][i] / n;
      const double error = n > 1 ? std::sqrt(std::max(squares[r][i] / n - mean * mean, 0.0) / (n - 1)) : 0;
      std::printf(",%.6g,%.2g", mean, error);
    }
    std::printf("\n");
  }
  std::fprintf(stderr,
               "%ld collisions tried, %ld pairs above the bound; Si in particles differs from what they took by %.2g "
               "at most; two OH not there %ld times\n",
               attempts, majorant_violations, worst, lacked);
  return worst < 1e-9 && (options.frozen || majorant_violations == 0);
}

}  // namespace
}  // namespace silica

int main(int count, char** words) try {
  using namespace silica;
  std::string gas;
  std::vector<double> rows = {0.01, 0.02, 0.025, 0.03, 0.045, 0.05, 0.06, 0.095, 0.2, 0.4, 0.8};
  bool verifying = false;
  std::map<std::string, bool*> flags = {
      {"frozen", &options.frozen},     {"inner", &options.inner},     {"bridges", &options.bridges},
      {"pooled", &options.pooled},     {"quanta", &options.quanta},   {"spheres", &options.spheres},
      {"uncapped", &options.uncapped}, {"held", &options.held},       {"given", &options.given},
      {"narrow", &options.narrow},     {"swapped", &options.swapped}, {"slip", &options.slip},
      {"surface", &options.surface},   {"verify", &verifying}};
  std::map<std::string, bool*> without = {{"no-sintering", &options.sinter},
                                          {"no-coagulation", &options.coagulate},
                                          {"no-condensation", &options.condense},
                                          {"no-growth", &options.grow},
                                          {"no-inception", &options.incept}};
  std::map<std::string, double*> numbers = {{"end", &options.end},
                                            {"tolerance", &options.tolerance},
                                            {"viscosity", &options.viscosity},
                                            {"looks", &options.looks},
                                            {"full_at", &options.full_at}};
  std::map<std::string, int*> counts = {
      {"particles", &options.capacity}, {"seeds", &options.seeds}, {"first", &options.first_seed}};
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const size_t equal = word.find('=');
    const std::string name = word.substr(0, equal), value = equal == std::string::npos ? "" : word.substr(equal + 1);
    if (flags.count(name) > 0)
      *flags[name] = true;
    else if (without.count(name) > 0)
      *without[name] = false;
    else if (numbers.count(name) > 0)
      *numbers[name] = std::stod(value);
    else if (counts.count(name) > 0)
      *counts[name] = std::stoi(value);
    else if (name == "gas")
      gas = value;
    else
      throw std::runtime_error("unknown option " + word);
  }
  if (verifying) return verify();
  if (options.spheres) rows = {0.1, 0.5, 1, 2, 5, 10};
  while (!rows.empty() && rows.back() > options.end * (1 + 1e-12)) rows.pop_back();
  return run(options.spheres ? Gas{{0, 10}, {0, 0}, {0, 0}} : read_gas(gas), rows) ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
