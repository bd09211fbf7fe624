#include "core/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/letter_case.hpp"

namespace lampblack {

namespace {

std::set<std::string> wordsOf(std::string_view name) {
  std::set<std::string> words;
  std::string word;
  for (const char letter : std::string(name) + '_') {
    if (letter != '_' && letter != '-') {
      word += lowerCase(letter);
    } else if (!word.empty()) {
      words.insert(std::exchange(word, {}));
    }
  }
  return words;
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
  const auto same = [&](std::size_t i, std::size_t j) { return lowerCase(a[i]) == lowerCase(b[j]); };
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t replace = cost[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

std::string nearestName(std::string_view name, const std::vector<std::string>& known) {
  if (name.size() > 100) return {};
  std::string best;
  std::size_t bestDistance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(name, candidate);
    // A name of one or two letters is one edit from any other: let it match only through case.
    if (distance >= std::min(name.size(), candidate.size()) && distance > 0) continue;
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string nameOfSameWords(std::string_view name, const std::vector<std::string>& known) {
  const auto tells = [](const std::set<std::string>& words) {
    return std::ranges::any_of(words, [](const std::string& word) { return word.size() > 2; });
  };
  const std::set<std::string> words = wordsOf(name);
  std::string found;
  for (const std::string& candidate : known) {
    const std::set<std::string> own = wordsOf(candidate);
    const bool isWithin = tells(own) && std::ranges::includes(words, own);
    const bool isAround = tells(words) && std::ranges::includes(own, words);
    if (!isWithin && !isAround) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
}

std::string_view closestName(std::string_view name, std::span<const std::string_view> known) {
  const auto closest =
      std::ranges::min_element(known, {}, [&](std::string_view candidate) { return editDistance(name, candidate); });
  return closest == known.end() ? std::string_view{} : *closest;
}

std::string didYouMean(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace lampblack
