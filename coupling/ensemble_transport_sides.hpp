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

// One of a cell's faces, as its particles see it, in one part of a step. A class that takes several parts together has
// so many times these probabilities.
struct EnsembleTransport::Side {
  int face = 0, beyond = -1;                // the cell on the other side, or -1
  std::array<double, classes> convected{};  // probability to go with the gas
  std::array<double, classes> diffused{};   // factor of `diffusion` and of `stirred`: o
  std::array<double, nodes> diffusion{};    // times d^2, m2: at the nodes
  bool diffuses = false;
  double stirred = 0.0;  // probability to go with the eddies
  // A wall that takes particles: `drift` is the probability to drift to it with the value of the cell, or below zero;
  // `convected` how much more of it particles have that follow the slope in the cell.
  bool isWall = false;
  double drift = 0.0;
  double eddies = 0.0;                    // before its layer: resistance of the eddies, over a probability
  std::array<bool, classes> isLimited{};  // whether convected or diffused is

  // To a wall: of a particle of that volume and class, and no less than that of any up to the next node.
  [[nodiscard]] double toWall(int k, const Between& at, double perSquare) const {
    const double through =
        diffuses ? perSquare * (diffusion[at.node] + at.part * (diffusion[at.node + 1] - diffusion[at.node])) : 0.0;
    const double taken = takenByWall(drift, through);
    return eddies > 0.0 ? taken * behindEddies(taken, eddies) : taken + outsideWallLayer(drift, through) * convected[k];
  }
  [[nodiscard]] double mostToWall(int k, std::size_t node, double perSquare) const {
    const double through =
        diffuses ? perSquare * std::max(diffusion[node], diffusion[std::min(node + 1, nodes - 1)]) : 0.0;
    const double taken = takenByWall(drift, through);
    return eddies > 0.0 ? taken * behindEddies(taken, eddies) : taken + std::max(convected[k], 0.0);
  }
};

// The sides of a cell beside one another, for loops that are compiled to vector instructions: those that are no walls.
struct EnsembleTransport::SideLanes {
  using Lanes = SideValues;
  std::array<Lanes, classes> convected{}, diffused{};
  std::array<Lanes, nodes> diffusion{};
  Lanes stirred{};
  bool hasWall = false;

  // Of these classes and nodes.
  void set(const std::vector<Side>& sides, std::span<const int> moving, std::size_t first, std::size_t end) {
    hasWall = std::ranges::any_of(sides, &Side::isWall);
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const Side& side = sides[s];
      for (const int k : moving) {
        convected[k][s] = side.convected[k];
        diffused[k][s] = side.diffused[k];
      }
      stirred[s] = side.stirred;
      for (std::size_t node = first; node < end; ++node) diffusion[node][s] = side.diffusion[node];
    }
  }
  // The probability to leave through each of them.
  [[nodiscard]] Lanes chances(const Size& size) const {
    const Lanes &low = diffusion[size.at.node], &high = diffusion[size.at.node + 1];
    const Lanes &gas = convected[size.ofClass], &own = diffused[size.ofClass];
    Lanes all;
    for (std::size_t s = 0; s < all.size(); ++s)
      all[s] = gas[s] + own[s] * (stirred[s] + size.perSquare * (low[s] + size.at.part * (high[s] - low[s])));
    return all;
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
