// The Newton matrix of a flame: the rows of a point, what is held, and the rows of the globals.
#include "flow/flame/flame_jacobian.hpp"

namespace lampblack::flow {
using namespace flamejacobian;

FlameEquations::Data::JacobianWork::JacobianWork(const Data& data) {
  const std::size_t n = data.species(), S = data.scalars();
  for (auto* v : {&rates, &rateTemperature, &concentrations, &sumByConcentration, &difference}) v->resize(n);
  rateJacobian.resize(n * n);
  densities.resize(S);
  timeWeights.resize(data.width());
  gain.resize(data.width());
  if (data.carried != nullptr) {
    const std::size_t rows = S + data.carried->exchanged().size();
    carried.resize(rows * (rows + 1));
  }
}

void FlameEquations::Data::fillRow(std::size_t i, double inverseTimeStep, JacobianWork& work) {
  const std::size_t n = species(), S = scalars(), w = width(), lastPoint = points() - 1, first = layout.firstScalar();
  work.D = matrix->diagonal(i);
  work.L = i > 0 ? std::optional(matrix->lower(i)) : std::nullopt;
  work.U = i < lastPoint ? std::optional(matrix->upper(i)) : std::nullopt;
  work.B = matrix->borderColumns(i);
  double* D = work.D;
  const double dv = volume[i], rho = gas.nodes.density[i], W = gas.nodes.weight[i], gained = gas.nodes.exchanged[i];
  const double spread = profile.at(i, V), temperature = profile.temperature(i);
  const double mLeft = leftFlux(i), mRight = profile.at(i, M);
  const auto fractions = profile.massFractions(i);

  // Continuity.
  D[M * w + M] += 1;
  if (i > 0)
    *(work.L->isDense() ? work.L->entries() + M * w + M : work.L->diagonal() + M) -= 1;
  else
    work.B[leftMassFlux * w + M] -= 1;
  D[V * w + M] += 2 * dv * rho;
  D[T * w + M] -= 2 * dv * spread * rho / temperature;
  for (std::size_t j = 0; j < n; ++j) D[(Y + j) * w + M] -= 2 * dv * spread * rho * W / gas.weights[j];

  // Spreading.
  if (spreadIsGiven(i)) {
    D[V * w + V] += 1;
    work.B[load * w + V] -= spreadGivenPerLoad(i);
  } else {
    D[V * w + V] += 2 * dv * rho * spread;
    D[T * w + V] -= dv * spread * spread * rho / temperature;
    for (std::size_t j = 0; j < n; ++j) D[(Y + j) * w + V] -= dv * spread * spread * rho * W / gas.weights[j];
    work.B[pressureGradient * w + V] += dv;
  }

  // Temperature.
  if (temperatureIsGiven(i)) D[T * w + T] += 1;

  // Y times the net flux and gain.
  const double net = mRight - mLeft - dv * gained;
  for (std::size_t k = 0; k < n; ++k) D[(Y + k) * w + Y + k] -= net;
  for (std::size_t s = 0; s < S; ++s) D[(first + s) * w + first + s] -= net;

  // Fluxes; the derivatives of the face on the left are those of the right face of the point before.
  if (i > 0) {
    if (work.beforeIsThere)
      std::swap(work.before, work.after);
    else
      work.before.compute(*this, i - 1);
    addFace(*this, i, false, work.before, work);
  } else {
    for (std::size_t k = 0; k < n; ++k) work.B[leftMassFlux * w + Y + k] += fractions[k] - problem.left.Y[k];
    for (std::size_t s = 0; s < S; ++s) {
      const double v = endDrift(s, false);
      D[(first + s) * w + first + s] -= v;
      work.B[leftMassFlux * w + first + s] += v < 0 ? 0 : profile.scalars(i)[s];
    }
  }
  if (i < lastPoint) {
    work.after.compute(*this, i);
    addFace(*this, i, true, work.after, work);
    work.beforeIsThere = true;
  } else {
    const bool stream = rightEnd == FlameEnd::Stream;
    for (std::size_t k = 0; k < n; ++k) {
      if (stream)
        D[M * w + Y + k] += problem.right->Y[k] - fractions[k];
      else
        D[(Y + k) * w + Y + k] += mRight;
    }
    for (std::size_t s = 0; s < S; ++s) {
      const double v = endDrift(s, true);
      D[(first + s) * w + first + s] += v;
      if (v == 0) D[M * w + first + s] -= profile.scalars(i)[s];
    }
  }

  addReactions(*this, i, work);
  if (carried != nullptr) addCarried(*this, i, work);
  if (!temperatureIsGiven(i)) D[T * w + T] += dv * gas.lossSlope(profile, i);

  if (inverseTimeStep > 0) {
    pointTimeWeights(i, work.timeWeights.data());
    for (std::size_t c = 0; c < w; ++c) D[c * w + c] += work.timeWeights[c] * inverseTimeStep;
    if (unsteady) {
      // d(rho)/dt in continuity, by the rates of change of temperature and composition.
      D[T * w + M] -= dv * rho / temperature * inverseTimeStep;
      for (std::size_t j = 0; j < n; ++j) D[(Y + j) * w + M] -= dv * rho * W / gas.weights[j] * inverseTimeStep;
    }
  }
  if (holds) holdRow(work);
}

void FlameEquations::Data::holdRow(JacobianWork& work) {
  const std::size_t w = width();
  for (std::size_t row = 0; row < w; ++row) {
    if (!isHeld(row)) continue;
    for (std::size_t c = 0; c < w; ++c) work.D[c * w + row] = 0;
    for (const auto& block : {work.L, work.U})
      if (block) block->clearRow(row);
    for (std::size_t g = 0; g < numFlameGlobals; ++g) work.B[g * w + row] = 0;
    work.D[row * w + row] = 1;
  }
}

void FlameEquations::Data::fillGlobals() {
  const std::size_t w = width(), lastPoint = points() - 1;
  double* corner = matrix->corner();
  const auto cornerAt = [&](std::size_t row, std::size_t column) -> double& {
    return corner[column * numFlameGlobals + row];
  };
  // Entries of the border rows below the blocks of a point, where this rank holds them.
  const auto below = [&](std::size_t row, std::size_t point, std::size_t component, double value) {
    if (point >= matrix->ownedBegin() && point < matrix->ownedEnd())
      matrix->borderRows(point)[component * numFlameGlobals + row] += value;
  };
  const bool potential = spreading && problem.nozzles == FlameNozzles::Potential;
  if (isHeld(w + leftMassFlux)) {
    cornerAt(leftMassFlux, leftMassFlux) = 1;
  } else if (problem.type == FlameType::Free) {
    below(leftMassFlux, anchor, T, 1);
  } else if (potential && rightEnd == FlameEnd::Wall) {
    below(leftMassFlux, lastPoint, M, 1);
  } else if (potential) {
    const Plane plane = stagnationPlane();
    below(leftMassFlux, plane.face, M, 1 - plane.share);
    below(leftMassFlux, plane.face + 1, M, plane.share);
  } else {
    cornerAt(leftMassFlux, leftMassFlux) = 1;
    cornerAt(leftMassFlux, load) = -problem.left.massFlux;
  }
  if (isHeld(w + pressureGradient) || !spreading) {
    cornerAt(pressureGradient, pressureGradient) = 1;
  } else if (!potential) {
    below(pressureGradient, lastPoint, M, 1);
    if (rightEnd == FlameEnd::Stream) cornerAt(pressureGradient, load) = problem.right->massFlux;
  } else {
    cornerAt(pressureGradient, pressureGradient) = 1;
    cornerAt(pressureGradient, load) =
        2 * rightDensity * problem.strainRate * problem.strainRate * profile.global(load);
  }
  if (isHeld(w + load) || !constraint) {
    cornerAt(load, load) = 1;
  } else {
    for (std::size_t i = matrix->ownedBegin(); i < matrix->ownedEnd(); ++i)
      for (std::size_t c = 0; c < w; ++c) below(load, i, c, constraint->coefficients[i * w + c]);
    for (std::size_t g = 0; g < numFlameGlobals; ++g) cornerAt(load, g) = constraint->coefficients[points() * w + g];
  }
}

}  // namespace lampblack::flow
