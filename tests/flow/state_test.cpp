// What operators tell the transport of a flow.
#include "flow/state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/state_backup.hpp"
#include "flow/field_registry.hpp"
#include "flow/stepping/finite_state.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(StateBalance, AddsWhatIsExchangedToTheReactions) {
  Box box(Geometry::Planar, {uniformAxis(1e-3, 4), uniformAxis(1e-3, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  const std::size_t n = box.gas.mechanism.numSpecies();
  State state(box.mesh, n, {});
  auto& balance = state.balance;
  for (std::size_t i = 0; i < balance.reactions.size(); ++i) balance.reactions[i] = static_cast<double>(i);
  // A second species gets its place beside the first; two that exchange the same one add up.
  balance.exchange(1, 4, 0.5);
  balance.exchange(1, 4, 0.25);
  balance.exchange(0, 2, 8.0);
  balance.exchange(1, 2, 2.0);
  std::vector<double> rate(n);
  for (std::size_t cell = 0; cell < 3; ++cell) {
    balance.ofSpecies(cell, rate);
    for (std::size_t k = 0; k < n; ++k) {
      const double exchanged = k == 4 && cell == 1 ? 0.75 : k == 2 && cell < 2 ? (cell == 0 ? 8.0 : 2.0) : 0.0;
      EXPECT_EQ(rate[k], static_cast<double>(cell * n + k) + exchanged) << "cell " << cell << ", species " << k;
    }
  }
  balance.clear();
  balance.ofSpecies(1, rate);
  EXPECT_EQ(rate[4], static_cast<double>(n + 4));  // the reactions stay
}

// What has values of cells is known to the neighbours, and goes on after a restart but for what operators tell anew;
// means of a step are of what can be averaged.
TEST(FieldRegistry, DeclaresWhatIsDoneWithEachField) {
  std::vector<std::string> archived;
  for (const FieldDeclaration& field : fieldRegistry()) {
    SCOPED_TRACE(field.name);
    const bool isOfCells =
        field.kind == FieldDeclaration::Kind::Intensive || field.kind == FieldDeclaration::Kind::PerVolume;
    EXPECT_NE(field.values == nullptr, field.rates == nullptr);
    EXPECT_EQ(field.isInHalo, isOfCells);
    EXPECT_EQ(field.rates != nullptr, field.kind == FieldDeclaration::Kind::Rate);
    EXPECT_TRUE(field.archived || field.kind == FieldDeclaration::Kind::Rate);
    EXPECT_TRUE(field.isChecked || !(field.isAveraged || field.isWritten || field.isWatched));
    if (field.archived) archived.emplace_back(field.archived);
  }
  std::ranges::sort(archived);
  EXPECT_EQ(std::ranges::adjacent_find(archived), archived.end());
}

// Sizes by width and place, for a flow that swirls and carries two owners' scalars, and for one that does neither.
TEST(FieldRegistry, GivesTheStateItsSizesAndItsHalo) {
  Box box(Geometry::Axisymmetric, {uniformAxis(1e-3, 4), uniformAxis(1e-3, 6)},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
           side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)});
  const std::size_t n = box.gas.mechanism.numSpecies(), cells = at(box.mesh.cells), owned = at(box.mesh.owned);
  const ScalarBlock one{"one", {{"a", "1/m^3", ""}}}, two{"two", {{"b", "1/m^3", ""}, {"c", "1/m^3", ""}}};
  State state(box.mesh, n, {one, two}, true);
  EXPECT_EQ(state.velocity.size(), 2 * cells);
  EXPECT_EQ(state.Y.size(), n * cells);
  EXPECT_EQ(state.swirl.size(), cells);
  EXPECT_EQ(state.carried.size(), 3 * cells);
  EXPECT_EQ(state.carriedDiffusivity.size(), 3 * cells);
  EXPECT_EQ(state.massFlux.size(), at(box.mesh.faces));
  EXPECT_EQ(state.balance.reactions.size(), n * owned);
  EXPECT_EQ(state.balance.carried.size(), 3 * owned);
  const State still(box.mesh, n, {});
  EXPECT_TRUE(still.swirl.empty() && still.carried.empty() && still.balance.carried.empty());

  for (const FieldDeclaration& field : fieldRegistry()) {
    const auto width = at(field.widthIn(state));
    for (std::size_t i = 0; i < field.of(state).size(); ++i)
      field.of(state)[i] = i < owned * width ? static_cast<double>(box.mesh.naturalCell[i / width]) : -1.0;
  }
  state.updateHalo(box.halo);
  for (const FieldDeclaration& field : fieldRegistry())
    for (std::size_t i = 0; field.isInHalo && i < field.of(state).size(); ++i)
      ASSERT_EQ(field.of(state)[i], box.mesh.naturalCell[i / at(field.widthIn(state))]) << field.name;
}

