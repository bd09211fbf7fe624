// The schema as documents: the reference page for people and the JSON schema for editors.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/deck_base.hpp"
#include "io/deck_former_names.hpp"
#include "io/deck_schema.hpp"
#include "io/json.hpp"

namespace lampblack::io {
namespace {

using Node = DeckSchema::Node;

constexpr const char* introduction =
    "Every key a deck may have. `*` stands for a name you choose, `[]` for an item of a list. A quantity is a number "
    "with a unit (`20 cm/s`); a bare number is in the unit shown; angles and speeds of revolution need theirs.\n\n"
    "`base: deck.yaml` at the top has a deck go on from another one in its folder, and say only what differs: maps go "
    "over those of the base key by key, values and lists replace them.\n";

std::string typeText(const DeckKey& key) {
  std::string one;
  switch (key.type) {
    case KeyType::quantity: {
      const std::string unit = units::siUnit(key.dimension);
      one = units::describe(key.dimension);
      if (one.starts_with("a ")) one = one.substr(2);
      if (one.starts_with("an ")) one = one.substr(3);
      if (!unit.empty() && !one.starts_with("quantity in")) one += fmt::format(" ({})", unit);
      break;
    }
    case KeyType::number:
      one = "number";
      break;
    case KeyType::integer:
      one = "integer";
      break;
    case KeyType::boolean:
      one = "true or false";
      break;
    case KeyType::string:
      one = "text";
      break;
    case KeyType::choice:
      one = fmt::format("`{}`", fmt::join(key.choices, "`, `"));
      break;
  }
  if (key.isList) one = key.count ? fmt::format("list of {}: {}", *key.count, one) : fmt::format("list of {}", one);
  if (const std::string range = rangeText(key); !range.empty()) one += ", " + range;
  return one;
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

// What it means, and with which choices of other keys it counts.
std::string meaning(const std::string& doc, const std::vector<DeckCondition>& conditions) {
  const std::string condition = conditionText(conditions);
  return condition.empty() ? doc : doc + " " + condition;
}

std::string meaning(const DeckKey& key) {
  const std::string former = formerNameText(key);
  return meaning(key.doc, key.conditions) + (former.empty() ? "" : " " + former);
}

// `level`: of the headings.
void writeMarkdown(const Node& node, int level, std::string& out) {
  std::string rows;
  for (const Node& child : node.children) {
    if (child.key == nullptr) continue;
    std::string standard = child.key->presence == Presence::defaulted  ? "`" + child.key->defaultText + "`"
                           : child.key->presence == Presence::optional ? "-"
                                                                       : "**required**";
    for (const DeckDefault& other : child.key->otherDefaults)
      standard += fmt::format("; `{}` with {}", other.text, partsText(other.conditions));
    rows += fmt::format("| `{}` | {} | {} | {} |\n", cell(child.path), cell(typeText(*child.key)), cell(standard),
                        cell(meaning(*child.key)));
  }
  const bool top = node.path.empty();
  if (!rows.empty() || node.section != nullptr) {
    const std::string mark(static_cast<std::size_t>(level), '#');
    out += top ? fmt::format("\n{} Top level\n\n", mark) : fmt::format("\n{} `{}`\n\n", mark, node.path);
    if (node.section != nullptr) {
      const char* presence = node.section->presence == Presence::required ? "Required. " : "Optional. ";
      out += fmt::format("{}{}\n\n", node.section->presence == Presence::defaulted ? "" : presence,
                         meaning(node.section->doc, node.section->conditions));
    }
    if (!rows.empty()) out += "| key | what | default | meaning |\n|---|---|---|---|\n" + rows;
  }
  for (const Node& child : node.children) {
    if (child.key == nullptr) writeMarkdown(child, level, out);
  }
}

void writeItem(const DeckKey& key, JsonWriter& json) {
  switch (key.type) {
    case KeyType::quantity:
    case KeyType::number: {
      json.key("type").beginArray().value("number").value("string").endArray();
      break;
    }
    case KeyType::integer:
      json.field("type", "integer");
      break;
    case KeyType::boolean:
      json.field("type", "boolean");
      break;
    case KeyType::string:
      json.key("type").beginArray().value("string").value("number").endArray();
      break;
    case KeyType::choice:
      json.key("enum").beginArray();
      for (const std::string& choice : key.choices) json.value(choice);
      for (const auto& [former, present] : key.formerChoices) json.value(former);
      json.endArray();
      if (key.formerChoices.empty()) break;
      json.key("x-former").beginArray();
      for (const auto& [former, present] : key.formerChoices) json.value(former);
      json.endArray();
      break;
  }
  // With a text ("20 cm/s") these limits are not looked at by an editor; `lampblack check` does.
  if (key.minimum) json.field(key.minimum->exclusive ? "exclusiveMinimum" : "minimum", key.minimum->value);
  if (key.maximum) json.field(key.maximum->exclusive ? "exclusiveMaximum" : "maximum", key.maximum->value);
}

// `isFormer`: under a former name.
void writeKey(const DeckKey& key, JsonWriter& json, bool isFormer = false) {
  json.beginObject();
  json.field("description", fmt::format("{} Expected: {}.", meaning(key), expectation(key)));
  if (isFormer) json.field("deprecated", true);
  if (key.isList) {
    json.field("type", "array");
    if (key.count) {
      json.field("minItems", static_cast<std::uint64_t>(*key.count));
      json.field("maxItems", static_cast<std::uint64_t>(*key.count));
    }
    json.key("items").beginObject();
    writeItem(key, json);
    json.endObject();
  } else {
    writeItem(key, json);
  }
  if (key.presence == Presence::defaulted && !key.isList) json.field("x-default", key.defaultText);
  json.endObject();
}

void writeTitle(JsonWriter& json) {
  json.field("$schema", "https://json-schema.org/draft/2020-12/schema");
  json.field("title", "Lampblack deck");
}

// The keys of a map.
void writeMap(const Node& node, JsonWriter& json);

void writeSchema(const Node& node, JsonWriter& json) {
  if (node.key != nullptr) {
    writeKey(*node.key, json);
    return;
  }
  json.beginObject();
  if (node.path.empty()) writeTitle(json);
  if (node.section != nullptr) json.field("description", meaning(node.section->doc, node.section->conditions));
  if (const Node* item = node.child("[]")) {
    const bool isMapToo = node.children.size() > 1;
    if (isMapToo) json.key("anyOf").beginArray().beginObject();
    json.field("type", "array");
    json.key("items");
    writeSchema(*item, json);
    json.endObject();
    if (!isMapToo) return;
    json.beginObject();
    writeMap(node, json);
    json.endObject().endArray().endObject();
    return;
  }
  writeMap(node, json);
  json.endObject();
}

void writeMap(const Node& node, JsonWriter& json) {
  // A section may be left with nothing in it ("output:").
  json.key("type").beginArray().value("object").value("null").endArray();
  json.key("properties").beginObject();
  for (const auto& [former, present] : node.formerSections) {
    json.key(former).beginObject();
    json.field("description",
               fmt::format("Its keys stand in '{}'; version {} does not read it.", present, formerNamesEnd));
    json.key("deprecated").value(true).endObject();
  }
  for (const Node& child : node.children) {
    if (child.name == "*" || child.name == "[]") continue;
    json.key(child.name);
    writeSchema(child, json);
    if (child.key == nullptr) continue;
    for (const std::string& former : child.key->formerNames) {
      json.key(former);
      writeKey(*child.key, json, true);
    }
  }
  json.endObject();
  json.key("required").beginArray();
  for (const Node& child : node.children) {
    const bool key = child.key != nullptr && child.key->presence == Presence::required;
    const bool section = child.section != nullptr && child.section->presence == Presence::required;
    if (child.name != "*" && (key || section)) json.value(child.name);
  }
  json.endArray();
  json.key("additionalProperties");
  if (const Node* any = node.child("*")) {
    writeSchema(*any, json);
  } else {
    json.value(false);
  }
}

}  // namespace

std::string markdownReference(const DeckSchema& schema) {
  std::string text = std::string("# Deck reference\n\n") + introduction;
  writeMarkdown(schema.tree(), 2, text);
  return text;
}

std::string markdownReference(const DeckKinds& kinds) {
  std::string text = std::string("# Deck reference\n\n") + introduction;
  text += fmt::format("\nThe key `{}` chooses what a deck is about; the other keys depend on it.\n\n", kinds.key);
  for (const DeckKind& kind : kinds.kinds)
    text += fmt::format("- [`{0}: {1}`](#{0}-{1}): {2}\n", kinds.key, kind.name, kind.doc);
  for (const DeckKind& kind : kinds.kinds) {
    text += fmt::format("\n## {}: {}\n\n{}\n", kinds.key, kind.name, kind.doc);
    writeMarkdown(kind.schema.tree(), 3, text);
  }
  return text;
}

std::string markdownPart(int level, const std::string& heading, const std::string& doc, const DeckSchema& schema) {
  std::string text = fmt::format("\n{} {}\n\n{}\n", std::string(static_cast<std::size_t>(level), '#'), heading, doc);
  writeMarkdown(schema.tree(), level + 1, text);
  return text;
}

std::string jsonSchema(const DeckSchema& schema) {
  JsonWriter json;
  writeSchema(schema.tree(), json);
  return json.text() + "\n";
}

// One conditional subschema a kind: editors then know the keys of the kind that is being written. What a deck with a
// base lacks is not theirs to tell.
std::string jsonSchema(const DeckKinds& kinds) {
  JsonWriter json;
  json.beginObject();
  writeTitle(json);
  json.field("type", "object");
  json.key("anyOf").beginArray().beginObject();
  json.key("required").beginArray().value(baseKey).endArray();
  json.key("properties").beginObject().key(baseKey).beginObject();
  json.field("description", "A deck in the same folder that this one goes on from.").field("type", "string");
  json.endObject().endObject().endObject().beginObject();
  json.key("properties").beginObject().key(kinds.key).beginObject().key("enum").beginArray();
  for (const DeckKind& kind : kinds.kinds)
    for (const std::string& name : namesOfKind(kind, kinds.key)) json.value(name);
  json.endArray().endObject().endObject();
  json.key("required").beginArray().value(kinds.key).endArray();
  json.key("allOf").beginArray();
  for (const DeckKind& kind : kinds.kinds) {
    json.beginObject().key("if").beginObject().key("properties").beginObject().key(kinds.key).beginObject();
    const std::vector<std::string> names = namesOfKind(kind, kinds.key);
    if (names.size() == 1) {
      json.field("const", kind.name);
    } else {
      json.key("enum").beginArray();
      for (const std::string& name : names) json.value(name);
      json.endArray();
    }
    json.endObject().endObject().endObject();
    json.key("then");
    writeSchema(kind.schema.tree(), json);
    json.endObject();
  }
  json.endArray().endObject().endArray().endObject();
  return json.text() + "\n";
}

}  // namespace lampblack::io
