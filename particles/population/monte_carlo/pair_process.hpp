// The population balance in time steps, by drawn pairs: coagulation (PairSampling) between two halves of all other
// processes, which is of second order in the step (Strang 1968). The halves, each exact but for what it leaves to the
// others:
// - nucleation adds the integral of its rate, to the nuclei that are there or as new particles: without noise;
// - growth moves every particle, deposition takes from every weight: without noise;
// - breakage: every numerical particle and its fragments live as long as exponential waiting times say; fragments are
//   particles of their own.
// More than options.particles are merged, fewer are made by halving once there were as many.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/engine/split_step.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/monte_carlo/growth_jump.hpp"
#include "particles/population/monte_carlo/growth_step.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/pair_merging.hpp"
#include "particles/population/monte_carlo/pair_sampling.hpp"
#include "particles/population/monte_carlo/power_law.hpp"
#include "particles/population/monte_carlo/weighted_statistics.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class PairProcess final : public PopulationSolver {
 public:
  using Particle = typename Type::Particle;
  static constexpr std::uint32_t streamPurpose = 0x50414952;

  PairProcess(const Type& type, const PopulationModel& model, const InitialPopulation& initial,
              const MonteCarloOptions& options);

  void advance(double end) override;
  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::array<double, 4> moments() const override {
    return weightedMoments(population_.type(), population_);
  }
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const override {
    return weightedInBins(population_.type(), population_, edges);
  }
  [[nodiscard]] double geometricDeviation() const override {
    return weightedGeometricDeviation(population_.type(), population_);
  }
  [[nodiscard]] std::size_t particles() const override { return population_.size(); }
  [[nodiscard]] std::size_t bytes() const override { return population_.bytes(); }
  [[nodiscard]] const PopulationCounters& counters() const override { return counters_; }
  // f(const Particle&, weight).
  template <class F>
  void forEachParticle(F f) const {
    population_.forEach([&](const auto& entry) { f(entry.particle, entry.weight); });
  }

 private:
  static constexpr double mergedTo = PairMerging<Type>::mergedTo;
  // Part of what there is room for below which lost particles are made up for.
  static constexpr double filledTo = 0.875;
  // Weight of a numerical particle over the mean, up to which nuclei are gathered.
  static constexpr double gathered = PairMerging<Type>::gathered;
  // Part of the volume by which particles grow in a step, as in the other methods.
  static constexpr double growthPart = 0.05;

  [[nodiscard]] double stepTo(double end);
  [[nodiscard]] double nucleationStep(double step, double pace) const;
  [[nodiscard]] bool isNucleus(const Particle& particle) const;
  void nucleate(double from, double to);
  void grow(double step);
  void breakUp(double step);
  void breakUp(const Particle& parent, double weight, double time);
  void deposit(double step);
  void fit();
  void measure();
  void checkGelation() const;
  [[nodiscard]] double capacity() const { return static_cast<double>(options_.particles); }

  PopulationModel model_;
  MonteCarloOptions options_;
  RandomStream random_;
  PairPopulation<Type> population_;
  PairSampling<Type> sampling_;
  PairMerging<Type> merging_;
  GrowthJump<Type> growth_;
  std::optional<NucleationSchedule> schedule_;
  std::optional<Particle> nucleus_;
  double nucleusVolume_ = 0;      // m3
  double nucleusCollisions_ = 0;  // kernel of two nuclei, m3/s
  PowerLaw breakage_, deposition_;
  bool grows_, gels_, filled_ = false;
  int processes_ = 0;
  double time_ = 0;
  // Of the population as it is: number (1/m3), mean relative rates (1/s).
  double number_ = 0, growthPace_ = 0, breakagePace_ = 0, depositionPace_ = 0;
  std::array<double, 2> held_{}, putIn_{};  // sums of w v and w v^2, of kernels that may gel
  std::vector<std::size_t> nuclei_;
  struct Fragment {
    Particle particle;
    double weight;  // 1/m3
    double time;    // s that are left of the step
  };
  std::vector<Fragment> fragments_;
  PopulationCounters counters_;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/monte_carlo/pair_steps.hpp"
