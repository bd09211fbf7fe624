// One cell that gas flows through, which reacts in eddies, against the root of its equation.
#include <gtest/gtest.h>

#include "combustion_fixture.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/models/combustion/fine_structure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::test {
namespace {

// One cell through which gas flows, of A that becomes B in eddies that stay: Y_in - Y = t k kappa Y with kappa =
// 1/(1 + tau_mix k Y), t the time that gas takes through it; of fine structures Y_in - Y = t chi (1 - e^(-k tau*))
// Y/tau*.
using Kind = ChemicalTime::Kind;

class OneCell : public testing::Test {
 protected:
  static constexpr double k = 4e3, energy = 2.0, dissipation = 240.0, speed = 2.0, length = 0.004;
  struct Found {
    double Y, share, residual;
    double slope, difference;  // of ln share by the mass fraction of A
  };
  static Found steady(CombustionOperator::Options options, double dt) {
    Gas two(twoGases({becomes(k)}));
    const std::vector<double> fresh{0.9, 0.1};
    const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                                  opening(BoundaryKind::Inlet, 1, false, speed, 600.0, fresh),
                                  opening(BoundaryKind::Outlet, 1, true, 0.0, 600.0, fresh)};
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.001, 1), uniformAxis(length, 1), {}};
    std::vector<BoundaryCondition> conditions;
    for (const Side& s : sides) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    Box cell(spec, conditions, {}, MPI_COMM_SELF, two);
    const auto model = std::make_shared<PointwiseModel<StillEddies>>();
    const double eddies = 0.09 * energy * energy / dissipation;
    State state = cell.stateWith(
        {TurbulenceOperator::blockOf(*model, conditions, std::vector<FreeStream>(4, {5e-5, eddies, energy}))},
        [&](const Vector3&) {
          return Box::Local{{0.0, speed}, 600.0, fresh};
        });
    TransportOperator transport(cell.context, state);
    const bool isFine = options.model == CombustionOperator::Model::EddyDissipation;
    ConstantPressureReactor::Options tight{.relativeTolerance = 1e-10, .negligibleChange = 0.0};
    ReactionOperator chemistry =
        isFine
            ? ReactionOperator(cell.context, {}, std::make_unique<FineStructureCells>(two.mechanism, two.thermo, tight))
            : ReactionOperator(cell.context, {.shareWork = true, .reactor = tight, .keepFailed = {}});
    TurbulenceOperator turbulence(cell.context, state, model, transport.properties());
    CombustionOperator combustion(cell.context, options, turbulence,
                                  [&](const State& of) { return chemistry.heatReleases(of); });
    chemistry.mixBy(combustion);
    turbulence.setStart(state, {5e-5, eddies, energy});
    const std::vector<Operator*> all{&transport, &chemistry, &turbulence, &combustion};
    transport.initialise(state, dt);
    const auto end = [&] {
      for (Operator* op : all) op->endStep(state);
      for (Operator* op : all) op->endSweep(state);
    };
    end();
    for (int step = 0; step * dt < 20.0 * length / speed; ++step) {
      for (Operator* op : all) op->advance(state, step * dt, dt);
      end();
    }
    FlowResidual residual(cell.context, state, VelocityScheme::Limited, all);
    const double left = residual.evaluate(state).species[0];
    std::vector<double> slopes(3);
    combustion.of(state);
    combustion.slopesOfShare(state, 0, slopes);
    State richer = state;
    const double more = 1e-6, share = combustion.present()[0].reactingShare;
    richer.Y[0] += more;
    const double difference = std::log(combustion.of(richer)[0].reactingShare / share) / more;
    return {state.Y[0], share, left / (state.density[0] * speed * 0.001), slopes[0], difference};
  }
};

TEST_F(OneCell, IsTheRootOfItsEquationWhateverTheStep) {
  CombustionOperator::Options options;
  const double t = length / speed, viscosity = 0.0;
  for (const auto kind : {Kind::WeightedReactions, Kind::SlowestSpecies}) {
    options.chemicalTime = kind;
    options.mixingTime = MixingTime::Integral;  // without the viscosity of the molecules
    const double mixing = 0.3 * energy / dissipation + viscosity;
    const Found found = steady(options, 1e-4), withLongSteps = steady(options, 7e-4);
    double low = 0.0, high = 0.9;
    const auto chemical = [&](double Y) {
      return kind == Kind::WeightedReactions ? 1.0 / (k * Y) : std::max(1.0, (1.0 - Y) / Y) / k;
    };
    const auto excess = [&](double Y) { return t * k * stirredShare(chemical(Y), mixing) * Y - (0.9 - Y); };
    for (int i = 0; i < 100; ++i) (excess(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
    report(fmt::format("Y {:.9f}, of steps seven times as long {:.9f}, root {:.9f}, kappa {:.4f}", found.Y,
                       withLongSteps.Y, low, found.share));
    EXPECT_NEAR(found.Y, low, 1e-6);
    EXPECT_NEAR(withLongSteps.Y, found.Y, 1e-7);
    EXPECT_NEAR(found.share, stirredShare(chemical(low), mixing), 1e-6);
    EXPECT_LT(std::abs(found.residual), 1e-6);
    if (kind == Kind::WeightedReactions) {
      EXPECT_NEAR(found.slope, found.difference, 1e-4 * std::abs(found.difference));
    } else {
      EXPECT_EQ(found.slope, 0.0);
    }
  }
}

TEST_F(OneCell, OfFineStructuresIsTheRootWhateverTheStep) {
  CombustionOperator::Options options;
  options.model = CombustionOperator::Model::EddyDissipation;
  const Found found = steady(options, 1e-4), withLongSteps = steady(options, 7e-4);
  EXPECT_NEAR(withLongSteps.Y, found.Y, 1e-7);
  EXPECT_LT(std::abs(found.residual), 1e-6);
  // By the viscosity of the gas at 600 K, which the share tells.
  const FineStructures fine;
  const double size = std::sqrt(found.share / (1.0 + found.share));
  const double viscosity = std::pow(size / fine.length, 4) * energy * energy / dissipation;
  EXPECT_NEAR(viscosity, 5.2e-5, 0.4e-5);
  const double time = fine.time * std::sqrt(viscosity / dissipation);
  const double rate = found.share / time * -std::expm1(-k * time);
  EXPECT_NEAR(found.Y, 0.9 / (1.0 + rate * length / speed), 1e-6);
}

// Where eddies are weaker than a tenth of the molecules the reactions are those of the mean, or are not.
TEST_F(OneCell, ReactsAsItIsWhereTurbulenceDiesOut) {
  CombustionOperator::Options options;
  const double perMolecules = 0.09 * energy * energy / dissipation / 5.2e-5;
  EXPECT_LT(steady(options, 4e-4).share, 0.9);
  options.laminarBelow = 2.0 * perMolecules;
  const Found found = steady(options, 4e-4);
  EXPECT_EQ(found.share, 1.0);
  EXPECT_NEAR(found.Y, 0.9 / (1.0 + k * length / speed), 1e-6);
  options.laminarBelow = 0.0;
  EXPECT_LT(steady(options, 4e-4).share, 0.9);
}

}  // namespace
}  // namespace lampblack::test
