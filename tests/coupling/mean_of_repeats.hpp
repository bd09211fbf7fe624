// Means of particles that move between cells, over repeats, against a field without particles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "tests/coupling/moving_particles.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test::moving {

// The mean of a cell's moment after some steps against the same scheme for a field without particles: what a particle
// does depends on its class alone, so that the means of a class obey linear equations, of which those of repeats are a
// sample.
class MeanOfRepeats {
 public:
  void add(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) all_[k].push_back(values[k]);
  }
  // The largest |z| of all values against the expected ones, over all ranks, and their mean square.
  struct Score {
    double largest, square;
  };
  [[nodiscard]] Score against(const std::vector<double>& expected) const {
    double largest = 0.0, squares = 0.0, count = 0.0;
    for (const auto& [k, values] : all_) {
      const Sample sample = summarise(values);
      if (!(sample.standardError > 1e-9 * std::abs(sample.mean))) continue;
      const double z = (sample.mean - expected[k]) / sample.standardError;
      largest = std::max(largest, std::abs(z));
      squares += z * z;
      count += 1.0;
    }
    return {maxOverRanks(largest), sumOverRanks(squares) / sumOverRanks(count)};
  }

 private:
  std::map<std::size_t, std::vector<double>> all_;
};

// A field without particles by the linear scheme on a uniform box, in which the ratio of face value to cell value is
// kept between 0 and 2: upwind values in the middle of each of these times, central differences, explicit diffusion.
inline std::vector<double> fieldAfter(const Moving& m, std::vector<double> field, const std::vector<double>& times,
                                      double diffusivity) {
  const Mesh& mesh = m.box.mesh;
  std::vector<double> slope(at(mesh.cells) * 2), boundary(at(mesh.boundaryFaces()));
  const bool take = m.box.context.boundaries[0].takesParticles;
  const std::vector<BoundaryData> known(boundary.size(), take ? BoundaryData::Nothing : BoundaryData::ZeroSlope);
  const Gradient gradient(mesh);
  HaloExchange halo(mesh);
  for (const double dt : times) {
    halo.update(field, 1);
    gradient.compute(field, boundary, 1, slope, known);
    halo.update(slope, 2);
    std::vector<double> next = field;
    for (int face = 0; face < (take ? mesh.faces : mesh.interiorFaces); ++face) {
      const int low = mesh.low[at(face)], high = mesh.high[at(face)];
      const double flux = (m.state.massFlux[at(face)] + 0.55 * m.drift[at(face)]) / m.state.density[0];
      const int up = flux > 0.0 || high < 0 ? low : high;
      double value = field[at(up)];
      for (int axis = 0; axis < 2; ++axis) {
        const double from = mesh.faceCentre[at(face)][at(axis)] - mesh.centre[at(up)][at(axis)] -
                            0.5 * dt * m.state.velocity[at(2 * up + axis)];
        value += slope[at(2 * up + axis)] * from;
      }
      value = std::clamp(value, 0.0, 2.0 * field[at(up)]);
      if (high < 0) {  // J = v c/(1 - e^-P), and coth(P/2) - 2/P of what c changes to the wall
        const double P = flux / (diffusivity * mesh.area[at(face)] / mesh.distance[at(face)]);
        const double outside = P > 0.0 ? 1.0 / std::tanh(0.5 * P) - 2.0 / P : 0.0;
        const double all =
            P == 0.0 ? diffusivity * mesh.area[at(face)] / mesh.distance[at(face)] : flux / (1.0 - std::exp(-P));
        const double taken = all * field[at(low)] + flux * outside * (value - field[at(low)]);
        next[at(low)] -= dt * taken / mesh.volume[at(low)];
        continue;
      }
      const double moved = dt * (flux * value + diffusivity * mesh.area[at(face)] / mesh.distance[at(face)] *
                                                    (field[at(low)] - field[at(high)]));
      next[at(low)] -= moved / mesh.volume[at(low)];
      next[at(high)] += moved / mesh.volume[at(high)];
    }
    field = std::move(next);
  }
  field.resize(at(mesh.owned));
  return field;
}

// In halves of steps.
inline std::vector<double> fieldAfter(const Moving& m, std::vector<double> field, double step, double diffusivity,
                                      int steps) {
  return fieldAfter(m, std::move(field), std::vector<double>(at(2 * steps), 0.5 * step), diffusivity);
}

}  // namespace lampblack::test::moving
