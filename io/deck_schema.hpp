// What a deck may say. Each key is declared once - path, type, unit, range, default, one line of prose - next to the
// code that uses it; the reader, `lampblack check`, the reference page and the JSON schema are all made from this
// declaration.
//
//   DeckSchema schema;
//   schema.section("boundaries", Presence::required, "Named parts of the surface and what happens there.")
//       .add(choiceKey("boundaries.*.type", {"inlet", "outlet", "wall"}, "Kind of boundary."))
//       .add(quantityKey("boundaries.*.velocity", units::velocity, "Velocity along the inward normal.").optional())
//       .add(integerKey("mesh.z[].cells", "Cells of this segment.").atLeast(1));
//
// A path is names joined by dots; `*` stands for a name the user chooses and `[]` for the items of a list. Where keys
// are declared both of a section and of its items ("initial.number" and "initial[].number"), a deck may have either.
//
// A key or section that counts only with some choices of another key says so, and a deck that has it in vain is
// refused:
//
//   schema.add(quantityKey("boundaries.*.velocity", ...).optional().onlyWith("boundaries.*.type", {"inlet"}))
//       .section("left", Presence::optional, "...", {{"flame.type", {"counterflow"}}});
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"
#include "io/units.hpp"

namespace lampblack::io {

// "mesh" and "x" to "mesh.x"; the root has the path "".
[[nodiscard]] std::string joinedPath(const std::string& path, const std::string& name);

enum class KeyType { quantity, number, integer, boolean, string, choice };

// A key that is absent: `required` is an error, `optional` leaves it unset, `defaulted` takes the default.
enum class Presence { required, optional, defaulted };

// A limit of the allowed range, in SI.
struct Bound {
  double value = 0.0;
  bool exclusive = false;
};

// A condition: a key counts only where another key, a choice or true or false, has one of these values, or where one of
// the others holds. A `*` or `[]` of its path is the same name or item as in the path of what it is said of.
struct DeckCondition {
  std::string key;
  std::vector<std::string> choices;
  std::vector<DeckCondition> others = {};
};

// A default that holds where all of the conditions do.
struct DeckDefault {
  std::string text;
  std::vector<DeckCondition> conditions;
};

// One key. Made by the functions below; required until told otherwise.
class DeckKey {
 public:
  DeckKey(std::string keyPath, KeyType keyType, std::string keyDoc)
      : path(std::move(keyPath)), type(keyType), doc(std::move(keyDoc)) {}

  DeckKey& required();  // says what a key is anyway, where another default would be taken (io/deck_keys.hpp)
  DeckKey& optional();
  DeckKey& byDefault(std::string text);  // as it would stand in a deck: "1 atm", "[0, 0, 1]", "true"
  // Another default where all of these conditions hold; of several the first that does.
  DeckKey& byDefault(std::string text, std::vector<DeckCondition> where);
  DeckKey& atLeast(double si);  // range, inclusive
  DeckKey& atMost(double si);
  DeckKey& above(double si);  // range, exclusive
  DeckKey& below(double si);
  DeckKey& list();                   // a list of any length of this type
  DeckKey& list(std::size_t count);  // a list of exactly `count`, for instance a vector
  // A former name of this key, without the path of its section (io/deck_former_names.hpp). A deck with the former name
  // is read as if it had the present one, and a note says what to write.
  DeckKey& formerly(std::string before);
  // The same of a choice: `before` is the former name of the choice `now`.
  DeckKey& formerly(std::string before, std::string now);
  // The key counts only with these choices of another key; said twice, both have to hold.
  DeckKey& onlyWith(std::string otherKey, std::vector<std::string> otherChoices);
  DeckKey& onlyWith(DeckCondition condition);

