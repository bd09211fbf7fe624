// Reactions in turbulence: times and shares against their definitions, cells that react at a share, and one cell that
// gas flows through against the root of its equation.
#include <gtest/gtest.h>

#include "combustion_fixture.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/models/combustion/fine_structure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::test {
namespace {

using Kind = ChemicalTime::Kind;

TEST(ChemicalTimes, AreThoseOfOneReaction) {
  const double k = 200.0, density = 1.3, quarter = 0.25;
  const std::vector<double> Y{quarter, 1.0 - quarter};
  const auto timeOf = [&](Kind kind, const std::vector<std::string>& reactions, std::span<const double> of) {
    const Mechanism mechanism = twoGases(reactions);
    return ChemicalTime(mechanism, kind).of(700.0, density, of);
  };
  const std::vector<std::string> one{becomes(k)}, beside{becomes(k), becomes(0.0, false, "B => A")},
      twice{becomes(0.5 * k, true), becomes(0.5 * k, true)};
  const double time = 1.0 / (k * quarter);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, one, Y), time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, one, Y), time, 1e-12 * time);
  // Of A; B, of which there is more, grows as fast as A falls and would take three times as long.
  EXPECT_NEAR(timeOf(Kind::SlowestSpecies, one, Y), 3.0 * time * quarter, 1e-12 * time);
  const std::vector<double> rich{0.9, 0.1};
  EXPECT_NEAR(timeOf(Kind::SlowestSpecies, one, rich), 1.0 / k, 1e-12 / k);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, beside, Y), 2.0 * time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, beside, Y), time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::ReactionsOf6, twice, Y), 2.0 * time, 1e-12 * time);
  EXPECT_NEAR(timeOf(Kind::WeightedReactions, twice, Y), 2.0 * time, 1e-12 * time);
  // Slow, and none at all.
  const std::vector<std::string> slow{becomes(1e-3)};
  for (const Kind kind : {Kind::ReactionsOf6, Kind::WeightedReactions, Kind::SlowestSpecies}) {
    EXPECT_EQ(timeOf(kind, slow, Y), ChemicalTime::longest);
    EXPECT_EQ(timeOf(kind, {becomes(0.0)}, Y), ChemicalTime::longest);
  }
}

TEST(ChemicalTimes, WeighBothDirections) {
  const double k = 0.2;  // m^3/mol/s
  const Mechanism mechanism = twoGases({becomes(1e3 * k, false, "2 A <=> 2 B")});
  // Of equal gases the reverse constant is the forward one.
  const double density = 1.3, c = density * 0.5 / mechanism.molecularWeights()[0], w = 2.0 * k * c * c;
  const std::vector<double> Y{0.5, 0.5};
  EXPECT_NEAR(ChemicalTime(mechanism, Kind::WeightedReactions).of(700.0, density, Y), 2.0 * c * 2.0 * w / (2.0 * w * w),
              1e-9 * c / w);
  EXPECT_NEAR(ChemicalTime(mechanism, Kind::ReactionsOf6).of(700.0, density, Y), 2.0 * c / w, 1e-9 * c / w);
  EXPECT_EQ(ChemicalTime(mechanism, Kind::SlowestSpecies).of(700.0, density, Y), ChemicalTime::longest);
}

// Against differences, at constant pressure. Hydrogen's third bodies are left out.
TEST(ChemicalTimes, HaveSlopes) {
  const Mechanism mechanism =
      twoGases({becomes(40.0, false, "2 A <=> 2 B"), becomes(300.0), becomes(70.0, false, "B => A")});
  const Thermo thermo(mechanism);
  for (const Kind kind : {Kind::WeightedReactions, Kind::ReactionsOf6}) {
    ChemicalTime time(mechanism, kind);
    const std::vector<double> Y{0.3, 0.7};
    const double T = 700.0, p = 101325.0, small = 1e-5;
    const auto at = [&](double temperature, std::span<const double> of) {
      return std::log(time.of(temperature, thermo.density(temperature, p, of), of));
    };
    std::vector<double> slopes(3);
    time.slopes(T, thermo.density(T, p, Y), Y, slopes);
    for (std::size_t j = 0; j < 2; ++j) {
      std::vector<double> above = Y, below = Y;
      above[j] += small;
      below[j] -= small;
      const double slope = (at(T, above) - at(T, below)) / (2.0 * small);
      EXPECT_NEAR(slopes[j], slope, 1e-6 * std::abs(slope)) << j;
    }
    const double byT = (at(T + 0.1, Y) - at(T - 0.1, Y)) / 0.2;
    EXPECT_NEAR(slopes[2], byT, 1e-4 * std::abs(byT));
  }
  ChemicalTime slowest(mechanism, Kind::SlowestSpecies);
  std::vector<double> slopes(3, 1.0);
  slowest.slopes(700.0, 0.5, std::vector<double>{0.3, 0.7}, slopes);
  EXPECT_EQ(slopes, std::vector<double>(3, 0.0));
}

