// The sectional method as a PopulationSolver, with what else is known of a sectional solution.
#pragma once

#include <memory>
#include <span>

#include "core/modules.hpp"
#include "particles/population/sectional/sectional_options.hpp"

namespace lampblack::particles {

// Counters: splitSteps are the steps of the integrator; there are no events.
class SectionalSolver final : public PopulationSolver {
 public:
  // Per m3 of gas, what is not in the sections any more. With deposition or dilution it is not thinned with the rest.
  struct Left {
    double overNumber, overVolume;          // 1/m3, m3/m3: grown beyond the last pivot, with the tail of the start
    double vanishedNumber, vanishedVolume;  // 1/m3, m3/m3: shrunk away below the first pivot
  };

  SectionalSolver(const PopulationModel& model, const InitialPopulation& initial, const SectionalOptions& options);
  ~SectionalSolver() override;

  void advance(double end) override;
  [[nodiscard]] double time() const override;
  // Of the pivots as points; M_0 holds the section at zero, too.
  [[nodiscard]] std::array<double, 4> moments() const override;
  // Each pivot's number is spread evenly between the harmonic means with its two neighbours. The mean of that interval
  // is the pivot: number and volume of the distribution are those of the sections. The section at zero is a point.
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const override;
  // Of the pivots as points, without the section at zero; 1 where there are no particles.
  [[nodiscard]] double geometricDeviation() const override;
  [[nodiscard]] std::size_t particles() const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] const PopulationCounters& counters() const override;

  [[nodiscard]] std::span<const double> volumes() const;  // m3, of the sections; the first is at zero
  [[nodiscard]] std::span<const double> numbers() const;  // 1/m3, of the sections
  [[nodiscard]] Left left() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lampblack::particles
