#include "io/deck.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <stdexcept>

#include "io/deck_base.hpp"
#include "io/deck_check.hpp"
#include "io/deck_former_names.hpp"
#include "io/deck_former_sections.hpp"

namespace lampblack::io {
namespace {

// Rank 0's text on all ranks.
std::string broadcast(std::string text, MPI_Comm comm) {
  auto size = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, comm);
  return text;
}

// Rank 0 reads the files, all ranks parse the same text.
template <typename Schema>
Deck loadCollectively(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                      const Schema& schema, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  DeckSource source{{path, {}}, {}, overrides};
  collectively(comm, [&] {
    if (rank == 0) source = readDeck(path, overrides);
  });
  source.file.text = broadcast(std::move(source.file.text), comm);
  const DeckFile base = source.base.value_or(DeckFile{});
  const std::string ofBase = broadcast(base.path.string(), comm), textOfBase = broadcast(base.text, comm);
  if (!ofBase.empty()) source.base = {ofBase, textOfBase};
  std::optional<Deck> deck;
  collectively(comm, [&] { deck = Deck::parse(std::move(source), schema); });
  return std::move(*deck);
}

}  // namespace

Deck::Deck(DeckSource read, const std::function<const DeckSchema&(const DeckSource&, const DeckNode&)>& choose) {
  const auto source = std::make_shared<DeckSource>(std::move(read));
  source_ = source;
  root_ = parseOnBase(*source);
  for (std::size_t i = 0; i < source->overrides.size(); ++i) applyOverride(root_, *source, i);
  schema_ = std::make_shared<DeckSchema>(choose(*source, root_));
  notes_ = moveFormerSections(*source, schema_->formerSections(), root_);
  const std::vector<std::string> moved = notes_;
  std::ranges::copy(replaceFormerNames(*source, *schema_, root_), std::back_inserter(notes_));
  try {
    values_ = checkDeck(*source, root_, *schema_);
  } catch (const InputError& wrong) {
    // Which speaks of keys as they are called now.
    if (moved.empty()) throw;
    throw InputError(fmt::format("{}\nnote: {}", wrong.what(), fmt::join(moved, "\nnote: ")));
  }
  for (std::size_t i = 0; i < values_.size(); ++i) index_.emplace(values_[i].path, i);
}

Deck Deck::parse(DeckSource source, const DeckSchema& schema) {
  return {std::move(source), [&](const DeckSource&, const DeckNode&) -> const DeckSchema& { return schema; }};
}

Deck Deck::parse(DeckSource source, const DeckKinds& kinds) {
  return {std::move(source), [&](const DeckSource& chosen, const DeckNode& root) -> const DeckSchema& {
            return chooseKind(chosen, root, kinds).schema;
          }};
}

Deck Deck::parse(std::string text, const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 const DeckSchema& schema) {
  return parse({{path, std::move(text)}, {}, overrides}, schema);
}

Deck Deck::parse(std::string text, const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 const DeckKinds& kinds) {
  return parse({{path, std::move(text)}, {}, overrides}, kinds);
}

Deck Deck::load(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                const DeckSchema& schema) {
  return parse(readDeck(path, overrides), schema);
}

Deck Deck::load(const std::filesystem::path& path, const std::vector<std::string>& overrides, const DeckSchema& schema,
                MPI_Comm comm) {
  return loadCollectively(path, overrides, schema, comm);
}

Deck Deck::load(const std::filesystem::path& path, const std::vector<std::string>& overrides, const DeckKinds& kinds,
                MPI_Comm comm) {
  return loadCollectively(path, overrides, kinds, comm);
}

const DeckValue* Deck::find(std::string_view key) const {
  const auto found = index_.find(key);
  return found == index_.end() ? nullptr : &values_[found->second];
}

const DeckValue& Deck::get(std::string_view key, KeyType type, bool list) const {
  const DeckValue* value = find(key);
  if (value == nullptr) {
    throw std::logic_error(
        fmt::format("deck key '{}' is {}", key, isDeclared(*schema_, key) ? "optional and not given" : "not declared"));
  }
  const bool text = type == KeyType::string && value->key.type == KeyType::choice;
  if ((value->key.type != type && !text) || value->key.isList != list) {
    throw std::logic_error(fmt::format("deck key '{}' is declared with another type than it is asked for", key));
  }
  return *value;
}

