// The blocks of one point's row of the Newton matrix.
#include "flow/flame/flame_jacobian.hpp"

#include "chemistry/numerics/dot.hpp"
#include "core/constants.hpp"

namespace lampblack {
namespace {

constexpr std::size_t M = FlameLayout::massFlux, V = FlameLayout::spread, T = FlameLayout::temperature,
                      Y = FlameLayout::firstSpecies;

}  // namespace

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

// d(convection, diffusion, conduction) through one side of the control volume; `sign` +1 for the right side.
static void addFace(const FlameEquations::Data& data, std::size_t i, bool isRight, const FaceDerivatives& face,
                    FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), S = data.scalars(), w = data.width(), first = data.layout.firstScalar();
  const std::size_t f = isRight ? i : i - 1;
  const double sign = isRight ? 1 : -1;
  double* other = isRight ? work.U : work.L;   // the block of the neighbour
  double* mBlock = isRight ? work.D : work.L;  // the mass flux of the face is an unknown of point f
  const std::vector<double>& own = isRight ? face.left : face.right;
  const std::vector<double>& far = isRight ? face.right : face.left;
  const std::vector<double>& ownT = isRight ? face.leftTemperature : face.rightTemperature;
  const std::vector<double>& farT = isRight ? face.rightTemperature : face.leftTemperature;
  const FlameFaces& faces = data.gas.faces;
  const double h = data.profile.z[f + 1] - data.profile.z[f];
  const double Tl = data.profile.temperature(f), Tr = data.profile.temperature(f + 1), Tm = 0.5 * (Tl + Tr);
  const double m = data.profile.at(f, M);
  const double lean = m > 0 ? 0.5 * faces.upwind[f] : -0.5 * faces.upwind[f];
  const double ownShare = isRight ? 0.5 + lean : 0.5 - lean;

  for (std::size_t j = 0; j < n; ++j) {
    double* d = work.D + (Y + j) * w + Y;
    double* o = other + (Y + j) * w + Y;
    for (std::size_t k = 0; k < n; ++k) {
      d[k] += sign * own[j * n + k];
      o[k] += sign * far[j * n + k];
    }
  }
  const auto fractions = data.profile.massFractions(i);
  for (std::size_t k = 0; k < n; ++k) {
    work.D[T * w + Y + k] += sign * ownT[k];
    other[T * w + Y + k] += sign * farT[k];
    mBlock[M * w + Y + k] += sign * (face.massFlux[k] - fractions[k]);
  }

  if (!data.temperatureIsGiven(i)) {
    double* dh = work.difference.data();
    double ownSlope = 0, farSlope = 0, byMassFlux = 0;
    for (std::size_t k = 0; k < n; ++k) {
      dh[k] = faces.enthalpy[f * n + k] - data.gas.nodes.enthalpy[i * n + k];
      const double flux = faces.flux[f * n + k];
      ownSlope += flux * (ownShare * faces.heat[f * n + k] - data.gas.nodes.heat[i * n + k]) + dh[k] * ownT[k];
      farSlope += flux * (1 - ownShare) * faces.heat[f * n + k] + dh[k] * farT[k];
      byMassFlux += dh[k] * face.massFlux[k];
    }
    const double conductance = faces.conductivity[f] / h;
    const double growth = -0.5 * conductanceExponent * conductance * (Tr - Tl) / Tm;
    ownSlope += (isRight ? conductance : -conductance) + growth;
    farSlope += (isRight ? -conductance : conductance) + growth;
    work.D[T * w + T] += sign * ownSlope;
    other[T * w + T] += sign * farSlope;
    mBlock[M * w + T] += sign * byMassFlux;
    for (std::size_t j = 0; j < n; ++j) {
      work.D[(Y + j) * w + T] += sign * dot(dh, &own[j * n], n);
      other[(Y + j) * w + T] += sign * dot(dh, &far[j * n], n);
    }
  }

