// Scalars that a held gas would feed without end: more of them than there is gas are no start for the two together.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_scalars.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/flow/flame/flame_fixture.hpp"
#include "tests/flow/flame/steady_hydrogen.hpp"

namespace lampblack::flow {
namespace {

// Droplets of water, as warm as its vapour: they grow on themselves, and where they are dense they evaporate.
class Droplets final : public CarriedModel {
 public:
  explicit Droplets(double growth) : growth_(growth), thermo_(*hydrogenMechanism()) {
    const Mechanism& mechanism = *hydrogenMechanism();
    exchanged_.push_back(mechanism.speciesIndex("H2O"));
    weight_ = mechanism.molecularWeights()[exchanged_[0]];
    std::vector<double> elements(mechanism.numElements());
    for (std::size_t e = 0; e < elements.size(); ++e)
      elements[e] = mechanism.atoms(exchanged_[0], e) * mechanism.atomicWeight(e) / weight_;
    scalars_.push_back({{"water", "kg/m^3", ""}, 1e-2, 0, elements});
  }
  [[nodiscard]] std::string material() const override { return "water"; }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
               std::span<double> exchange) override {
    const double vapour = std::max(gas.concentrations[0], 0.0), water = std::max(densities[0], 0.0);
    rates[0] = (birth + growth_ * water) * vapour - evaporation * water * water;
    exchange[0] = -rates[0] / weight_;
  }
  void jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) override {
    const double vapour = std::max(gas.concentrations[0], 0.0), water = std::max(densities[0], 0.0);
    out(0, 0) = growth_ * vapour - 2 * evaporation * water;
    out(0, 1) = birth + growth_ * water;
    out(0, 2) = 0;
    for (std::size_t j = 0; j < 3; ++j) out(1, j) = -out(0, j) / weight_;
  }
  ParticleAdvance advance(const CarrierGas&, double, std::span<double>, std::span<double>,
                          std::span<const double>) override {
    return {};
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) override { D[0] = 1e-5; }
  void enthalpies(double temperature, std::span<double> h, std::span<double> slope) override {
    std::vector<double> all(hydrogenMechanism()->numSpecies());
    const auto at = [&](double T) {
      thermo_.speciesEnthalpies(T, all);
      return all[exchanged_[0]];
    };
    h[0] = at(temperature);
    slope[0] = at(temperature + 0.5) - at(temperature - 0.5);
  }
  double absorption(double, std::span<const double>) override { return 0; }

 private:
  static constexpr double birth = 1e-3, evaporation = 10;
  double growth_, weight_ = 0;
  Thermo thermo_;
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

struct Solved {
  std::vector<std::string> stages;
  double mostWater = 0;  // kg per kg of gas
};

Solved solvedWith(double growth) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  Droplets droplets(growth);
  FlameSolverOptions options;
  options.grid = coarseGrid();
  FlameSolver solver(MPI_COMM_WORLD, hydrogenMechanism(), problem, &droplets, options);
  const FlameSolution solution = solver.solve(initialFlame(*hydrogenMechanism(), problem, 1));
  Solved result;
  for (const FlameStage& stage : solution.stages) result.stages.push_back(stage.name);
  for (std::size_t i = 0; i < solution.profile.points(); ++i)
    result.mostWater = std::max(result.mostWater, 1e-2 * solution.profile.scalars(i)[0]);
  return result;
}

// Comes into every volume alike, in proportion to the gas, drifts and diffuses.
class Dust final : public CarriedModel {
 public:
  Dust(double thermophoresis, double diffusivity) : diffusivity_(diffusivity) {
    std::vector<double> elements(hydrogenMechanism()->numElements());
    elements[0] = 1;
    scalars_.push_back({{"dust", "kg/m^3", ""}, 1e-2, thermophoresis, elements});
  }
  [[nodiscard]] std::string material() const override { return "dust"; }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  void sources(const ParticleGas& gas, std::span<const double>, std::span<double> rates, std::span<double>) override {
    rates[0] = gas.density;
  }
  void jacobian(const ParticleGas&, std::span<const double>, const CarriedJacobian& out) override {
    std::ranges::fill(out.values, 0.0);
  }
  ParticleAdvance advance(const CarrierGas&, double, std::span<double>, std::span<double>,
                          std::span<const double>) override {
    return {};
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) override { D[0] = diffusivity_; }
  void enthalpies(double, std::span<double> h, std::span<double> slope) override { h[0] = slope[0] = 0; }
  double absorption(double, std::span<const double>) override { return 0; }

