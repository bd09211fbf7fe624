// The deck reader accepts a text or says what is wrong with it; nothing else. What it accepts, it can write out and
// read again with the same result. Lines before a line "%%" are overrides, one each.
#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "io/deck.hpp"
#include "tests/every_module.hpp"
#include "tests/io/sample_schema.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lampblack;
  using namespace lampblack::app;
  static const DeckSchema schema = test::sampleSchema();
  std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> overrides;
  if (const std::size_t mark = text.find("\n%%\n"); mark != std::string::npos) {
    std::istringstream lines(text.substr(0, mark));
    for (std::string line; std::getline(lines, line);) overrides.push_back(line);
    text = text.substr(mark + 4);
  }
  std::string resolved;
  try {
    resolved = Deck::parse(text, "fuzz.yaml", overrides, schema).resolved();
  } catch (const InputError&) {
    return 0;
  }
  try {
    if (Deck::parse(resolved, "resolved.yaml", {}, schema).resolved() != resolved) {
      throw std::runtime_error("the resolved deck reads back differently:\n" + resolved);
    }
  } catch (const InputError& error) {
    throw std::runtime_error("the resolved deck is refused: " + std::string(error.what()) + "\n" + resolved);
  }
  return 0;
}
