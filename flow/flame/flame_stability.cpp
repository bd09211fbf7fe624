#include "flow/flame/flame_stability.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "numerics/arnoldi.hpp"

namespace lampblack::flow {
namespace {

constexpr double slowest = 1e-3;  // 1/s, slower growth is none
constexpr double accuracy = 1.1;  // factor to which bisection finds a rate: Arnoldi's method does the rest

// The rates of the unstable flames of hydrogen (1 to 90 atm) and methane at hand are 1 to 1.4e4 1/s; this is beyond,
// where shifts of 1e4 and 1e5 found them as well.
constexpr double fast = 3e4;  // 1/s

// Decaying modes have eigenvalues between 0 and 1/s, or one over the slowest decay. One that stands beside them by a
// part g of that is separated in m steps to 2 exp(-2 m g^1/2) (Chebyshev polynomials; Saad 2011, theorem 6.3): for g =
// 0.1 and the least number of vectors to 4e-3.
constexpr std::size_t leastVectors = 10, mostVectors = 40;
// A value counts where its error, by the residual of its vector, is below this part of its growth; where it might still
// become one, the search goes on. Spurious values of hydrogen flames had 0.02 and more after ten steps, the growing
// modes less than 1e-4.
constexpr double certain = 0.01, undecided = 0.5;
// Eigenvalues near zero are those of the algebraic equations and of diffusion over a spacing; values there mean
// nothing. Looked at is what is this near to the fast shift (in its own units), and from zero what is far below it.
constexpr double reach = 5, slowReach = 0.1 * fast;
// Implicit Euler steps of half a time of growth amplify what turns less fast than this: 0.25 (1 + 1.7^2) < 1.
constexpr double mostTurns = 1.7;

class Modes {
 public:
  Modes(FlameEquations& equations, std::span<const double> x)
      : equations_(equations), x_(x), weights_(x.size()), scale_(x.size()) {
    equations.timeWeights(x, weights_);
    equations.scales(x, scale_);
  }

  [[nodiscard]] int signAt(double s) {
    const bool regular = s > 0 ? equations_.factoriseUnsteady(x_, s) : equations_.factorise(x_, 0);
    if (!regular) throw NumericsError("the Newton matrix of the flame is singular: its stability cannot be told");
    return equations_.determinantSign();
  }

  // The fastest growing mode that is seen from s, whose factors are at hand.
  [[nodiscard]] std::optional<GrowingMode> seenFrom(double s) {
    std::vector<double> start = anything();
    divide(start, scale_);
    Arnoldi arnoldi(
        [this](std::vector<double>& v) {
          multiply(v, scale_);
          applyInverse(v);
          divide(v, scale_);
        },
        std::move(start));
    while (true) {
      const bool more = arnoldi.extend();
      if (more && arnoldi.dimension() < leastVectors) continue;
      bool open = false;
      double rate = 0;
      std::optional<RitzPair> best;
      for (RitzPair& pair : arnoldi.pairs()) {
        const std::complex<double> lambda = s - 1.0 / pair.value;
        const double distance = std::abs(lambda - s);
        if (!(lambda.real() > 0) || std::abs(lambda.imag()) > mostTurns * lambda.real()) continue;
        if (distance > (s > 0 ? reach * s : slowReach)) continue;
        const double error = pair.residual / std::abs(pair.value) * distance / lambda.real();
        if (error > certain) {
          open = open || error < undecided;
        } else if (lambda.real() > rate) {
          rate = lambda.real();
          best = std::move(pair);
        }
      }
      if (open && more && arnoldi.dimension() < mostVectors) continue;
      if (!best) return std::nullopt;
      std::vector<double> v = arnoldi.vector(*best);
      multiply(v, scale_);
      return GrowingMode{rate, hotter(std::move(v))};
    }
  }

  // The only real mode that grows more slowly than `fast`, where the matrix has the sign `atFast`.
  [[nodiscard]] std::optional<GrowingMode> single(int atFast) {
    double low = slowest, high = fast;
    while (high > accuracy * low) {
      const double middle = std::sqrt(low * high);
      (signAt(middle) == atFast ? high : low) = middle;
    }
    const double rate = std::sqrt(low * high);
    static_cast<void>(signAt(rate));
    return seenFrom(rate);
  }

 private:
  [[nodiscard]] std::vector<double> anything() const {
    std::vector<double> v(x_.size());
    const std::size_t width = equations_.layout().width();
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) v[i * width + FlameLayout::temperature] = 1;
    return v;
  }
  [[nodiscard]] std::vector<double> hotter(std::vector<double> v) const {
    double largest = 0;
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) {
      const double change = v[i * equations_.layout().width() + FlameLayout::temperature];
      if (std::abs(change) > std::abs(largest)) largest = change;
    }
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
    keepSums(v);
  }
  void keepSums(std::vector<double>& v) const {
    const FlameLayout& layout = equations_.layout();
    for (std::size_t i = 0; i < equations_.grid().size(); ++i) {
      const std::size_t first = i * layout.width() + FlameLayout::firstSpecies;
      double sum = 0;
      for (std::size_t k = 0; k < layout.species; ++k) sum += v[first + k];
      for (std::size_t k = 0; k < layout.species; ++k) v[first + k] -= sum * x_[first + k];
    }
  }
  static void multiply(std::vector<double>& v, std::span<const double> by) {
    for (std::size_t i = 0; i < v.size(); ++i) v[i] *= by[i];
  }
  static void divide(std::vector<double>& v, std::span<const double> by) {
    for (std::size_t i = 0; i < v.size(); ++i) v[i] /= by[i];
  }

  FlameEquations& equations_;
  std::span<const double> x_;
  std::vector<double> weights_, scale_;
};

}  // namespace

std::optional<GrowingMode> growingMode(FlameEquations& equations, std::span<const double> x, bool atHand) {
  Modes modes(equations, x);
  const int atRest = atHand && equations.hasSteadyFactors() ? equations.determinantSign() : modes.signAt(0);
  const auto slow = modes.seenFrom(0);
  const int atFast = modes.signAt(fast);
  const auto quick = modes.seenFrom(fast);
  if (slow || quick) return !quick || (slow && slow->rate > quick->rate) ? slow : quick;
  if (atRest == atFast) return std::nullopt;
  return modes.single(atFast);
}

std::optional<GrowingMode> singleGrowingMode(FlameEquations& equations, std::span<const double> x) {
  Modes modes(equations, x);
  const int atFast = modes.signAt(fast);
  if (modes.signAt(0) == atFast) return std::nullopt;
  return modes.single(atFast);
}

}  // namespace lampblack::flow