// What is kept goes back to where it was; the rest is left alone.
TEST(FieldRegistry, KeepsWhatIsArchived) {
  Box box(Geometry::Axisymmetric, {uniformAxis(1e-3, 4), uniformAxis(1e-3, 6)},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
           side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)});
  State state(box.mesh, box.gas.mechanism.numSpecies(), {{"one", {{"a", "1/m^3", ""}, {"b", "1/m^3", ""}}}}, true);
  const auto fill = [&](double sign) {
    for (const FieldDeclaration& field : fieldRegistry())
      for (std::size_t i = 0; i < field.of(state).size(); ++i)
        field.of(state)[i] = sign * (1.0 + static_cast<double>(i));
  };
  StateBackup backup(box.mesh.owned, box.mesh.faces);
  const auto owner = [&](StateArchive& archive) { state.saveOrLoad(archive); };
  fill(1.0);
  backup.save(owner);
  fill(-1.0);
  backup.restore(owner);
  for (const FieldDeclaration& field : fieldRegistry()) {
    const bool isOfFaces = field.kind == FieldDeclaration::Kind::FaceFlux;
    const std::size_t own = at(isOfFaces ? box.mesh.faces : box.mesh.owned) * at(field.widthIn(state));
    for (std::size_t i = 0; i < field.of(state).size(); ++i)
      ASSERT_EQ(field.of(state)[i], (field.archived && i < own ? 1.0 : -1.0) * (1.0 + static_cast<double>(i)))
          << field.name << ' ' << i;
  }
}

// Every value that has to be a number is looked at, and the message names it.
TEST(FieldRegistry, FindsWhatIsNoNumber) {
  Box box(Geometry::Planar, {uniformAxis(1e-3, 4), uniformAxis(1e-3, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  State state(box.mesh, box.gas.mechanism.numSpecies(), {{"one", {{"soot_number", "1/m^3", ""}}}});
  for (auto* all : {&state.Y, &state.carried, &state.massFlux, &state.pressure}) std::ranges::fill(*all, 0.5);
  std::vector<std::string> names;
  for (const FieldDeclaration& field : fieldRegistry()) {
    if (!field.isChecked || field.widthIn(state) == 0) continue;
    EXPECT_TRUE(isFinite(box.mesh, state));
    field.of(state).front() = std::nan("");
    EXPECT_FALSE(isFinite(box.mesh, state)) << field.name;
    try {
      raiseNotFinite(box.context, state);
      ADD_FAILURE() << field.name;
    } catch (const NumericsError& error) {
      names.push_back(std::string(error.what()).substr(0, std::string(error.what()).find(" is ")));
    }
    field.of(state).front() = 1.0;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"the temperature", "the density", "the velocity", "the pressure",
                                             "the enthalpy", "the mass fraction of " + box.gas.mechanism.speciesName(0),
                                             "the soot_number", "the mass flux"}));
}

}  // namespace
}  // namespace lampblack::test
