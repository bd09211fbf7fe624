// What reactions, and exchange with what is carried, put into the rows of a point.
#include <algorithm>

#include "flow/flame/flame_jacobian.hpp"
#include "numerics/dot.hpp"

namespace lampblack::flow::flamejacobian {

void addReactions(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work) {
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

void addCarried(FlameEquations::Data& data, std::size_t i, FlameEquations::Data::JacobianWork& work) {
  const std::size_t n = data.species(), S = data.scalars(), w = data.width(), first = data.layout.firstScalar();
  const auto& exchanged = data.carried->exchanged();
  const std::size_t E = exchanged.size(), rows = S + E, columns = rows + 1;
  const double dv = data.volume[i], rho = data.gas.nodes.density[i], W = data.gas.nodes.weight[i];
  const double temperature = data.profile.temperature(i);
  const ParticleGas gas = data.gas.carriedGas(data.profile, i, work.carriedConcentrations);
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

}  // namespace lampblack::flow::flamejacobian
