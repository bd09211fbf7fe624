// Cells that react at a share of their rates, in work sharing, coupled with others, and as fine structures.
#include <gtest/gtest.h>

#include "combustion_fixture.hpp"
#include "core/group_failure.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/models/combustion/fine_structure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::test {
namespace {

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

// Whoever advances them: work sharing carries the shares, to the last bit.
TEST_F(Mixed, CellsReactAtTheirShares) {
  const double dt = 2e-5;
  GivenMixing mixing(box.mesh, shareAt);
  std::vector<double> ofShared;
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
    if (isShared) ofShared = state.Y;
    EXPECT_EQ(state.Y, ofShared);
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
    double sum = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = at(c) * n + k;
      sum += some[i];
      largest = std::max(largest, std::abs(some[i]));
      EXPECT_NEAR(some[i], share * all[i], 1e-12 * std::abs(all[i]));
      const double slope = slopes[at(c) * width * width + n * width + k];
      EXPECT_NEAR((above[i] - some[i]) / rise, slope, 1e-4 * std::abs(slope) + 1e-5) << k;
    }
    EXPECT_NEAR(sum, 0.0, 1e-12 * largest);
  }
}

// Fine structures: elements and enthalpy stay, a short interval changes what the rates say, and rates and slopes of
// short ones are a share of those of the mean.
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

// Fine structures in which the gas ignites: rates sum to nothing, are those of tighter tolerances to a tenth of the
// reactor's, do not depend on the cells that are asked with one, and slopes are their differences.
TEST_F(Mixed, FineStructuresHaveTheRatesOfOneStateAndTheirSlopes) {
  const std::size_t width = n + 1;
  const auto ratesOf = [&](CellReactor& reactor, std::span<const double> temperatures, std::span<const double> Y,
                           std::span<double> slopes) {
    std::vector<double> values(temperatures.size() * n);
    std::vector<CellReactor::Asked> asked(temperatures.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
      asked[i].gas.temperature = temperatures[i];
      asked[i].gas.pressure = 101325.0;
      asked[i].gas.mixing = {0.3, i == 1 ? 0.0 : 8e-6};  // one without fine structures among them
      asked[i].Y = Y;
      asked[i].rates.values = {&values[i * n], n};
      if (!slopes.empty()) asked[i].rates.slopes = slopes.subspan(i * width * width, width * width);
    }
    reactor.rates(asked);
    return values;
  };
  const auto reactor = fineCells();
  const auto exact = std::make_unique<FineStructureCells>(
      gas.mechanism, gas.thermo,
      ConstantPressureReactor::Options{
          .relativeTolerance = 1e-10, .absoluteTolerance = 1e-16, .negligibleChange = 0.0});
  const std::vector<double> temperatures{1050.0, 1100.0, 1300.0, 1700.0, 2400.0};
  std::vector<double> slopes(temperatures.size() * width * width);
  const auto values = ratesOf(*reactor, temperatures, burning, slopes);
  const auto tight = ratesOf(*exact, temperatures, burning, {});
  // The Jacobian of each step's start, in steps that a method of third order takes with a tolerance of 1e-5.
  const double rise = 1e-3, more = 1e-7, ofFrozen = 2.0 * std::cbrt(1e-5);
  std::vector<double> warmer = temperatures, wetter = burning;
  for (double& T : warmer) T += rise;
  const std::size_t water = gas.mechanism.speciesIndex("H2O");
  wetter[water] += more;
  const auto above = ratesOf(*exact, warmer, burning, {}), beside = ratesOf(*exact, temperatures, wetter, {});
  for (std::size_t i = 0; i < temperatures.size(); ++i) {
    SCOPED_TRACE(temperatures[i]);
    if (i != 1) {
      EXPECT_EQ(ratesOf(*reactor, {&temperatures[i], 1}, burning, {}),
                std::vector<double>(&values[i * n], &values[i * n] + n));
    }
    double sum = 0.0, fastest = 0.0;
    std::array<double, 2> steepest{};  // by temperature, by the mass fraction of water
    const double* own = &slopes[i * width * width];
    const auto slope = [&](bool isOfWater, std::size_t k) { return own[(isOfWater ? water : n) * width + k]; };
    const auto difference = [&](bool isOfWater, std::size_t k) {
      return isOfWater ? (beside[i * n + k] - tight[i * n + k]) / more : (above[i * n + k] - tight[i * n + k]) / rise;
    };
    for (std::size_t k = 0; k < n; ++k) {
      sum += values[i * n + k];
      fastest = std::max(fastest, std::abs(values[i * n + k]));
      for (const bool isOfWater : {false, true})
        steepest[isOfWater] = std::max(steepest[isOfWater], std::abs(difference(isOfWater, k)));
    }
    EXPECT_NEAR(sum, 0.0, 1e-11 * fastest);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(values[i * n + k], tight[i * n + k], 1e-7 * fastest) << k;
      for (const bool isOfWater : {false, true})
        EXPECT_NEAR(slope(isOfWater, k), difference(isOfWater, k), ofFrozen * steepest[isOfWater]) << k << isOfWater;
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
  EXPECT_THROW(reactor->advance({&cell, 1}, 1.0, results), FailureInGroup);  // half a million of them
}

// The next interval begins with the step that the last one ended with, of the time of the structures: without more
// steps than without one.
TEST_F(Mixed, FineStructuresGoOnWithTheirStep) {
  const double fineTime = 1e-8;
  const std::vector<double> source(n, 0.0);
  const auto reactor = fineCells();
  std::vector<CellReactor::Result> results(1);
  const auto advance = [&](double firstStep) {
    std::vector<double> Y = burning;
    CellReactor::Cell cell{{}, Y, source};
    cell.gas.temperature = 1700.0;
    cell.gas.pressure = 101325.0;
    cell.gas.enthalpy = gas.thermo.enthalpyMass(1700.0, Y);
    cell.gas.firstStep = firstStep;
    cell.gas.mixing = {0.5, fineTime};
    reactor->advance({&cell, 1}, 0.1 * fineTime, results);
    return results[0];
  };
  const CellReactor::Result anew = advance(0.0), again = advance(anew.firstStep);
  EXPECT_GT(anew.firstStep, 1e-3 * fineTime);
  EXPECT_LT(anew.firstStep, 10.0 * fineTime);
  EXPECT_LE(again.steps, anew.steps);
  EXPECT_EQ(anew.isHandedOver, 0.0);
  EXPECT_EQ(again.isHandedOver, 0.0) << "a step too short for the quick method";
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
  const double shear = 50.0, energy = 2.0, eddies = 1.5e-3;
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
  // Eddies that dissipate nothing never mix.
  std::ranges::fill(state.eddyViscosity, eddies);
  for (std::size_t i = 1; i < state.carried.size(); i += 2) state.carried[i] = 0.0;
  options.model = CombustionOperator::Model::EddyDissipation;
  CombustionOperator fine(box.context, options, turbulence,
                          [&](const State&) { return std::vector<double>(at(box.mesh.owned)); });
  for (const CellMixing& mixing : fine.of(state)) {
    EXPECT_EQ(mixing.reactingShare, 0.0);
    EXPECT_EQ(mixing.fineTime, 0.0);
  }
  fine.endSweep(state);
  EXPECT_TRUE(std::isnan(fine.historyValues(state)[1]));
  EXPECT_EQ(fine.closingLines().at(0), "combustion: no heat is released");
}

}  // namespace
}  // namespace lampblack::test
