#include "chemistry/reactor/newton_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;

// Backward errors of one solution, row by row: the residual of (I - gamma J) x = b in units of the terms of the row,
// and in units of its largest entry times the largest unknown, temperatures in 1000 K.
struct BackwardError {
  double byTerms = 0, bySizes = 0;
};

BackwardError backwardError(const std::vector<double>& J, double gamma, const std::vector<double>& x,
                            const std::vector<double>& b) {
  const std::size_t size = b.size();
  const auto unit = [&](std::size_t j) { return j + 1 == size ? 1e3 : 1.0; };
  double largestX = 0;
  for (std::size_t j = 0; j < size; ++j) largestX = std::max(largestX, std::abs(x[j]) / unit(j));
  BackwardError worst;
  for (std::size_t i = 0; i < size; ++i) {
    double residual = x[i] - b[i], terms = std::abs(x[i]) + std::abs(b[i]), largest = 1;
    for (std::size_t j = 0; j < size; ++j) {
      const double term = gamma * J[i + j * size] * x[j];
      residual -= term;
      terms += std::abs(term);
      largest = std::max(largest, std::abs(gamma * J[i + j * size]) * unit(j));
    }
    if (terms > 0) raise(worst.byTerms, residual / terms);
    raise(worst.bySizes, residual / (largest * largestX));
  }
  return worst;
}

// Along a flame, for steps from far below to far above all times of the chemistry, both kinds of reactor, with the
// right side of a typical Newton iteration. Where the sparse elimination asks for pivoting, which mixes the rows, tiny
// rows are right by the size of their entries only.
TEST(NewtonMatrix, SolvesTheReactorsSystemForAnyStep) {
  const Table states("counterflow_c2h4_states.csv");
  ReactorSystem system(ethylene());
  NewtonMatrix newton(system);
  const std::size_t size = system.size(), n = size - 1;
  double worst = 0, worstBySizes = 0;
  int factorisations = 0;
  for (std::size_t row = 0; row < states.size(); row += 2)
    for (const auto held : {ReactorSystem::Held::Pressure, ReactorSystem::Held::Density}) {
      std::vector<double> y(size), f(size), J(size * size);
      Thermo(ethylene()).moleToMass(states.moleFractions(row, ethylene()), {y.data(), n});
      y[n] = states.number(row, "T");
      ReactorSystem::Conditions conditions;
      conditions.held = held;
      conditions.value = held == ReactorSystem::Held::Pressure ? constants::oneAtmosphere : 0.2;
      system.setConditions(conditions);
      ASSERT_TRUE(system.jacobian(y.data(), f.data(), J.data(), size));
      ASSERT_TRUE(newton.evaluate(system, y.data(), f.data()));
      for (double gamma = 1e-12; gamma < 2; gamma *= 10) {
        const long pivotedBefore = newton.pivotedFactorisations();
        ASSERT_TRUE(newton.factorise(gamma)) << row << " " << gamma;
        ++factorisations;
        auto x = f;
        newton.solve(x.data());
        const auto error = backwardError(J, gamma, x, f);
        raise(worstBySizes, error.bySizes);
        EXPECT_LT(error.bySizes, 1e-12) << "state " << row << ", gamma " << gamma;
        if (newton.pivotedFactorisations() > pivotedBefore) continue;
        raise(worst, error.byTerms);
        EXPECT_LT(error.byTerms, 1e-9) << "state " << row << ", gamma " << gamma;
      }
    }
  measured("backward error by terms, without pivoting", worst);
  measured("backward error by sizes", worstBySizes);
  measured("part of factorisations with pivoting",
           static_cast<double>(newton.pivotedFactorisations()) / factorisations);
}

// A source of a species faster than it is used makes a negative diagonal that some gamma cancels exactly; the sparse
// elimination must notice and pivoting help.
TEST(NewtonMatrix, PivotsWhereADiagonalEntryVanishes) {
  ReactorSystem system(ethylene());
  NewtonMatrix newton(system);
  const std::size_t size = system.size(), n = size - 1;
  std::vector<double> y(size, 0.0), f(size), J(size * size);
  y[ethylene().speciesIndex("N2")] = 1;
  y[n] = 300;
  ReactorSystem::Conditions conditions;
  conditions.value = constants::oneAtmosphere;
  conditions.removal = -1e3;  // every mass fraction grows by itself: J_kk = 1000/s
  conditions.energy = ReactorSystem::Energy::GivenTemperature;
  system.setConditions(conditions);
  ASSERT_TRUE(system.jacobian(y.data(), f.data(), J.data(), size));
  ASSERT_TRUE(newton.evaluate(system, y.data(), f.data()));
  EXPECT_FALSE(newton.factorise(1e-3)) << "I - gamma J has rows of zeros";
  EXPECT_EQ(newton.pivotedFactorisations(), 1);
  EXPECT_TRUE(newton.factorise(0.9e-3));
  EXPECT_EQ(newton.pivotedFactorisations(), 1);
}

}  // namespace