  if (!data.spreadIsGiven(i)) {
    const double a = data.profile.at(f, V), b = data.profile.at(f + 1, V);
    const double conductance = faces.viscosity[f] / h;
    work.D[V * w + V] += sign * (-0.5 * m + (isRight ? conductance : -conductance));
    other[V * w + V] += sign * (0.5 * m + (isRight ? -conductance : conductance));
    mBlock[M * w + V] += sign * (0.5 * (a + b) - data.profile.at(i, V));
    const double growth = -0.5 * conductanceExponent * conductance * (b - a) / Tm;
    work.D[T * w + V] += sign * growth;
    other[T * w + V] += sign * growth;
  }

  const double driftSlope = faces.viscosity[f] / (h * Tm), bend = 0.5 * (Tr - Tl) / Tm;
  for (std::size_t s = 0; s < S; ++s) {
    const double c = data.gas.scalarThermophoresis[s], v = m + c * faces.drift[f];
    const auto [left, right] = data.scalarSlopes(f, s);
    const double upstream = (1 + faces.scalarLift[f * S + s]) * data.profile.scalars(v > 0 ? f : f + 1)[s];
    const std::size_t row = first + s;
    work.D[row * w + row] += sign * (isRight ? left : right);
    other[row * w + row] += sign * (isRight ? right : left);
    mBlock[M * w + row] += sign * (upstream - data.profile.scalars(i)[s]);
    const double byRight = -c * driftSlope * (1 - bend) * upstream, byLeft = c * driftSlope * (1 + bend) * upstream;
    work.D[T * w + row] += sign * (isRight ? byLeft : byRight);
    other[T * w + row] += sign * (isRight ? byRight : byLeft);
  }
}

// Reactions of the gas: -volume * d(source).
static void addReactions(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), w = data.width();
  const double dv = data.volume[i], rho = data.gas.nodes.density[i], W = data.gas.nodes.weight[i];
  const double temperature = data.profile.temperature(i);
  const auto fractions = data.profile.massFractions(i);
  const auto& weights = data.gas.weights;
  for (std::size_t k = 0; k < n; ++k) work.concentrations[k] = rho * fractions[k] / weights[k];
  data.kinetics.netProductionRatesAndJacobian(temperature, work.concentrations, work.rates, work.rateJacobian,
                                              work.rateTemperature);
  std::fill(work.sumByConcentration.begin(), work.sumByConcentration.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double c = work.concentrations[j];
    const double* column = &work.rateJacobian[j * n];
    for (std::size_t k = 0; k < n; ++k) work.sumByConcentration[k] += column[k] * c;
  }
  const bool energy = !data.temperatureIsGiven(i);
  const double* h = &data.gas.nodes.enthalpy[i * n];
  // c_j = rho Y_j / W_j, with rho proportional to W / T.
  for (std::size_t j = 0; j < n; ++j) {
    const double own = rho / weights[j], common = W / weights[j];
    const double* column = &work.rateJacobian[j * n];
    double* d = work.D + (Y + j) * w;
    double* slope = work.difference.data();
    for (std::size_t k = 0; k < n; ++k) {
      slope[k] = dv * weights[k] * (column[k] * own - work.sumByConcentration[k] * common);
      d[Y + k] -= slope[k];
    }
    if (energy) d[T] += dot(h, slope, n);
  }
  double heat = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double slope = dv * weights[k] * (work.rateTemperature[k] - work.sumByConcentration[k] / temperature);
    work.D[T * w + Y + k] -= slope;
    heat += h[k] * slope + data.gas.nodes.heat[i * n + k] * dv * weights[k] * work.rates[k];
  }
  if (energy) work.D[T * w + T] += heat;
}

