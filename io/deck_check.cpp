#include "io/deck_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "core/nearest_name.hpp"
#include "io/deck_conditions.hpp"
#include "io/deck_former_names.hpp"
#include "io/deck_hints.hpp"
#include "io/deck_mistakes.hpp"
#include "io/deck_value.hpp"

namespace lampblack::io {
namespace {

using SchemaNode = DeckSchema::Node;

class Checker {
 public:
  Checker(const DeckSource& source, const DeckSchema& schema) : source_(source), schema_(schema) {}

  // First every name, then every value: a misspelt required key is reported as misspelt, not as missing. Which keys
  // count with which choices is asked where all values are right.
  std::vector<DeckValue> check(const DeckNode& root) {
    const SchemaNode tree = schema_.tree();
    checkNames(tree, root, "");
    readSection(tree, &root, "", root);
    mistakes_.raise();
    applyConditions(source_, tree, root, values_);
    return std::move(values_);
  }

 private:
  void checkNames(const SchemaNode& schema, const DeckNode& node, const std::string& path) {
    if (schema.key != nullptr) return;
    if (const SchemaNode* item = schema.itemFor(node.kind)) {
      for (std::size_t i = 0; i < node.children.size() && node.kind == DeckNode::Kind::list; ++i) {
        checkNames(*item, node.children[i], fmt::format("{}[{}]", path, i));
      }
      return;
    }
    if (node.kind != DeckNode::Kind::map) return;
    const SchemaNode* any = schema.child("*");
    for (const DeckNode& child : node.children) {
      const SchemaNode* known = schema.child(child.name);
      const std::string childPath = joinedPath(path, child.name);
      if (known == nullptr && any != nullptr && child.name.find_first_of(".[]") != std::string::npos) {
        mistakes_.add(child.nameAt, deckError(source_, child.nameAt, childPath,
                                              "a name may not contain '.', '[' or ']'; write '_' in its place, also "
                                              "where a mesh file has such a name"));
        unread_.insert(&child);
        continue;
      }
      if (known == nullptr) known = any;
      if (known == nullptr) {
        mistakes_.add(child.nameAt, unknown(schema, child, childPath));
        hasUnknown_.insert(&node);
        continue;
      }
      checkNames(*known, child, childPath);
    }
  }

  // Of a section that this kind of deck has not: the one section here that has all of its keys.
  std::string whereChildrenStand(const DeckNode& section) const {
    std::string found;
    for (const DeckKey& first : schema_.keys()) {
      const std::string end = "." + section.children.front().name;
      if (!first.path.ends_with(end)) continue;
      const std::string candidate = first.path.substr(0, first.path.size() - end.size());
      const bool hasAll = std::ranges::all_of(section.children, [&](const DeckNode& child) {
        return std::ranges::any_of(schema_.keys(), [&](const DeckKey& key) {
          return key.path == fmt::format("{}.{}", candidate, child.name);
        });
      });
      if (!hasAll || candidate.find_first_of("*[") != std::string::npos) continue;
      if (!found.empty()) return {};
      found = candidate;
    }
    return found.empty() ? "" : fmt::format("; did you mean '{}'?", found);
  }

  // Keys of this name that sections in this section have.
  static std::vector<std::string> ofParts(const SchemaNode& schema, const std::string& name) {
    std::vector<std::string> paths;
    for (const SchemaNode& part : schema.children)
      if (const SchemaNode* key = part.name.find_first_of("*[") == std::string::npos ? part.child(name) : nullptr;
          key != nullptr && key->key != nullptr && !schema.path.empty())
        paths.push_back(key->path);
    return paths.size() > 3 ? std::vector<std::string>() : paths;
  }

