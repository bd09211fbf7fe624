// What particles of a cell see of its faces in a part of a step: of the sources of EnsembleTransport alone.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"
#include "coupling/ensemble_transport.hpp"
#include "flow/boundaries/wall_flux.hpp"

namespace lampblack::coupling {

// floor(log2(x)) of a normal x above zero.
inline int exponentOf(double x) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52U) - 1023;
}

// Where a volume (m3) lies between powers of two, 2^(first + node): straight between them.
struct Between {
  std::size_t node;
  double part;
};
[[nodiscard]] inline Between between(double volume, int first, std::size_t nodes) {
  const int exponent = exponentOf(volume), node = exponent - first;
  if (node < 0) return {0, 0.0};
  if (node > static_cast<int>(nodes) - 2) return {nodes - 2, 1.0};
  // 1 + part: the same digits with the exponent of one.
  constexpr std::uint64_t one = 1023ULL << 52U, digits = (1ULL << 52U) - 1U;
  const double scaled = std::bit_cast<double>((std::bit_cast<std::uint64_t>(volume) & digits) | one);
  return {static_cast<std::size_t>(node), scaled - 1.0};
}

// One of a cell's faces, as its particles see it, in one part of a step.
struct EnsembleTransport::Side {
  int face = 0, beyond = -1;                // the cell on the other side, or -1
  std::array<double, classes> convected{};  // probability to go with the gas
  std::array<double, classes> diffused{};   // factor of `diffusion`: o
  std::array<double, nodes> diffusion{};    // times d^2, m2: at the nodes
  bool diffuses = false;
  // A wall that takes particles: `drift` is the probability to drift to it with the value of the cell, or below zero;
  // `convected` how much more of it particles have that follow the slope in the cell.
  bool isWall = false;
  double drift = 0.0;
  std::array<bool, classes> isLimited{};  // whether convected or diffused is

  // To a wall: of a particle of that volume and class, and no less than that of any up to the next node.
  [[nodiscard]] double toWall(int k, const Between& at, double perSquare) const {
    const double through =
        diffuses ? perSquare * (diffusion[at.node] + at.part * (diffusion[at.node + 1] - diffusion[at.node])) : 0.0;
    return takenByWall(drift, through) + outsideWallLayer(drift, through) * convected[k];
  }
  [[nodiscard]] double mostToWall(int k, std::size_t node, double perSquare) const {
    const double through =
        diffuses ? perSquare * std::max(diffusion[node], diffusion[std::min(node + 1, nodes - 1)]) : 0.0;
    return takenByWall(drift, through) + std::max(convected[k], 0.0);
  }
};

struct EnsembleTransport::Leaving {
  int face = 0;         // local
  int cell = 0;         // local, where it comes to
  std::size_t row = 0;  // in leavingRows_, the number per metre depth or radian
  int next = -1;        // that comes through the face to the same side
};

}  // namespace lampblack::coupling
