// Reactions tabulated over pressure whose rate is a sum or a difference of several tables, written as several
// reactions.
#pragma once

#include <string>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// A reaction of this type that is zero at all pressures becomes an elementary one of rate zero. One that is not
// positive at some pressure (rateProblem) is joined with its marked duplicates of the same direction, type and
// pressures: the rates of a pressure add up, the logarithm of the sums is straight over that of pressure, as it is
// where all stand under one equation. Duplicates that are positive each for themselves stay apart. A warning for each;
// InputError with file and line where there is none to join, where the pressures differ, and where the sum is not
// positive either.
void joinPressureRates(const std::string& file, std::vector<Reaction>& reactions, std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
