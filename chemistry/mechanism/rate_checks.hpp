// Whether the parameters of a rate constant make sense, whatever format they came from.
#pragma once

#include <span>
#include <string>

#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// What is wrong and what was expected, or nothing: limits of opposite sign or zero; SRI parameters that give no
// positive F; a bond energy that is not above the intrinsic activation energy, or this below zero.
std::string rateProblem(const Reaction& reaction);

// The same of rates tabulated over pressure, sorted by it: those of one pressure do not add up to a positive number
// between 300 and 10000 K (their logarithm is interpolated).
std::string pressureRateProblem(std::span<const PressureRate> rates);

}  // namespace lampblack::chemistry
