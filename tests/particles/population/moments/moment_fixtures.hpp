// Short ways to write models and methods for the tests of the moment methods.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "particles/population/exact_solutions/exact_solution.hpp"
#include "particles/population/moments/moment_options.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline InitialPopulation equalStart(double number = 1, double volume = 1) {
  return {InitialPopulation::Distribution::monodisperse, number, volume, 1};
}
inline InitialPopulation exponentialStart(double number = 1, double volume = 1) {
  return {InitialPopulation::Distribution::exponential, number, volume, 1};
}
inline InitialPopulation logNormalStart(double number, double volume, double deviation) {
  return {InitialPopulation::Distribution::lognormal, number, volume, deviation};
}

inline PopulationModel coagulating(CollisionKernelType type, double rate = 1) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = rate;
  model.coagulation->gas = {1500, 101325, 0.24, 5.6e-5, 0.029};
  model.coagulation->shearRate = 1;
  return model;
}

inline NucleationOptions steadyNuclei(double rate, double volume) {
  NucleationOptions nuclei;
  nuclei.rate = rate;
  nuclei.volume = volume;
  return nuclei;
}

struct Closure {
  std::string name;
  MomentOptions options;
};

inline MomentOptions qmom(std::size_t nodes, QuadratureInversion inversion = QuadratureInversion::wheeler) {
  return {MomentMethod::qmom, 2 * nodes, inversion, 1e-8};
}
inline MomentOptions momic(std::size_t moments) {
  return {MomentMethod::momic, moments, QuadratureInversion::wheeler, 1e-8};
}

inline std::vector<Closure> everyClosure() {
  return {{"QMOM 2", qmom(2)},   {"QMOM 3", qmom(3)},
          {"QMOM 4", qmom(4)},   {"QMOM 3 product-difference", qmom(3, QuadratureInversion::productDifference)},
          {"MOMIC 4", momic(4)}, {"MOMIC 6", momic(6)},
          {"MOMIC 8", momic(8)}};
}

}  // namespace lampblack::test
