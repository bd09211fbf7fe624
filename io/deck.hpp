// A run's input deck: a YAML file, over another one where it names a base (io/deck_base.hpp), checked against a
// DeckSchema, with `--set a.b=c` on top. Every key is known, has its
// type, its unit and its range before anybody asks for it, so that the code that uses a deck cannot meet a bad one. All
// values are SI. Reading is strict: unknown and repeated keys are errors, and a message shows the line they stand in.
#pragma once

#include <mpi.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/deck_node.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::io {

// One checked value; a list holds several numbers or texts.
struct DeckValue {
  DeckKey key;
  std::string path;  // "mesh.z[0].cells"
  bool isDefault = false;
  bool counts = true;                  // false: a default of a key that another choice makes meaningless
  std::vector<double> numbers;         // quantity, number (SI)
  std::vector<std::int64_t> integers;  // integer, boolean (0 or 1)
  std::vector<std::string> texts;      // string, choice
};

class Deck {
 public:
  // Reads and checks a deck. `overrides` are the arguments of --set, "a.b=c" each, applied in order; c is YAML. Throws
  // InputError for everything that can be wrong with the file, the overrides or the values.
  static Deck load(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                   const DeckSchema& schema);
  // The same, collectively: rank 0 reads the file, all ranks check the same text and raise the same error.
  static Deck load(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                   const DeckSchema& schema, MPI_Comm comm);
  // The same where the deck itself says which kind it is; InputError where it names none of the kinds.
  static Deck load(const std::filesystem::path& path, const std::vector<std::string>& overrides, const DeckKinds& kinds,
                   MPI_Comm comm);
  // The same from text; `path` is what messages call it and what relative paths start from.
  static Deck parse(std::string text, const std::filesystem::path& path, const std::vector<std::string>& overrides,
                    const DeckSchema& schema);
  static Deck parse(std::string text, const std::filesystem::path& path, const std::vector<std::string>& overrides,
                    const DeckKinds& kinds);

  // The same from what was read of its files.
  static Deck parse(DeckSource source, const DeckSchema& schema);
  static Deck parse(DeckSource source, const DeckKinds& kinds);

  // Typed access by path, list items by index: "mesh.z[0].cells". Asking for a key that the schema does not declare,
  // with another type, or that is optional and absent is a mistake of the caller: std::logic_error.
  [[nodiscard]] double quantity(std::string_view key) const;  // SI
  [[nodiscard]] double number(std::string_view key) const;
  // In the type it is used in; InputError where the deck's number does not fit.
  template <std::integral T = std::int64_t>
  [[nodiscard]] T integer(std::string_view key) const {
    return static_cast<T>(integerWithin(key, lowest<T>, highest<T>));
  }
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string string(std::string_view key) const;
  [[nodiscard]] std::string choice(std::string_view key) const;
  [[nodiscard]] std::vector<double> quantities(std::string_view key) const;  // lists and vectors
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  [[nodiscard]] std::vector<std::int64_t> integers(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> strings(std::string_view key) const;  // strings and choices

  // The same for optional keys: empty where the deck does not say.
  [[nodiscard]] std::optional<double> optionalQuantity(std::string_view key) const;
  [[nodiscard]] std::optional<double> optionalNumber(std::string_view key) const;
  template <std::integral T = std::int64_t>
  [[nodiscard]] std::optional<T> optionalInteger(std::string_view key) const {
    if (!isThere(key)) return std::nullopt;
    return integer<T>(key);
  }
  [[nodiscard]] std::optional<bool> optionalBoolean(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> optionalString(std::string_view key) const;  // string or choice

  // Whether the deck has this key or section; a key with a default is always there.
  [[nodiscard]] bool has(std::string_view key) const;
  // The same of a key that is read if so: true of a key nobody declared, whose reading then says that this is a
  // mistake.
  [[nodiscard]] bool isThere(std::string_view key) const;
  // Whether the deck itself says it, rather than a default.
  [[nodiscard]] bool isGiven(std::string_view key) const;
  // Names in a map, in the order of the file; empty where it is absent.
  [[nodiscard]] std::vector<std::string> children(std::string_view section) const;
  // Number of items of a list; 0 where it is absent.
  [[nodiscard]] std::size_t size(std::string_view list) const;

  // An InputError about this key or section, pointing at where it stands in the deck (or the section it should be in).
  [[nodiscard]] InputError error(std::string_view key, const std::string& message) const;
  // What `read` returns; an InputError of it points at this key or section.
  template <typename Read>
  auto at(std::string_view key, Read read) const {
    try {
      return read();
    } catch (const InputError& wrong) {
      throw error(key, wrong.what());
    }
  }

  // Everything the run was told, defaults included, in SI: a deck that can be read again.
  [[nodiscard]] std::string resolved() const;
  [[nodiscard]] std::string resolvedJson() const;

  // What the deck should say otherwise: a note for each former name of a key or choice.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  [[nodiscard]] const std::filesystem::path& path() const { return source_->file.path; }
  // A file named in the deck: relative names start from the deck's folder.
  [[nodiscard]] std::filesystem::path resolvePath(const std::string& name) const;

 private:
  template <std::integral T>
  static constexpr std::int64_t lowest = std::is_unsigned_v<T>
                                             ? 0
                                             : static_cast<std::int64_t>(std::numeric_limits<T>::min());
  template <std::integral T>
  static constexpr std::int64_t highest = sizeof(T) < sizeof(std::int64_t)
                                              ? static_cast<std::int64_t>(std::numeric_limits<T>::max())
                                              : std::numeric_limits<std::int64_t>::max();
  [[nodiscard]] std::int64_t integerWithin(std::string_view key, std::int64_t low, std::int64_t high) const;
  Deck(DeckSource read, const std::function<const DeckSchema&(const DeckSource&, const DeckNode&)>& choose);
  [[nodiscard]] const DeckValue* find(std::string_view key) const;
  [[nodiscard]] const DeckValue& get(std::string_view key, KeyType type, bool list) const;
  [[nodiscard]] const DeckNode* nodeAt(std::string_view key) const;

  std::shared_ptr<const DeckSource> source_;
  std::shared_ptr<const DeckSchema> schema_;
  DeckNode root_;  // with the present names of keys and choices
  std::vector<std::string> notes_;
  std::vector<DeckValue> values_;  // in the order of the schema
  std::map<std::string, std::size_t, std::less<>> index_;
};

}  // namespace lampblack::io
