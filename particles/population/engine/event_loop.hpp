// The Markov jump process of a population: which event comes when, for any method and any kind of particles. Processes
// have a bound of their rate and are attempted at it; an attempt may turn out fictitious, which leaves the law of the
// others exact. Births come when they are due (EvenBirths, NucleationBirths).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::particles {

template <class P>
concept JumpingProcess = requires(P process, RandomStream& random) {
  { P::name } -> std::convertible_to<const char*>;
  { process.isActive } -> std::convertible_to<bool>;
  { process.bound() } -> std::convertible_to<double>;        // 1/s, of the sample
  { process.attempt(random) } -> std::convertible_to<bool>;  // whether it took place
};

template <class B>
concept Births = requires(B births, double time) {
  { births.due(time) } -> std::convertible_to<double>;  // s, when the next one is, as seen from `time`
  births.pass(time);                                    // so long (s) without one
  births.happen();                                      // the one that is due
};

// Who has the population.
template <class H, class Process>
concept EventHost = requires(H host, const Process& process, double time) {
  host.look();               // before each event
  host.setTime(time);        // of the event that follows, s
  host.giveBirth();          // to what is due
  host.take(process, true);  // whether an attempt took place
};

// All events from `time` to `end` (s), which `time` is then. What is left of an exponential waiting time when a nucleus
// is born goes on at the rates that there are then, as it has no memory.
template <class Host, Births B, JumpingProcess... Processes>
void runEvents(double& time, double end, RandomStream& random, B& births, Host& host, Processes... processes) {
  static_assert((EventHost<Host, Processes> && ...));
  constexpr double never = std::numeric_limits<double>::infinity();
  double wait = (processes.isActive || ...) ? random.exponential(1) : 0.0;  // of the integral of all rates
  while (true) {
    host.look();
    const std::array<double, sizeof...(Processes)> bounds{processes.bound()...};
    double total = 0;
    for (const double bound : bounds) total += bound;
    if (!(total < never)) {
      constexpr std::array names{Processes::name...};
      throw NumericsError(fmt::format("the rate of {} is too large for numbers at t = {:.6g} s",
                                      names[std::ranges::max_element(bounds) - bounds.begin()], time));
    }
    const double next = total > 0 ? time + wait / total : never, until = std::min(next, end);
    if (const double due = births.due(time); due < until) {
      wait = std::max(0.0, wait - total * std::max(0.0, due - time));
      time = std::max(due, time);
      host.setTime(time);
      births.happen();
      host.giveBirth();
      continue;
    }
    births.pass(until - time);
    if (next >= end) break;
    time = next;
    wait = random.exponential(1);
    host.setTime(time);
    std::size_t which = 0;
    for (double choice = total == bounds[0] ? 0.0 : random.uniform() * total;
         which + 1 < bounds.size() && choice >= bounds[which]; ++which)
      choice -= bounds[which];
    std::size_t k = 0;
    ((k++ == which ? host.take(processes, processes.attempt(random)) : void()), ...);
  }
  time = end;
}

}  // namespace lampblack::particles
