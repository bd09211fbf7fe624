// The equation of a reaction as text, the same whatever file it came from.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// "H + O2 (+M) <=> HO2 (+M)", "2 OH => ...", "0.5 O2 + ...": terms in the order of the reaction's lists, the
// coefficients such that they read back as the same doubles. A fall-off reaction with one collider of efficiency one
// and no other names it, "(+AR)". `name` gives a species' name.
std::string equationText(const Reaction& reaction, const std::function<std::string_view(std::size_t)>& name);

// The species that "(+AR)" names, if the reaction is of that kind.
std::optional<std::size_t> namedCollider(const Reaction& reaction);

}  // namespace lampblack::chemistry
