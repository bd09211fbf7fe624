#include "coupling/engine_soot.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

constexpr std::size_t headValues = 4;  // of a row: whether it changes, factor of the mass, temperature, enthalpy given

}  // namespace

EngineSoot::EngineSoot(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, CarriedParticles& particles)
    : comm_(comm),
      thermo_(thermo),
      particles_(particles),
      seen_(mechanism, particles.exchanged()),
      scalars_(particles.scalars().size()),
      enthalpy_(scalars_),
      slope_(scalars_) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  for (const std::size_t k : particles.exchanged()) weights_.push_back(mechanism.species(k).molecularWeight);
  for (const CarriedModel::Scalar& scalar : particles.scalars()) elements_.push_back(scalar.elements);
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    atomicWeights_.push_back(mechanism.atomicWeight(e));
    atoms_.emplace_back();
    for (const std::size_t k : particles.exchanged()) atoms_.back().push_back(mechanism.atoms(k, e));
  }
}

void EngineSoot::keepElements(std::span<const double> before) {
  const std::size_t n = atoms_.size(), species = concentrations_.size();
  std::vector<double>&matrix = matrix_, &weight = weight_;
  matrix.assign(n * n, 0);
  weight.assign(n, 0);  // first what there is too much of
  for (std::size_t e = 0; e < n; ++e) {
    for (std::size_t s = 0; s < scalars_; ++s)
      weight[e] += (densities_[s] - before[s]) * elements_[s][e] / atomicWeights_[e];
    for (std::size_t k = 0; k < species; ++k) weight[e] += (concentrations_[k] - before[scalars_ + k]) * atoms_[e][k];
    for (std::size_t other = 0; other < n; ++other)
      for (std::size_t k = 0; k < species; ++k)
        matrix[e * n + other] += atoms_[e][k] * atoms_[other][k] * concentrations_[k] * concentrations_[k];
  }
  // Symmetric and not negative: elimination without exchange of rows, past elements that are in none of the species or
  // not by themselves.
  for (std::size_t e = 0; e < n; ++e) {
    double diagonal = 0;
    for (std::size_t k = 0; k < species; ++k) diagonal += std::pow(atoms_[e][k] * concentrations_[k], 2);
    if (!(matrix[e * n + e] > 1e-10 * diagonal)) {
      for (std::size_t other = 0; other < n; ++other) matrix[e * n + other] = other == e ? 1 : 0;
      weight[e] = 0;
      continue;
    }
    for (std::size_t row = e + 1; row < n; ++row) {
      const double factor = matrix[row * n + e] / matrix[e * n + e];
      for (std::size_t column = e; column < n; ++column) matrix[row * n + column] -= factor * matrix[e * n + column];
      weight[row] -= factor * weight[e];
    }
  }
  for (std::size_t e = n; e-- > 0;) {
    for (std::size_t column = e + 1; column < n; ++column) weight[e] -= matrix[e * n + column] * weight[column];
    weight[e] /= matrix[e * n + e];
  }
  for (std::size_t k = 0; k < species; ++k) {
    double change = 0;
    for (std::size_t e = 0; e < n; ++e) change += atoms_[e][k] * weight[e];
    concentrations_[k] -= change * concentrations_[k] * concentrations_[k];
  }
}

void EngineSoot::advanceOne(double duration, const EngineGas& gas, std::size_t i, std::span<double> row) {
  const std::span<const double> Y = gas.Y(i), amounts = gas.amounts(i);
  const std::vector<std::size_t>& exchanged = particles_.exchanged();
  const double T = gas.temperature[i], density = thermo_.density(T, gas.pressure, Y);
  densities_.assign(amounts.begin(), amounts.end());
  for (double& amount : densities_) amount *= density;
  concentrations_.clear();
  for (std::size_t k = 0; k < exchanged.size(); ++k) concentrations_.push_back(density * Y[exchanged[k]] / weights_[k]);
  const ParticleGas still{{T, gas.pressure, density, 0, thermo_.meanMolecularWeight(Y)}, concentrations_};
  if (particles_.idle(still, densities_)) return;

  const CarrierGas around = seen_.atComposition(T, gas.pressure, Y);
  before_ = densities_;
  before_.insert(before_.end(), concentrations_.begin(), concentrations_.end());
  particles_.advance(around, duration, densities_, concentrations_, {});
  // A radical that is used up at once may have become less than nothing by the solver's error.
  for (std::size_t k = 0; k < concentrations_.size(); ++k)
    concentrations_[k] = std::max(concentrations_[k], std::min(0.0, before_[scalars_ + k]));
  keepElements(before_);
  particles_.enthalpies(T, enthalpy_, slope_);
  const std::span<double> newY = row.subspan(headValues, gas.species),
                          newAmounts = row.subspan(headValues + gas.species);
  std::ranges::copy(Y, newY.begin());
  double gained = 0, given = 0;  // kg and J a kg of the gas before
  for (std::size_t k = 0; k < exchanged.size(); ++k) {
    const double change = concentrations_[k] * weights_[k] / density - Y[exchanged[k]];
    newY[exchanged[k]] += change;
    gained += change;
  }
  for (std::size_t s = 0; s < scalars_; ++s) {
    const double amount = densities_[s] / density;
    given += (amount - amounts[s]) * enthalpy_[s];
    newAmounts[s] = amount / (1 + gained);
  }
  for (double& fraction : newY) fraction /= 1 + gained;
  const double enthalpy = (thermo_.enthalpyMass(T, Y) - given) / (1 + gained);
  row[0] = 1;
  row[1] = 1 + gained;
  row[2] = thermo_.temperatureFromEnthalpy(enthalpy, newY, T);
  row[3] = given;
}

double EngineSoot::advance(double duration, EngineGas& gas) {
  const std::size_t width = headValues + gas.species + scalars_;
  rows_.assign(gas.count() * width, 0);
  const auto ranks = static_cast<std::size_t>(ranks_);
  collectively(comm_, [&] {
    for (auto i = static_cast<std::size_t>(rank_); i < gas.count(); i += ranks)
      advanceOne(duration, gas, i, std::span(rows_).subspan(i * width, width));
  });
  // Each row is of one rank, and zero on the others.
  if (ranks_ > 1) MPI_Allreduce(MPI_IN_PLACE, rows_.data(), static_cast<int>(rows_.size()), MPI_DOUBLE, MPI_SUM, comm_);
  double given = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const std::span<const double> row = std::span<const double>(rows_).subspan(i * width, width);
    if (row[0] == 0) continue;
    given += gas.mass[i] * row[3];
    gas.mass[i] *= row[1];
    gas.temperature[i] = row[2];
    std::ranges::copy(row.subspan(headValues, gas.species), gas.Y(i).begin());
    std::ranges::copy(row.subspan(headValues + gas.species), gas.amounts(i).begin());
  }
  return given;
}

}  // namespace lampblack::coupling
