// Blocks of carried scalars side by side, which know nothing of each other, and what cells beside boundaries see of
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "flow/equations/face_state.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/scalar_toy.hpp"

namespace lampblack::test {
namespace {

// Particles of two sizes in a gas that is warmer than its walls, beside another block, before it and alone.
struct Beside {
  std::vector<double> particles, toy, gas, through;
};
Beside particlesBeside(bool isToyFirst, bool isToyThere, int sweeps, std::optional<Split> split,
                       bool areParticlesThere = true) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1, N2: 4");
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 400.0, air),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  sides[1].condition.isothermal = sides[1].condition.takesParticles = true;
  sides[1].condition.temperature = 350.0;
  Box box(Geometry::Planar, {uniformAxis(0.006, 6), uniformAxis(0.012, 12)}, sides, gas, split);
  ScalarToy toy;
  toy.given = {{"ymin", {.value = 3.0, .isHeld = true}}};
  toy.diffusivity = 3e-3;
  toy.source = 10.0;
  std::vector<ScalarBlock> blocks{
      takenByWalls({"soot", {{"small", "1/m^3", "", 0.55}, {"large", "1/m^3", "", 0.55}}}, box.context.boundaries)};
  // Also one that its owner moves.
  ScalarBlock others = toy.block(box.context);
  others.scalars.push_back({.name = "moved",
                            .unit = "1/m^3",
                            .description = "",
                            .thermophoresis = 0.55,
                            .isTransported = false,
                            .boundaries = blocks[0].scalars[0].boundaries});
  // And one that drifts to a wall which takes the particles, but nothing of it.
  others.scalars.push_back({.name = "drifting", .unit = "1/m^3", .description = "", .thermophoresis = 0.55});
  if (isToyThere) blocks.insert(isToyFirst ? blocks.begin() : blocks.end(), others);
  if (!areParticlesThere) std::erase_if(blocks, [](const ScalarBlock& block) { return block.owner == "soot"; });
  State state = box.stateWith(blocks, [&](const Vector3& x) {
    return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], x[1] < 0.005 ? air : fuel};
  });
  const ScalarRange soot = areParticlesThere ? state.block("soot") : ScalarRange{};
  const auto of = [&](int c, int s) { return at(c) * state.scalars.size() + at(soot.first + s); };
  std::ranges::fill(state.carried, 1.0);
  std::ranges::fill(state.carriedDiffusivity, 1e-4);
  for (int c = 0; c < box.mesh.cells; ++c)
    for (int s = 0; s < soot.count; ++s) {
      state.carried[of(c, s)] = 1.0 + std::sin(700.0 * box.mesh.centre[at(c)][0] + s) * (s + 1.0);
      state.carriedDiffusivity[of(c, s)] = s == 0 ? 2e-4 : 1e-6;
    }
  TransportOperator transport(box.context, state, {.sweeps = sweeps});
  const double dt = 1e-4;
  transport.initialise(state, dt);
  for (int i = 0; i < 4; ++i)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (isToyThere) toy.endSweep(state);
      transport.advance(state, i * dt, dt);
      transport.endSweep(state);
    }
  Beside found;
  for (int c = 0; c < box.mesh.owned; ++c)
    for (int s = 0; s < soot.count; ++s) found.particles.push_back(state.carried[of(c, s)]);
  found.gas = state.temperature;
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    for (const double flux : transport.carriedFlux(soot, face)) found.through.push_back(flux);
  if (!isToyThere) return found;
  const std::size_t moved = at(state.block("toy").first + 1), all = state.scalars.size();
  EXPECT_EQ(transport.boundaryAmounts().carriedOut[moved] + transport.boundaryAmounts().carriedIn[moved], 0.0);
  for (std::size_t c = 0; c < at(box.mesh.owned); ++c) EXPECT_EQ(state.carried[c * all + moved], 1.0);
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    if (box.context.takesParticles(face)) {
      EXPECT_EQ(transport.carriedFlux(state.block("toy"), face)[2], 0.0);
    }
  EXPECT_GT(largest(box.mesh, [&](int c) { return std::abs(state.carried[at(c) * all + moved - 1] - 1.0); }), 0.01);
  for (std::size_t c = 0; c < at(box.mesh.owned); ++c)
    for (std::size_t s = moved - 1; s < moved + 2; ++s) found.toy.push_back(state.carried[c * all + s]);
  return found;
}

TEST(ScalarBlocks, StandSideBySideAndDoNotDisturbEachOther) {
  for (const auto& split : {std::optional<Split>(), std::optional<Split>(Split{Cells::Triangles})})
    for (const int sweeps : {1, 2}) {
      SCOPED_TRACE(fmt::format("{} sweeps, {}", sweeps, split ? "triangles" : "rectangles"));
      const Beside alone = particlesBeside(false, false, sweeps, split);
      const Beside toyAlone = particlesBeside(false, true, sweeps, split, false);
      for (const bool isFirst : {false, true}) {
        const Beside beside = particlesBeside(isFirst, true, sweeps, split);
        EXPECT_EQ(beside.particles, alone.particles) << isFirst;
        EXPECT_EQ(beside.toy, toyAlone.toy) << isFirst;
        EXPECT_EQ(beside.gas, alone.gas) << isFirst;
        EXPECT_EQ(beside.through, alone.through) << isFirst;
      }
    }
}

