// The nearest known name to one that is not known, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lampblack {

// Insertions, deletions, replacements and swaps of neighbours that make one text the other (optimal string alignment;
// Damerau 1964), letters compared without case.
std::size_t editDistance(std::string_view a, std::string_view b);

// The nearest of the known names when it is near enough to be meant: at most a third of the letters differ (one in
// short names). Empty when none is.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);

// The one known name whose words ('_' and '-' part them) are all in `name`, or that has all words of `name`:
// 'connecting_rod' and 'rod'. Empty when none or several have. Words of one or two letters alone do not count.
std::string nameOfSameWords(std::string_view name, const std::vector<std::string>& known);

// The nearest of the known names however far it is; empty only if none is known.
std::string_view closestName(std::string_view name, std::span<const std::string_view> known);

// "; did you mean 'velocity'?" or nothing.
std::string didYouMean(std::string_view name, const std::vector<std::string>& known);

}  // namespace lampblack
