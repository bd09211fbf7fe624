#include "io/deck_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lampblack::io {

DeckLocation locationOf(const YAML::Mark& mark, std::size_t length) {
  return {-1, mark.line + 1, mark.column + 1, std::max(1, static_cast<int>(length))};
}

namespace {

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

}  // namespace

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

}  // namespace lampblack::io
