// Scalars that a held gas would feed without end: more of them than there is gas are no start for the two together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
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
