// Nuclei of a population balance, placed along the integral I of its nucleation rate (1/m3), which may change in time.
// Random: the distance to the next one is exponentially distributed with mean w, what a nucleus stands for; when w
// changes, what is left of the distance changes in proportion, as the exponential distribution has no memory. Even: I
// is cut into intervals as long as the weight of their nucleus, which lies at a random place in its interval. Both have
// the mean I at any time; for the second, the number put in never differs from it by more than a nucleus or two,
// whatever w does.
#pragma once

#include <limits>
#include <optional>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

template <class Method>
class NucleationBirths {
 public:
  // Keeps a reference to the method, which has the weight of its nuclei.
  NucleationBirths(const Method& method, const PopulationModel& model, NucleationSampling sampling,
                   RandomStream& random)
      : method_(method), sampling_(sampling) {
    if (!model.nucleation) return;
    schedule_.emplace(*model.nucleation);
    plan(0, random);
  }

  double due(double time) {
    if (schedule_ && sampling_ == NucleationSampling::random && method_.nucleusWeight() != weight_) replan(time);
    return time_;
  }
  void pass(double) {}
  void happen() {}
  // The one that was due, of this weight, is there.
  void bear(double weight, RandomStream& random) {
    intervalStart_ += weight;
    plan(at_, random);
  }

 private:
  void plan(double reached, RandomStream& random) {
    weight_ = method_.nucleusWeight();
    at_ = sampling_ == NucleationSampling::even ? intervalStart_ + random.uniform() * weight_
                                                : reached + random.exponential(1) * weight_;
    time_ = schedule_->timeOf(at_);
  }
  void replan(double time) {
    const double weight = method_.nucleusWeight(), reached = schedule_->cumulative(time);
    at_ = reached + (at_ - reached) * weight / weight_;
    weight_ = weight;
    time_ = schedule_->timeOf(at_);
  }

  const Method& method_;
  NucleationSampling sampling_;
  std::optional<NucleationSchedule> schedule_;
  double intervalStart_ = 0, at_ = 0, weight_ = 0;         // 1/m3
  double time_ = std::numeric_limits<double>::infinity();  // s
};

}  // namespace lampblack::particles
