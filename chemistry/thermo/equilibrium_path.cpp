#include "chemistry/thermo/equilibrium_path.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/vector_math.hpp"

namespace lampblack::chemistry {
namespace {

constexpr double basisTolerance = 1.0;  // e-fold by which a species may exceed its components before they are rechosen
constexpr double largestPrediction = 4.0;  // of an unknown along the tangent
constexpr double roughly = 1e-2;           // last step of Newton's method on the way; its error is the square of it
constexpr double exactly = 1e-9;           // the same at the end
constexpr double nothing = 1e-30;  // left of the path: amounts that fall with it, to e^vanishing times it, will be zero
constexpr double vanishing = 20.0;
constexpr int mostIterations = 12;
constexpr int mostSteps = 1000;
constexpr double almostAll = 0.98;     // of what is left, tried where all of it at once fails
constexpr double smallestStep = 1e-6;  // of what is left

double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double v : x) most = std::isfinite(v) ? std::max(most, std::abs(v)) : INFINITY;
  return most;
}

}  // namespace

void EquilibriumPath::setMixture(Constant constant, std::size_t numElements, std::vector<double> atoms,
                                 std::span<const double> amounts) {
  constant_ = constant;
  n_ = amounts.size();
  components_.setSpecies(numElements, n_, std::move(atoms));
  mixture_.assign(amounts.begin(), amounts.end());
  for (auto* array : {&startDg_, &endDg_, &dg_, &lnAmounts_, &amounts_, &weighted_, &change_}) array->resize(n_);
  excluded_.clear();
  iterations_ = 0;
}

void EquilibriumPath::startFrom(std::span<const double> lnAmounts) {
  lnAmounts_.assign(lnAmounts.begin(), lnAmounts.end());
  start_.resize(n_);
  double total = 0;
  for (std::size_t j = 0; j < n_; ++j) total += start_[j] = std::exp(lnAmounts[j]);
  endG_.resize(n_);
  const double lnTotal = constant_ == Constant::Pressure ? std::log(total) : 0.0;
  for (std::size_t j = 0; j < n_; ++j) endG_[j] = lnTotal - lnAmounts[j];
  z_.assign(1, lnTotal);
}

// Of component i in a composition; what is left by cancellation is no amount.
double EquilibriumPath::componentAmounts(std::span<const double> amounts, std::size_t i) const {
  const double* nu = components_.row(i);
  double sum = 0, magnitude = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    sum += nu[j] * amounts[j];
    magnitude += std::abs(nu[j]) * amounts[j];
  }
  constexpr double rounding = 4e-15;
  return std::abs(sum) < rounding * magnitude ? 0.0 : sum;
}

// Of forming each species from components.
void EquilibriumPath::componentPotentials(std::span<const double> g, std::vector<double>& dg) const {
  dg.assign(g.begin(), g.end());
  for (std::size_t i = 0; i < components_.count(); ++i) {
    const double* nu = components_.row(i);
    const double own = g[components_.species(i)];
    for (std::size_t j = 0; j < n_; ++j) dg[j] -= nu[j] * own;
  }
}

// Chooses components for the present composition, takes their logarithms as unknowns (ln N stays), and writes elements
// and potentials in them. False if species are excluded.
bool EquilibriumPath::chooseComponents() {
  const double lnTotal = z_.back();
  components_.choose(lnAmounts_);
  const std::size_t c = components_.count();
  z_.resize(c + 1);
  for (std::size_t i = 0; i < c; ++i) z_[i] = lnAmounts_[components_.species(i)];
  z_[c] = lnTotal;
  for (auto* array : {&residual_, &scale_, &tangent_, &saved_, &work_}) array->resize(c + 1);
  matrix_.resize((c + 1) * (c + 1));
  for (auto* array : {&startQ_, &endQ_, &q_}) array->resize(c);
  componentPotentials(startG_, startDg_);
  componentPotentials(endG_, endDg_);
  for (std::size_t i = 0; i < c; ++i) {
    startQ_[i] = componentAmounts(start_.empty() ? mixture_ : start_, i);
    endQ_[i] = componentAmounts(mixture_, i);
  }
  return !excludeAbsent();
}

// Marks the species that contain component i.
void EquilibriumPath::exclude(std::size_t i) {
  const double* nu = components_.row(i);
  for (std::size_t j = 0; j < n_; ++j)
    if (nu[j] != 0 && std::find(excluded_.begin(), excluded_.end(), j) == excluded_.end()) excluded_.push_back(j);
}

