// The known name that is the fewest edits away from a mistyped one (Levenshtein distance, letter case counting half).
#pragma once

#include <algorithm>
#include <cctype>
#include <span>
#include <string_view>
#include <vector>

namespace lampblack {

inline double editDistance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<double> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    double diagonal = row[0];
    row[0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const double exchange = a[i - 1] == b[j - 1] ? 0.0 : lower(a[i - 1]) == lower(b[j - 1]) ? 0.5 : 1.0;
      const double best = std::min({row[j] + 1, row[j - 1] + 1, diagonal + exchange});
      diagonal = row[j];
      row[j] = best;
    }
  }
  return row[b.size()];
}

// Empty only if no name is known.
inline std::string_view nearestName(std::string_view name, std::span<const std::string_view> known) {
  std::string_view nearest;
  double least = 0;
  for (const auto candidate : known) {
    const double distance = editDistance(name, candidate);
    if (nearest.empty() || distance < least) {
      nearest = candidate;
      least = distance;
    }
  }
  return nearest;
}

}  // namespace lampblack
