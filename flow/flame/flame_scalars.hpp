// The scalars of a flame in a gas that is held: soot in a flame that does not feel it yet. The same equations as in
// FlameEquations, with blocks of the scalars alone, and reactions and diffusion of the gas evaluated once.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"
#include "numerics/block_tridiagonal.hpp"

namespace lampblack::flow {

class FlameScalars : public NewtonSystem {
 public:
  // `equations` has the grid of `flame`; it serves as workspace as long as this object is used.
  FlameScalars(FlameEquations& equations, const FlameProfile& flame);

  [[nodiscard]] std::vector<double> start() const;  // the scalars of the flame
  void put(std::span<const double> x, FlameProfile& flame) const;

  [[nodiscard]] std::size_t size() const override;
  void residual(std::span<const double> x, std::span<double> F) override;
  void beginStep() override { valuesAreChosen_ = false; }
  void timeWeights(std::span<const double> x, std::span<double> M) override;
  [[nodiscard]] bool factorise(std::span<const double> x, double inverseTimeStep) override;
  void solve(std::span<double> b) override { matrix_.solve(b); }
  void bounds(std::span<double> lower, std::span<double> upper) const override;
  void correct(std::span<const double> x, std::span<double> trial) const override;
  void scales(std::span<const double> x, std::span<double> scale) const override;
  [[nodiscard]] std::string nameOf(std::size_t unknown) const override;

 private:
  void evaluate(std::span<const double> x);
  void fillRow(std::size_t i, double inverseTimeStep);

  FlameEquations::Data& flame_;
  std::size_t scalars_;
  BlockTridiagonal matrix_;
  bool valuesAreChosen_ = false;
  std::vector<double> jacobian_, concentrations_, densities_;
};

}  // namespace lampblack::flow