double Deck::quantity(std::string_view key) const {
  return get(key, KeyType::quantity, false).numbers[0];
}
double Deck::number(std::string_view key) const {
  return get(key, KeyType::number, false).numbers[0];
}
std::int64_t Deck::integerWithin(std::string_view key, std::int64_t low, std::int64_t high) const {
  const std::int64_t value = get(key, KeyType::integer, false).integers[0];
  if (value > high) throw error(key, fmt::format("expected an integer of at most {}, found {}", high, value));
  if (value < low) throw error(key, fmt::format("expected an integer of at least {}, found {}", low, value));
  return value;
}
bool Deck::boolean(std::string_view key) const {
  return get(key, KeyType::boolean, false).integers[0] != 0;
}
std::string Deck::string(std::string_view key) const {
  return get(key, KeyType::string, false).texts[0];
}
std::string Deck::choice(std::string_view key) const {
  return get(key, KeyType::choice, false).texts[0];
}

std::vector<double> Deck::quantities(std::string_view key) const {
  return get(key, KeyType::quantity, true).numbers;
}
std::vector<double> Deck::numbers(std::string_view key) const {
  return get(key, KeyType::number, true).numbers;
}
std::vector<std::int64_t> Deck::integers(std::string_view key) const {
  return get(key, KeyType::integer, true).integers;
}
std::vector<std::string> Deck::strings(std::string_view key) const {
  return get(key, KeyType::string, true).texts;
}

bool Deck::has(std::string_view key) const {
  return find(key) != nullptr || nodeAt(key) != nullptr;
}

bool Deck::isGiven(std::string_view key) const {
  return nodeAt(key) != nullptr;
}

bool Deck::isThere(std::string_view key) const {
  return has(key) || !isDeclared(*schema_, key);  // the read after this says that nobody declared it
}

std::optional<double> Deck::optionalQuantity(std::string_view key) const {
  return isThere(key) ? std::optional(quantity(key)) : std::nullopt;
}
std::optional<double> Deck::optionalNumber(std::string_view key) const {
  return isThere(key) ? std::optional(number(key)) : std::nullopt;
}
std::optional<bool> Deck::optionalBoolean(std::string_view key) const {
  return isThere(key) ? std::optional(boolean(key)) : std::nullopt;
}
std::optional<std::string> Deck::optionalString(std::string_view key) const {
  return isThere(key) ? std::optional(string(key)) : std::nullopt;
}

namespace {

// The part of the tree under a path, or nullptr; `deepest` is the last part on the way that is there.
const DeckNode* descend(const DeckNode& root, std::string_view path, const DeckNode** deepest) {
  const DeckNode* node = &root;
  *deepest = node;
  for (const std::string& part : splitDeckPath(path)) {
    if (node->kind == DeckNode::Kind::list) {
      std::size_t item = 0;
      const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), item);
      if (status != std::errc{} || end != part.data() + part.size() || item >= node->children.size()) return nullptr;
      node = &node->children[item];
    } else {
      node = node->child(part);
    }
    if (node == nullptr) return nullptr;
    *deepest = node;
  }
  return node;
}

// The item of a list that a message quotes first; of several that are alike the last.
const DeckNode* quotedItem(const DeckNode& list, const std::string& message) {
  const DeckNode* found = nullptr;
  std::size_t first = std::string::npos;
  for (const DeckNode& item : list.children) {
    const std::size_t place = item.kind == DeckNode::Kind::scalar ? message.find("'" + item.text + "'") : first;
    if (place == std::string::npos || place > first) continue;
    first = place;
    found = &item;
  }
  return found;
}

}  // namespace

const DeckNode* Deck::nodeAt(std::string_view key) const {
  const DeckNode* deepest = nullptr;
  return descend(root_, key, &deepest);
}

std::vector<std::string> Deck::children(std::string_view section) const {
  std::vector<std::string> names;
  const DeckNode* node = section.empty() ? &root_ : nodeAt(section);
  if (node == nullptr || node->kind != DeckNode::Kind::map) return names;
  for (const DeckNode& child : node->children) names.push_back(child.name);
  return names;
}

std::size_t Deck::size(std::string_view list) const {
  const DeckNode* node = nodeAt(list);
  return node != nullptr && node->kind == DeckNode::Kind::list ? node->children.size() : 0;
}

InputError Deck::error(std::string_view key, const std::string& message) const {
  const DeckNode* deepest = nullptr;
  const DeckNode* node = descend(root_, key, &deepest);
  if (node != nullptr && node->kind == DeckNode::Kind::list)
    if (const DeckNode* item = quotedItem(*node, message); item != nullptr) node = item;
  const bool leaf = node != nullptr && node->kind == DeckNode::Kind::scalar;
  return deckError(*source_, leaf ? node->at : deepest->nameAt, std::string(key), message);
}

std::filesystem::path Deck::resolvePath(const std::string& name) const {
  const std::filesystem::path file(name);
  return file.is_absolute() ? file : source_->file.path.parent_path() / file;
}

}  // namespace lampblack::io
