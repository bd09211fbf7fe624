#include "io/deck_base.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "core/text_file.hpp"

namespace lampblack::io {
namespace {

constexpr std::uintmax_t largestDeck = 16U << 20U;  // bytes; a deck is a page or two

DeckFile readDeckFile(const std::filesystem::path& path) {
  return {path, readTextFile(path, "a deck", largestDeck)};
}

void placeInBase(DeckNode& node) {
  node.nameAt.isInBase = node.at.isInBase = true;
  for (DeckNode& child : node.children) placeInBase(child);
}

void putOver(DeckNode& base, DeckNode own) {
  if (base.kind != DeckNode::Kind::map || own.kind != DeckNode::Kind::map) {
    base = std::move(own);
    return;
  }
  for (DeckNode& child : own.children) {
    if (DeckNode* there = base.child(child.name))
      putOver(*there, std::move(child));
    else
      base.children.push_back(std::move(child));
  }
}

}  // namespace

DeckSource readDeck(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  DeckSource source{readDeckFile(path), {}, overrides};
  const DeckNode root = parseDeck(source.file);
  const DeckNode* name = root.child(baseKey);
  if (name == nullptr) return source;
  const std::filesystem::path file(name->text);
  if (name->kind != DeckNode::Kind::scalar || file.empty() || file != file.filename())
    throw deckError(
        source, name->at.line > 0 ? name->at : name->nameAt, baseKey,
        fmt::format("expected the name of a deck in the same folder ('deck.yaml'), found {}", foundText(*name)));
  try {
    source.base = readDeckFile(path.parent_path() / file);
  } catch (const InputError& error) {
    throw deckError(source, name->at, baseKey, error.what());
  }
  return source;
}

DeckNode parseOnBase(const DeckSource& source) {
  DeckNode own = parseDeck(source.file);
  if (!source.base) return own;
  std::erase_if(own.children, [](const DeckNode& child) { return child.name == baseKey; });
  DeckNode root = parseDeck(*source.base);
  placeInBase(root);
  if (const DeckNode* second = root.child(baseKey))
    throw deckError(source, second->nameAt, baseKey, "a deck that others go on from has no base of its own");
  putOver(root, std::move(own));
  return root;
}

}  // namespace lampblack::io
