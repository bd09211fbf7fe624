// Pieces of YAML text that read back as exactly what they were made from.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// The fewest digits that read back as the same double; always with a point where there is an exponent, as YAML 1.1
// wants.
std::string yamlNumber(double value);

// The number x of fewest digits with x * factor == value; where no double fulfils that, the nearest.
std::string yamlNumber(double value, double factor);

// A name as a scalar, quoted where YAML would take it for something else (NO, 1E5, "a:b"), also within lists and maps.
std::string yamlName(std::string_view name);

// An equation as a scalar of a block map.
std::string yamlEquation(std::string_view equation);

// Text of one or several lines as the value of a key at the top of a file.
std::string yamlBlock(std::string_view text);

// "[a, b, ...]" broken into lines of at most 120 characters; `indent` for all but the first line.
std::string yamlList(const std::vector<std::string>& words, std::size_t indent);

}  // namespace lampblack::chemistry
