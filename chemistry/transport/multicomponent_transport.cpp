#include "chemistry/transport/multicomponent_transport.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/dot.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::chemistry {

namespace {

using constants::gasConstant;
using constants::pi;

constexpr double kLeastInternal = 1e-3;  // internal heat capacity over R below which a species counts as without
constexpr double kReduction = 1e-8;      // of the residuals of the systems
constexpr int kMostIterations = 500;

std::vector<double> padded(std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  result.resize(paddedToLanes(result.size()), 0.0);
  return result;
}

}  // namespace

MulticomponentTransport::MulticomponentTransport(const Mechanism& mechanism, CollisionIntegrals integrals)
    : n_(mechanism.numSpecies()),
      ld_(paddedToLanes(n_)),
      gas_(mechanism, integrals),
      averaged_(mechanism, {integrals, DiffusionModel::MixtureAveraged, {}}),
      thermo_(mechanism.allSpecies()),
      weights_(padded(mechanism.molecularWeights())),
      pairTable_(gas_, mechanism.molecularWeights()),
      inverseMass_(ld_ * ld_, 0.0),
      ofFluxes_(ld_),
      ofHeat_(3 * ld_),
      pivots_(n_) {
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) inverseMass_[j * ld_ + i] = 1.0 / (weights_[i] + weights_[j]);
  for (auto* work : {&viscosity_, &cp_, &internal_, &rotation_, &x_, &drag_, &thermalDrag_, &collisions_, &exchange_,
                     &exchanges_, &internalDiagonal_, &y0_, &y1_, &y2_, &momentum_, &heated_})
    work->assign(ld_, 0.0);
  for (auto* work : {&weight_, &inverseDiagonal_, &residual_, &solution_}) work->assign(3 * ld_, 0.0);
  averagedDiffusion_.assign(n_, 0.0);
  energy_.assign(ld_ * ld_, 0.0);
  for (auto* pairs : {&ordinary_, &inverse_}) pairs->assign(n_ * n_, 0.0);
}

void MulticomponentTransport::setMixture(double T, std::span<const double> X) {
  Transport::requireInRange(T);
  double total = 0;
  for (std::size_t i = 0; i < n_; ++i) total += x_[i] = std::max(X[i], 0.0);
  for (std::size_t i = 0; i < n_; ++i) x_[i] /= total;
  setTemperature(T);
  std::fill(drag_.begin(), drag_.end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    const double* c = &pairs_.conductance[j * ld_];
    for (std::size_t i = 0; i < ld_; ++i) drag_[i] += x_[j] * c[i];
  }
  // The Stefan-Maxwell equations sum_j x_i c_ij v_j - drag_i v_i = grad x_i are dependent: their sum is zero. As the
  // solution has sum_j W_j v_j = 0, x_i W_i times that with any factor makes them regular, and keeps them symmetric.
  const double momentum = dot(x_.data(), weights_.data(), n_), drag = dot(x_.data(), drag_.data(), n_);
  // A gas of one species: nothing diffuses.
  frame_ = (drag > 0 ? drag : 1.0) / (momentum * momentum);
}

// L00,00 (Kee et al. eq. 12.117) over 16 T/25, with what multiplies x_j a_j, not a_j, in column j: so absent species
// leave the matrix regular. The diagonal is zero.
double MulticomponentTransport::ordinary(std::size_t i, std::size_t j) const {
  if (n_ == 1) return 1.0;  // nothing diffuses
  return i == j ? 0.0 : weights_[j] / weights_[i] * drag_[i] + x_[i] * conductance(i, j);
}

void MulticomponentTransport::setTemperature(double T) {
  if (T == temperature_) return;
  temperature_ = T;
  pairTable_.fill(T, pairs_);
  thermo_.cpOverR(T, cp_.data());
  for (std::size_t i = 0; i < n_; ++i) {
    viscosity_[i] = gas_.viscosity(i, T);
    // Atoms have none: what excites their electrons is not exchanged in collisions of kinetic theory.
    internal_[i] = gas_.rotationalHeatCapacity(i) > 0 ? cp_[i] - 2.5 : 0.0;
    // Rotational heat capacity over the collision number; one of less than a collision at 298 K has no meaning here.
    rotation_[i] = gas_.rotationalHeatCapacity(i) / gas_.rotationalRelaxation(i, T, 1.0);
  }
}