// A component of which there is nothing, and that no species can take up, forbids all that contain it.
bool EquilibriumPath::excludeAbsent() {
  for (std::size_t i = 0; i < components_.count(); ++i) {
    const double* nu = components_.row(i);
    if (endQ_[i] == 0 && std::none_of(nu, nu + n_, [](double v) { return v < 0; })) exclude(i);
  }
  return !excluded_.empty();
}

// The same where only several components together allow no other way: they vanish with what is left of the path.
bool EquilibriumPath::excludeVanishing(double left) {
  for (std::size_t i = 0; i < components_.count(); ++i)
    if (endQ_[i] == 0 && z_[i] < std::log(left) + vanishing) exclude(i);
  return !excluded_.empty();
}

// Elements and potentials on the way, where a part `left` of it is still to go.
void EquilibriumPath::setPosition(Stage stage, double left) {
  const double elementsLeft = stage == Stage::Elements ? left : 0.0;
  const double potentialsLeft = stage == Stage::Elements ? 1.0 : left;
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = elementsLeft * startQ_[i] + (1 - elementsLeft) * endQ_[i];
  for (std::size_t j = 0; j < n_; ++j) dg_[j] = potentialsLeft * startDg_[j] + (1 - potentialsLeft) * endDg_[j];
}

// sums_i = sum_j nu_ij n_j values_j, and the same with d_j at the end.
void EquilibriumPath::weightedSums(const std::vector<double>& values, std::vector<double>& sums) const {
  const std::size_t c = components_.count();
  for (std::size_t i = 0; i <= c; ++i) {
    const double* nu = i < c ? components_.row(i) : components_.remainder();
    double sum = 0;
    for (std::size_t j = 0; j < n_; ++j) sum += nu[j] * amounts_[j] * values[j];
    sums[i] = sum;
  }
}

// Amounts, residual and matrix of Newton's method for the present unknowns.
void EquilibriumPath::evaluate() {
  const std::size_t c = components_.count(), m = c + 1;
  const double* d = components_.remainder();
  for (std::size_t j = 0; j < n_; ++j) lnAmounts_[j] = d[j] * z_[c] - dg_[j];
  for (std::size_t i = 0; i < c; ++i) {
    const double* nu = components_.row(i);
    for (std::size_t j = 0; j < n_; ++j) lnAmounts_[j] += nu[j] * z_[i];
  }
  vectormath::exp(lnAmounts_.data(), amounts_.data(), n_);
  const double total = std::exp(z_[c]);
  double qSum = 0;
  for (std::size_t i = 0; i <= c; ++i) {
    const double* nu = i < c ? components_.row(i) : d;
    double sum = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      weighted_[j] = nu[j] * amounts_[j];
      sum += weighted_[j];
    }
    if (i < c) qSum += q_[i];
    residual_[i] = i < c ? sum - q_[i] : sum - total + qSum;
    for (std::size_t k = i; k <= c; ++k) {
      const double* other = k < c ? components_.row(k) : d;
      double product = 0;
      for (std::size_t j = 0; j < n_; ++j) product += weighted_[j] * other[j];
      matrix_[i * m + k] = matrix_[k * m + i] = product;
    }
  }
  matrix_[m * m - 1] -= total;
  if (constant_ == Constant::Volume) {
    residual_[c] = 0;
    for (std::size_t k = 0; k < c; ++k) matrix_[c * m + k] = matrix_[k * m + c] = 0;
    matrix_[m * m - 1] = -total;
  }
  ++iterations_;
}

// L D L^T of the scaled matrix: positive in the components, negative in N.
bool EquilibriumPath::factorise() {
  const std::size_t m = unknowns();
  for (std::size_t i = 0; i < m; ++i) {
    scale_[i] = 1.0 / std::sqrt(i + 1 < m ? matrix_[i * m + i] : std::exp(z_[i]));
    if (!(scale_[i] > 0) || !std::isfinite(scale_[i])) return false;
  }
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k) matrix_[i * m + k] *= scale_[i] * scale_[k];
  for (std::size_t k = 0; k < m; ++k) {
    const double pivot = matrix_[k * m + k];
    if (!(k + 1 < m ? pivot > 0 : pivot < 0)) return false;
    for (std::size_t i = k + 1; i < m; ++i) {
      const double factor = matrix_[i * m + k] / pivot;
      for (std::size_t l = k + 1; l < m; ++l) matrix_[i * m + l] -= factor * matrix_[k * m + l];
      matrix_[i * m + k] = factor;
    }
  }
  return true;
}

