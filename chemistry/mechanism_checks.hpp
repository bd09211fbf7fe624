// Physical checks on a mechanism as a whole, whatever format it came from.
#pragma once

#include <span>
#include <string>

#include "chemistry/reaction.hpp"
#include "chemistry/species.hpp"

namespace lampblack {

struct Element;

// Throws InputError with file and line for a reaction that does not conserve an element, and for two reactions between
// the same species (same third body) that are not both marked as duplicates. Opposite directions count as the same
// unless both are irreversible; three-body reactions count as different if no species is a collider in both.
void checkReactions(const std::string& file, std::span<const Element> elements, std::span<const Species> species,
                    std::span<const Reaction> reactions);

}  // namespace lampblack
