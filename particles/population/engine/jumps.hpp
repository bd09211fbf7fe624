// The processes of the methods that have their particles change by events (JumpMethod), as the event loop takes them.
// What each does to the particles is the method's; growth over a time is a step beside the loop (split_step.hpp).
#pragma once

#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::particles {

template <class Method>
struct CoagulationJumps {
  static constexpr const char* name = "coagulation";
  Method& method;
  bool isActive;
  [[nodiscard]] double bound() const { return isActive ? method.coagulationRate() : 0.0; }
  bool attempt(RandomStream& random) { return method.coagulate(random); }
};
template <class Method>
struct BreakageJumps {
  static constexpr const char* name = "breakage";
  Method& method;
  bool isActive;
  [[nodiscard]] double bound() const { return isActive ? method.breakageRate() : 0.0; }
  bool attempt(RandomStream& random) { return method.breakUp(random); }
};
template <class Method>
struct DepositionJumps {
  static constexpr const char* name = "deposition";
  Method& method;
  bool isActive;
  [[nodiscard]] double bound() const { return isActive ? method.depositionRate() : 0.0; }
  bool attempt(RandomStream& random) { return method.deposit(random); }
};
template <class Method>
struct CondensationJumps {
  static constexpr const char* name = "condensation";
  Method& method;
  bool isActive;
  [[nodiscard]] double bound() const { return isActive ? method.condensationRate() : 0.0; }
  bool attempt(RandomStream& random) { return method.condense(random); }
};

}  // namespace lampblack::particles
