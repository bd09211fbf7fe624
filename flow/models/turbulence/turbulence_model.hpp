// Models of Reynolds-averaged turbulence: what is known of a cell, what a model makes of it, and the table of all
// models. A model is a class with the members that PointwiseModel names and a row of turbulenceModels().
//
// Each model carries one or two variables per kg of gas (ScalarBlock). Their rates are parted into a source and a sink
// in proportion to what there is, which the step takes implicitly, so that what is positive stays positive. Sources of
// the equations: docs/theory/turbulence.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/boundaries/gas_variation.hpp"
#include "flow/scalar_block.hpp"

namespace lampblack::flow {

struct TurbulentCell {
  static constexpr std::size_t most = 2;  // variables of a model

  double strain = 0.0;         // 1/s, sqrt(2 S_ij S_ij - 2/3 (div u)^2): dilatation has no part in it
  double vorticity = 0.0;      // 1/s, sqrt(2 W_ij W_ij)
  double dilatation = 0.0;     // 1/s, div u
  double stretching = 0.0;     // 1/s^3, |W_ij W_jk S_ki|, S without half of the dilatation
  double strainShape = 0.0;    // S_ij S_jk S_ki/(S_ij S_ij)^(3/2) of the strain without dilatation
  double distance = 0.0;       // m, from the nearest wall
  double viscosity = 0.0;      // m^2/s, kinematic, molecular
  double strainBend = 0.0;     // 1/m^2, lap S/S
  Vector3 strainSlope{};       // 1/m, grad S/S
  Vector3 densityGradient{};   // 1/m, of the density over the density
  double buoyancy = 0.0;       // 1/s^2, -g . grad rho/(rho Sc_t), by which eddies gain k; zero where it is not wanted
  double buoyancyShare = 0.0;  // of that, what makes epsilon: tanh(|u along g|/|u across g|)
  std::array<double, most> values{};
  std::array<Vector3, most> gradients{};
  // Of the second variable's: what differences see beside the products of the gradients (Gradient::Beyond).
  double productBeyond = 0.0, squareBeyond = 0.0;
  // Of models of one variable that go by the strain's slope: the neighbours towards which the variable rises and falls
  // most steeply; none where no neighbour has more, or less.
  struct Neighbour {
    double value = 0.0, distance = 0.0;  // distance: m, between the centres, or to that of a boundary's face
  };
  bool knowsNeighbours = false;
  std::optional<Neighbour> above{}, below{};
};

// grad ln S . grad of the first variable, in its unit over m^2: where the neighbours are known, by no more than twice
// what the slopes towards those above and below say, as slopes of convection are limited. A term nu~ grad ln S . grad
// nu~ carries nu~ towards the lower strain and makes none where nu~ is largest; slopes over three values say otherwise
// beside a wall, where nu~ falls to zero in a layer thinner than the cell.
[[nodiscard]] double slopeAlongStrain(const TurbulentCell& cell);

// What a model of two equations carries beside k.
enum class SecondVariable : char { None, OmegaRoot, Dissipation };

struct TurbulentRates {
  double eddyViscosity = 0.0;                                // m^2/s
  std::array<double, TurbulentCell::most> diffusivity{};     // m^2/s, molecular part included
  std::array<double, TurbulentCell::most> source{}, sink{};  // the variable's unit over s; 1/s, not below zero

  // A rate that stays explicit where it adds, and is implicit where it takes from a value above zero.
  void add(std::size_t variable, double rate, double value) {
    if (rate < 0.0 && value > 0.0)
      sink[variable] -= rate / value;
    else
      source[variable] += rate;
  }
};

// 1/s, of a gas that moves as one.
inline constexpr double leastStrain = 1e-16;

// tanh(x^4), by which models pass from the layers at walls to what is beyond them.
[[nodiscard]] inline double layerShare(double x) {
  const double most = std::min(x, 10.0), square = most * most;
  return std::tanh(square * square);
}

// Of gas that comes in, or that a flow starts from.
struct FreeStream {
  double viscosity = 0.0;      // m^2/s, kinematic, molecular
  double eddyViscosity = 0.0;  // m^2/s
  double energy = 0.0;         // m^2/s^2, k; of models that know it
  // k and epsilon (m^2/s^3) over a boundary, in place of the two values above; empty: the same everywhere.
  FieldFunction energyAt = {}, dissipationAt = {};

  [[nodiscard]] bool varies() const { return static_cast<bool>(energyAt); }
  // At a place. InputError where k or epsilon is not above zero.
  [[nodiscard]] FreeStream at(const Vector3& place) const;
};

class TurbulenceModel {
 public:
  struct Variable {
    std::string name, unit, description;
    double wallDiffusivity = 1.0;  // its diffusivity at a wall over the kinematic viscosity (CarriedScalar)
  };

