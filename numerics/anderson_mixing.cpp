#include "numerics/anderson_mixing.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::numerics {
namespace {

// Of a direction's square, what has to be left of it beside the others: else it tells nothing new.
constexpr double leastNew = 1e-10;

}  // namespace

void AndersonMixing::clear() {
  change_.clear();
  found_.clear();
  differences_.clear();
}

// Of the least squares problem, by the Cholesky factors of its normal equations; directions that tell nothing new have
// no part.
std::vector<double> AndersonMixing::coefficients(std::span<const double> change,
                                                 std::span<const double> weights) const {
  const std::size_t n = differences_.size();
  std::vector<double> sums(n * (n + 1), 0.0);
  for (std::size_t a = 0; a < n; ++a) {
    const std::vector<double>& ofA = differences_[a].change;
    for (std::size_t b = 0; b <= a; ++b) {
      const std::vector<double>& ofB = differences_[b].change;
      double sum = 0.0;
      for (std::size_t i = 0; i < change.size(); ++i) sum += weights[i] * ofA[i] * ofB[i];
      sums[a * n + b] = sum;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < change.size(); ++i) sum += weights[i] * ofA[i] * change[i];
    sums[n * n + a] = sum;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
  std::vector<double> x(sums.end() - static_cast<std::ptrdiff_t>(n), sums.end());
  std::vector<char> counts(n, 1);
  for (std::size_t a = 0; a < n; ++a) {
    double* row = &sums[a * n];
    const double whole = row[a];
    for (std::size_t b = 0; b < a; ++b) {
      if (!counts[b]) {
        row[b] = 0.0;
        continue;
      }
      for (std::size_t k = 0; k < b; ++k) row[b] -= row[k] * sums[b * n + k];
      row[b] /= sums[b * n + b];
      row[a] -= row[b] * row[b];
    }
    counts[a] = row[a] > leastNew * whole;
    row[a] = counts[a] ? std::sqrt(row[a]) : 1.0;
    for (std::size_t b = 0; b < a; ++b) x[a] -= row[b] * x[b];
    x[a] = counts[a] ? x[a] / row[a] : 0.0;
  }
  for (std::size_t a = n; a-- > 0;) {
    for (std::size_t b = a + 1; b < n; ++b)
      if (counts[b]) x[a] -= sums[b * n + a] * x[b];
    x[a] = counts[a] ? x[a] / sums[a * n + a] : 0.0;
  }
  return x;
}

void AndersonMixing::mix(std::span<const double> before, std::span<double> found, std::span<const double> weights) {
  std::vector<double> change(found.begin(), found.end());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= before[i];
  std::vector<double> kept(found.begin(), found.end());
  if (!change_.empty()) {
    if (differences_.size() == depth_) differences_.pop_front();
    Difference& latest = differences_.emplace_back(Difference{change, kept});
    for (std::size_t i = 0; i < change.size(); ++i) {
      latest.change[i] -= change_[i];
      latest.found[i] -= found_[i];
    }
    const std::vector<double> x = coefficients(change, weights);
    for (std::size_t a = 0; a < differences_.size(); ++a)
      for (std::size_t i = 0; i < change.size(); ++i) found[i] -= x[a] * differences_[a].found[i];
  }
  change_ = std::move(change);
  found_ = std::move(kept);
}

}  // namespace lampblack::numerics