TEST(MixingTimes, GoByTheEddies) {
  const Eddies eddies{.energy = 8.0, .dissipation = 400.0, .viscosity = 2e-5, .eddyViscosity = 3.4e-4};
  const double kolmogorov = std::sqrt(2e-5 / 400.0), integral = 8.0 / 400.0;
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Effective, 0.3), 0.3 * std::sqrt(3.6e-4 / 400.0));
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Kolmogorov, 0.3), kolmogorov);
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Geometric, 0.3), std::sqrt(kolmogorov * integral));
  EXPECT_DOUBLE_EQ(mixingTime(eddies, MixingTime::Integral, 0.5), 0.5 * integral);
  EXPECT_EQ(stirredShare(1e-3, mixingTime({8.0, 0.0, 2e-5, 0.0}, MixingTime::Effective, 0.3)), 0.0);
  EXPECT_DOUBLE_EQ(stirredShare(1e-3, 3e-3), 0.25);
  EXPECT_EQ(stirredShare(1e-3, 0.0), 1.0);
}

TEST(FineStructuresOfEddies, HaveTheSharesOfTheThreeVersions) {
  const Eddies eddies{.energy = 8.0, .dissipation = 400.0, .viscosity = 2e-5, .eddyViscosity = 3.4e-4};
  FineStructures fine;
  const double size = 2.1377 * std::pow(2e-5 * 400.0 / 64.0, 0.25);
  EXPECT_NEAR(fine.size(eddies), size, 1e-12);
  EXPECT_NEAR(fine.mixing(eddies), 0.4083 * std::sqrt(2e-5 / 400.0), 1e-15);
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.25 / 0.75);
  fine.powerBelow = 3.0;
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.25 / 0.875);
  fine.powerAbove = 3.0;
  EXPECT_DOUBLE_EQ(fine.share(0.5), 0.125 / 0.875);
  EXPECT_EQ(fine.share(0.99), 1.0);
  EXPECT_EQ(fine.share(1.5), 1.0);
  EXPECT_EQ(fine.share(fine.size({0.0, 400.0, 2e-5, 0.0})), 1.0);
}

class Mixed : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<double> burning = gas.massFractions("H2: 0.3, O2: 0.15, N2: 0.55, OH: 0.002, H: 0.001");
  static std::vector<Side> sides() {
    return {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
            side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  }
  Box box{Geometry::Planar, {uniformAxis(0.008, 6), uniformAxis(0.006, 2)}, sides()};
  State hot() {
    return box.state([&](const Vector3& x) { return Box::Local{{}, 1100.0 + 4e4 * x[0], burning}; });
  }
  static CellMixing shareAt(const Vector3& x) { return {std::min(100.0 * x[0], 1.0), 0.0}; }
  std::unique_ptr<CellReactor> fineCells() const {
    return std::make_unique<FineStructureCells>(gas.mechanism, gas.thermo, ConstantPressureReactor::Options{});
  }
};

