// Paths of particles through flames: what they dilute is what the flame's own transport does to an inert scalar.
#include "coupling/flame_trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "flow/models/carried_model.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::coupling {
namespace {

constexpr double coefficient = 0.55;

GasOfFlame plainGas(std::size_t points, double length) {
  GasOfFlame gas;
  for (std::size_t i = 0; i < points; ++i)
    gas.z.push_back(length * static_cast<double>(i) / static_cast<double>(points - 1));
  gas.carrier.resize(points);
  for (CarrierGas& carrier : gas.carrier) carrier.density = 1;
  gas.concentrations.assign(points * SootSpecies::fixed, 0);
  gas.thermophoresis.assign(points, 0);
  gas.spread.assign(points, 0);
  gas.velocity.resize(points);
  return gas;
}

// Number per m3 after the path, of 1 at its start.
double kept(const ParticlePath& path) {
  double sum = 0;
  for (std::size_t k = 0; k < path.divergence.size(); ++k)
    sum += path.divergence[k].at(0.5) * (path.points[k + 1].time - path.points[k].time);
  return std::exp(-sum);
}

TEST(FlamePath, WithoutSpreadingTheFluxOfParticlesIsConstant) {
  GasOfFlame gas = plainGas(23, 0.02);
  for (std::size_t i = 0; i < 23; ++i) {
    gas.velocity[i] = 0.1 + 20 * gas.z[i] * (1 + 30 * gas.z[i]);
    gas.thermophoresis[i] = 0.02 * std::sin(200 * gas.z[i]);
  }
  const FlamePath path = flamePath(gas, {});
  EXPECT_FALSE(path.stagnates);
  ASSERT_EQ(path.path.points.size(), 23u);
  EXPECT_NEAR(kept(path.path) * path.velocity.back() / path.velocity.front(), 1, 1e-13);
}

// u = 2 a (z_s - z), V = a: stagnation flow of constant density, whose divergence is zero. With a constant drift c the
// particles stop at z_s + c / 2a, after the time ln(w_0 / w) / 2a.
TEST(FlamePath, EndsNearTheParticlesStagnationPlane) {
  const double a = 100, zs = 0.008, c = 0.1;
  for (const bool fromRight : {false, true}) {
    GasOfFlame gas = plainGas(41, 0.02);
    for (std::size_t i = 0; i < 41; ++i) {
      gas.velocity[i] = 2 * a * (zs - gas.z[i]);
      gas.thermophoresis[i] = c;
      gas.spread[i] = a;
    }
    FlamePathOptions options;
    options.fromRight = fromRight;
    options.slowest = 2e-3;
    const FlamePath path = flamePath(gas, options);
    EXPECT_TRUE(path.stagnates);
    EXPECT_NEAR(path.z.back(), zs + c / (2 * a) + (fromRight ? 1 : -1) * 2e-3 / (2 * a), 1e-15);
    const double start = fromRight ? 2 * a * (zs - 0.02) + c : 2 * a * zs + c;
    EXPECT_NEAR(path.path.points.back().time, std::log(std::abs(start) / 2e-3) / (2 * a), 1e-13);
    EXPECT_NEAR(kept(path.path), 1, 1e-11);
  }
}

TEST(FlamePath, StartsWhereItIsTold) {
  GasOfFlame gas = plainGas(11, 0.01);
  gas.velocity.assign(11, 0.3);
  FlamePathOptions options;
  options.start = 0.0045;
  EXPECT_NEAR(flamePath(gas, options).z.front(), 0.005, 1e-15);
  options.fromRight = true;  // against the flow
  EXPECT_TRUE(flamePath(gas, options).path.points.empty());
}

// A scalar that a flame carries, made at a rate that depends on the temperature only; moves by convection and
// thermophoresis.
class Inert final : public CarriedModel {
 public:
  static double rate(double T) { return 1e15 * std::exp(-std::pow((T - 600) / 60, 2)); }  // 1/m3/s
  explicit Inert(std::size_t elements)
      : scalars_{{{"number", "1/m^3", "inert"}, 1e12, coefficient, std::vector<double>(elements, 0.0)}} {}
  [[nodiscard]] std::string material() const override { return "inert"; }
  [[nodiscard]] const std::vector<Scalar>& scalars() const override { return scalars_; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return exchanged_; }
  void sources(const ParticleGas& gas, std::span<const double>, std::span<double> rates, std::span<double>) override {
    rates[0] = rate(gas.temperature);
  }
  ParticleAdvance advance(const CarrierGas&, double, std::span<double>, std::span<double>,
                          std::span<const double>) override {
    return {};
  }
  void jacobian(const ParticleGas& gas, std::span<const double>, const CarriedJacobian& out) override {
    out(0, 0) = 0;
    out(0, 1) = -2 * (gas.temperature - 600) / 3600 * rate(gas.temperature);
  }
  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) override { D[0] = 0; }
  void enthalpies(double, std::span<double> h, std::span<double> slope) override { h[0] = slope[0] = 0; }
  double absorption(double, std::span<const double>) override { return 0; }

