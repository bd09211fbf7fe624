#include "io/deck_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "io/deck_mistakes.hpp"

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
  // False where a condition does not hold of something the deck does not say; InputError where it says it.
  bool hold(const std::vector<DeckCondition>& conditions, const DeckNode* node, const std::string& path) const {
    for (const DeckCondition& condition : conditions) {
      const std::string other = beside(condition.key, path);
      const auto found = index_.find(other);
      const std::string value = found == index_.end() ? "" : textOf(values_[found->second]);
      if (std::find(condition.choices.begin(), condition.choices.end(), value) != condition.choices.end()) continue;
      if (node == nullptr) return false;
      const std::string wanted = fmt::format("{}", fmt::join(condition.choices, ", "));
      throw deckError(
          source_, node->nameAt, path,
          value.empty()
              ? fmt::format("this counts only with '{}'; leave it out, or choose: {}", other, wanted)
              : fmt::format("'{}: {}' does not have this; leave it out, or choose: {}", other, value, wanted));
    }
    return true;
  }

  const DeckSource& source_;
  std::vector<DeckValue>& values_;
  std::map<std::string, std::size_t, std::less<>> index_;
  DeckMistakes mistakes_;
};

}  // namespace

void applyConditions(const DeckSource& source, const SchemaNode& schema, const DeckNode& root,
                     std::vector<DeckValue>& values) {
  Conditions conditions(source, values);
  conditions.apply(schema, &root, "", true);
  conditions.raise();
}

}  // namespace lampblack::io
