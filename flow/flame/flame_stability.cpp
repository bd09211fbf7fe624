#include "flow/flame/flame_stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr double beyondAll = 1e12;  // 1/s, no mode grows as fast
constexpr double slowest = 1e-3;    // 1/s, slower growth is none
constexpr double accuracy = 1.1;    // factor to which bisection finds a rate: inverse iteration does the rest
// Linear Euler steps of 1/s amplify a mode by 1/|1 - lambda/s|: above `grows` where lambda is from 0.17 to 1.83 s.
// Decades of s leave no gap.
constexpr std::array shifts{1e6, 1e5, 1e4, 1e3};
constexpr int eulerSteps = 30, lastSteps = 10;
constexpr double grows = 1.2;

class Modes {
 public:
  Modes(FlameEquations& equations, std::span<const double> x) : equations_(equations), x_(x), weights_(x.size()) {
    equations.timeWeights(x, weights_);
  }

  [[nodiscard]] int signAt(double s) {
    const bool regular = s > 0 ? equations_.factoriseUnsteady(x_, s) : equations_.factorise(x_, 0);
    if (!regular) throw NumericsError("the Newton matrix of the flame is singular: its stability cannot be told");
    return equations_.determinantSign();
  }

  // What linear Euler steps of 1/s amplify most; empty where that does not grow.
  [[nodiscard]] std::optional<GrowingMode> amplified(double s) {
    static_cast<void>(signAt(s));
    std::vector<double> v = anything();
    double gain = 0, average = 1;
    for (int step = 0; step < eulerSteps; ++step) {
      const std::vector<double> old = v;
      applyInverse(v);
      const std::size_t u = hottest(v);
      gain = s * v[u] / old[u];
      const double size = std::abs(v[u]);
      if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
      for (double& value : v) value /= size;
      if (step >= eulerSteps - lastSteps) average *= s * size;
    }
    average = std::pow(average, 1.0 / lastSteps);
    if (average < grows) return std::nullopt;
    // A real mode has the same gain everywhere and always.
    const bool real = std::abs(std::abs(gain) / average - 1) < 0.1;
    return GrowingMode{real ? s * (1 - 1 / gain) : s * (1 - 1 / average), hotter(std::move(v))};
  }

  // Zero: there is none. Otherwise near the only growing mode, the matrix at rest having another sign than beyond all
  // modes.
  [[nodiscard]] double alone() {
    const int atFastest = signAt(beyondAll);
    if (signAt(0) == atFastest) return 0;
    double low = slowest, high = beyondAll;
    while (high > accuracy * low) {
      const double middle = std::sqrt(low * high);
      (signAt(middle) == atFastest ? high : low) = middle;
    }
    return std::sqrt(low * high);
  }

  // Mass fractions keep their sum of one. Where nothing flows, at a wall, it is the equations' own error that stays or
  // grows, slowly, when they do not.
  [[nodiscard]] bool keepsSums(const GrowingMode& mode) const {
    const FlameLayout& layout = equations_.layout();
    double largest = 0, sums = 0;
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < layout.species; ++k) {
        const double change = mode.direction[i * layout.width() + FlameLayout::firstSpecies + k];
        sum += change;
        largest = std::max(largest, std::abs(change));
      }
      sums = std::max(sums, std::abs(sum));
    }
    return sums < 0.01 * largest;
  }

  // Inverse iteration near a real rate.
  [[nodiscard]] GrowingMode near(double rate) {
    static_cast<void>(signAt(rate));
    GrowingMode mode{rate, anything()};
    for (int pass = 0; pass < 6; ++pass) {
      const std::vector<double> v = mode.direction;
      applyInverse(mode.direction);
      const std::size_t u = hottest(mode.direction);
      // (J + s M) y = M v with J v = -lambda M v.
      mode.rate = rate - v[u] / mode.direction[u];
      mode.direction = hotter(std::move(mode.direction));
      if (!std::isfinite(mode.rate)) throw NumericsError("the growing mode of the flame does not converge");
    }
    return mode;
  }

 private:
  [[nodiscard]] std::vector<double> anything() const {
    std::vector<double> v(x_.size());
    const std::size_t width = equations_.layout().width();
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) v[i * width + FlameLayout::temperature] = 1;
    return v;
  }
  [[nodiscard]] std::size_t hottest(std::span<const double> v) const {
    std::size_t best = FlameLayout::temperature;
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) {
      const std::size_t u = i * equations_.layout().width() + FlameLayout::temperature;
      if (std::abs(v[u]) > std::abs(v[best])) best = u;
    }
    return best;
  }
  [[nodiscard]] std::vector<double> hotter(std::vector<double> v) const {
    const double largest = v[hottest(v)];
    for (double& value : v) value /= largest;
    return v;
  }
  // v becomes (J + s M)^-1 M v.
  void applyInverse(std::vector<double>& v) {
    std::vector<double> y(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) y[i] = weights_[i] * v[i];
    equations_.storage(x_, v, y);
    equations_.solve(y);
    v = std::move(y);
  }

  FlameEquations& equations_;
  std::span<const double> x_;
  std::vector<double> weights_;
};

}  // namespace

std::optional<GrowingMode> growingMode(FlameEquations& equations, std::span<const double> x) {
  Modes modes(equations, x);
  for (const double s : shifts)
    if (auto mode = modes.amplified(s)) return mode;
  const double rate = modes.alone();
  if (rate == 0) return std::nullopt;
  GrowingMode mode = modes.near(rate);
  if (!modes.keepsSums(mode)) return std::nullopt;
  return mode;
}

}  // namespace lampblack
