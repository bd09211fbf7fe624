// What the tests of the exact solutions share: short ways to write models, and the density of a solution.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "particles/population/exact_solutions/exact_solution.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline InitialPopulation start(InitialPopulation::Distribution distribution, double number, double volume,
                               double deviation = 1) {
  return {.distribution = distribution, .number = number, .volume = volume, .geometricDeviation = deviation};
}

inline InitialPopulation equalStart(double number = 1, double volume = 1) {
  return start(InitialPopulation::Distribution::monodisperse, number, volume);
}

inline InitialPopulation exponentialStart(double number = 1, double volume = 1) {
  return start(InitialPopulation::Distribution::exponential, number, volume);
}

inline PopulationModel coagulating(CollisionKernelType type, double rate = 1) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = rate;
  return model;
}

inline PopulationModel breaking(BreakageOptions::Daughters daughters, double exponent, int pieces = 2,
                                double rate = 1) {
  PopulationModel model;
  model.breakage = BreakageOptions{.rate = rate, .exponent = exponent, .fragments = pieces, .daughters = daughters};
  return model;
}

inline NucleationOptions steadyNuclei(double rate, double volume) {
  NucleationOptions nuclei;
  nuclei.rate = rate;
  nuclei.volume = volume;
  return nuclei;
}

inline NucleationOptions precursorNuclei(double rateConstant, double precursor, double volume) {
  NucleationOptions nuclei;
  nuclei.source = NucleationOptions::Source::precursor;
  nuclei.rateConstant = rateConstant;
  nuclei.precursor = precursor;
  nuclei.volume = volume;
  return nuclei;
}

// n(v, t) from a bin of width h around v: h^2 n''/24 off.
inline double density(const ExactSolution& solution, double time, double v, double h = 2e-3) {
  const std::vector<double> edges{v - h / 2, v + h / 2};
  return solution.numberInBins(time, edges).at(0) / h;
}

// Composite Simpson rule.
inline double simpson(const std::function<double(double)>& f, double a, double b, int intervals) {
  const double h = (b - a) / intervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

inline double dndt(const ExactSolution& solution, double time, double v, double dt = 1e-3) {
  return (density(solution, time + dt, v) - density(solution, time - dt, v)) / (2 * dt);
}

// Bins from 0 up: geometric, the first from zero.
inline std::vector<double> geometricEdges(double first, double last, double ratio) {
  std::vector<double> edges{0.0};
  for (double x = first; x < last; x *= ratio) edges.push_back(x);
  edges.push_back(last);
  return edges;
}

inline double sum(const std::vector<double>& numbers) {
  double total = 0;
  for (const double x : numbers) total += x;
  return total;
}

}  // namespace lampblack::test
