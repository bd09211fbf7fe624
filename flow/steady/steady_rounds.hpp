// A steady gas and the stochastic particles in it, found in turn: the gas with what the particles took of it in the
// mean (nothing at first), then the particles in that gas until their averages have enough blocks, and again, until the
// gas no longer changes by what the particles take. A plan that is told what came of each turn, as SteadySearch is.
#pragma once

#include <cstddef>
#include <optional>

#include "core/modules.hpp"
#include "core/state_archive.hpp"

namespace lampblack::flow {

class SteadyRounds {
 public:
  struct Options {
    int most = 8;                 // rounds, each a turn of the gas and one of the particles
    double tolerance = 1e-2;      // change of the gas from one round to the next, of the range of any field
    std::size_t blocks = 20;      // of the averages of the last turn of the particles
    std::size_t leastBlocks = 5;  // of those before, while the gas still changes by several times the tolerance
    bool actsOnGas = true;        // false: the gas does not know of the particles, and one round is all
  };
  enum class Turn { Gas, Particles };

  explicit SteadyRounds(const Options& options) : options_(options) {}

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] Turn turn() const { return turn_; }
  // Whether there is no further turn.
  [[nodiscard]] bool isDone() const { return isDone_; }
  // Whether gas and particles belong to each other: the last two gases are the same but for the tolerance.
  [[nodiscard]] bool agrees() const { return !options_.actsOnGas || (change_ && *change_ <= options_.tolerance); }
  // Turns of the particles that have ended.
  [[nodiscard]] int rounds() const { return rounds_; }
  // Whether the particles have to be stationary in their present turn; else, as the gas will change again, they have
  // leastBlocks to follow it and then the averages.
  [[nodiscard]] bool isLong() const { return isLong_; }
  // Of the averages of the present turn of the particles.
  [[nodiscard]] std::size_t blocks() const { return isLong_ ? options_.blocks : options_.leastBlocks; }
  // Of the gas in the last round, over its range; nothing before the second.
  [[nodiscard]] std::optional<double> change() const { return change_; }

  // The steady gas was found; how far from that of the round before.
  void addGas(std::optional<double> change);
  // The particles have their averages.
  void addParticles();

  void saveOrLoad(StateArchive& archive);

 private:
  Options options_;
  Turn turn_ = Turn::Gas;
  bool isDone_ = false, isLong_ = false;
  int rounds_ = 0;
  std::optional<double> change_;
};

}  // namespace lampblack::flow
