// Species that the program looks for by itself: those that radiate, that soot exchanges, that mark a flame.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// The species meant by a name such as "H2O", whatever the mechanism calls it: the one of this name; or else, of a
// formula of C, H, O and N, the only neutral species of this composition, or the only one of those whose name differs
// in the case of letters alone. Any other name ("A4") is one as Mechanism::findSpecies takes it. Empty if there is
// none, and if several could be meant.
std::optional<std::size_t> findKnownSpecies(const Mechanism& mechanism, std::string_view name);

// The same; InputError "`whoNeeds` the species 'C2H2', ..." (of "ensembles need") with those that have its composition.
std::size_t knownSpecies(const Mechanism& mechanism, std::string_view name, std::string_view whoNeeds);
std::vector<std::size_t> knownSpecies(const Mechanism& mechanism, std::span<const std::string> names,
                                      std::string_view whoNeeds);

}  // namespace lampblack::chemistry
