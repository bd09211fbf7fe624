// Moments of broken order from those of whole order: ln M is interpolated by the Lagrange polynomial through ln M_0 ...
// ln M_(n-1) (Frenklach and Harris 1987; Frenklach 2002). Exact for log-normal distributions.
#pragma once

#include <span>
#include <vector>

namespace lampblack {

// Lagrange's weights of the points 0 ... count-1 at x.
[[nodiscard]] std::vector<double> lagrangeWeights(std::size_t count, double x);

// Moments of the orders j/6.
class MomentInterpolation {
 public:
  // Orders from `lowest`/6 to `highest`/6.
  MomentInterpolation(std::size_t count, int lowest, int highest);

  // For these moments (all above zero); at() is of the last ones.
  void set(std::span<const double> moments);
  [[nodiscard]] double at(int sixths) const { return values_[static_cast<std::size_t>(sixths - lowest_)]; }

 private:
  std::size_t count_;
  int lowest_;
  std::vector<std::vector<double>> weights_;
  std::vector<double> values_, logarithms_;
};

}  // namespace lampblack