// The blocks of Kee et al. eqs 12.118 to 12.127 in the form of WeightedConjugateGradients: row and column i over x_i,
// all signs turned. L00,00 is in the frame of setMixture().
void MulticomponentTransport::prepareThermal(double T) {
  const double ordinary = 16.0 * T / 25.0;
  constexpr double inelastic = 5.0 / (3.0 * pi);
  for (auto* sums : {&thermalDrag_, &collisions_, &exchanges_, &heated_}) std::fill(sums->begin(), sums->end(), 0.0);
  for (std::size_t j = 0; j < n_; ++j) {
    const double x = x_[j], W = weights_[j], byWeight = x / W, carried = 1.6 * T * x * W, rotation = rotation_[j];
    const double* c = &pairs_.conductance[j * ld_];
    const double* f = &pairs_.thermal[j * ld_];
    const double* h = &pairs_.exchange[j * ld_];
    const double* b = &pairs_.energy[j * ld_];
    const double* inverseMass = &inverseMass_[j * ld_];
    double* energy = &energy_[j * ld_];
    for (std::size_t i = 0; i < ld_; ++i) {
      const double Wi = weights_[i],
                   exchanged = 4.0 * h[i] * inverseMass[i] * (1.0 + inelastic * (rotation_[i] + rotation));
      energy[i] = ordinary * Wi * W * (b[i] - exchanged);
      collisions_[i] += ordinary * x * (7.5 * c[i] * inverseMass[i] * (Wi - W) + W * W * b[i] + Wi * W * exchanged);
      thermalDrag_[i] += carried * f[i];
      exchanges_[i] += x * h[i];
      heated_[i] += (x + byWeight * Wi) * h[i];  // x_j/W_j A*_ij c_ij
    }
  }
  for (std::size_t i = 0; i < n_; ++i) {
    const double W = weights_[i], x = x_[i], own = pairs_.exchange[i * ld_ + i];
    const double internal = internal_[i];
    weight_[i] = weight_[ld_ + i] = weight_[2 * ld_ + i] = x;
    inverseDiagonal_[i] = 1.0 / (ordinary * (drag_[i] + frame_ * x * W * W));
    inverseDiagonal_[ld_ + i] = 1.0 / (collisions_[i] - x * energy_[i * ld_ + i]);
    exchange_[i] = 0.0;
    internalDiagonal_[i] = 1.0;
    const bool hasInternal = internal > kLeastInternal;
    if (hasInternal) {
      exchange_[i] = 32.0 * T / (5.0 * pi) * W * rotation_[i] / internal;
      const double drag = drag_[i] + x * pairs_.own[i];
      const double internalDrag = 2.4 * W * rotation_[i] / pi * (heated_[i] - 2.0 * x * own);
      internalDiagonal_[i] = 8.0 / pi * W * x * rotation_[i] / (internal * internal * gasConstant * viscosity_[i]) +
                             4.0 * T / internal * (drag + internalDrag / internal);
    }
    exchanges_[i] *= exchange_[i];
    inverseDiagonal_[2 * ld_ + i] = 1.0 / internalDiagonal_[i];
    residual_[i] = 0.0;
    residual_[ld_ + i] = -1.0;
    residual_[2 * ld_ + i] = hasInternal ? -1.0 : 0.0;
  }
}

void MulticomponentTransport::thermalProduct(double T, const double* p, double* q) {
  const double *p0 = p, *p1 = p + ld_, *p2 = p + 2 * ld_;
  double *q0 = q, *q1 = q + ld_, *q2 = q + 2 * ld_;
  double moving = 0;
  for (std::size_t i = 0; i < ld_; ++i) {
    y0_[i] = x_[i] * p0[i];
    y1_[i] = x_[i] * p1[i];
    y2_[i] = x_[i] * exchange_[i] * p2[i];
    momentum_[i] = weights_[i] * y0_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) moving += momentum_[i];
  for (std::size_t row = 0; row < ld_; row += laneCount) {
    Lanes conducted{}, thermal{}, thermalMomentum{}, energy{}, exchanged{}, given{};
    for (std::size_t j = 0; j < n_; ++j) {
      const std::size_t at = j * ld_ + row;
      const Lanes f = loadLanes(&pairs_.thermal[at]), h = loadLanes(&pairs_.exchange[at]);
      conducted += loadLanes(&pairs_.conductance[at]) * y0_[j];
      thermal += f * y1_[j];
      thermalMomentum += f * momentum_[j];
      energy += loadLanes(&energy_[at]) * y1_[j];
      exchanged += h * y2_[j];
      given += h * y1_[j];
    }
    const Lanes W = loadLanes(&weights_[row]), drag = loadLanes(&thermalDrag_[row]);
    const Lanes exchanges = loadLanes(&exchanges_[row]);
    const Lanes l0 = loadLanes(p0 + row), l1 = loadLanes(p1 + row), l2 = loadLanes(p2 + row);
    const double ordinary = 16.0 * T / 25.0, soret = 1.6 * T;
    storeLanes(q0 + row, ordinary * (loadLanes(&drag_[row]) * l0 - conducted + (frame_ * moving) * W) +
                             soret * W * thermal - drag * l1);
    storeLanes(q1 + row, soret * thermalMomentum - drag * l0 + loadLanes(&collisions_[row]) * l1 - energy - exchanged -
                             exchanges * l2);
    storeLanes(q2 + row, loadLanes(&internalDiagonal_[row]) * l2 - loadLanes(&exchange_[row]) * given - exchanges * l1);
  }
}

void MulticomponentTransport::singular(double T, double p) {
  throw NumericsError(
      fmt::format("the multicomponent transport equations at {:.6g} K and {:.6g} Pa are singular", T, p));
}

