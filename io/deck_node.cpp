#include "io/deck_node.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <unordered_map>

#include "io/deck_hints.hpp"

namespace lampblack::io {
namespace {

// Found while YAML events arrive; turned into an InputError where the source is known.
struct StructureError {
  YAML::Mark mark;
  std::string key;
  std::string message;
};

DeckLocation locationOf(const YAML::Mark& mark, std::size_t length = 1) {
  return {-1, mark.line + 1, mark.column + 1, std::max(1, static_cast<int>(length))};
}

bool isNullText(const std::string& text) {
  return text.empty() || text == "~" || text == "null" || text == "Null";
}

// Builds the tree of one document. The nodes under construction are kept by value on a stack.
class TreeBuilder : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuseAnchor(mark, anchor);
    scalar(mark, "", false);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw StructureError{mark, path(), "aliases (*name) are not used in decks; write the value here"};
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuseAnchor(mark, anchor);
    if (tag != "?" && tag != "!" && !tag.empty()) {
      throw StructureError{mark, path(), fmt::format("tags ({}) are not used in decks", tag)};
    }
    scalar(mark, value, tag == "!");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    refuseAnchor(mark, anchor);
    open(mark, DeckNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    refuseAnchor(mark, anchor);
    open(mark, DeckNode::Kind::map);
  }
  void OnMapEnd() override { close(); }

  DeckNode root;

 private:
  struct Open {
    DeckNode node;
    bool hasKey = false;  // of a map: the key of the next value has been read
    std::string key;
    DeckLocation keyAt;
    std::unordered_map<std::string, int> lines;  // of a map: where each key stands
  };

  std::string path() const {
    std::string text;
    for (const Open& open : stack_) {
      if (open.node.kind == DeckNode::Kind::list) text += fmt::format("[{}]", open.node.children.size());
      if (open.node.kind == DeckNode::Kind::map && open.hasKey) text += (text.empty() ? "" : ".") + open.key;
    }
    return text;
  }

  void refuseAnchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != 0) throw StructureError{mark, path(), "anchors (&name) are not used in decks"};
  }

  bool expectsKey() const {
    return !stack_.empty() && stack_.back().node.kind == DeckNode::Kind::map && !stack_.back().hasKey;
  }

  void scalar(const YAML::Mark& mark, const std::string& value, bool quoted) {
    if (expectsKey()) {
      Open& map = stack_.back();
      if (value.empty()) throw StructureError{mark, path(), "a key has no name"};
      const auto [first, isNew] = map.lines.emplace(value, mark.line + 1);
      if (!isNew) {
        const std::string where = path();
        throw StructureError{mark, (where.empty() ? "" : where + ".") + value,
                             fmt::format("this key is given twice; first in line {}", first->second)};
      }
      map.hasKey = true;
      map.key = value;
      map.keyAt = locationOf(mark, value.size());
      return;
    }
    DeckNode node;
    node.kind = !quoted && isNullText(value) ? DeckNode::Kind::null : DeckNode::Kind::scalar;
    node.at = locationOf(mark, value.size() + (quoted ? 2 : 0));
    node.text = value;
    node.quoted = quoted;
    attach(std::move(node));
  }

  void open(const YAML::Mark& mark, DeckNode::Kind kind) {
    if (expectsKey()) throw StructureError{mark, path(), "a key has to be a name, not a list or a map"};
    Open open;
    open.node.kind = kind;
    open.node.at = locationOf(mark);
    stack_.push_back(std::move(open));
  }

  void close() {
    DeckNode node = std::move(stack_.back().node);
    stack_.pop_back();
    attach(std::move(node));
  }

  void attach(DeckNode node) {
    if (stack_.empty()) {
      root = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    if (parent.node.kind == DeckNode::Kind::map) {
      node.name = parent.key;
      node.nameAt = parent.keyAt;
      parent.hasKey = false;
    } else {
      node.nameAt = node.at;
    }
    parent.node.children.push_back(std::move(node));
  }

  std::vector<Open> stack_;
};

// Takes events and does nothing: to see whether a text is YAML at all.
class NoBuilder : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// Throws YAML::Exception where the text is not YAML, StructureError where it is not a deck.
DeckNode parseYaml(const std::string& text) {
  const auto read = [&text](YAML::EventHandler& first, YAML::EventHandler& second) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    return parser.HandleNextDocument(first) && parser.HandleNextDocument(second);
  };
  // A first pass, because half a list can look like an odd key until the parser reaches its end.
  NoBuilder nothing;
  read(nothing, nothing);
  TreeBuilder builder;
  if (read(builder, nothing)) {
    throw StructureError{YAML::Mark::null_mark(), "", "it holds several YAML documents ('---'); a deck is one"};
  }
  return std::move(builder.root);
}

// yaml-cpp gives its message and mark; the prefix of what() repeats the mark.
StructureError fromYaml(const YAML::Exception& error) {
  if (dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr)
    return {error.mark, "", "lists and maps are nested too deeply; a deck has a few levels"};
  return {error.mark, "", fmt::format("this is not YAML: {}", error.msg)};
}

}  // namespace

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
      structure.message += whyNotYaml(lineOf(file.text, error.mark.line + 1), lineOf(file.text, error.mark.line));
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