// Cells next to an inlet fall away from it, along a line. A value there that is far above it bends the slope of the
// first cell where it is held; what is fed alone counts no further than the line leads: diffusion may have taken it
// away.
TEST(ScalarBlocks, CellsSeeWhatAnInletHolds) {
  for (const bool isHeld : {false, true}) {
    ScalarChannel channel(1e-3, 2, 4e-3, 4);
    const Box& box = channel.box;
    ScalarToy toy;
    toy.given["ymin"] = {.value = 9.0, .isHeld = isHeld};
    State state = channel.stateOf({toy.block(box.context)});
    for (int c = 0; c < box.mesh.cells; ++c)
      state.carried[at(c)] = state.density[at(c)] * (5.0 - 1e3 * box.mesh.centre[at(c)][1]);
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    for (int face = 0; face < box.mesh.interiorFaces; ++face) {
      if (box.mesh.low[at(face)] >= box.mesh.owned || std::abs(box.mesh.faceCentre[at(face)][1] - 1e-3) > 1e-6)
        continue;
      const double found = faces.carriedPerMass(face, 0, 1.0);
      EXPECT_TRUE(isHeld ? found < 3.95 : std::abs(found - 4.0) < 1e-12) << isHeld << ' ' << found;
    }
  }
}

// Amounts that fall along a line towards a wall which holds them: to something at the wall, along the line to the face;
// to nothing before the wall, no more than the cell beside it has, and nothing of a cell that has nothing.
TEST(ScalarBlocks, ACellBesideAWallGivesNoMoreThanItHas) {
  ScalarChannel channel(4e-3, 4, 2e-3, 2);
  const Box& box = channel.box;
  ScalarToy toy;
  toy.given["xmax"] = {.value = 0.0, .isHeld = true};
  State state = channel.stateOf({toy.block(box.context)});
  const auto faceValue = [&](double beside, double direction) {
    for (int c = 0; c < box.mesh.cells; ++c) {
      const double along = (3.5e-3 - box.mesh.centre[at(c)][0]) / 1e-3;  // cells from the one beside the wall
      state.carried[at(c)] = state.density[at(c)] * (beside + along);
    }
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    double found = 0.0;
    for (int face = 0; face < box.mesh.interiorFaces; ++face)
      if (box.mesh.low[at(face)] < box.mesh.owned && std::abs(box.mesh.faceCentre[at(face)][0] - 3e-3) < 1e-6)
        found = std::max(found, faces.carriedPerMass(face, 0, direction));
    MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return found;
  };
  EXPECT_NEAR(faceValue(0.6, -1.0), 1.1, 1e-12) << "0.1 at the wall";
  EXPECT_EQ(faceValue(0.0, -1.0), 0.0);
  for (const double beside : {1e-6, 0.1, 0.3}) {
    EXPECT_GE(faceValue(beside, -1.0), beside);
    EXPECT_LT(faceValue(beside, -1.0), 3.0 * beside) << beside;
  }
  // The gradient leads to zero at the wall, half a cell away: 0.6, the mean of 1 ahead and 0.2 behind, whose harmonic
  // mean is a third.
  EXPECT_NEAR(faceValue(0.3, -1.0), 0.3 + 0.5 / 3.0, 1e-12);
  EXPECT_NEAR(faceValue(0.1, 1.0), 0.6, 1e-12) << "from the other side";
}

TEST(ScalarBlocks, AreFoundByTheirOwners) {
  ScalarChannel channel(1e-3, 2, 1e-3, 4);
  const FlowContext& context = channel.box.context;
  ScalarToy toy;
  const ScalarBlock two{"two", {{"a", "1/m^3", ""}, {"b", "1/m^3", ""}}};
  const State state = channel.stateOf({two, toy.block(context)});
  EXPECT_EQ(state.block("toy").first, 2);
  EXPECT_EQ(state.block("toy").count, 1);
  EXPECT_EQ(state.block("two").first, 0);
  EXPECT_THROW((void)state.block("three"), std::logic_error);
  EXPECT_THROW(channel.stateOf({two, two}), std::logic_error);
  ScalarBlock wrong = two;
  wrong.scalars[1].boundaries.resize(2);
  EXPECT_THROW(TransportOperator(context, channel.stateOf({wrong})), std::logic_error);
  toy.given["ymax"].isHeld = true;  // an outlet
  EXPECT_THROW(TransportOperator(context, channel.stateOf({toy.block(context)})), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