  virtual ~TurbulenceModel() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::vector<Variable> variables() const = 0;  // zero at walls that are resolved
  [[nodiscard]] virtual bool needsWallDistance() const = 0;
  [[nodiscard]] virtual bool needsStrainGradient() const = 0;
  // The law of the wall that stands for the layers beside walls, where they are not resolved: the first variable is k,
  // which has no slope there, the second its dissipation or omega^(-1/2), which is that of the law in the cells beside
  // them.
  [[nodiscard]] virtual WallLaw wallLaw() const { return WallLaw::None; }
  [[nodiscard]] bool usesWallLaw() const { return wallLaw() != WallLaw::None; }
  // beta of omega = 6 nu/(beta y^2) beside a wall, of epsilon that of C_mu k omega; 0: the model knows no blended law.
  [[nodiscard]] virtual double wallBeta() const { return 0.0; }
  [[nodiscard]] virtual SecondVariable secondVariable() const { return SecondVariable::None; }
  // Its first variable is k then.
  [[nodiscard]] bool knowsEnergy() const { return variables().size() > 1; }
  // m^2/s^3, by which k decays; nothing of models that do not know k.
  [[nodiscard]] virtual std::optional<double> dissipation(std::span<const double> variables) const = 0;
  [[nodiscard]] virtual std::array<double, TurbulentCell::most> freeStream(const FreeStream& stream) const = 0;
  virtual void evaluate(std::span<const TurbulentCell> cells, std::span<TurbulentRates> rates) const = 0;
};

// A model of what is known of one cell. `blendsLayers`: it has the blended law of the wall, as it can with a
// `wallBeta`.
template <class Kernel>
class PointwiseModel : public TurbulenceModel {
 public:
  explicit PointwiseModel(Kernel kernel = {}, bool blendsLayers = false)
      : kernel_(kernel), blendsLayers_(blendsLayers) {}
  [[nodiscard]] std::string name() const override { return kernel_.name(); }
  [[nodiscard]] std::vector<Variable> variables() const override { return kernel_.variables(); }
  [[nodiscard]] bool needsWallDistance() const override { return Kernel::needsWallDistance; }
  [[nodiscard]] bool needsStrainGradient() const override { return Kernel::needsStrainGradient; }
  [[nodiscard]] WallLaw wallLaw() const override {
    if constexpr (requires { Kernel::needsWallLaw; }) return WallLaw::TwoLayers;
    return blendsLayers_ ? WallLaw::Blended : WallLaw::None;
  }
  [[nodiscard]] double wallBeta() const override {
    if constexpr (requires { Kernel::wallBeta; }) return Kernel::wallBeta;
    return 0.0;
  }
  [[nodiscard]] SecondVariable secondVariable() const override {
    if constexpr (requires { Kernel::second; }) return Kernel::second;
    return SecondVariable::None;
  }
  [[nodiscard]] std::array<double, TurbulentCell::most> freeStream(const FreeStream& stream) const override {
    return kernel_.freeStream(stream);
  }
  [[nodiscard]] std::optional<double> dissipation(std::span<const double> variables) const override {
    if constexpr (requires { Kernel::dissipation(variables); }) return Kernel::dissipation(variables);
    return {};
  }
  void evaluate(std::span<const TurbulentCell> cells, std::span<TurbulentRates> rates) const override {
    for (std::size_t c = 0; c < cells.size(); ++c) rates[c] = kernel_.at(cells[c]);
  }

 private:
  Kernel kernel_;
  bool blendsLayers_;
};

// What a deck may choose of a model.
struct TurbulenceChoices {
  bool blendsLayers = false;                  // the blended law of the wall, of models of two equations
  std::optional<double> dissipationSource{};  // C_1 of k-epsilon, in place of its own
};

struct TurbulenceRow {
  const char* name;  // in decks
  const char* description;
  std::shared_ptr<const TurbulenceModel> (*make)(const TurbulenceChoices& choices);
};
[[nodiscard]] std::span<const TurbulenceRow> turbulenceModels();
// InputError for a name that no row has, for the blended law of a model of one equation, and for C_1 of one that has
// none.
[[nodiscard]] std::shared_ptr<const TurbulenceModel> turbulenceModel(std::string_view name,
                                                                     const TurbulenceChoices& choices = {});

// The root X of X^4 / (X^3 + c^3) = ratio: of models whose eddy viscosity is X nu f with f = X^3/(X^3 + c^3).
[[nodiscard]] double dampedRatio(double ratio, double c);

}  // namespace lampblack::flow