// Whoever advances them: work sharing carries the shares.
TEST_F(Mixed, CellsReactAtTheirShares) {
  const double dt = 2e-5;
  GivenMixing mixing(box.mesh, shareAt);
  for (const bool isShared : {true, false}) {
    State state = hot();
    const State start = state;
    ReactionOperator chemistry(box.context, {.shareWork = isShared, .reactor = {}, .keepFailed = {}});
    chemistry.mixBy(mixing);
    chemistry.advance(state, 0.0, dt);
    for (int c = 0; c < box.mesh.owned; ++c) {
      std::vector<double> Y(&start.Y[at(c) * n], &start.Y[at(c) * n] + n);
      ConstantPressureReactor::Cell cell{start.temperature[at(c)], start.thermodynamicPressure, Y, {}};
      ConstantPressureReactor(gas.mechanism).advance(cell, dt * mixing.present()[at(c)].reactingShare);
      EXPECT_NEAR(state.temperature[at(c)], cell.temperature, 0.02);
      for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(state.Y[at(c) * n + k], Y[k], 3e-6);
    }
  }
}

TEST_F(Mixed, AllOfTheReactionsAreThoseWithoutMixingToTheLastBit) {
  GivenMixing all(box.mesh, [](const Vector3&) { return CellMixing{}; });
  std::vector<State> states;
  for (const int way : {0, 1, 2}) {
    State& state = states.emplace_back(hot());
    ReactionOperator chemistry =
        way == 2 ? ReactionOperator(box.context, {}, fineCells()) : ReactionOperator(box.context, {});
    if (way > 0) chemistry.mixBy(all);
    for (int step = 0; step < 2; ++step) chemistry.advance(state, 0.0, 1e-5);
    if (way == 0) continue;
    EXPECT_EQ(state.Y, states[0].Y);
    EXPECT_EQ(state.temperature, states[0].temperature);
  }
}

// The warmer a cell the more of it reacts.
class WarmMixing final : public MixingModel {
 public:
  explicit WarmMixing(const Mesh& mesh) : cells_(at(mesh.owned)) {}
  [[nodiscard]] std::span<const CellMixing> present() const override { return cells_; }
  std::span<const CellMixing> of(const State& state) override {
    for (std::size_t c = 0; c < cells_.size(); ++c)
      cells_[c].reactingShare = std::pow(state.temperature[c] / 3000.0, 2);
    return cells_;
  }
  void slopesOfShare(const State& state, int cell, std::span<double> slopes) override {
    std::ranges::fill(slopes, 0.0);
    slopes.back() = 2.0 / state.temperature[at(cell)];
  }

 private:
  std::vector<CellMixing> cells_;
};

// Rates of a state, and their slopes, which differences of the rates are.
TEST_F(Mixed, RatesHaveTheirShareAndSlopes) {
  WarmMixing mixing(box.mesh);
  State state = hot();
  ReactionOperator chemistry(box.context, {}), plain(box.context, {});
  chemistry.mixBy(mixing);
  const auto ratesOf = [&](ReactionOperator& of, const State& at) {
    State::Balance rates = at.balance;
    std::ranges::fill(rates.reactions, 0.0);
    of.addRates(at, rates);
    return rates.reactions;
  };
  const auto all = ratesOf(plain, state), some = ratesOf(chemistry, state);
  const std::size_t width = n + 1;
  std::vector<double> slopes(at(box.mesh.owned) * width * width, 0.0);
  chemistry.addSlopes(state, {slopes, {}});
  State warmer = state;
  const double rise = 1e-3;
  for (std::size_t c = 0; c < warmer.temperature.size(); ++c) {
    warmer.temperature[c] += rise;
    warmer.density[c] *= state.temperature[c] / warmer.temperature[c];
  }
  const auto above = ratesOf(chemistry, warmer);
  for (int c = 0; c < box.mesh.owned; ++c) {
    const double share = std::pow(state.temperature[at(c)] / 3000.0, 2);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = at(c) * n + k;
      EXPECT_NEAR(some[i], share * all[i], 1e-12 * std::abs(all[i]));
      const double slope = slopes[at(c) * width * width + n * width + k];
      EXPECT_NEAR((above[i] - some[i]) / rise, slope, 1e-4 * std::abs(slope) + 1e-5) << k;
    }
  }
}