MulticomponentTransport::Mixture MulticomponentTransport::mixture(double T, double p, std::span<const double> X,
                                                                  std::span<double> DT) {
  const auto averaged = averaged_.mixture(T, p, X, averagedDiffusion_);
  setMixture(T, X);
  prepareThermal(T);
  std::fill(solution_.begin(), solution_.end(), 0.0);
  const auto product = [&](const double* from, double* to) { thermalProduct(T, from, to); };
  if (!ofHeat_.solve(weight_, inverseDiagonal_, product, residual_, solution_, kReduction, kMostIterations))
    singular(T, p);
  double sum = 0, net = 0;
  const double mass = dot(x_.data(), weights_.data(), n_);
  for (std::size_t i = 0; i < n_; ++i) {
    sum += x_[i] * (solution_[ld_ + i] + solution_[2 * ld_ + i]);
    net += DT[i] = 1.6 / gasConstant * weights_[i] * x_[i] * solution_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) DT[i] -= x_[i] * weights_[i] / mass * net;
  return {averaged.viscosity, -4.0 * sum};
}

// With v_i = -grad x_i/(drag_i + frame x_i W_i^2) + x_i y_i the first part takes up what does not go with x_i, and y is
// found by WeightedConjugateGradients.
void MulticomponentTransport::diffusionFluxes(double T, double p, std::span<const double> X,
                                              std::span<const double> gradX, std::span<double> j) {
  setMixture(T, X);
  double moving = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    inverseDiagonal_[i] = 1.0 / (drag_[i] + frame_ * x_[i] * weights_[i] * weights_[i]);
    y0_[i] = -gradX[i] * inverseDiagonal_[i];
    moving += weights_[i] * y0_[i];
  }
  // sum_j c_ij from_j
  const auto conduct = [&](const std::vector<double>& from, std::size_t row) {
    Lanes sum{};
    for (std::size_t k = 0; k < n_; ++k) sum += loadLanes(&pairs_.conductance[k * ld_ + row]) * from[k];
    return sum;
  };
  for (std::size_t row = 0; row < ld_; row += laneCount) {
    const Lanes W = loadLanes(&weights_[row]);
    storeLanes(&residual_[row], conduct(y0_, row) - frame_ * W * (moving - W * loadLanes(&y0_[row])));
  }
  const auto product = [&](const double* y, double* out) {
    double momentum = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      y1_[i] = x_[i] * y[i];
      momentum += weights_[i] * y1_[i];
    }
    for (std::size_t row = 0; row < ld_; row += laneCount)
      storeLanes(out + row, loadLanes(&drag_[row]) * loadLanes(y + row) - conduct(y1_, row) +
                                (frame_ * momentum) * loadLanes(&weights_[row]));
  };
  const std::span residual(residual_.data(), ld_), y(solution_.data(), ld_);
  std::fill(y.begin(), y.end(), 0.0);
  if (!ofFluxes_.solve(x_, {inverseDiagonal_.data(), ld_}, product, residual, y, kReduction, kMostIterations))
    singular(T, p);
  double net = 0, mass = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    net += j[i] = weights_[i] / (gasConstant * T) * (y0_[i] + x_[i] * y[i]);
    mass += x_[i] * weights_[i];
  }
  for (std::size_t i = 0; i < n_; ++i) j[i] -= x_[i] * weights_[i] / mass * net;
}

// inverse_: of ordinary_, column after column.
void MulticomponentTransport::invert(double T, double p) {
  if (!dense_.factorise(n_, ordinary_.data(), pivots_.data())) singular(T, p);
  std::fill(inverse_.begin(), inverse_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) inverse_[i * n_ + i] = 1.0;
  dense_.solve(n_, ordinary_.data(), pivots_.data(), n_, inverse_.data());
}

// D_ij = x_i 16 T W/(25 p W_j) (P_ij - P_ii) with P the inverse of L00,00 (Kee et al. eq. 12.116).
void MulticomponentTransport::diffusion(double T, double p, std::span<const double> X, std::span<double> D) {
  setMixture(T, X);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) ordinary_[j * n_ + i] = ordinary(i, j);
  invert(T, p);
  const double meanWeight = dot(x_.data(), weights_.data(), n_);
  for (std::size_t i = 0; i < n_; ++i) {
    const double own = inverse_[i * n_ + i];
    for (std::size_t j = 0; j < n_; ++j) D[i * n_ + j] = meanWeight / (p * weights_[j]) * (inverse_[j * n_ + i] - own);
  }
}

// The column that makes the equations regular is -x_i times a row of weights here, which keeps every row i but for its
// diagonal in proportion to x_i.
void MulticomponentTransport::fluxMatrix(double T, double p, std::span<const double> X, std::span<double> M) {
  setMixture(T, X);
  const double drag = dot(x_.data(), drag_.data(), n_), weight = dot(x_.data(), weights_.data(), n_);
  // A gas of one species: nothing diffuses.
  const double frame = (n_ > 1 && drag > 0 ? drag : 1.0) / weight;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i)
      ordinary_[j * n_ + i] =
          i == j ? -drag_[i] - frame * x_[i] * weights_[i] : x_[i] * (conductance(i, j) - frame * weights_[j]);
  invert(T, p);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) M[i * n_ + j] = inverse_[j * n_ + i];
}

}  // namespace lampblack::chemistry
