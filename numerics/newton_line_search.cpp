// The line search of NewtonIteration (newton_iteration.hpp). Vectors called `inverse` are J^-1 F: minus the step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/newton_iteration.hpp"

namespace lampblack::numerics {

void NewtonIteration::searchLine(SNESLineSearch lineSearch) {
  Vec X = nullptr, F = nullptr, Y = nullptr;
  checkPetsc(SNESLineSearchGetVecs(lineSearch, &X, &F, &Y, nullptr, nullptr));
  {
    const PetscMutableValues x(X), f(F);
    const PetscValues inverse(Y);
    system_.scales(x.get(), scale_);
    const Size size = sizeOf(inverse.get());
    if (!converged_) note(size);
    if (!std::isfinite(size.mean)) {
      fail(SNES_DIVERGED_LINEAR_SOLVE, fmt::format("the Newton step of {} is not finite", system_.nameOf(size.worst)));
    } else if (search(x.get(), inverse.get(), size)) {
      std::ranges::copy(trial_, x.get().begin());
      std::ranges::copy(trialF_, f.get().begin());
    } else {
      haveSimplified_ = false;
    }
  }
  checkPetsc(SNESLineSearchSetReason(lineSearch, SNES_LINESEARCH_SUCCEEDED));
  checkPetsc(SNESLineSearchSetLambda(lineSearch, lastDamping_));
  PetscReal norm = 0;
  checkPetsc(VecNorm(F, NORM_2, &norm));
  checkPetsc(SNESLineSearchSetNorms(lineSearch, 1, norm, report_->stepSize));
}

// Part of the step that stays short of all bounds, at most 1; `limit` is the unknown that meets it.
double NewtonIteration::roomInBounds(std::span<const double> x, std::span<const double> inverse,
                                     std::size_t& limit) const {
  double room = 1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double step = -inverse[i];
    const double space = step > 0 ? upper_[i] - x[i] : lower_[i] - x[i];
    if (std::abs(room * step) <= std::abs(space)) continue;
    room = space / step;
    limit = i;
  }
  // Not onto the bound itself, where the smallest next step outwards would have no room.
  return room < 1 ? 0.9 * room : 1;
}

// The damping for which the step before, and what its simplified step told about the curvature, would have been right
// (Deuflhard 2004, NLEQ-ERR, a-priori estimate). Old factors tell nothing of it.
double NewtonIteration::predictedDamping(std::span<const double> inverse, double size) const {
  if (!haveSimplified_ || !lastFresh_ || lastStep_ == 0) return 1;
  const double change = distance(simplified_, 1, inverse) * size;
  const double known = lastStep_ * sizeOf(simplified_).mean * lastDamping_;
  return known >= change ? 1 : std::max(known / change, options_.smallestDamping);
}

// Tries points x - damping * inverse. True: trial_, trialF_ and simplified_ hold one that is acceptable. False: stay at
// x, with new factors, or having failed, or having finished.
bool NewtonIteration::search(std::span<const double> x, std::span<const double> inverse, const Size& size) {
  const bool fresh = factorsAge_ == 0;
  std::size_t limit = 0;
  const double room = roomInBounds(x, inverse, limit);
  double damping = fresh && !converged_ ? std::min(room, predictedDamping(inverse, size.mean)) : room;

  // A step that is within the tolerance anyway may be cut to nothing.
  const double least = !converged_ && size.largest <= options_.stepTolerance ? 0 : options_.smallestDamping;
  constexpr double rounding = 1e-16;  // a smaller part is tried once
  while (damping >= least) {
    // Within bounds but for rounding.
    for (std::size_t i = 0; i < x.size(); ++i)
      trial_[i] = std::clamp(x[i] - damping * inverse[i], lower_[i], upper_[i]);
    system_.correct(x, trial_);
    const bool evaluated = tryEvaluate(trial_, trialF_);
    Size next;
    if (evaluated) {
      applyInverse(trialF_, simplified_);
      next = sizeOf(simplified_);
      const double enough = converged_ ? options_.polish : options_.stepTolerance;
      if (next.largest <= enough || next.mean <= (1 - damping / 4) * size.mean) {
        accept(size, next, damping);
        return true;
      }
    }
    if (!fresh || converged_ || damping < rounding) break;
    // A-posteriori estimate of the same algorithm, within [1/10, 1/2].
    double factor = 0.5;
    if (evaluated && std::isfinite(next.mean)) {
      const double defect = distance(simplified_, 1 - damping, inverse);
      factor = std::clamp(0.5 * size.mean * damping / defect, 0.1, 0.5);
    }
    damping *= factor;
  }

  if (converged_) {
    stopPolishing(fresh);
  } else if (!fresh) {
    renew_ = true;
  } else if (room < options_.smallestDamping) {
    fail(SNES_DIVERGED_LINE_SEARCH,
         fmt::format("{} = {:.6g} has reached its bound and cannot change further", system_.nameOf(limit), x[limit]));
    worst_ = limit;
  } else {
    fail(SNES_DIVERGED_LINE_SEARCH,
         fmt::format("no part of the Newton step larger than {:g} leads closer to a solution; it is largest in {}",
                     options_.smallestDamping, system_.nameOf(size.worst)));
  }
  return false;
}

void NewtonIteration::accept(const Size& size, const Size& next, double damping) {
  const bool fresh = factorsAge_ == 0;
  const double ratio = size.mean > 0 ? next.mean / size.mean : 0;
  ++steps_;
  ++factorsAge_;
  ++report_->steps;
  note(next);
  lastStep_ = size.mean;
  lastDamping_ = damping;
  lastFresh_ = fresh;
  haveSimplified_ = true;
  renew_ = damping < 1 || ratio > options_.fastEnough;
  if (next.largest <= options_.stepTolerance) converged_ = true;
  if (!converged_) return;
  if (options_.polish <= 0 || next.largest <= options_.polish) {
    finished_ = true;
  } else {
    renew_ = false;
    if (ratio > 0.5) stopPolishing(fresh);
  }
}

// Old factors may be the reason: new ones once.
void NewtonIteration::stopPolishing(bool fresh) {
  if (fresh || polishRenewals_ > 0) {
    finished_ = true;
  } else {
    ++polishRenewals_;
    renew_ = true;
  }
}

}  // namespace lampblack::numerics
