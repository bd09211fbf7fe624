#include "io/deck_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace lampblack::io {

void DeckMistakes::add(const DeckLocation& at, const InputError& mistake) {
  all_.emplace_back(at, mistake.what());
  if (all_.size() == most) raise();
}

void DeckMistakes::raise() const {
  if (all_.empty()) return;
  auto sorted = all_;
  std::ranges::stable_sort(sorted, {}, [](const auto& mistake) {
    const DeckLocation& at = mistake.first;
    return std::tuple(at.overrideIndex, at.isInBase, at.line == 0, at.line, at.column);
  });
  std::string text;
  for (const auto& [at, message] : sorted) text += (text.empty() ? "" : "\n") + message;
  if (all_.size() == most) text += fmt::format("\nthese are {} mistakes; there may be more", most);
  throw InputError(text);
}

}  // namespace lampblack::io
