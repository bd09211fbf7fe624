// What the tests of combustion in turbulence share: a gas A that becomes B, eddies that are given, and shares that are.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "flow/models/combustion/combustion_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace lampblack::test {

// Two gases of the same weight and heat, and reactions between them.
inline Mechanism twoGases(const std::vector<std::string>& reactions) {
  std::string text =
      "phases:\n  - {name: gas, thermo: ideal-gas, kinetics: bulk, elements: [N], species: [A, B]}\nspecies:\n";
  for (const char* name : {"A", "B"})
    text += fmt::format(
        "  - name: {}\n    composition: {{N: 2}}\n"
        "    transport: {{model: gas, geometry: linear, diameter: 3.621, well-depth: 97.53}}\n"
        "    thermo: {{model: constant-cp, T0: 298.15 K, h0: 0 J/mol, s0: 191.6 J/mol/K, cp0: 29.1 J/mol/K}}\n",
        name);
  text += "reactions:\n";
  for (const std::string& reaction : reactions) text += "  - " + reaction + "\n";
  const ScratchFolder scratch;
  return Mechanism::fromFile(scratch.file("two_gases.yaml", text));
}

inline std::string becomes(double rate, bool isDuplicate = false, const std::string& equation = "A => B") {
  return fmt::format("{{equation: {}, rate-constant: {{A: {:.17g}, b: 0, Ea: 0}}{}}}", equation, rate,
                     isDuplicate ? ", duplicate: true" : "");
}

// Turbulence with a k and an epsilon that nothing changes.
struct StillEddies {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  [[nodiscard]] std::string name() const { return "still"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const {
    return {{"turbulent_kinetic_energy", "m^2/s^2", ""}, {"turbulent_dissipation", "m^2/s^3", ""}};
  }
  [[nodiscard]] static double dissipation(std::span<const double> variables) { return variables[1]; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.energy, 0.09 * stream.energy * stream.energy / stream.eddyViscosity};
  }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.eddyViscosity = 0.09 * cell.values[0] * cell.values[0] / cell.values[1],
            .diffusivity = {cell.viscosity, cell.viscosity}};
  }
};

// Of each owned cell what a function of its place says.
class GivenMixing final : public MixingModel {
 public:
  template <typename Of>
  GivenMixing(const Mesh& mesh, const Of& mixingAt) {
    for (int c = 0; c < mesh.owned; ++c) cells_.push_back(mixingAt(mesh.centre[at(c)]));
  }
  [[nodiscard]] std::span<const CellMixing> present() const override { return cells_; }
  std::span<const CellMixing> of(const State&) override { return cells_; }

 private:
  std::vector<CellMixing> cells_;
};

}  // namespace lampblack::test