// Fine structures: elements and enthalpy stay, a short interval changes what the rates say, and slopes are those of the
// implicit step, which short structures are.
TEST_F(Mixed, FineStructuresReactAndMixBack) {
  const double fineTime = 1e-9, share = 0.2;
  GivenMixing mixing(box.mesh, [&](const Vector3&) { return CellMixing{share, fineTime}; });
  State state = hot();
  const State start = state;
  ReactionOperator chemistry(box.context, {}, fineCells()), plain(box.context, {});
  chemistry.mixBy(mixing);
  State::Balance rates = state.balance, all = rates;
  for (State::Balance* of : {&rates, &all}) std::ranges::fill(of->reactions, 0.0);
  chemistry.addRates(state, rates);
  plain.addRates(state, all);
  const std::size_t width = n + 1;
  std::vector<double> slopes(at(box.mesh.owned) * width * width, 0.0), ofAll = slopes;
  chemistry.addSlopes(state, {slopes, {}});
  plain.addSlopes(state, {ofAll, {}});
  const double dt = fineTime;
  chemistry.advance(state, 0.0, dt);
  for (int c = 0; c < box.mesh.owned; ++c) {
    double fastest = 0.0, steepest = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      fastest = std::max(fastest, std::abs(all.reactions[at(c) * n + k]));
      steepest = std::max(steepest, std::abs(ofAll[at(c) * width * width + n * width + k]));
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = at(c) * n + k;
      EXPECT_NEAR(rates.reactions[i], share * all.reactions[i], 0.05 * fastest);
      EXPECT_NEAR((state.Y[i] - start.Y[i]) / dt * start.density[at(c)], rates.reactions[i], 1e-6 * fastest);
      const std::size_t s = at(c) * width * width + n * width + k;
      EXPECT_NEAR(slopes[s], share * ofAll[s], 0.1 * steepest);
    }
    EXPECT_NEAR(gas.thermo.enthalpyMass(state.temperature[at(c)], {&state.Y[at(c) * n], n}), start.enthalpy[at(c)],
                1e-6);
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e) {
      double before = 0.0, after = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double moles = gas.mechanism.atoms(k, e) / gas.mechanism.molecularWeights()[k];
        before += moles * start.Y[at(c) * n + k];
        after += moles * state.Y[at(c) * n + k];
      }
      EXPECT_NEAR(after, before, 1e-12 * (before + 1.0));
    }
  }
}

// Long against what they mix in, an interval is taken in parts: as in many short ones.
TEST_F(Mixed, FineStructuresTakeLongIntervalsInParts) {
  const double fineTime = 2e-6, share = 0.5, dt = 3.9e-5, heating = 1e10;
  std::vector<double> whole = burning, parts = burning, source(n, 0.0);
  const auto cellOf = [&](std::span<double> Y) {
    CellReactor::Cell cell{{}, Y, source};
    cell.gas.temperature = 1200.0;
    cell.gas.pressure = 101325.0;
    cell.gas.enthalpy = gas.thermo.enthalpyMass(1200.0, Y);
    cell.gas.mixing = {share, fineTime};
    cell.gas.heating = heating;
    return cell;
  };
  const auto reactor = fineCells();
  std::vector<CellReactor::Result> results(1);
  CellReactor::Cell cell = cellOf(whole);
  reactor->advance({&cell, 1}, dt, results);
  const double steps = results[0].steps, temperature = results[0].temperature;
  const int count = 20;  // tau*/chi is a tenth of the interval, parts are half of it
  cell = cellOf(parts);
  for (int i = 0; i < count; ++i) {
    reactor->advance({&cell, 1}, dt / count, results);
    cell.gas.temperature = results[0].temperature;
    cell.gas.firstStep = results[0].firstStep;
    cell.gas.enthalpy += dt / count * heating;
  }
  EXPECT_GT(steps, 19.0);
  EXPECT_NEAR(results[0].temperature, temperature, 1e-6 * temperature);
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(whole[k], parts[k], 1e-9);
}

