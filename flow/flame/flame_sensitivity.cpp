#include "flow/flame/flame_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "flow/flame/flame_equations_data.hpp"
#include "numerics/block_tridiagonal.hpp"

namespace lampblack::flow {
namespace {

// Differences as parts of an unknown, and of the size with which Newton's method measures it.
constexpr double partOfValue = 1e-6, partOfScale = 1e-2;
constexpr std::size_t colours = 3;  // points so far apart do not see each other

class Adjoint {
 public:
  Adjoint(FlameEquations& equations, const FlameProfile& profile)
      : equations_(equations),
        d_(equations.data()),
        x_(profile.x),
        F_(x_.size()),
        steps_(x_.size()),
        transposed_(d_.comm, d_.points(), d_.width(), numFlameGlobals) {
    equations_.scales(x_, steps_);
    for (std::size_t u = 0; u < x_.size(); ++u) steps_[u] = partOfScale * steps_[u] + partOfValue * std::abs(x_[u]);
  }

  // lambda with J^T lambda = e of the mass flux: minus the change of the mass flux with each residual.
  [[nodiscard]] std::vector<double> solve() {
    equations_.residual(x_, F_);
    transposed_.clear();
    for (std::size_t colour = 0; colour < colours; ++colour)
      for (std::size_t c = 0; c < d_.width(); ++c) byComponent(colour, c);
    for (std::size_t g = 0; g < numFlameGlobals; ++g) byGlobal(g);
    // The only equation of the whole flame that looks at points: the temperature of the anchor.
    if (owns(d_.anchor)) transposed_.borderColumns(d_.anchor)[leftMassFlux * d_.width() + FlameLayout::temperature] = 1;
    if (!transposed_.factorise())
      throw NumericsError("sensitivities: the Jacobian of the flame is singular at " +
                          d_.nameOf(transposed_.singularPoint(), FlameLayout::temperature));
    std::vector<double> lambda(x_.size(), 0.0);
    lambda[d_.points() * d_.width() + leftMassFlux] = 1;
    transposed_.solve(lambda);
    equations_.residual(x_, F_);  // the gas at the points is that of the flame again
    return lambda;
  }

 private:
  [[nodiscard]] bool owns(std::size_t i) const { return i >= transposed_.ownedBegin() && i < transposed_.ownedEnd(); }

  // Differences of the residual by one component at every third point.
  void byComponent(std::size_t colour, std::size_t c) {
    const std::size_t w = d_.width(), n = d_.points();
    std::vector<double> trial = x_;
    for (std::size_t i = colour; i < n; i += colours) trial[i * w + c] += steps_[i * w + c];
    const std::vector<double> changed = residualAt(trial);
    for (std::size_t i = colour; i < n; i += colours) {
      if (!owns(i)) continue;
      const double step = trial[i * w + c] - x_[i * w + c];
      for (std::size_t j = i > 0 ? i - 1 : i; j <= std::min(i + 1, n - 1); ++j) {
        double* block = j < i    ? transposed_.lower(i).entries()
                        : j == i ? transposed_.diagonal(i)
                                 : transposed_.upper(i).entries();
        for (std::size_t e = 0; e < w; ++e) block[e * w + c] = (changed[j * w + e] - F_[j * w + e]) / step;
      }
    }
  }

  void byGlobal(std::size_t g) {
    const std::size_t w = d_.width(), n = d_.points(), at = n * w + g;
    std::vector<double> trial = x_;
    trial[at] += steps_[at];
    const std::vector<double> changed = residualAt(trial);
    const double step = trial[at] - x_[at];
    for (std::size_t i = transposed_.ownedBegin(); i < transposed_.ownedEnd(); ++i)
      for (std::size_t e = 0; e < w; ++e)
        transposed_.borderRows(i)[e * numFlameGlobals + g] = (changed[i * w + e] - F_[i * w + e]) / step;
    for (std::size_t h = 0; h < numFlameGlobals; ++h)
      transposed_.corner()[h * numFlameGlobals + g] = (changed[n * w + h] - F_[n * w + h]) / step;
  }

  std::vector<double> residualAt(const std::vector<double>& x) {
    std::vector<double> F(x.size());
    equations_.residual(x, F);
    return F;
  }

  FlameEquations& equations_;
  FlameEquations::Data& d_;
  const std::vector<double>& x_;
  std::vector<double> F_, steps_;
  BlockTridiagonal transposed_;
};

// Where a free flame is pinned: its steepest place, whichever does not matter.
std::size_t steepest(const FlameProfile& profile) {
  std::size_t best = 1;
  double most = 0;
  for (std::size_t i = 1; i + 1 < profile.points(); ++i) {
    const double slope =
        (profile.temperature(i + 1) - profile.temperature(i - 1)) / (profile.z[i + 1] - profile.z[i - 1]);
    if (slope <= most) continue;
    most = slope;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<double> speedSensitivities(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism,
                                       const FlameProblem& problem, CarriedModel* carried,
                                       const FlameTolerances& tolerances, const FlameProfile& profile) {
  if (problem.type != FlameType::Free) throw std::logic_error("only a free flame has a speed");
  FlameEquations equations(comm, mechanism, problem, carried, tolerances);
  equations.setGrid(profile.z);
  const std::size_t anchor = steepest(profile);
  equations.setAnchor(anchor, profile.temperature(anchor));
  equations.setLoad(profile.global(load));
  equations.data().matrix.reset();  // the transposed one takes as much
  const std::vector<double> lambda = Adjoint(equations, profile).solve();

  // dm/d ln k = -lambda . dF/d ln k; the residuals have the sources of species, and of energy where it is solved.
  FlameEquations::Data& d = equations.data();
  const std::size_t n = d.species(), reactions = mechanism->numReactions();
  std::vector<double> result(reactions, 0.0), concentrations(n), forward(reactions), reverse(reactions);
  for (std::size_t i = d.begin; i < d.end; ++i) {
    const auto Y = profile.massFractions(i);
    for (std::size_t k = 0; k < n; ++k) concentrations[k] = d.gas.nodes.density[i] * Y[k] / d.gas.weights[k];
    d.kinetics.ratesOfProgress(profile.temperature(i), concentrations, forward, reverse);
    const double* of = &lambda[i * d.width()];
    const double ofEnergy = d.temperatureIsGiven(i) ? 0 : of[FlameLayout::temperature];
    const double* h = &d.gas.nodes.enthalpy[i * n];
    for (std::size_t r = 0; r < reactions; ++r)
      for (const auto& [k, nu] : d.kinetics.netStoichiometry(r))
        result[r] += d.volume[i] * d.gas.weights[k] * nu * (forward[r] - reverse[r]) *
                     (of[FlameLayout::firstSpecies + k] - ofEnergy * h[k]);
  }
  MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(reactions), MPI_DOUBLE, MPI_SUM, comm);
  for (double& value : result) value /= profile.global(leftMassFlux);
  return result;
}

}  // namespace lampblack::flow