void EquilibriumPath::solve(std::vector<double>& x) const {
  const std::size_t m = unknowns();
  for (std::size_t i = 0; i < m; ++i) {
    x[i] *= scale_[i];
    for (std::size_t k = 0; k < i; ++k) x[i] -= matrix_[i * m + k] * x[k];
  }
  for (std::size_t i = m; i-- > 0;) {
    for (std::size_t k = i + 1; k < m; ++k) x[i] -= matrix_[i * m + k] * x[k];
    x[i] /= matrix_[i * m + i];
  }
  for (std::size_t i = 0; i < m; ++i) x[i] *= scale_[i];
}

// Newton's method at the present position. An amount that grows does so linearly, one that falls exponentially: it can
// neither overshoot nor become negative where a component is made of itself alone.
bool EquilibriumPath::correct(double tolerance) {
  for (int iteration = 0; iteration < mostIterations; ++iteration) {
    evaluate();
    if (!factorise()) return false;
    for (std::size_t i = 0; i < unknowns(); ++i) work_[i] = -residual_[i];
    solve(work_);
    const double size = largest(work_);
    if (!std::isfinite(size)) return false;
    for (std::size_t i = 0; i < unknowns(); ++i) z_[i] += work_[i] > 0 ? std::log1p(work_[i]) : work_[i];
    if (size <= tolerance) {
      evaluate();
      return true;
    }
  }
  return false;
}

// Change of the unknowns along the path.
bool EquilibriumPath::setTangent(Stage stage) {
  evaluate();
  if (!factorise()) return false;
  if (stage == Stage::Elements) {
    tangent_.back() = 0;
    for (std::size_t i = 0; i < components_.count(); ++i) {
      tangent_[i] = endQ_[i] - startQ_[i];
      tangent_.back() -= tangent_[i];
    }
  } else {
    for (std::size_t j = 0; j < n_; ++j) change_[j] = endDg_[j] - startDg_[j];
    weightedSums(change_, tangent_);
  }
  if (constant_ == Constant::Volume) tangent_.back() = 0;
  solve(tangent_);
  return std::isfinite(largest(tangent_));
}

// From a solution with a part `left` of the way to go: a step along the tangent, shortened until Newton's method gets
// back to the path. Returns what is left then; not less than before if there is no such step.
double EquilibriumPath::advance(Stage stage, double left, double step) {
  setPosition(stage, left);
  if (!setTangent(stage)) return left;
  saved_ = z_;
  const double steepest = largest(tangent_);
  step = std::min({step, left, largestPrediction / steepest});
  while (step > smallestStep * left) {
    for (std::size_t i = 0; i < unknowns(); ++i) z_[i] = saved_[i] + step * tangent_[i];
    setPosition(stage, left - step);
    if (correct(stage == Stage::Potentials && step == left ? exactly : roughly)) return left - step;
    // Amounts that almost vanish at the end are approached by orders of magnitude.
    step = step == left ? almostAll * left : step / 4;
  }
  return left;
}

EquilibriumPath::Outcome EquilibriumPath::walk(Stage stage) {
  double left = 1, step = 1;
  for (int count = 0; count < mostSteps; ++count) {
    if (count == 0 || !components_.fit(lnAmounts_, basisTolerance)) {
      if (!chooseComponents()) return Outcome::SpeciesExcluded;
      if (left == 0 && stage == Stage::Potentials) {
        setPosition(stage, left);
        if (!correct(exactly)) return Outcome::Lost;
        continue;
      }
    }
    if (left == 0) return Outcome::Found;
    const double before = left;
    left = advance(stage, left, step);
    if (left == before) return Outcome::Lost;
    if (left > 0 && left < nothing && excludeVanishing(left)) return Outcome::SpeciesExcluded;
    step = 4 * (before - left);
  }
  return Outcome::Lost;
}

EquilibriumPath::Outcome EquilibriumPath::follow(std::span<const double> g) {
  startG_ = endG_;
  endG_.assign(g.begin(), g.end());
  if (!start_.empty()) {
    const Outcome outcome = walk(Stage::Elements);
    if (outcome != Outcome::Found) return outcome;
    start_.clear();
  }
  return walk(Stage::Potentials);
}

void EquilibriumPath::sensitivity(std::span<const double> dg, std::span<double> dLnAmounts) {
  const std::size_t c = components_.count();
  evaluate();
  factorise();
  componentPotentials(dg, change_);
  weightedSums(change_, tangent_);
  if (constant_ == Constant::Volume) tangent_.back() = 0;
  solve(tangent_);
  for (std::size_t j = 0; j < n_; ++j) {
    dLnAmounts[j] = components_.remainder()[j] * tangent_[c] - change_[j];
    for (std::size_t i = 0; i < c; ++i) dLnAmounts[j] += components_.row(i)[j] * tangent_[i];
  }
}

}  // namespace lampblack::chemistry
