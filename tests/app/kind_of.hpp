// What a deck says of its kind of reactor.
#pragma once

#include "app/problems/reactor/reactor_kind.hpp"

namespace lampblack::app {

// std::bad_cast where the case is of another kind.
template <typename Kind>
[[nodiscard]] const Kind& kindOf(const ReactorCase& reactorCase) {
  return dynamic_cast<const Kind&>(*reactorCase.kind);
}

}  // namespace lampblack::app
