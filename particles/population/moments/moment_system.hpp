// The equations of the moments as an OdeSystem: what is common to the closures. Unknowns are M_k / v^k (1/m3) with one
// volume v, so that they are numbers of like size; tolerances are relative to each.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "core/modules.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/moments/moment_options.hpp"

namespace lampblack::particles {

class MomentSystem : public OdeSystem {
 public:
  static constexpr std::size_t most = 8;

  MomentSystem(const PopulationModel& model, const InitialPopulation& initial, std::size_t count);

  std::size_t size() const override { return count_; }
  bool rates(double t, const double* y, double* f) override;
  // By differences: the closures are not worth derivatives, and the problem is mild enough for a rough Jacobian.
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override;
  bool hasMovingScales() const override { return true; }
  void toleranceScales(const double* y, double* scales) const override;
  std::string describe(double t, const double* y) const override;

  [[nodiscard]] const PopulationModel& model() const { return model_; }
  [[nodiscard]] double unit() const { return unit_; }  // m3
  [[nodiscard]] std::vector<double> start(const InitialPopulation& initial) const;
  [[nodiscard]] const NucleationSchedule* schedule() const { return schedule_ ? &*schedule_ : nullptr; }
  // Within an interval in which the nucleation rate is smooth: whether there is any, and how many nuclei to expect.
  void setNucleation(bool on, double expected);

  // Whether the state at y has something at or below the smallest volume, and the state without it (NumericsError where
  // the closure cannot tell): see moment_options.hpp.
  virtual bool hasVanishing(const double* y) const = 0;
  virtual std::vector<double> withoutVanishing(double time, const double* y) const = 0;
  virtual bool limited(const double* y) const = 0;  // the closure has to do with less than asked for
  // Then: the moments of what it does with, for those that have drifted off by rounding and the tolerance.
  virtual std::vector<double> simplified(const double* y) const = 0;
  virtual double geometricDeviation(const double* y) const = 0;

 protected:
  // f += rates of breakage, deposition, coagulation, surface growth at a state with y[k] > 0 for all k. False where the
  // closure has no answer.
  virtual bool addClosed(const double* y, double* f) const = 0;

  [[nodiscard]] double lossRate(double volume) const;  // 1/s, of deposition
  [[nodiscard]] double share(std::size_t k) const;     // sum of the k-th powers of the pieces of a unit volume
  [[nodiscard]] double surfaceFactor() const { return surfaceFactor_; }  // dv/dt = factor v^(2/3), in units
  // Volume at which particles vanish, in units, at a mean volume; zero where none do.
  [[nodiscard]] double vanishingVolume(double mean) const;

 private:
  PopulationModel model_;
  std::size_t count_;
  double unit_ = 1, surfaceFactor_ = 0;
  std::optional<NucleationSchedule> schedule_;
  bool nucleating_ = false;
  double expected_ = 0;
};

std::unique_ptr<MomentSystem> makeQmomSystem(const PopulationModel& model, const InitialPopulation& initial,
                                             const MomentOptions& options);
std::unique_ptr<MomentSystem> makeMomicSystem(const PopulationModel& model, const InitialPopulation& initial,
                                              const MomentOptions& options);

// Binomial coefficients up to n = 8.
[[nodiscard]] double binomial(std::size_t n, std::size_t k);

}  // namespace lampblack::particles
