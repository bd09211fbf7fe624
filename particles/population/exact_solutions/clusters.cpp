#include "particles/population/exact_solutions/clusters.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "particles/population/exact_solutions/quadrature.hpp"
#include "particles/population/exact_solutions/series.hpp"

namespace lampblack::particles::exact {
namespace {

// The first k of a bin; an edge that misses k by a rounding still is k.
double firstCluster(double edge) {
  return std::max(1.0, std::ceil(edge * (1 - 1e-12)));
}

// With Stirling's formula for k! nothing large is subtracted: the exponent of each k is k (ln t + 1 - t).
class BorelTerm {
 public:
  explicit BorelTerm(const Borel& law) : law_(law), excess_(logarithmicExcess(law.rest)) {}

  double operator()(double k) const {
    return law_.factor / (std::sqrt(2 * constants::pi) * law_.t) *
           std::exp(-k * excess_ - law_.power * std::log(k) - stirlingRest(k));
  }
  double slope(double k) const { return (*this)(k) * (-excess_ - law_.power / k + 1 / (12 * k * k)); }
  double largest() const { return 750 / excess_; }  // beyond it a term is below the smallest double

 private:
  Borel law_;
  double excess_;
};

}  // namespace

double geometricClusters(double tau, double lower, double upper) {
  const double first = firstCluster(lower), end = firstCluster(upper), size = 1 + 0.5 * tau;
  if (!(end > first)) return 0;
  if (!(tau > 0)) return first == 1 ? 1.0 : 0.0;
  const double decay = std::log1p(1 / (0.5 * tau));  // -ln of the ratio of neighbours
  return -std::exp(-(first - 1) * decay) * std::expm1(-(end - first) * decay) / size;
}

double borelClusters(const Borel& law, double lower, double upper) {
  const double first = firstCluster(lower), end = firstCluster(upper);
  if (!(end > first)) return 0;
  if (!(law.t > 0)) return first == 1 ? law.factor : 0.0;
  const BorelTerm term(law);
  const double last = std::min(end, term.largest());
  // Below 4096 term by term, above by Euler and Maclaurin's formula; what it leaves out is below k^-4 of a term.
  constexpr double small = 4096;
  double sum = 0;
  for (double k = first; k < std::min(last, small); ++k) sum += term(k);
  const double a = std::max(first, small), b = last;
  if (b > a) {
    sum += integralOverSizes([&](double k) { return term(k); }, a, b, term.largest()) - 0.5 * (term(b) - term(a)) +
           (term.slope(b) - term.slope(a)) / 12;
  }
  return sum;
}

}  // namespace lampblack::particles::exact
