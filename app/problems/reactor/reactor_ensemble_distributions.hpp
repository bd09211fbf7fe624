// Distributions of particles of all repeats: of diameters in the deck's bins, and of numbers from zero to one.
#pragma once

#include <string>
#include <vector>

#include "app/problems/reactor/reactor_case.hpp"
#include "app/problems/reactor/reactor_ensemble_summary.hpp"
#include "core/modules.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

class EnsembleDistributions {
 public:
  explicit EnsembleDistributions(const ReactorCase& reactorCase);

  // size_distributions.csv, and share_distributions.csv of kinds of particles that have them: those of the last row.
  void writeTables(const RunFolder& folder, const EnsembleSummary& summary) const;
  // Collective: those of all rows, below /particles.
  void write(ResultsWriter& results, const EnsembleSummary& summary) const;

 private:
  struct One {
    std::string name;
    std::string description;
    bool isShare = false;
    std::size_t first = 0;  // of a row's bins
  };
  [[nodiscard]] std::size_t binsOf(bool shares) const { return edges(shares).size() - 1; }
  [[nodiscard]] const std::vector<double>& edges(bool shares) const { return shares ? shareEdges_ : sizeEdges_; }
  void writeTable(const RunFolder& folder, const std::string& name, bool shares, const EnsembleSummary& summary) const;

  std::vector<One> all_;
  bool hasShares_ = false;
  std::vector<double> sizeEdges_, shareEdges_;
};

}  // namespace lampblack::app