 private:
  std::vector<Scalar> scalars_;
  std::vector<std::size_t> exchanged_;
};

// Largest difference between number densities along the paths and those that the flame carries, over the largest.
// Nitrogen at 900 K against nitrogen at 300 K. Along the path dN/dt = S - N D.
double difference(std::size_t points) {
  FlameProblem problem;
  problem.type = FlameType::Counterflow;
  problem.length = 0.02;
  problem.left = hydrogenStream("N2: 1", 900, 0.12);
  problem.right = hydrogenStream("N2: 1", 300, 0.2);
  Inert inert(hydrogenMechanism()->numElements());
  FlameSolverOptions solver;
  InitialFlameOptions cold;
  cold.cold = true;
  cold.points = points;
  solver.refine = false;
  FlameSolver flame(MPI_COMM_WORLD, hydrogenMechanism(), problem, &inert, solver);
  const FlameSolution solution = flame.solve(initialFlame(*hydrogenMechanism(), problem, 1, cold));
  const FlameProfile& profile = solution.profile;
  EXPECT_GT(solution.scalarChange, 0) << "values of scalars between points follow the profile";
  EXPECT_LE(solution.scalarChange, solver.scalarChange);
  EXPECT_EQ(profile.points(), points);
  const GasOfFlame gas = flameGasOf(sootSpecies({}), profile, *hydrogenMechanism(), problem.pressure, coefficient);
  double worst = 0, largest = 0;
  for (const bool fromRight : {false, true}) {
    FlamePathOptions options;
    options.fromRight = fromRight;
    options.slowest = 0.03;
    const ParticlePath path = flamePath(gas, options).path;
    EXPECT_GT(path.points.size(), points / 4);
    double N = 0;
    for (std::size_t k = 0; k + 2 < path.points.size(); ++k) {  // the last point lies between those of the flame
      const auto &a = path.points[k], &b = path.points[k + 1];
      const double dt = b.time - a.time, D = path.divergence[k].at(0.5);
      const double S = 0.5 * (Inert::rate(a.gas.temperature) + Inert::rate(b.gas.temperature));
      const double decay = std::exp(-D * dt);
      N = N * decay + S * (std::abs(D * dt) > 1e-9 ? (1 - decay) / D : dt);
      const std::size_t i = fromRight ? points - 2 - k : k + 1;
      const double there = profile.scalars(i)[0] * inert.scalars()[0].scale * gas.carrier[i].density;
      worst = std::max(worst, std::abs(N - there));
      largest = std::max(largest, there);
    }
  }
  return worst / largest;
}

// The flame's own transport is upwind, of first order.
TEST(FlamePath, CarriesAnInertScalarAsTheFlameDoes) {
  const double coarse = difference(321), fine = difference(1281);
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
  EXPECT_LT(fine, 0.3 * coarse);
  EXPECT_LT(fine, 0.03);
}

}  // namespace
}  // namespace lampblack::coupling
