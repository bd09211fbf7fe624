#include "io/deck_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "io/deck_mistakes.hpp"
#include "io/deck_value.hpp"

namespace lampblack::io {
namespace {

using SchemaNode = DeckSchema::Node;

// The path of another key beside `path`: "boundaries.*.type" beside "boundaries.fuel.velocity" is
// "boundaries.fuel.type".
std::string beside(const std::string& other, const std::string& path) {
  const std::vector<std::string> here = splitDeckPath(path);
  const std::vector<std::string> parts = splitDeckPath(other);
  std::string result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty())
      result += fmt::format("[{}]", here.at(i));
    else
      result += (i > 0 ? "." : "") + (parts[i] == "*" ? here.at(i) : parts[i]);
  }
  return result;
}

std::string textOf(const DeckValue& value) {
  if (value.key.type == KeyType::boolean) return value.integers[0] != 0 ? "true" : "false";
  return value.texts[0];
}

class Conditions {
 public:
  Conditions(const DeckSource& source, std::vector<DeckValue>& values) : source_(source), values_(values) {
    for (std::size_t i = 0; i < values.size(); ++i) index_.emplace(values[i].path, i);
  }

  // Defaults that depend on other keys.
  void chooseDefaults() {
    for (DeckValue& value : values_) {
      if (!value.isDefault) continue;
      for (const DeckDefault& other : value.key.otherDefaults) {
        if (!std::ranges::all_of(other.conditions, [&](const auto& one) { return holds(one, value.path); })) continue;
        DeckKey key = value.key;
        key.defaultText = other.text;
        value = defaultDeckValue(key, value.path);
        break;
      }
    }
  }

  // `counts`: the enclosing section does.
  void apply(const SchemaNode& schema, const DeckNode* node, const std::string& path, bool counts) {
    const auto add = [&](const std::vector<DeckCondition>& conditions) {
      bool holds = false;
      mistakes_.collect(node == nullptr ? DeckLocation{} : node->nameAt, [&] { holds = hold(conditions, node, path); });
      counts = holds && counts;
    };
    if (schema.section != nullptr) add(schema.section->conditions);
    if (schema.key != nullptr) {
      add(schema.key->conditions);
      if (const auto value = index_.find(path); value != index_.end()) values_[value->second].counts = counts;
      return;
    }
    const bool isList = node != nullptr && node->kind == DeckNode::Kind::list;
    for (const SchemaNode& child : schema.children) {
      if (child.name == "[]" && !isList) continue;
      if (child.name == "[]" || child.name == "*") {
        for (std::size_t i = 0; node != nullptr && i < node->children.size(); ++i) {
          const DeckNode& entry = node->children[i];
          if (child.name == "[]")
            apply(child, &entry, fmt::format("{}[{}]", path, i), counts);
          else if (schema.child(entry.name) == nullptr)
            apply(child, &entry, joinedPath(path, entry.name), counts);
        }
      } else {
        apply(child, node == nullptr ? nullptr : node->child(child.name), joinedPath(path, child.name), counts);
      }
    }
  }

  void raise() const { mistakes_.raise(); }

 private:
  [[nodiscard]] std::string valueOf(const std::string& path) const {
    const auto found = index_.find(path);
    return found == index_.end() ? "" : textOf(values_[found->second]);
  }

  [[nodiscard]] bool isDefault(const std::string& path) const {
    const auto found = index_.find(path);
    return found != index_.end() && values_[found->second].isDefault;
  }

  [[nodiscard]] bool holds(const DeckCondition& condition, const std::string& path) const {
    return std::ranges::find(condition.choices, valueOf(beside(condition.key, path))) != condition.choices.end() ||
           std::ranges::any_of(condition.others, [&](const DeckCondition& other) { return holds(other, path); });
  }

  // False where a condition does not hold of something the deck does not say; InputError where it says it.
  bool hold(const std::vector<DeckCondition>& conditions, const DeckNode* node, const std::string& path) const {
    for (const DeckCondition& condition : conditions) {
      if (holds(condition, path)) continue;
      if (node == nullptr) return false;
      const std::string other = beside(condition.key, path), value = valueOf(other);
      std::string wanted = fmt::format("{}", fmt::join(condition.choices, ", "));
      for (const DeckCondition& one : condition.others)
        wanted += fmt::format("; or '{}': {}", beside(one.key, path), fmt::join(one.choices, ", "));
      throw deckError(source_, node->nameAt, path,
                      value.empty()
                          ? fmt::format("this counts only with '{}'; leave it out, or choose: {}", other, wanted)
                          : fmt::format("'{}: {}' does not have this; leave it out, or choose: {}{}", other, value,
                                        wanted, isDefault(other) ? fmt::format(" ({} is the default)", value) : ""));
    }
    return true;
  }

  const DeckSource& source_;
  std::vector<DeckValue>& values_;
  std::map<std::string, std::size_t, std::less<>> index_;
  DeckMistakes mistakes_;
};

}  // namespace

std::string partsText(const std::vector<DeckCondition>& conditions) {
  std::vector<std::string> parts;
  for (const DeckCondition& condition : conditions) {
    std::string part = fmt::format("`{}`: `{}`", condition.key, fmt::join(condition.choices, "`, `"));
    for (const DeckCondition& other : condition.others)
      part += fmt::format(" or `{}`: `{}`", other.key, fmt::join(other.choices, "`, `"));
    parts.push_back(part);
  }
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string conditionText(const std::vector<DeckCondition>& conditions) {
  return conditions.empty() ? "" : fmt::format("Only with {}.", partsText(conditions));
}

void applyConditions(const DeckSource& source, const SchemaNode& schema, const DeckNode& root,
                     std::vector<DeckValue>& values) {
  Conditions conditions(source, values);
  conditions.chooseDefaults();
  conditions.apply(schema, &root, "", true);
  conditions.raise();
}

}  // namespace lampblack::io
