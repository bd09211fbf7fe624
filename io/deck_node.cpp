#include "io/deck_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/deck_hints.hpp"
#include "io/deck_yaml.hpp"

namespace lampblack::io {

const DeckNode* DeckNode::child(std::string_view childName) const {
  if (kind != Kind::map) return nullptr;
  for (const DeckNode& node : children) {
    if (node.name == childName) return &node;
  }
  return nullptr;
}

DeckNode* DeckNode::child(std::string_view childName) {
  return const_cast<DeckNode*>(std::as_const(*this).child(childName));
}

DeckNode parseDeck(const DeckFile& file) {
  const DeckSource source{file, {}, {}};
  const auto fail = [&](const StructureError& error) {
    const bool known = !error.mark.is_null();
    return deckError(source, known ? locationOf(error.mark) : DeckLocation{}, error.key, error.message);
  };
  if (const std::size_t zero = file.text.find('\0'); zero != std::string::npos) {
    throw deckError(source, {}, "", "it is not a text file");
  }
  DeckNode root;
  try {
    root = parseYaml(file.text);
  } catch (const StructureError& error) {
    throw fail(error);
  } catch (const YAML::Exception& error) {
    StructureError structure = fromYaml(error);
    if (!error.mark.is_null())
      structure.message += whyNotYaml(lineOf(file.text, error.mark.line + 1), lineOf(file.text, error.mark.line),
                                      lineOf(file.text, error.mark.line - 1));
    throw fail(structure);
  }
  if (root.kind == DeckNode::Kind::null) throw deckError(source, {}, "", "the deck is empty");
  if (root.kind != DeckNode::Kind::map) {
    throw deckError(source, root.at, "", fmt::format("expected a map of keys, found {}", foundText(root)));
  }
  return root;
}

namespace {

// Puts every location of a tree that came from an override onto the text of that override.
void relocate(DeckNode& node, int overrideIndex, int shift) {
  for (DeckLocation* at : {&node.nameAt, &node.at}) {
    at->overrideIndex = overrideIndex;
    at->column += at->line == 1 ? shift : 0;
  }
  for (DeckNode& child : node.children) relocate(child, overrideIndex, shift);
}

}  // namespace

void applyOverride(DeckNode& root, const DeckSource& source, std::size_t i) {
  const std::string& text = source.overrides[i];
  const int index = static_cast<int>(i);
  const std::size_t equals = text.find('=');
  const auto fail = [&](const std::string& message, std::size_t column, std::size_t length, const std::string& key) {
    return deckError(source,
                     {index, 1, static_cast<int>(column) + 1, static_cast<int>(std::max<std::size_t>(length, 1))}, key,
                     message);
  };
  if (equals == std::string::npos || equals == 0) throw fail("expected 'key=value'", 0, text.size(), "");
  if (std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(equals), '[') !=
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(equals), ']'))
    throw fail("a bracket of the key is not closed", 0, equals, text.substr(0, equals));

  const std::string key = text.substr(0, equals);
  const std::string valueText = text.substr(equals + 1);
  DeckNode value;
  try {
    value = parseYaml(valueText);
  } catch (const StructureError& error) {
    throw fail(error.message, equals + 1, valueText.size(), key);
  } catch (const YAML::Exception& error) {
    if (valueText.find(": ") == std::string::npos || valueText.find_first_of("{}[]\n") != std::string::npos)
      throw fail(fromYaml(error).message, equals + 1, valueText.size(), key);
    value.kind = DeckNode::Kind::scalar;
    value.text = valueText;
    value.at = {index, 1, 1, static_cast<int>(valueText.size())};
  }
  if (value.kind == DeckNode::Kind::map && !valueText.starts_with('{')) value.text = valueText;
  relocate(value, index, static_cast<int>(equals) + 1);

  DeckNode* node = &root;
  const std::vector<std::string> parts = splitDeckPath(key);
  const DeckLocation keyAt{index, 1, 1, static_cast<int>(key.size())};
  for (const std::string& part : parts) {
    if (part.empty()) throw fail("a part of the key has no name", 0, key.size(), key);
    if (node->kind == DeckNode::Kind::null) node->kind = DeckNode::Kind::map;
    if (node->kind == DeckNode::Kind::scalar) {
      throw fail(fmt::format("'{}' cannot be set: what is above it is {}", part, foundText(*node)), 0, key.size(), key);
    }
    if (node->kind == DeckNode::Kind::list) {
      std::size_t item = 0;
      const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), item);
      if (status != std::errc{} || end != part.data() + part.size() || item > node->children.size()) {
        throw fail(fmt::format("'{}' is not an item of this list, which has items 0 to {}; {} would append one", part,
                               static_cast<long>(node->children.size()) - 1, node->children.size()),
                   0, key.size(), key);
      }
      if (item == node->children.size()) {
        node->children.emplace_back();
        node->children.back().nameAt = node->children.back().at = keyAt;
      }
      node = &node->children[item];
    } else {
      DeckNode* next = node->child(part);
      if (next == nullptr) {
        node->children.emplace_back();
        next = &node->children.back();
        next->name = part;
        next->nameAt = next->at = keyAt;
      }
      node = next;
    }
  }
  value.name = node->name;
  value.nameAt = keyAt;
  if (value.at.line == 0) value.at = keyAt;
  *node = std::move(value);
}

std::vector<std::string> splitDeckPath(std::string_view path) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.' || (path[i] == '[' && i > 0)) {
      parts.emplace_back();
    } else if (path[i] == ']' && (i + 1 == path.size() || path[i + 1] == '.' || path[i + 1] == '[')) {
      continue;
    } else {
      parts.back() += path[i];
    }
  }
  return parts;
}

}  // namespace lampblack::io
