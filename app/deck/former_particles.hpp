// The sections `soot`, `stochastic` and `particles` of former versions, which are one section now.
#pragma once

#include "core/modules.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

// `besideModel`: whether the gas may carry a model beside an ensemble or trees.
[[nodiscard]] FormerSections formerParticleSections(bool besideModel);

}  // namespace lampblack::app
