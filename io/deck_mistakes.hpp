// The mistakes of a deck that do not depend on each other, told in one go.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"

namespace lampblack::io {

class DeckMistakes {
 public:
  static constexpr std::size_t most = 10;  // of one message

  // InputError of all so far where there are that many.
  void add(const DeckLocation& at, const InputError& mistake);
  // Adds the InputError that `work` throws.
  template <typename Work>
  void collect(const DeckLocation& at, const Work& work) {
    try {
      work();
    } catch (const InputError& mistake) {
      add(at, mistake);
    }
  }
  // InputError where there are any: their messages one after the other, in the order of the deck; what is missing and
  // what overrides say come last.
  void raise() const;

 private:
  std::vector<std::pair<DeckLocation, std::string>> all_;
};

}  // namespace lampblack::io
