#include "io/deck_former_sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/deck_former_names.hpp"

namespace lampblack::io {
namespace {

class Mover {
 public:
  Mover(const DeckSource& source, const FormerSections& former) : source_(source), former_(former) {}

  // Keys whose names have changed, for the note of their section.
  std::vector<std::string> move(const std::string& section, DeckNode from, DeckNode& root) const {
    std::vector<std::string> renamed;
    for (DeckNode& child : from.children) {
      const std::string before = joinedPath(section, child.name), now = presentPath(section, child.name);
      if (!now.ends_with("." + child.name)) renamed.push_back(fmt::format("'{}' as '{}'", before, now));
      const std::size_t dot = now.rfind('.');
      child.name = now.substr(dot + 1);
      give(placeOf(now.substr(0, dot), from, root), std::move(child), before, now);
    }
    placeOf(presentPath(section, ""), from, root);  // also of an empty section
    return renamed;
  }

 private:
  [[nodiscard]] std::string presentPath(const std::string& section, const std::string& name) const {
    std::string present;
    for (const auto& [before, now] : former_.table) {
      if (before == joinedPath(section, name)) return now;
      if (before == section) present = now;
    }
    return name.empty() ? present : joinedPath(present, name);
  }

  // The map at a path, made where `like` stands if it is not there.
  DeckNode& placeOf(const std::string& path, const DeckNode& like, DeckNode& root) const {
    DeckNode* node = &root;
    for (const std::string& part : splitDeckPath(path)) {
      DeckNode* next = node->child(part);
      if (next == nullptr) {
        node->children.emplace_back();
        next = &node->children.back();
        next->name = part;
        next->nameAt = like.nameAt;
        next->at = like.at;
      }
      if (next->kind == DeckNode::Kind::null) next->kind = DeckNode::Kind::map;
      if (next->kind != DeckNode::Kind::map)
        throw deckError(source_, next->nameAt, part, fmt::format("expected a map of keys, found {}", foundText(*next)));
      node = next;
    }
    return *node;
  }

  void give(DeckNode& target, DeckNode node, const std::string& before, const std::string& now) const {
    if (DeckNode* other = target.child(node.name))
      join(*other, std::move(node), before, now);
    else
      target.children.push_back(std::move(node));
  }

  void join(DeckNode& other, DeckNode node, const std::string& before, const std::string& now) const {
    if (node.kind == DeckNode::Kind::map && other.kind == DeckNode::Kind::map) {
      for (DeckNode& child : node.children) {
        const std::string name = child.name;
        give(other, std::move(child), joinedPath(before, name), joinedPath(now, name));
      }
    } else if (node.kind == DeckNode::Kind::map && other.kind == DeckNode::Kind::list && isOfItems(node, other)) {
      for (DeckNode& child : node.children) {
        const std::string item = fmt::format("[{}]", child.name);
        DeckNode& place = other.children[std::stoul(child.name)];
        join(place, std::move(child), before + item, now + item);
      }
    } else if (node.at.overrideIndex == other.at.overrideIndex) {
      throw deckError(source_, node.nameAt, before,
                      fmt::format("this is '{}' now, which is given too; leave '{}' out", now, before));
    } else if (node.at.overrideIndex > other.at.overrideIndex) {
      other = std::move(node);
    }
  }

  // What --set makes of "modes[0].size" where the list stands under another name.
  static bool isOfItems(const DeckNode& node, const DeckNode& list) {
    return std::ranges::all_of(node.children, [&](const DeckNode& child) {
      return child.name.size() < 9 && child.name.find_first_not_of("0123456789") == std::string::npos &&
             std::stoul(child.name) < list.children.size();
    });
  }

  const DeckSource& source_;
  const FormerSections& former_;
};

}  // namespace

std::string formerNote(const DeckSource& source, const DeckLocation& at, const std::string& what,
                       const std::string& now) {
  return fmt::format("{}: {} since version {}; {}, as version {} does not read the old one", deckPlace(source, at),
                     what, presentNamesBegin, now, formerNamesEnd);
}

std::vector<std::string> moveFormerSections(const DeckSource& source, const FormerSections& former, DeckNode& root) {
  std::vector<std::string> notes;
  std::vector<std::string> said;
  if (former.settle) said = former.settle(source, root, notes);
  for (const auto& [section, present] : former.table) {
    DeckNode* node = section.find('.') == std::string::npos ? root.child(section) : nullptr;
    if (node == nullptr) continue;
    DeckNode from = std::move(*node);
    root.children.erase(root.children.begin() + (node - root.children.data()));
    if (from.kind != DeckNode::Kind::map && from.kind != DeckNode::Kind::null)
      throw deckError(source, from.nameAt, section, fmt::format("expected a map of keys, found {}", foundText(from)));
    const DeckLocation at = from.nameAt;
    std::vector<std::string> write = Mover(source, former).move(section, std::move(from), root);
    std::ranges::move(said, std::back_inserter(write));
    said.clear();
    const std::string how = write.empty() ? "" : fmt::format(", {}", fmt::join(write, ", "));
    notes.push_back(formerNote(source, at, fmt::format("the keys of '{}' stand in '{}'", section, present),
                               fmt::format("write them there{}", how)));
  }
  return notes;
}

}  // namespace lampblack::io