  // Perhaps a key is right elsewhere.
  std::string ofElsewhere(const std::string& name) const {
    std::vector<std::string> paths;
    for (const DeckKey& key : schema_.keys()) {
      if (key.path == name) return fmt::format("; '{}' stands at the top of the deck, not in a section.", key.path);
      const bool isFormer = std::ranges::find(key.formerNames, name) != key.formerNames.end();
      if ((key.path.ends_with("." + name) || isFormer) && paths.size() < 3) paths.push_back(key.path);
    }
    return didYouMeanOneOf(paths);
  }

  InputError unknown(const SchemaNode& schema, const DeckNode& node, const std::string& path) const {
    std::vector<std::string> here;
    for (const SchemaNode& child : schema.children)
      if (child.name != "[]") here.push_back(child.name);
    std::string hint = byOtherName(node.name, here, schema_.otherNames());
    if (hint.empty() && node.kind == DeckNode::Kind::null && node.name.find_first_of("0123456789") == 0)
      hint = "; a number has a decimal point, 1.5.";  // what is behind the comma of "{end: 1,5 ms}"
    if (hint.empty() && node.name.find(':') != std::string::npos)
      hint = "; a text with a comma in it stands in quotes, \"H2: 2, O2: 1\".";
    if (hint.empty()) hint = didYouMeanOneOf(ofParts(schema, node.name));
    if (hint.empty()) hint = didYouMean(node.name, here);
    if (const std::string present = presentName(schema, node.name); hint.empty() && !present.empty())
      hint = fmt::format("; did you mean '{}'?", present);
    if (hint.empty()) hint = ofElsewhere(node.name);
    if (hint.empty())
      if (const std::string similar = nameOfSameWords(node.name, here); !similar.empty())
        hint = fmt::format("; did you mean '{}'?", similar);
    if (hint.empty() && !node.children.empty() && !node.children.front().name.empty()) hint = whereChildrenStand(node);
    return deckError(
        source_, node.nameAt, path,
        fmt::format("unknown key '{}'{} Known here: {}", node.name, hint.empty() ? "." : hint, fmt::join(here, ", ")));
  }

  // `node` may be absent (nullptr); `enclosing` is the nearest part of the deck that is there.
  void read(const SchemaNode& schema, const DeckNode* node, const std::string& path, const DeckNode& enclosing) {
    if (schema.key == nullptr) {
      readSection(schema, node, path, enclosing);
    } else if (node != nullptr) {
      mistakes_.collect(node->at.line > 0 ? node->at : node->nameAt, [&] {
        values_.push_back(readDeckValue(source_, *schema.key, path, *node, schema_.otherNames()));
      });
    } else if (schema.key->presence == Presence::defaulted) {
      values_.push_back(defaultDeckValue(*schema.key, path));
    } else if (schema.key->presence == Presence::required && !hasUnknown_.contains(&enclosing)) {
      mistakes_.add(enclosing.nameAt, deckError(source_, enclosing.nameAt, path,
                                                fmt::format("this key is missing; expected {}. {}",
                                                            expectation(*schema.key), schema.key->doc)));
    }
  }

  void readSection(const SchemaNode& schema, const DeckNode* node, const std::string& path, const DeckNode& enclosing) {
    const bool empty = node == nullptr || node->kind == DeckNode::Kind::null;
    if (schema.section != nullptr) {
      const bool hollow = empty || (node->kind != DeckNode::Kind::scalar && node->children.empty());
      if (schema.section->presence == Presence::required && hollow) {
        const DeckLocation& at = node ? node->nameAt : enclosing.nameAt;
        if (node != nullptr || !hasUnknown_.contains(&enclosing))
          mistakes_.add(at, deckError(source_, at, path,
                                      fmt::format("this section is missing or empty. {}", schema.section->doc)));
        return;
      }
      if (schema.section->presence == Presence::optional && node == nullptr) return;
    }
    const DeckNode& here = node ? *node : enclosing;
    if (const SchemaNode* item = schema.itemFor(empty ? DeckNode::Kind::null : node->kind)) {
      if (empty) return;
      if (node->kind != DeckNode::Kind::list) return addWrongKind("a list", *node, path);
      for (std::size_t i = 0; i < node->children.size(); ++i) {
        read(*item, &node->children[i], fmt::format("{}[{}]", path, i), here);
      }
      return;
    }
    if (!empty && node->kind != DeckNode::Kind::map)
      return addWrongKind(ofSection(schema) + asSection(source_, schema, *node), *node, path);
    for (const SchemaNode& child : schema.children) {
      if (child.name == "[]") continue;
      if (child.name != "*") {
        read(child, empty ? nullptr : node->child(child.name), joinedPath(path, child.name), here);
        continue;
      }
      for (std::size_t i = 0; !empty && i < node->children.size(); ++i) {
        const DeckNode& entry = node->children[i];
        if (schema.child(entry.name) == nullptr && !unread_.contains(&entry))
          read(child, &entry, joinedPath(path, entry.name), here);
      }
    }
  }

