// One repeat of a method: what it leaves for the statistics, as flat numbers that travel between ranks.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/comparison/population_case.hpp"

namespace lampblack::particles {

// Whom repeats tell where they are.
class RepeatProgress {
 public:
  virtual ~RepeatProgress() = default;
  virtual void at(const PopulationMethod& method, std::uint64_t repeat, double time) = 0;  // s
  virtual void repeatEnded() = 0;

 protected:
  RepeatProgress() = default;
  RepeatProgress(const RepeatProgress&) = default;
  RepeatProgress& operator=(const RepeatProgress&) = default;
};

// What was not reached, or what a method does not have.
inline constexpr double noValue = std::numeric_limits<double>::quiet_NaN();

// Where the numbers of a repeat stand in its record. Rows and bins that were not reached, or that a method does not
// have, are NaN.
class RepeatRecord {
 public:
  static constexpr std::size_t numCounters = std::size(populationCounters);

  struct Shape {
    std::size_t rows = 0;   // of the history
    std::size_t times = 0;  // of the distribution
    std::size_t bins = 0;
    [[nodiscard]] std::size_t size() const { return 6 * rows + times * bins + 2 + numCounters; }
  };

  RepeatRecord(const Shape& shape, std::span<const double> data) : shape_(shape), data_(data) {}

  [[nodiscard]] double moment(std::size_t row, std::size_t k) const { return data_[6 * row + k]; }
  [[nodiscard]] double geometricDeviation(std::size_t row) const { return data_[6 * row + 4]; }
  [[nodiscard]] double particles(std::size_t row) const { return data_[6 * row + 5]; }
  [[nodiscard]] double number(std::size_t time, std::size_t bin) const {
    return data_[6 * shape_.rows + time * shape_.bins + bin];
  }
  [[nodiscard]] double seconds() const { return tail()[0]; }  // of CPU, of the advance alone
  [[nodiscard]] std::optional<double> gelation() const;       // s
  [[nodiscard]] PopulationCounters counters() const;
  [[nodiscard]] std::size_t rows() const;  // that were reached
  // Not cut off by a signal.
  [[nodiscard]] bool whole() const { return rows() == shape_.rows || gelation(); }

 private:
  [[nodiscard]] std::span<const double> tail() const {
    return data_.subspan(6 * shape_.rows + shape_.times * shape_.bins);
  }

  Shape shape_;
  std::span<const double> data_;
};

// Solves a repeat and stops at every row and time of the distribution. Ends early where the population gels, at the
// latest at `gelation` (s), which is then in the record, and where the run is asked to stop. `data` has the size of the
// shape. InputError, NumericsError with the names of method and repeat.
void runRepeat(const PopulationCase& populationCase, const PopulationMethod& method, std::uint64_t repeat,
               std::optional<double> gelation, const RepeatRecord::Shape& shape, RepeatProgress& progress,
               std::span<double> data);

}  // namespace lampblack::particles