  std::string path;
  KeyType type;
  std::string doc;
  units::Dimension dimension;
  std::vector<std::string> choices;
  std::vector<std::string> formerNames;
  std::vector<std::pair<std::string, std::string>> formerChoices;  // before, now
  Presence presence = Presence::required;
  bool isPresenceSaid = false;  // by one of the functions above
  std::string defaultText;
  std::vector<DeckDefault> otherDefaults;
  std::optional<Bound> minimum;
  std::optional<Bound> maximum;
  bool isList = false;
  std::optional<std::size_t> count;
  std::vector<DeckCondition> conditions;
};

DeckKey quantityKey(std::string path, const units::Dimension& dimension, std::string doc);
DeckKey numberKey(std::string path, std::string doc);  // a plain number; "5 %" is 0.05
DeckKey integerKey(std::string path, std::string doc);
DeckKey booleanKey(std::string path, std::string doc);
DeckKey stringKey(std::string path, std::string doc);
DeckKey choiceKey(std::string path, std::vector<std::string> choices, std::string doc);
DeckKey vectorKey(std::string path, const units::Dimension& dimension, std::string doc);  // three components

// "a velocity (for instance '20 cm/s')", "an integer from 1 to 64", "one of: inlet, outlet, wall".
std::string expectation(const DeckKey& key);

// The same limits in words, without the type: "above 0 K", "0 to 1"; empty when there are none.
std::string rangeText(const DeckKey& key);

// "`flame.type`: `wall`, `counterflow`", of several conditions with "and" in between.
std::string partsText(const std::vector<DeckCondition>& conditions);
// "Only with `flame.type`: `wall`, `counterflow`."; empty without conditions.
std::string conditionText(const std::vector<DeckCondition>& conditions);

// A map or list that needs saying more than that it exists. Sections that are not declared are always looked into, so
// that their required keys are required and their defaults hold. An `optional` section that is absent is skipped with
// everything in it; a `required` one must be there and not be empty.
struct DeckSection {
  std::string path;
  Presence presence = Presence::optional;
  std::string doc;
  std::vector<DeckCondition> conditions;  // of everything in it
};

// Sections that former versions had, whose keys stand elsewhere now (io/deck_former_sections.hpp).
struct FormerSections {
  // Paths then and now, of a section (top level) or of a key in one; a key without a line has that of its section.
  std::vector<std::pair<std::string, std::string>> table;
  // Of a deck before its keys move: says in the tree what the sections said by being there, and returns that as the
  // note of the first is to have it, "'description: ensemble'"; or adds a note of its own. May be empty. InputError.
  std::function<std::vector<std::string>(const DeckSource&, DeckNode& root, std::vector<std::string>& notes)> settle;
};

// What other programs and papers call a key or a choice, and its name here: {"psr", "stirred"}. A deck that has the
// former is told of the latter, where that is known at its place.
using OtherNames = std::vector<std::pair<std::string, std::string>>;

class DeckSchema {
 public:
  // std::logic_error for a path declared twice, a key that is also a section, and a former name that is another key.
  DeckSchema& add(DeckKey key);
  DeckSchema& section(std::string path, Presence presence, std::string doc, std::vector<DeckCondition> onlyWith = {});
  DeckSchema& add(const DeckSchema& other);  // everything another schema declares
  // The same, of which all counts only under this condition too.
  DeckSchema& add(DeckSchema other, const DeckCondition& onlyWith);
  DeckSchema& formerly(FormerSections sections);
  DeckSchema& calledElsewhere(OtherNames names);

  [[nodiscard]] const std::vector<DeckKey>& keys() const { return keys_; }
  [[nodiscard]] const FormerSections& formerSections() const { return former_; }
  [[nodiscard]] const OtherNames& otherNames() const { return otherNames_; }

  // The same declarations as a tree, one node for each part of a path, in order of declaration.
  struct Node {
    std::string name;  // "mesh", "*" or "[]"
    std::string path;  // "boundaries.*"
    const DeckKey* key = nullptr;
    const DeckSection* section = nullptr;
    std::vector<std::pair<std::string, std::string>> formerSections;  // of the root: names then and now
    std::vector<Node> children;

    [[nodiscard]] const Node* child(const std::string& childName) const;  // exact, nullptr if none
    // What the items of a part of a deck are: of a list, and of anything where nothing but a list may stand here.
    [[nodiscard]] const Node* itemFor(DeckNode::Kind kind) const;
  };
  // Refers to this schema, which has to live as long. std::logic_error for a condition on a key or choice that is not
  // declared.
  [[nodiscard]] Node tree() const;

 private:
  void checkConditions(const std::string& path, const std::vector<DeckCondition>& conditions) const;

  std::vector<DeckKey> keys_;
  std::vector<DeckSection> sections_;
  FormerSections former_;
  OtherNames otherNames_;
};

// Decks of several kinds, told apart by the choice at one key of the top level ("problem"). The schema of each kind
// declares that key too, with its own name as the only choice; former names of a kind are those of the choice.
struct DeckKind {
  std::string name;
  std::string doc;  // one line
  DeckSchema schema;
};
struct DeckKinds {
  std::string key;
  std::vector<DeckKind> kinds;
};

// The reference page: a table of keys for each section; of several kinds, a part for each.
std::string markdownReference(const DeckSchema& schema);
std::string markdownReference(const DeckKinds& kinds);
// A part of such a page under a heading of a level (2 is "##"), for a schema that is none of the kinds.
std::string markdownPart(int level, const std::string& heading, const std::string& doc, const DeckSchema& schema);

// A JSON schema (draft 2020-12) for editors that check YAML while it is typed.
std::string jsonSchema(const DeckSchema& schema);
std::string jsonSchema(const DeckKinds& kinds);

}  // namespace lampblack::io
