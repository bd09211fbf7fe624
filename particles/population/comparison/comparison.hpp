// Runs the methods of a population balance case and compares them with the exact solution where one is known. Repeats
// are spread over the ranks (repeat r on rank r modulo their number) with random numbers keyed by seed and repeat, and
// are summed in the order of the repeats: no number but the times of the computer depends on the ranks.
//
// Quantities of comparison, for the moments k = 0 to 3 and L repeats:
//   sigma_Mk = 1/L sum over repeats of sqrt( 1/t int_0^t (M_k / M_k,exact - 1)^2 dt )
//   z_k = (mean of M_k - M_k,exact) sqrt(L) / s, with the standard deviation s of the repeats.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/timers.hpp"
#include "particles/population/comparison/repeat_record.hpp"

namespace lampblack::particles {

using FourMoments = std::array<double, 4>;  // M_0 to M_3, or a quantity of each; NaN where there is none

enum class BiasVerdict {
  none,           // nothing to compare with: one run only, no exact solution, or gelled
  noBias,         // every moment claimed is within the scatter of the mean
  biased,         // one at least is not
  biasedAsKnown,  // no moment has to be unbiased, and one shows a bias
  noBiasSeen      // no moment has to be unbiased, and none shows a bias
};

struct RepeatResult {
  FourMoments moments{}, sigma{};  // at the end
  double massError = 0;            // see MethodStatistics::massError
  double particles = 0, seconds = 0;
  PopulationCounters counters;
};

struct MethodStatistics {
  std::string name, type;
  bool deterministic = false;
  std::vector<RepeatResult> repeats;

  // One for each row of the history that all repeats reached.
  std::vector<FourMoments> mean, error;  // of the repeats, and its standard error (NaN of a single one)
  std::vector<FourMoments> sigma;        // up to the row's time
  std::vector<double> geometricDeviation, geometricDeviationError;
  std::vector<double> particles;  // numerical particles, sections or moments; mean
  // Times of the distribution (that were reached) x bins, 1/m3; empty where the method has none.
  std::vector<std::vector<double>> number, numberError;

  // At the last row.
  FourMoments deviation{};  // of the mean, relative to the exact value
  FourMoments z{};          // NaN where there is no scatter: less than 1e-12 of the mean
  // Largest |M1 / M1(0) - 1| of all rows and repeats where the processes conserve mass, otherwise
  // |M1 / M1,exact - 1|; NaN where neither can be said.
  double massError = 0;
  double secondsPerRepeat = 0;  // of CPU, the advance alone
  double eventsPerSecond = 0;
  PopulationCounters counters;     // summed over the repeats
  std::optional<double> gelation;  // s, earliest of the repeats
  BiasVerdict bias = BiasVerdict::none;
  std::string verdict;    // in words
  Timers::Stage stage{};  // wall time over the ranks
};

struct ExactReference {
  std::string name;                         // empty: none known
  std::string limit;                        // why nothing is compared from some time on, in words; empty: all is
  std::vector<FourMoments> moments;         // a row each
  std::vector<std::vector<double>> number;  // time x bins; empty where not known
  std::optional<double> gelation;           // s
};

struct PopulationStatistics {
  std::vector<double> rows;  // s
  PopulationBins bins;
  ExactReference exact;
  std::vector<MethodStatistics> methods;  // in the order of the case
  int stop = 0;  // the signal that stopped the run, on all ranks: the last methods lack repeats, or are not there
  [[nodiscard]] std::optional<double> gelation() const;  // s, of the earliest method
};

// Warnings, one a method, where the intervals at the start do not hold a moment of the initial distribution: the mean
// of the repeats is more than 1 % and 3.3 standard errors away from it.
std::vector<std::string> startsWithoutTruth(const PopulationCase& populationCase,
                                            const PopulationStatistics& statistics);

// Collective; InputError and NumericsError are raised on all ranks. What comes back is complete on rank 0 and empty on
// the others. A method that gels has the rows until then, and no further repeats are begun.
PopulationStatistics runPopulation(MPI_Comm comm, const PopulationCase& populationCase, RepeatProgress& progress);

}  // namespace lampblack::particles
