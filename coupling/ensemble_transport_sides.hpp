// What particles of a cell see of its faces in a part of a step: of the sources of EnsembleTransport alone.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

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

// What the chances to leave of a particle depend on.
struct EnsembleTransport::Size {
  int ofClass;
  Between at;        // of its volume of mobility
  double perSquare;  // of its diameter of mobility, 1/m2
};

inline int EnsembleTransport::classOf(double volume) {
  return std::clamp((exponentOf(volume) - smallest) / 3, 0, classes - 1);
}

// One of a cell's faces, as its particles see it, in one part of a step. What depends on the particles stands in
// SideLanes, in the same place.
struct EnsembleTransport::Side {
  int face = 0, beyond = -1;  // the cell on the other side, or -1
  bool diffuses = false;
  // A wall that takes particles: `drift` is the probability to drift to it with the value of the cell, or below zero;
  // `convected` how much more of it particles have that follow the slope in the cell.
  bool isWall = false;
  double drift = 0.0;
  double eddies = 0.0;                    // before its layer: resistance of the eddies, over a probability
  std::array<bool, classes> isLimited{};  // whether convected or diffused is
};

// The sides of a cell beside one another, for loops that are compiled to vector instructions. A class that takes
// several parts together has so many times these probabilities. Of classes that move, and nodes that these ask for.
struct EnsembleTransport::SideLanes {
  using Lanes = SideValues;
  std::array<Lanes, classes> convected{};  // probability to go with the gas
  std::array<Lanes, classes> diffused{};   // factor of `diffusion` and of `stirred`: o
  std::array<Lanes, nodes> diffusion{};    // times d^2, m2: at the nodes
  Lanes stirred{};                         // probability to go with the eddies
  bool hasWall = false;

  // The probability to leave through each of them, but for walls.
  [[nodiscard]] Lanes chances(const Size& size) const {
    const Lanes &low = diffusion[size.at.node], &high = diffusion[size.at.node + 1];
    const Lanes &gas = convected[size.ofClass], &own = diffused[size.ofClass];
    Lanes all;
    for (std::size_t s = 0; s < all.size(); ++s)
      all[s] = gas[s] + own[s] * (stirred[s] + size.perSquare * (low[s] + size.at.part * (high[s] - low[s])));
    return all;
  }
  // No less than that of any between a node and the next.
  [[nodiscard]] Lanes mostChances(int k, std::size_t node, double perSquare) const {
    const Lanes &low = diffusion[node], &high = diffusion[std::min(node + 1, nodes - 1)];
    Lanes all;
    for (std::size_t s = 0; s < all.size(); ++s)
      all[s] = convected[k][s] + diffused[k][s] * (stirred[s] + perSquare * std::max(low[s], high[s]));
    return all;
  }
  // To the wall that is side s: of a particle, and no less than that of any up to the next node.
  [[nodiscard]] double toWall(std::size_t s, const Side& side, const Size& size) const {
    const double low = diffusion[size.at.node][s], high = diffusion[size.at.node + 1][s];
    const double through = side.diffuses ? size.perSquare * (low + size.at.part * (high - low)) : 0.0;
    const double taken = takenByWall(side.drift, through);
    return side.eddies > 0.0 ? taken * behindEddies(taken, side.eddies)
                             : taken + outsideWallLayer(side.drift, through) * convected[size.ofClass][s];
  }
  [[nodiscard]] double mostToWall(std::size_t s, const Side& side, int k, std::size_t node, double perSquare) const {
    const double through =
        side.diffuses ? perSquare * std::max(diffusion[node][s], diffusion[std::min(node + 1, nodes - 1)][s]) : 0.0;
    const double taken = takenByWall(side.drift, through);
    return side.eddies > 0.0 ? taken * behindEddies(taken, side.eddies) : taken + std::max(convected[k][s], 0.0);
  }
};

// What a cell has in a half of a step. Its particles as they are at the begin stand in `order_` as places in their rows
// (placeOf), of one node of size after the other, a particle once for each piece in which it goes; then those of sizes
// beyond the nodes, which are drawn singly. Those that come later stand behind the others in `arrived`. A piece that
// has left is `nowhere`, and who has left altogether has the number zero in its row until the end of the half.
struct EnsembleTransport::Content {
  std::size_t order = 0;                        // its begin in order_
  std::array<std::uint32_t, nodes + 1> upTo{};  // in it: of each node, then of the single ones
  std::size_t before = 0;                       // values of `arrived` at the begin
  double number = 0.0;                          // 1/m3, of all
  std::int64_t count = 0;
  std::array<double, classes> numbers{};  // 1/m3, of each class
  std::array<int, classes> counts{};
  std::array<double, classes> lightest{};  // kg, at the begin
  bool hasLost = false;                    // whether a row has the number zero

  static constexpr std::uint32_t nowhere = ~0U;
  [[nodiscard]] static std::uint32_t placeOf(std::size_t at, bool hasArrived) {
    return static_cast<std::uint32_t>(2 * at + (hasArrived ? 1 : 0));
  }
  [[nodiscard]] static bool hasArrived(std::uint32_t place) { return (place & 1U) != 0; }
  // 1/m3, that a numerical particle may stand for that goes as one.
  [[nodiscard]] double whole() const { return 2.0 * number / static_cast<double>(count); }
  // `change`: of how many numerical ones there are.
  void add(int ofClass, double more, int change) {
    number += more;
    count += change;
    numbers[ofClass] = std::max(0.0, numbers[ofClass] + more);
    counts[ofClass] += change;
    if (counts[ofClass] == 0) numbers[ofClass] = 0.0;
  }
};

// A particle of a cell as its order is made.
struct EnsembleTransport::Stock {
  double number;  // 1/m3
  std::uint32_t node, pieces;
  std::uint32_t place;  // Content::placeOf()
};

struct EnsembleTransport::Hit {
  std::size_t entry;  // in order_
  double most;        // no probability to leave is above it
};

struct EnsembleTransport::Leaving {
  int face = 0;  // local
  int cell = 0;  // local, where it comes to
  int ofClass = 0;
  std::size_t row = 0;  // in leavingRows_, the number per metre depth or radian
  int next = -1;        // that comes through the face to the same side
};

}  // namespace lampblack::coupling
