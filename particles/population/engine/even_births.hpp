// Nuclei at a rate that stays as it is for some time, put in evenly: the integral of the rate is cut into intervals as
// long as what their nucleus stands for, and it is born at a random place in its own. The number put in never differs
// from the integral by more than a nucleus or two, whatever the weight of nuclei does; its mean is the integral.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::particles {

class EvenBirths {
 public:
  void setRate(double rate) { rate_ = rate; }  // 1/m3/s
  // Without particles: what there was of an interval is gone.
  void startAfresh() {
    reached_ = 0;
    planned_ = false;
  }
  // A nucleus of this weight (1/m3), unless there is one whose interval has begun.
  void plan(double weight, RandomStream& random) {
    if (planned_ || !(rate_ > 0)) return;
    place(weight, random);
    planned_ = true;
  }
  [[nodiscard]] double due(double time) const {
    return rate_ > 0 ? time + std::max(0.0, after_ - reached_) / rate_ : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool isDue() const { return rate_ > 0 && reached_ >= after_; }
  void pass(double dt) { add(dt * rate_); }
  // To the integral, 1/m3.
  void add(double number) { reached_ += number; }
  void happen() { reached_ = after_; }  // the nucleus that is due, now
  // It is born and stands for `weight`. The next interval begins where this one, as long as what was put in, ends; its
  // nucleus has the weight `next`.
  void bear(double weight, double next, RandomStream& random) {
    reached_ -= weight;
    place(next, random);
  }
  void dilute(double factor) {
    reached_ *= factor;
    after_ *= factor;
  }
  // What a population keeps of them.
  using Memory = std::array<double, 3>;
  [[nodiscard]] Memory memory() const { return {reached_, after_, planned_ ? 1.0 : 0.0}; }
  void restore(const Memory& memory) {
    reached_ = memory[0];
    after_ = memory[1];
    planned_ = memory[2] != 0;
  }

 private:
  void place(double weight, RandomStream& random) { after_ = weight * random.uniform(); }

  double rate_ = 0;
  // Of the interval: how much has passed (negative: it has not begun), and where in it the nucleus is due, 1/m3.
  double reached_ = 0, after_ = 0;
  bool planned_ = false;
};

}  // namespace lampblack::particles
