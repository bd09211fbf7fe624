#include "io/deck_schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "io/deck_node.hpp"

namespace lampblack::io {

std::string joinedPath(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

DeckKey& DeckKey::required() {
  presence = Presence::required;
  isPresenceSaid = true;
  return *this;
}

DeckKey& DeckKey::optional() {
  presence = Presence::optional;
  isPresenceSaid = true;
  return *this;
}

DeckKey& DeckKey::byDefault(std::string text) {
  presence = Presence::defaulted;
  isPresenceSaid = true;
  defaultText = std::move(text);
  return *this;
}

DeckKey& DeckKey::byDefault(std::string text, std::vector<DeckCondition> where) {
  otherDefaults.push_back({std::move(text), std::move(where)});
  return *this;
}

DeckKey& DeckKey::atLeast(double si) {
  minimum = Bound{si, false};
  return *this;
}

DeckKey& DeckKey::atMost(double si) {
  maximum = Bound{si, false};
  return *this;
}

DeckKey& DeckKey::above(double si) {
  minimum = Bound{si, true};
  return *this;
}

DeckKey& DeckKey::below(double si) {
  maximum = Bound{si, true};
  return *this;
}

DeckKey& DeckKey::list() {
  isList = true;
  return *this;
}

DeckKey& DeckKey::list(std::size_t n) {
  isList = true;
  count = n;
  return *this;
}

DeckKey& DeckKey::formerly(std::string before) {
  formerNames.push_back(std::move(before));
  return *this;
}

DeckKey& DeckKey::formerly(std::string before, std::string now) {
  formerChoices.emplace_back(std::move(before), std::move(now));
  return *this;
}

DeckKey& DeckKey::onlyWith(std::string otherKey, std::vector<std::string> otherChoices) {
  return onlyWith(DeckCondition{std::move(otherKey), std::move(otherChoices)});
}

DeckKey& DeckKey::onlyWith(DeckCondition condition) {
  conditions.push_back(std::move(condition));
  return *this;
}

DeckKey quantityKey(std::string path, const units::Dimension& dimension, std::string doc) {
  DeckKey key(std::move(path), KeyType::quantity, std::move(doc));
  key.dimension = dimension;
  return key;
}

DeckKey numberKey(std::string path, std::string doc) {
  return {std::move(path), KeyType::number, std::move(doc)};
}
DeckKey integerKey(std::string path, std::string doc) {
  return {std::move(path), KeyType::integer, std::move(doc)};
}
DeckKey booleanKey(std::string path, std::string doc) {
  return {std::move(path), KeyType::boolean, std::move(doc)};
}
DeckKey stringKey(std::string path, std::string doc) {
  return {std::move(path), KeyType::string, std::move(doc)};
}

DeckKey choiceKey(std::string path, std::vector<std::string> choices, std::string doc) {
  DeckKey key(std::move(path), KeyType::choice, std::move(doc));
  key.choices = std::move(choices);
  return key;
}

DeckKey vectorKey(std::string path, const units::Dimension& dimension, std::string doc) {
  return quantityKey(std::move(path), dimension, std::move(doc)).list(3);
}

std::string rangeText(const DeckKey& key) {
  const std::string unit = key.type == KeyType::quantity ? units::siUnit(key.dimension) : "";
  const std::string suffix = unit.empty() ? "" : " " + unit;
  const auto& low = key.minimum;
  const auto& high = key.maximum;
  if (low && high && !low->exclusive && !high->exclusive) {
    return fmt::format("from {} to {}{}", low->value, high->value, suffix);
  }
  std::string text;
  if (low) text = fmt::format("{} {}{}", low->exclusive ? "above" : "at least", low->value, suffix);
  if (low && high) text += " and ";
  if (high) text += fmt::format("{} {}{}", high->exclusive ? "below" : "at most", high->value, suffix);
  return text;
}

std::string expectation(const DeckKey& key) {
  std::string one;
  switch (key.type) {
    case KeyType::quantity:
      one = units::describe(key.dimension);
      if (const std::string example = units::example(key.dimension); !example.empty()) {
        one += fmt::format(" (for instance '{}')", example);
      }
      break;
    case KeyType::number:
      one = "a number";
      break;
    case KeyType::integer:
      one = "an integer";
      break;
    case KeyType::boolean:
      one = "true or false";
      break;
    case KeyType::string:
      one = "a text";
      break;
    case KeyType::choice:
      one = fmt::format("one of: {}", fmt::join(key.choices, ", "));
      break;
  }
  if (const std::string range = rangeText(key); !range.empty()) one += " " + range;
  if (!key.isList) return one;
  return key.count ? fmt::format("a list of {}, each {}", *key.count, one) : fmt::format("a list, each item {}", one);
}

const DeckSchema::Node* DeckSchema::Node::child(const std::string& childName) const {
  for (const Node& node : children) {
    if (node.name == childName) return &node;
  }
  return nullptr;
}

const DeckSchema::Node* DeckSchema::Node::itemFor(DeckNode::Kind kind) const {
  return kind == DeckNode::Kind::list || children.size() == 1 ? child("[]") : nullptr;
}

namespace {

// A schema has hundreds of keys, and each is compared with all: nothing here makes a text.

// Whether a former name of `key` is the path of `other`.
bool formerlyNamed(const DeckKey& key, const DeckKey& other) {
  if (key.formerNames.empty()) return false;
  const std::string_view section =
      std::string_view(key.path).substr(0, key.path.rfind('.') + 1);  // with its dot, if any
  const std::string_view path = other.path;
  return path.starts_with(section) &&
         std::ranges::find(key.formerNames, path.substr(section.size())) != key.formerNames.end();
}

// Whether `path` is `whole` or lies below it: "mesh.r" and "mesh.r[]" below "mesh".
bool isWithin(std::string_view path, std::string_view whole) {
  if (!path.starts_with(whole)) return false;
  return path.size() == whole.size() || path[whole.size()] == '.' || path[whole.size()] == '[';
}

}  // namespace

DeckSchema& DeckSchema::add(DeckKey key) {
  for (const DeckKey& other : keys_) {
    if (formerlyNamed(key, other) || formerlyNamed(other, key))
      throw std::logic_error(
          fmt::format("deck keys '{}' and '{}': one has the former name of the other", key.path, other.path));
    if (isWithin(other.path, key.path) || isWithin(key.path, other.path)) {
      throw std::logic_error(fmt::format("deck key '{}' clashes with '{}'", key.path, other.path));
    }
  }
  if (key.type == KeyType::choice && key.choices.empty()) {
    throw std::logic_error(fmt::format("deck key '{}' has no choices", key.path));
  }
  keys_.push_back(std::move(key));
  return *this;
}

DeckSchema& DeckSchema::section(std::string path, Presence presence, std::string doc,
                                std::vector<DeckCondition> onlyWith) {
  for (const DeckSection& other : sections_) {
    if (other.path == path) throw std::logic_error(fmt::format("deck section '{}' is declared twice", path));
  }
  sections_.push_back({std::move(path), presence, std::move(doc), std::move(onlyWith)});
  return *this;
}

DeckSchema& DeckSchema::add(const DeckSchema& other) {
  for (const DeckKey& key : other.keys_) add(key);
  for (const DeckSection& part : other.sections_) section(part.path, part.presence, part.doc, part.conditions);
  calledElsewhere(other.otherNames_);
  if (!other.former_.table.empty()) {
    if (!former_.table.empty()) throw std::logic_error("two parts of a deck's keys have former sections");
    former_ = other.former_;
  }
  return *this;
}

DeckSchema& DeckSchema::add(DeckSchema other, const DeckCondition& onlyWith) {
  const auto isInSection = [&](const std::string& path) {
    return std::ranges::any_of(other.sections_, [&](const DeckSection& part) {
      return path.size() > part.path.size() && isWithin(path, part.path);
    });
  };
  for (DeckKey& key : other.keys_)
    if (!isInSection(key.path)) key.conditions.push_back(onlyWith);
  for (DeckSection& part : other.sections_)
    if (!isInSection(part.path)) part.conditions.push_back(onlyWith);
  return add(other);
}

DeckSchema& DeckSchema::formerly(FormerSections sections) {
  former_ = std::move(sections);
  return *this;
}

DeckSchema& DeckSchema::calledElsewhere(OtherNames names) {
  otherNames_.insert(otherNames_.end(), names.begin(), names.end());
  return *this;
}

void DeckSchema::checkConditions(const std::string& path, const std::vector<DeckCondition>& conditions) const {
  for (const DeckCondition& condition : conditions) {
    checkConditions(path, condition.others);
    const auto other =
        std::find_if(keys_.begin(), keys_.end(), [&](const DeckKey& key) { return key.path == condition.key; });
    if (other == keys_.end())
      throw std::logic_error(fmt::format("deck: '{}' depends on '{}', which is no key", path, condition.key));
    const std::vector<std::string> known =
        other->type == KeyType::boolean ? std::vector<std::string>{"true", "false"} : other->choices;
    for (const std::string& choice : condition.choices)
      if (std::find(known.begin(), known.end(), choice) == known.end())
        throw std::logic_error(
            fmt::format("deck: '{}' depends on '{}: {}', which is no choice of that key", path, condition.key, choice));
  }
}

DeckSchema::Node DeckSchema::tree() const {
  Node root;
  const auto place = [&root](const std::string& path) {
    Node* node = &root;
    for (std::string part : splitDeckPath(path)) {
      if (part.empty()) part = "[]";
      if (node->child(part) == nullptr) {
        Node made;
        made.name = part;
        made.path = part == "[]" ? node->path + part : (node->path.empty() ? "" : node->path + ".") + part;
        node->children.push_back(std::move(made));
      }
      node = const_cast<Node*>(node->child(part));
    }
    return node;
  };
  for (const DeckKey& key : keys_) {
    checkConditions(key.path, key.conditions);
    for (const DeckDefault& other : key.otherDefaults) checkConditions(key.path, other.conditions);
    place(key.path)->key = &key;
  }
  for (const auto& [former, present] : former_.table)
    if (former.find('.') == std::string::npos) root.formerSections.emplace_back(former, present);
  for (const DeckSection& section : sections_) {
    checkConditions(section.path, section.conditions);
    place(section.path)->section = &section;
  }
  return root;
}

}  // namespace lampblack::io