 private:
  double diffusivity_;
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

// Still gas, hardly warmer than the wall at its right end, into which dust comes: its flux is J = rho z, and with P = w
// L/(rho D), w c - rho D c' = J leads to c = rho (z + D/v)/w - rho (L + D/v)/w e^(P(z/L - 1)) with c = 0 at the wall.
// The mean error of c between the ends, over its mean.
double errorAtAWall(std::size_t points, double peclet) {
  const double length = 0.01, cold = 300, warmer = 0.03, v = 0.02;
  FlameProblem problem = hydrogenProblem(FlameType::Wall);
  problem.length = length;
  problem.left = hydrogenStream("N2: 1", cold + warmer, 1e-12);  // as good as still
  problem.wallTemperature = cold;
  const Thermo thermo(*hydrogenMechanism());
  Transport transport(*hydrogenMechanism());
  const std::size_t n = hydrogenMechanism()->numSpecies();
  std::vector<double> X(n), D(n);
  thermo.massToMole(problem.left.Y, X);
  const double density = thermo.density(cold, problem.pressure, problem.left.Y);
  const double viscosity = transport.mixture(cold, problem.pressure, X, D).viscosity;
  const double diffusivity = v * length / peclet, w = density * v;
  Dust dust(w * cold * length / (viscosity * warmer), diffusivity);
  FlameEquations equations(MPI_COMM_SELF, hydrogenMechanism(), problem, &dust);
  const auto exact = [&](double z) {
    const double layer = diffusivity / v;
    return density / w * (z + layer - (length + layer) * std::exp(peclet * (z / length - 1)));
  };
  FlameProfile flame{{n, 1}, {}, {}};
  for (std::size_t i = 0; i < points; ++i)
    flame.z.push_back(length * static_cast<double>(i) / static_cast<double>(points - 1));
  flame.x.assign(flame.size(), 0.0);
  for (std::size_t i = 0; i < points; ++i) {
    flame.at(i, FlameLayout::temperature) = cold + warmer * (1 - flame.z[i] / length);
    std::ranges::copy(problem.left.Y, &flame.at(i, FlameLayout::firstSpecies));
    flame.at(i, flame.layout.firstScalar()) = exact(flame.z[i]) / 1e-2;
  }
  flame.global(load) = 1;
  equations.setGrid(flame.z);
  FlameScalars scalars(equations, flame);
  std::vector<double> x = scalars.start(), F(x.size());
  scalars.residual(x, F);
  EXPECT_TRUE(scalars.factorise(x, 0));
  scalars.solve(F);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= F[i];
  scalars.put(x, flame);
  double error = 0, sum = 0;
  for (std::size_t i = 1; i + 1 < points; ++i) {
    error += std::abs(1e-2 * x[i] - exact(flame.z[i]));
    sum += exact(flame.z[i]);
  }
  // Nothing is lost on the way, and what the budget has is what the wall takes.
  const WallDeposition taken = equations.wallDeposition(flame.x);
  EXPECT_NEAR(taken.rate / (density * length), 1, 1e-3);
  EXPECT_NEAR(equations.budgets(flame.x)[0].wall / taken.rate, 1, 1e-12);
  EXPECT_NEAR(taken.thermophoresis / v, 1, 1e-3);
  return error / sum;
}

TEST(ScalarsAtAWall, DriftAndDiffuseToIt) {
  for (const double peclet : {1.0, 10.0, 2e4}) {
    const double coarse = errorAtAWall(21, peclet), fine = errorAtAWall(41, peclet);
    fmt::print("P {:g}: errors of c {:.2e} and {:.2e}\n", peclet, coarse, fine);
    EXPECT_LT(fine, 0.35 * coarse + 1e-4);
    EXPECT_LT(fine, 5e-3);
  }
}

TEST(ScalarsAlone, AreAStartWhereTheGasCanFeedThem) {
  const Solved flame = solvedWith(1);
  EXPECT_THAT(flame.stages, testing::Contains("scalars in the gas"));
  EXPECT_GT(flame.mostWater, 1e-6);
}

TEST(ScalarsAlone, AreNoStartWhereTheyWouldOutweighTheGas) {
  const Solved flame = solvedWith(500);
  EXPECT_THAT(flame.stages, testing::Contains("scalars in the gas: too many to start from"));
  // Less than the held gas would have fed them, which was put aside.
  EXPECT_GT(flame.mostWater, 1e-3);
  EXPECT_LT(flame.mostWater, 1);
}

}  // namespace
}  // namespace lampblack::flow
