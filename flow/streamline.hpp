// Paths of particles through a frozen flow: the gas velocity plus thermophoresis, bilinear between cell centres, traced
// by the second-order midpoint rule. The whole flow is held in natural order on every rank, so that any rank can trace
// any path and finds the same one, to the last bit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "core/rooms.hpp"
#include "flow/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// Where a point lies between four cell centres, and their weights.
struct BilinearPoint {
  std::array<std::size_t, 4> cell;
  std::array<double, 4> weight;
  [[nodiscard]] double of(std::span<const double> field, int components = 1, int component = 0) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += weight[i] * field[cell[i] * components + component];
    return sum;
  }
};

struct PathPoint {
  double time;                     // s
  std::array<double, 2> position;  // m
  BilinearPoint place;
  double divergence;  // 1/s, of the particles' velocity
};

class Streamlines {
 public:
  // Whether they can be traced on a mesh: a plane one that is a whole box.
  static bool isPossible(const Mesh& mesh);

  // Collective. InputError where that is not so. `thermophoresis` is the coefficient K of the drift velocity -K
  // (mu/rho) grad T / T.
  Streamlines(const Mesh& mesh, const State& state, const GasProperties& properties, double thermophoresis);

  // Path from `start` until it leaves the domain or `duration` has passed, one point every `timeStep`.
  [[nodiscard]] std::vector<PathPoint> trace(std::array<double, 2> start, double timeStep, double duration) const;

  [[nodiscard]] BilinearPoint locate(const std::array<double, 2>& position) const;
  [[nodiscard]] std::span<const double> velocity() const { return velocity_; }  // of the particles, 2 a cell

 private:
  [[nodiscard]] bool inside(const std::array<double, 2>& position) const;
  [[nodiscard]] std::array<double, 2> velocityAt(const std::array<double, 2>& position) const;
  void computeDivergence();

  const Mesh& mesh_;
  std::array<std::vector<double>, 2> centre_;  // of the cells along each axis
  std::vector<double> velocity_, divergence_;
};

}  // namespace lampblack::flow
