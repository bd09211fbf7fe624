#include "app/problems/reactor/reactor_ensemble_distributions.hpp"

#include <cmath>
#include <cstdint>

#include "io/csv.hpp"

namespace lampblack::app {

EnsembleDistributions::EnsembleDistributions(const ReactorCase& reactorCase)
    : sizeEdges_(reactorCase.ensemble->bins.edges()) {
  for (std::size_t b = 0; b <= shareBins; ++b)
    shareEdges_.push_back(static_cast<double>(b) / static_cast<double>(shareBins));
  const auto population = reactorCase.ensemble->make(0);
  std::size_t first = 0;
  const auto add = [&](const std::string& name, const std::string& description, bool isShare) {
    all_.push_back({name, description, isShare, first});
    first += binsOf(isShare);
    hasShares_ = hasShares_ || isShare;
  };
  for (std::size_t r = 0; r < reactorCase.kind->reactors(); ++r) {
    const std::string prefix = reactorCase.kind->prefix(r);
    for (const auto& d : population->distributions())
      add(prefix + d.name + "size_distribution", "dN/dlog10 d, " + d.description, false);
    for (const auto& d : population->shares()) add(prefix + d.name + "_distribution", "dN/dx, " + d.description, true);
  }
}

void EnsembleDistributions::writeTable(const RunFolder& folder, const std::string& name, bool shares,
                                       const EnsembleSummary& summary) const {
  if (!summary.has()) return;
  const std::vector<double>& ends = edges(shares);
  const std::string unit = shares ? "1" : "m";
  std::vector<Quantity> columns{{"from", unit, "lower end of the bin"}, {"to", unit, "upper end of the bin"}};
  for (const One& one : all_)
    if (one.isShare == shares) addRepeatColumns({one.name, "1/m^3", one.description}, columns);
  const RepeatIntervals intervals(summary.repeats());
  std::vector<double> rows;
  for (std::size_t b = 0; b < binsOf(shares); ++b) {
    rows.insert(rows.end(), {ends[b], ends[b + 1]});
    for (const One& one : all_) {
      if (one.isShare != shares) continue;
      const RunningMean& density = summary.density(summary.rows() - 1, one.first + b);
      intervals.append(density.mean(), density.standardError(), rows);
    }
  }
  writeFileAtomically(folder.file(name), csvTable(columns, rows));
}

void EnsembleDistributions::writeTables(const RunFolder& folder, const EnsembleSummary& summary) const {
  writeTable(folder, "size_distributions.csv", false, summary);
  if (hasShares_) writeTable(folder, "share_distributions.csv", true, summary);
}

void EnsembleDistributions::write(ResultsWriter& results, const EnsembleSummary& summary) const {
  std::vector<double> diameter, share;
  for (std::size_t b = 0; b < binsOf(false); ++b) diameter.push_back(std::sqrt(sizeEdges_[b] * sizeEdges_[b + 1]));
  for (std::size_t b = 0; b < binsOf(true); ++b) share.push_back(0.5 * (shareEdges_[b] + shareEdges_[b + 1]));
  const auto count = [](const std::vector<double>& values) { return static_cast<std::int64_t>(values.size()); };
  results.dataset("/particles/diameter", {count(diameter)}, diameter, "m",
                  "middles of the bins of the size distribution");
  if (hasShares_)
    results.dataset("/particles/share", {count(share)}, share, "1",
                    "middles of the bins of the distributions of numbers from 0 to 1");
  // Rank 0 alone has rows.
  const auto rows = static_cast<std::int64_t>(summary.rows());
  for (const One& one : all_) {
    std::vector<double> means, errors;
    for (std::size_t row = 0; row < summary.rows(); ++row)
      for (std::size_t b = 0; b < binsOf(one.isShare); ++b) {
        const RunningMean& density = summary.density(row, one.first + b);
        means.push_back(density.mean());
        errors.push_back(density.standardError());
      }
    const std::vector<std::int64_t> dims{rows, static_cast<std::int64_t>(binsOf(one.isShare))};
    results.dataset("/particles/" + one.name, dims, means, "1/m^3",
                    one.description + ", of each row of the table, mean of the repeats");
    results.dataset("/particles/" + one.name + "_error", dims, errors, "1/m^3", "standard error of that mean");
  }
}

}  // namespace lampblack::app
