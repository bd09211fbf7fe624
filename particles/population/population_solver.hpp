// One solution of the population balance in time, whatever the method: Monte Carlo ensembles, sections or moments.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

struct PopulationCounters {
  std::uint64_t coagulations = 0, fictitious = 0;  // fictitious jumps of every process
  std::uint64_t nucleations = 0, breakages = 0, depositions = 0, condensations = 0;
  std::uint64_t merges = 0;                               // of two numerical particles into one, or of one into another
  std::uint64_t doublings = 0, copies = 0, removals = 0;  // of all, of one, to keep their number in range
  std::uint64_t vanished = 0;                             // fell below the smallest volume
  std::uint64_t splitSteps = 0;
  std::uint64_t limited = 0;  // events that a method could not do as the model says; see its header
  [[nodiscard]] std::uint64_t events() const {
    return coagulations + nucleations + breakages + depositions + condensations;
  }
};

// All of them, by the names they have in results.
struct PopulationCounter {
  const char* name;
  std::uint64_t PopulationCounters::*value;
};
inline constexpr PopulationCounter populationCounters[] = {{"coagulations", &PopulationCounters::coagulations},
                                                           {"nucleations", &PopulationCounters::nucleations},
                                                           {"breakages", &PopulationCounters::breakages},
                                                           {"depositions", &PopulationCounters::depositions},
                                                           {"condensations", &PopulationCounters::condensations},
                                                           {"fictitious", &PopulationCounters::fictitious},
                                                           {"merges", &PopulationCounters::merges},
                                                           {"doublings", &PopulationCounters::doublings},
                                                           {"copies", &PopulationCounters::copies},
                                                           {"removals", &PopulationCounters::removals},
                                                           {"vanished", &PopulationCounters::vanished},
                                                           {"split_steps", &PopulationCounters::splitSteps},
                                                           {"limited", &PopulationCounters::limited}};
static_assert(sizeof(PopulationCounters) == std::size(populationCounters) * sizeof(std::uint64_t));

class PopulationSolver {
 public:
  virtual ~PopulationSolver() = default;
  PopulationSolver() = default;
  PopulationSolver(const PopulationSolver&) = delete;
  PopulationSolver& operator=(const PopulationSolver&) = delete;

  // From time() to `end` (s). Throws NumericsError; gelation() of what is thrown then says so, see GelationError.
  virtual void advance(double end) = 0;
  // advance() calls `callback` after each step or some hundred events: at most some milliseconds apart for samples and
  // sections of common sizes. An exception of the callback ends advance() in an incomplete state: the solver cannot be
  // used further.
  void setCallback(std::function<void()> callback) { callback_ = std::move(callback); }
  [[nodiscard]] virtual double time() const = 0;

  // M_0 to M_3, M_k being the sum of v^k per m3 (m^(3k-3)).
  [[nodiscard]] virtual std::array<double, 4> moments() const = 0;
  // Number (1/m3) of particles with a volume in each [edges[k], edges[k+1]); edges increase. Empty where the method
  // has no distribution (moments).
  [[nodiscard]] virtual std::vector<double> numberInBins(std::span<const double> edges) const = 0;
  // Geometric standard deviation of the diameter by number.
  [[nodiscard]] virtual double geometricDeviation() const = 0;
  [[nodiscard]] virtual std::size_t particles() const = 0;  // numerical particles, sections or moments
  [[nodiscard]] virtual std::size_t bytes() const = 0;      // of memory that grows with their number
  [[nodiscard]] virtual const PopulationCounters& counters() const = 0;

 protected:
  void runCallback() const {
    if (callback_) callback_();
  }

 private:
  std::function<void()> callback_;
};

}  // namespace lampblack::particles
