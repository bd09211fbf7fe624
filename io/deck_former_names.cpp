#include "io/deck_former_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/nearest_name.hpp"
#include "io/deck_former_sections.hpp"

namespace lampblack::io {
namespace {

using SchemaNode = DeckSchema::Node;

class FormerNames {
 public:
  explicit FormerNames(const DeckSource& source) : source_(source) {}

  void replace(const SchemaNode& schema, DeckNode& node, const std::string& path) {
    if (schema.key != nullptr) {
      replaceChoices(*schema.key, node, path);
      return;
    }
    if (const SchemaNode* item = schema.itemFor(node.kind)) {
      for (std::size_t i = 0; node.kind == DeckNode::Kind::list && i < node.children.size(); ++i)
        replace(*item, node.children[i], fmt::format("{}[{}]", path, i));
      return;
    }
    if (node.kind != DeckNode::Kind::map) return;
    for (const SchemaNode& child : schema.children)
      if (child.key != nullptr)
        for (const std::string& former : child.key->formerNames) replaceKey(child.name, former, node, path);
    for (DeckNode& child : node.children) {
      const SchemaNode* known = schema.child(child.name);
      if (known == nullptr) known = schema.child("*");
      if (known != nullptr) replace(*known, child, joinedPath(path, child.name));
    }
  }

  [[nodiscard]] std::vector<std::string> takeNotes() { return std::move(notes_); }

 private:
  void replaceKey(const std::string& present, const std::string& former, DeckNode& section, const std::string& path) {
    DeckNode* old = section.child(former);
    if (old == nullptr) return;
    note(old->nameAt, joinedPath(path, former), joinedPath(path, present));
    DeckNode* other = section.child(present);
    if (other == nullptr) {
      old->name = present;
      return;
    }
    const int oldOverride = old->at.overrideIndex, otherOverride = other->at.overrideIndex;
    if (oldOverride == otherOverride)
      throw deckError(
          source_, old->nameAt, joinedPath(path, former),
          fmt::format("this is the former name of '{}', which is given too; leave '{}' out", present, former));
    if (oldOverride > otherOverride) {
      old->name = present;
      std::swap(*old, *other);
    }
    section.children.erase(section.children.begin() + (old - section.children.data()));
  }

  void replaceChoices(const DeckKey& key, DeckNode& node, const std::string& path) {
    if (key.formerChoices.empty()) return;
    for (DeckNode& item : node.children) replaceChoices(key, item, path);
    if (node.kind != DeckNode::Kind::scalar) return;
    for (const auto& [former, present] : key.formerChoices) {
      if (node.text != former) continue;
      note(node.at, fmt::format("'{}: {}'", path, former), fmt::format("'{}: {}'", path, present));
      node.text = present;
      return;
    }
  }

  void note(const DeckLocation& at, const std::string& former, const std::string& present) {
    notes_.push_back(formerNote(source_, at, fmt::format("{} is called {}", former, present), "write the new name"));
  }

  const DeckSource& source_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> replaceFormerNames(const DeckSource& source, const DeckSchema& schema, DeckNode& root) {
  FormerNames names(source);
  names.replace(schema.tree(), root, "");
  return names.takeNotes();
}

std::string presentName(const DeckSchema::Node& section, const std::string& name) {
  for (const SchemaNode& child : section.children)
    if (child.key != nullptr && !nearestName(name, child.key->formerNames).empty()) return child.name;
  return {};
}

std::vector<std::string> namesOfKind(const DeckKind& kind, const std::string& key) {
  std::vector<std::string> names{kind.name};
  for (const DeckKey& one : kind.schema.keys())
    if (one.path == key)
      for (const auto& [former, present] : one.formerChoices) names.push_back(former);
  return names;
}

std::string formerNameText(const DeckKey& key) {
  std::vector<std::string> parts;
  for (const std::string& former : key.formerNames)
    parts.push_back(fmt::format("`{}` is a former name of this key", former));
  for (const auto& [former, present] : key.formerChoices)
    parts.push_back(fmt::format("`{}` is a former name of `{}`", former, present));
  return parts.empty()
             ? ""
             : fmt::format("{}; version {} does not read former names.", fmt::join(parts, "; "), formerNamesEnd);
}

}  // namespace lampblack::io
