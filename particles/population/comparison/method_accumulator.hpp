// Adds up the repeats of one method, in their order.
#pragma once

#include "core/modules.hpp"
#include "core/running_mean.hpp"
#include "particles/population/comparison/comparison.hpp"
#include "particles/population/comparison/repeat_record.hpp"

namespace lampblack::particles {

class MethodAccumulator {
 public:
  MethodAccumulator(const PopulationCase& populationCase, const PopulationMethod& method,
                    const PopulationStatistics& frame, const RepeatRecord::Shape& shape);

  void add(const RepeatRecord& record);
  [[nodiscard]] MethodStatistics finish() const;

 private:
  const PopulationCase& case_;
  const PopulationMethod& method_;
  const PopulationStatistics& frame_;
  RepeatRecord::Shape shape_;
  std::size_t reachedRows_, reachedTimes_;
  std::vector<std::array<RunningMean, 6>> rows_;  // moments, geometric deviation, particles
  std::vector<FourMoments> sigma_;                // sums
  std::vector<std::vector<RunningMean>> number_;
  MethodStatistics made_;
};

// Compares the deviations with the moments that have to be unbiased; sets `bias` and `verdict`.
void judge(const PopulationCase& populationCase, const PopulationMethod& method, MethodStatistics& statistics);

}  // namespace lampblack::particles
