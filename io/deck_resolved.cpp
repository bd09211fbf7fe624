// The deck as the run understood it, defaults included: as a deck that can be read again, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/deck.hpp"
#include "io/json.hpp"

namespace lampblack::io {
namespace {

// The values as a tree again.
struct Branch {
  std::string name;
  bool isList = false;
  const DeckValue* value = nullptr;
  std::vector<Branch> children;

  Branch& child(const std::string& childName) {
    for (Branch& branch : children) {
      if (branch.name == childName) return branch;
    }
    Branch made;
    made.name = childName;
    children.push_back(std::move(made));
    return children.back();
  }
};

using Index = std::map<std::string, std::size_t, std::less<>>;

// The sections as the deck has them, empty ones included: that a section is there can mean something.
void addSections(const DeckNode& node, const std::string& path, const Index& values, Branch& branch) {
  branch.isList = node.kind == DeckNode::Kind::list;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const DeckNode& child = node.children[i];
    const std::string name = branch.isList ? std::to_string(i) : child.name;
    const std::string childPath = branch.isList ? fmt::format("{}[{}]", path, i) : joinedPath(path, name);
    Branch& made = branch.child(name);
    if (!values.contains(childPath)) addSections(child, childPath, values, made);
  }
}

Branch treeOf(const DeckNode& deck, const std::vector<DeckValue>& values, const Index& index) {
  Branch root;
  addSections(deck, "", index, root);
  for (const DeckValue& value : values) {
    if (!value.counts) continue;
    Branch* branch = &root;
    for (const std::string& part : splitDeckPath(value.path)) branch = &branch->child(part);
    branch->value = &value;
  }
  return root;
}

std::size_t countOf(const DeckValue& value) {
  return std::max({value.numbers.size(), value.integers.size(), value.texts.size()});
}

bool isPlainWord(const std::string& text) {
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '_' && c != '-' && c != '/' && c != '.') return false;
  }
  if (text.empty() || !((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z'))) return false;
  return text != "null" && text != "Null" && text != "NULL";
}

std::string yamlText(const std::string& text) {
  return isPlainWord(text) ? text : jsonString(text);
}

std::string yamlItem(const DeckValue& value, std::size_t i) {
  switch (value.key.type) {
    case KeyType::quantity: {
      const std::string unit = units::siUnit(value.key.dimension);
      return unit.empty() ? fmt::format("{}", value.numbers[i]) : fmt::format("{} {}", value.numbers[i], unit);
    }
    case KeyType::number:
      return fmt::format("{}", value.numbers[i]);
    case KeyType::integer:
      return fmt::format("{}", value.integers[i]);
    case KeyType::boolean:
      return value.integers[i] != 0 ? "true" : "false";
    case KeyType::string:
    case KeyType::choice:
      return yamlText(value.texts[i]);
  }
  return {};
}

void writeYaml(const Branch& branch, std::string& out, std::size_t depth) {
  for (const Branch& child : branch.children) {
    out.append(2 * depth, ' ');
    out += branch.isList ? "-" : yamlText(child.name) + ":";
    if (child.value == nullptr) {
      out += '\n';
      writeYaml(child, out, depth + 1);
      continue;
    }
    std::string text;
    for (std::size_t i = 0; i < countOf(*child.value); ++i) text += (i > 0 ? ", " : "") + yamlItem(*child.value, i);
    out += child.value->key.isList ? fmt::format(" [{}]\n", text) : fmt::format(" {}\n", text);
  }
}

void writeJsonItem(const DeckValue& value, std::size_t i, JsonWriter& json) {
  switch (value.key.type) {
    case KeyType::quantity:
    case KeyType::number:
      json.value(value.numbers[i]);
      return;
    case KeyType::integer:
      json.value(value.integers[i]);
      return;
    case KeyType::boolean:
      json.value(value.integers[i] != 0);
      return;
    case KeyType::string:
    case KeyType::choice:
      json.value(value.texts[i]);
      return;
  }
}

void writeJson(const Branch& branch, JsonWriter& json) {
  if (branch.value == nullptr) {
    branch.isList ? json.beginArray() : json.beginObject();
    for (const Branch& child : branch.children) {
      if (!branch.isList) json.key(child.name);
      writeJson(child, json);
    }
    branch.isList ? json.endArray() : json.endObject();
  } else if (branch.value->key.isList) {
    json.beginArray();
    for (std::size_t i = 0; i < countOf(*branch.value); ++i) writeJsonItem(*branch.value, i, json);
    json.endArray();
  } else {
    writeJsonItem(*branch.value, 0, json);
  }
}

}  // namespace

std::string Deck::resolved() const {
  std::string text;
  writeYaml(treeOf(root_, values_, index_), text, 0);
  return text;
}

std::string Deck::resolvedJson() const {
  JsonWriter json;
  writeJson(treeOf(root_, values_, index_), json);
  return json.text();
}

}  // namespace lampblack::io