  // What a section with names of the user's own expects of its kind.
  [[nodiscard]] static std::string ofSection(const SchemaNode& section) {
    if (section.child("[]") != nullptr) return "a map of keys or a list of such maps";
    const SchemaNode* any = section.child("*");
    if (any == nullptr || any->children.empty()) return "a map of keys";
    return fmt::format("a map of names, each with its keys, 'NAME: {{{}: ...}}'", any->children.front().name);
  }

  void addWrongKind(const std::string& expected, const DeckNode& node, const std::string& path) {
    const DeckLocation& at = node.at.line > 0 ? node.at : node.nameAt;
    mistakes_.add(at, deckError(source_, at, path, fmt::format("expected {}, found {}", expected, foundText(node))));
  }

  const DeckSource& source_;
  const DeckSchema& schema_;
  std::vector<DeckValue> values_;
  DeckMistakes mistakes_;
  std::set<const DeckNode*> hasUnknown_, unread_;  // sections with unknown keys; what has no path
};

}  // namespace

std::vector<DeckValue> checkDeck(const DeckSource& source, const DeckNode& root, const DeckSchema& schema) {
  return Checker(source, schema).check(root);
}

const DeckKind& chooseKind(const DeckSource& source, const DeckNode& root, const DeckKinds& kinds) {
  std::vector<std::string> names;
  for (const DeckKind& kind : kinds.kinds) names.push_back(kind.name);
  const DeckNode* node = root.child(kinds.key);
  if (node == nullptr) {
    for (const DeckNode& child : root.children)
      if (const std::string hint = didYouMean(child.name, {kinds.key}); !hint.empty())
        throw deckError(source, child.nameAt, child.name, fmt::format("unknown key '{}'{}", child.name, hint));
    throw deckError(source, root.nameAt, kinds.key,
                    fmt::format("this key is missing; expected one of: {}", fmt::join(names, ", ")));
  }
  for (const DeckKind& kind : kinds.kinds)
    for (const std::string& name : namesOfKind(kind, kinds.key))
      if (node->kind == DeckNode::Kind::scalar && node->text == name) return kind;
  throw deckError(source, node->at.line > 0 || node->at.overrideIndex >= 0 ? node->at : node->nameAt, kinds.key,
                  fmt::format("expected one of: {}; found {}{}", fmt::join(names, ", "), foundText(*node),
                              didYouMean(node->text, names)));
}

bool isDeclared(const DeckSchema& schema, std::string_view path) {
  const std::vector<std::string> parts = splitDeckPath(path);
  for (const DeckKey& key : schema.keys()) {
    const std::vector<std::string> pattern = splitDeckPath(key.path);
    bool match = pattern.size() == parts.size();
    for (std::size_t i = 0; match && i < parts.size(); ++i) {
      match = pattern[i] == "*" || pattern[i].empty() || pattern[i] == parts[i];
    }
    if (match) return true;
  }
  return false;
}

}  // namespace lampblack::io