// What scalars and gas exchange: sources of both.
static void addCarried(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), S = data.scalars(), w = data.width(), first = data.layout.firstScalar();
  const auto& exchanged = data.carried->exchanged();
  const std::size_t E = exchanged.size(), rows = S + E, columns = rows + 1;
  const double dv = data.volume[i], rho = data.gas.nodes.density[i], W = data.gas.nodes.weight[i];
  const double temperature = data.profile.temperature(i);
  const CarriedGas gas = data.gas.carriedGas(data.profile, i, work.carriedConcentrations);
  data.gas.densities(data.profile, i, work.densities);
  data.carried->jacobian(gas, work.densities, {work.carried, columns});
  const auto fractions = data.profile.massFractions(i);
  const auto scalars = data.profile.scalars(i);
  const double* h = &data.gas.nodes.enthalpy[i * n];
  const double* hs = &data.gas.nodes.scalarEnthalpy[i * S];
  const bool energy = !data.temperatureIsGiven(i);
  const auto& scale = data.gas.scalarScale;
  const auto& weights = data.gas.weights;
  // Rows of the matrix that a row of the model enters: its own, the energy equation, and for species the gain of the
  // whole gas (continuity, and Y times the gain everywhere).
  const auto add = [&](std::size_t row, std::size_t column, double slope) {
    double* d = work.D + column * w;
    slope *= dv;
    if (row < S) {
      d[first + row] -= slope / scale[row];
      if (energy) d[T] += hs[row] * slope;
      return;
    }
    const std::size_t k = exchanged[row - S];
    const double mass = slope * weights[k];
    d[Y + k] -= mass;
    if (energy) d[T] += h[k] * mass;
    work.gain[column] += mass;
  };
  std::fill(work.gain.begin(), work.gain.end(), 0.0);
  for (std::size_t row = 0; row < rows; ++row) {
    const double* J = &work.carried[row * columns];
    double common = 0;  // what a change of the density of everything does
    for (std::size_t s = 0; s < S; ++s) common += J[s] * work.densities[s];
    for (std::size_t e = 0; e < E; ++e) common += J[S + e] * gas.concentrations[e];
    for (std::size_t s = 0; s < S; ++s)
      if (J[s] != 0) add(row, first + s, J[s] * scale[s] * rho);
    for (std::size_t e = 0; e < E; ++e)
      if (J[S + e] != 0) add(row, Y + exchanged[e], J[S + e] * rho / weights[exchanged[e]]);
    if (common != 0)
      for (std::size_t j = 0; j < n; ++j) add(row, Y + j, -common * W / weights[j]);
    add(row, T, J[rows] - common / temperature);
  }
  for (std::size_t column = 0; column < w; ++column) {
    const double mass = work.gain[column];
    if (mass == 0) continue;
    double* d = work.D + column * w;
    d[M] -= mass;
    for (std::size_t l = 0; l < n; ++l) d[Y + l] += fractions[l] * mass;
    for (std::size_t s = 0; s < S; ++s) d[first + s] += scalars[s] * mass;
  }
}

void FlameEquations::Data::fillRow(std::size_t i, double inverseTimeStep, JacobianWork& work) {
  const std::size_t n = species(), S = scalars(), w = width(), lastPoint = points() - 1, first = layout.firstScalar();
  work.D = matrix->diagonal(i);
  work.L = i > 0 ? matrix->lower(i) : nullptr;
  work.U = i < lastPoint ? matrix->upper(i) : nullptr;
  work.B = matrix->borderColumns(i);
  double* D = work.D;
  const double dv = volume[i], rho = gas.nodes.density[i], W = gas.nodes.weight[i], gained = gas.nodes.exchanged[i];
  const double spread = profile.at(i, V), temperature = profile.temperature(i);
  const double mLeft = leftFlux(i), mRight = profile.at(i, M);
  const auto fractions = profile.massFractions(i);

  // Continuity.
  D[M * w + M] += 1;
  if (i > 0)
    work.L[M * w + M] -= 1;
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
    for (double* block : {work.D, work.L, work.U})
      if (block != nullptr)
        for (std::size_t c = 0; c < w; ++c) block[c * w + row] = 0;
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

}  // namespace lampblack
