// When nuclei appear: the integral of the nucleation rate J over time and its inverse, in closed form, so that the
// waiting time to the next nucleus is exact however fast J changes.
#pragma once

#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

class NucleationSchedule {
 public:
  explicit NucleationSchedule(const NucleationOptions& options);  // throws InputError

  [[nodiscard]] double rate(double time) const;        // J, 1/m3/s
  [[nodiscard]] double cumulative(double time) const;  // integral of J from zero to `time`, 1/m3
  // The time at which cumulative() reaches `number`; infinity where it never does.
  [[nodiscard]] double timeOf(double number) const;

 private:
  NucleationOptions options_;
  std::vector<double> integral_;  // of a table, at its points
};

}  // namespace lampblack::particles