// Cells that go together with their neighbours take their shares along.
TEST_F(Mixed, CoupledCellsReactAtTheirShares) {
  CoupledCells cells(n);
  CoupledCells::Cell cell;
  cell.mass = 1e-6;
  cell.pressure = 101325.0;
  cell.temperature = cell.referenceTemperature = 1200.0;
  cell.enthalpy = gas.thermo.enthalpyMass(1200.0, burning);
  cell.Y = cell.reference = burning;
  cell.brought = cell.reacts = std::vector<double>(n, 0.0);
  cell.mixing = {0.3, 2e-6};
  cells.add(cell);
  cells.gather(MPI_COMM_SELF);
  int asked = 0;
  const auto react = [&](std::span<CoupledCells::Reacting> all, double) {
    for (const CoupledCells::Reacting& of : all) {
      ++asked;
      EXPECT_EQ(of.gas.mixing.reactingShare, 0.3);
      EXPECT_EQ(of.gas.mixing.fineTime, 2e-6);
    }
  };
  cells.advance(MPI_COMM_SELF, react, gas.thermo, 1e-6, 2);
  EXPECT_EQ(asked, 2);
}

// A shear of which epsilon can be made, and what the history tells of a heat release that is given.
TEST_F(Mixed, OperatorsTellOfEddiesAndHeat) {
  const double shear = 500.0, energy = 2.0, eddies = 1.5e-3;
  const auto model = std::make_shared<PointwiseModel<StillEddies>>();
  State state = box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3& x) {
                                return Box::Local{{0.0, shear * x[0]}, 1200.0, burning};
                              });
  GasProperties properties;
  properties.update(box.context, state);
  TurbulenceOperator turbulence(box.context, state, model, properties);
  turbulence.setStart(state, {5e-5, eddies, energy});
  turbulence.setDiffusivities(state);
  for (int c = 0; c < box.mesh.owned; ++c) {
    if (std::abs(box.mesh.centre[at(c)][0] - 0.004) > 0.002) continue;
    const Eddies own = turbulence.eddies(state, c, false), ofShear = turbulence.eddies(state, c, true);
    EXPECT_NEAR(own.energy, energy, 1e-12);
    EXPECT_NEAR(own.dissipation, 0.09 * energy * energy / eddies, 1e-9);
    EXPECT_NEAR(own.eddyViscosity, eddies, 1e-12);
    EXPECT_NEAR(own.viscosity, properties.viscosity[at(c)] / state.density[at(c)], 1e-15);
    // Planes of symmetry stop the gas across them, which adds to the shear.
    const double all = std::sqrt(ofShear.dissipation / eddies);
    EXPECT_GT(all, (1.0 - 1e-9) * shear);
    EXPECT_LT(all, 4.0 * shear);
    EXPECT_NEAR(ofShear.energy, eddies * all / 0.3, 1e-9);
  }
  // Heat where x is above the middle, and some that is taken below it.
  const auto heat = [&](const State&) {
    std::vector<double> all;
    for (int c = 0; c < box.mesh.owned; ++c) all.push_back(box.mesh.centre[at(c)][0] > 0.004 ? 2.0 : -1.0);
    return all;
  };
  CombustionOperator::Options options;
  options.mixingTime = MixingTime::Integral;
  for (const double constant : {0.3, 1e6}) {
    options.mixingConstant = constant;
    CombustionOperator combustion(box.context, options, turbulence, heat);
    combustion.endSweep(state);
    const std::vector<double> told = combustion.historyValues(state);
    const double share = combustion.present()[0].reactingShare;
    EXPECT_NEAR(told[0], share, 1e-12 * share);
    EXPECT_NEAR(told[1], share, 1e-12 * share);
    EXPECT_NEAR(told[2], 1.0 / share - 1.0, 1e-9 / share);
    EXPECT_EQ(told[3], constant > 1.0 ? 1.0 : 0.0);
    EXPECT_EQ(told[4], 0.0);
  }
  std::ranges::fill(state.eddyViscosity, 1e-7);
  CombustionOperator weak(box.context, options, turbulence, heat);
  weak.endSweep(state);
  EXPECT_EQ(weak.historyValues(state)[4], 1.0);
  EXPECT_EQ(weak.present()[0].reactingShare, 1.0);
}

// One cell through which gas flows, of A that becomes B in eddies that stay: Y_in - Y = t k kappa Y with kappa =
// 1/(1 + tau_mix k Y), t the time that gas takes through it; of fine structures Y_in - Y = t chi (1 - e^(-k tau*))
// Y/tau*.
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
