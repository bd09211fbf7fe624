// Warnings of a mechanism that say the same of many species or reactions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// Each kind once, in the order of the first of it, with the number of others like it. Two warnings "file:line: reaction
// 'name': text" are of one kind if their texts are the same up to what stands in quotes (but the name of an unknown key
// counts), to numbers and to what follows a further colon.
std::vector<std::string> oneOfEachKind(std::span<const std::string> warnings);

}  // namespace lampblack::chemistry
