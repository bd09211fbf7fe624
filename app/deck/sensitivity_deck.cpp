#include "app/deck/sensitivity_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "io/csv.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

// An equation without blanks, for comparisons.
std::string bare(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return text;
}

std::vector<std::size_t> reactionsNamed(const Mechanism& mechanism, const std::string& text) {
  std::size_t number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status == std::errc{} && end == text.data() + text.size()) {
    if (number < 1 || number > mechanism.numReactions())
      throw InputError(fmt::format("there is no reaction {}; expected 1 to {}", number, mechanism.numReactions()));
    return {number - 1};
  }
  std::vector<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t r = 0; r < mechanism.numReactions(); ++r) {
    known.push_back(mechanism.reaction(r).equation);
    if (bare(known.back()) == bare(text)) found.push_back(r);
  }
  if (found.empty())
    throw InputError(fmt::format("no reaction '{}' in the mechanism{}", text, didYouMean(text, known)));
  return found;
}

}  // namespace

void addSensitivityKeys(DeckSchema& schema, const std::string& doc, const std::string& of,
                        std::vector<DeckCondition> onlyWith) {
  SectionKeys keys("sensitivity");
  keys.section(Presence::optional, doc, std::move(onlyWith));
  keys.choice("of", {of}, rules().byDefault(of), "Result whose sensitivities are computed.");
  keys.text("reactions", rules().list().byDefault("[all]"),
            "Reactions by their number in the file, from 1, or by their equation; 'all' takes every one.");
  schema.add(keys.schema());
}

std::vector<std::size_t> readSensitivityReactions(const Deck& deck, const Mechanism& mechanism) {
  std::vector<std::size_t> reactions;
  for (const std::string& text : deck.strings("sensitivity.reactions")) {
    if (text == "all") {
      reactions.resize(mechanism.numReactions());
      std::iota(reactions.begin(), reactions.end(), std::size_t{0});
      return reactions;
    }
    try {
      const auto found = reactionsNamed(mechanism, text);
      if (std::find(reactions.begin(), reactions.end(), found.front()) != reactions.end())
        throw InputError(fmt::format("the reaction '{}' is named twice", text));
      reactions.insert(reactions.end(), found.begin(), found.end());
    } catch (const InputError& error) {
      throw deck.error("sensitivity.reactions", error.what());
    }
  }
  if (reactions.empty()) throw deck.error("sensitivity.reactions", "expected at least one reaction, or 'all'");
  return reactions;
}

std::string sensitivityTable(const Mechanism& mechanism, std::span<const std::size_t> reactions,
                             std::span<const Sensitivities> results) {
  std::vector<std::string> names{"reaction", "equation"};
  for (const Sensitivities& result : results)
    if (!result.values.empty()) names.push_back(result.name + " [1]");
  std::string text = csvLine(names);
  for (std::size_t p = 0; p < reactions.size(); ++p) {
    std::vector<std::string> fields{std::to_string(reactions[p] + 1), mechanism.reaction(reactions[p]).equation};
    for (const Sensitivities& result : results)
      if (!result.values.empty()) fields.push_back(fmt::format("{}", result.values[p]));
    text += csvLine(fields);
  }
  return text;
}

void writeSensitivities(ResultsWriter& file, std::span<const std::size_t> reactions,
                        std::span<const Sensitivities> results, const std::string& doc) {
  const auto count = static_cast<std::int64_t>(reactions.size());
  std::vector<std::int64_t> numbers;
  for (const std::size_t r : reactions) numbers.push_back(static_cast<std::int64_t>(r) + 1);
  file.dataset("/sensitivity/reaction", {count}, std::span<const std::int64_t>(numbers), "1",
               "number of the reaction in the mechanism file, from 1");
  for (const Sensitivities& result : results) {
    std::vector<double> values(numbers.size(), std::numeric_limits<double>::quiet_NaN());
    if (!result.values.empty()) values = result.values;
    file.dataset("/sensitivity/" + result.name, {count}, std::span<const double>(values), "1", doc);
  }
}

std::string largestSensitivities(const Mechanism& mechanism, std::span<const std::size_t> reactions,
                                 std::span<const double> values, const std::string& sum) {
  constexpr std::size_t shown = 10;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::abs(values[a]) > std::abs(values[b]); });
  std::string text;
  for (std::size_t j = 0; j < std::min(shown, order.size()); ++j) {
    const std::size_t r = reactions[order[j]];
    text += fmt::format("  {:>5}  {:<40} {:>9.4f}\n", r + 1, mechanism.reaction(r).equation, values[order[j]]);
  }
  if (values.size() == mechanism.numReactions())
    text += fmt::format("  {:>5}  {:<40} {:>9.4f}\n", "", "all together (" + sum + ")",
                        std::accumulate(values.begin(), values.end(), 0.0));
  return text;
}

}  // namespace lampblack::app
