// Keys bound to the members of options: what the schema has of them, and where their values go.
#include "io/deck_keys.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "core/modules.hpp"

namespace lampblack::io {
namespace {

using testing::ElementsAre;

enum class Colour { red, blue };

struct BoundLimits {
  double largest = 3.0;
};

struct BoundOptions {
  double share = 0.25, length = 2.0, size = 7.0, needed = 0.0;
  int count = 5;
  bool on = true, rises = false;
  std::string name = "soot", kind = "b";
  Colour colour = Colour::blue;
  std::optional<double> time;
  std::optional<bool> keeps;
  std::vector<double> times;
  std::vector<int> moments{0, 1};
  std::array<double, 2> centre{1.0, 2.0};
  BoundLimits limits;
};

DeckKeys<BoundOptions> boundKeys() {
  using Options = BoundOptions;
  DeckKeys<Options> keys("parts.*");
  keys.number("share", &Options::share, rules().above(0).atMost(1), "Share.");
  keys.quantity("length", units::length, &Options::length, rules(), "Length.");
  keys.quantity("size", units::length, &Options::size, rules().optional(), "Size.");
  keys.number("needed", &Options::needed, rules().required(), "Needed.");
  keys.integer("count", &Options::count, rules().atLeast(1), "Count.");
  keys.boolean("on", &Options::on, rules(), "On.");
  keys.choice("rises", &Options::rises, {{"up", true}, {"down", false}}, rules(), "Up or down.");
  keys.text("name", &Options::name, rules(), "Name.");
  keys.word("kind", &Options::kind, {"a", "b"}, rules(), "Kind.");
  keys.choice("colour", &Options::colour, {{"red", Colour::red}, {"blue", Colour::blue}}, rules(), "Colour.");
  keys.quantity("time", units::time, &Options::time, rules().onlyWith("parts.*.kind", {"a"}), "Time.");
  keys.choice("keeps", &Options::keeps, {{"yes", true}, {"no", false}}, rules(), "Keeps.");
  keys.quantity("times", units::time, &Options::times, rules().optional(), "Times.");
  keys.choice("moments", &Options::moments, {{"M0", 0}, {"M1", 1}, {"M2", 2}}, rules().byDefault("[M0]"), "Moments.");
  keys.quantity("centre", units::length, &Options::centre, rules(), "Centre.");
  keys.number("largest", inner(&Options::limits, &BoundLimits::largest), rules(), "Largest.");
  keys.other("twice", KeyType::number, rules().optional(), "Twice the share.",
             [](const Deck& deck, const std::string& key, Options& options) { options.share = 2 * deck.number(key); });
  return keys;
}

BoundOptions bound(const std::string& part) {
  const DeckSchema schema = boundKeys().schema();
  return boundKeys().read(Deck::parse("parts: {mine: {" + part + "}}", "deck.yaml", {}, schema), "parts.mine");
}

const DeckKey& boundKey(const DeckSchema& schema, const std::string& name) {
  for (const DeckKey& key : schema.keys())
    if (key.path == "parts.*." + name || key.path == name) return key;
  throw std::logic_error("no key " + name);
}

TEST(DeckKeys, DefaultsAreThoseOfTheOptions) {
  const DeckSchema schema = boundKeys().schema();
  const auto text = [&](const char* name) { return boundKey(schema, name).defaultText; };
  EXPECT_EQ(text("share"), "0.25");
  EXPECT_EQ(text("length"), "2 m");
  EXPECT_EQ(text("count"), "5");
  EXPECT_EQ(text("on"), "true");
  EXPECT_EQ(text("rises"), "down");
  EXPECT_EQ(text("name"), "'soot'");
  EXPECT_EQ(text("kind"), "b");
  EXPECT_EQ(text("colour"), "blue");
  EXPECT_EQ(text("centre"), "[1 m, 2 m]");
  EXPECT_EQ(text("largest"), "3");
  EXPECT_EQ(boundKey(schema, "time").presence, Presence::optional);
  EXPECT_EQ(boundKey(schema, "keeps").presence, Presence::optional);
  EXPECT_EQ(boundKey(schema, "needed").presence, Presence::required);
  EXPECT_EQ(boundKey(schema, "centre").count, 2u);
}

TEST(DeckKeys, WhatTheDeckLeavesOutIsAsTheOptionsHaveIt) {
  const BoundOptions options = bound("needed: 1");
  EXPECT_EQ(options.share, 0.25);
  EXPECT_EQ(options.size, 7.0);
  EXPECT_EQ(options.colour, Colour::blue);
  EXPECT_EQ(options.kind, "b");
  EXPECT_FALSE(options.rises);
  EXPECT_FALSE(options.time.has_value());
  EXPECT_FALSE(options.keeps.has_value());
  EXPECT_TRUE(options.times.empty());
  EXPECT_THAT(options.moments, ElementsAre(0));
  EXPECT_THAT(options.centre, ElementsAre(1.0, 2.0));
}

TEST(DeckKeys, WhatTheDeckSaysGoesWhereItIsBound) {
  const BoundOptions options = bound(
      "needed: 1, length: 3 cm, size: 4 m, count: 9, on: false, rises: up, name: ash, kind: a, colour: red, "
      "time: 2 ms, keeps: 'no', times: [1 s, 2 s], moments: [M2, M0], centre: [3 m, 4 m], largest: 6, twice: 0.25");
  EXPECT_EQ(options.share, 0.5);
  EXPECT_EQ(options.length, 0.03);
  EXPECT_EQ(options.size, 4.0);
  EXPECT_EQ(options.needed, 1.0);
  EXPECT_EQ(options.count, 9);
  EXPECT_FALSE(options.on);
  EXPECT_TRUE(options.rises);
  EXPECT_EQ(options.name, "ash");
  EXPECT_EQ(options.kind, "a");
  EXPECT_EQ(options.colour, Colour::red);
  EXPECT_EQ(options.time, 2e-3);
  EXPECT_EQ(options.keeps, false);
  EXPECT_THAT(options.times, ElementsAre(1.0, 2.0));
  EXPECT_THAT(options.moments, ElementsAre(2, 0));
  EXPECT_THAT(options.centre, ElementsAre(3.0, 4.0));
  EXPECT_EQ(options.limits.largest, 6.0);
}

TEST(DeckKeys, RangesAndConditionsHold) {
  EXPECT_THROW((void)bound("needed: 1, share: 2"), InputError);
  EXPECT_THROW((void)bound("needed: 1, count: 0"), InputError);
  EXPECT_THROW((void)bound("needed: 1, time: 2 ms"), InputError);  // of the kind a alone
  EXPECT_THROW((void)bound("share: 0.5"), InputError);
}

// A key without a member stands in the schema as its rules say, and its value is not looked at.
TEST(DeckKeys, KeysWithoutAMemberAreReadByHand) {
  DeckKeys<BoundLimits> keys("limits");
  keys.number("largest", &BoundLimits::largest, rules(), "Largest.");
  keys.quantity("width", units::length, rules().above(0), "Width.");
  keys.text("names", rules().list().byDefault("[a, b]"), "Names.");
  keys.choice("side", {"left", "right"}, rules().optional(), "Side.");
  keys.add(booleanKey("limits.on", "On.").byDefault("true"));
  const DeckSchema schema = keys.schema();
  EXPECT_EQ(boundKey(schema, "limits.width").presence, Presence::required);
  EXPECT_EQ(boundKey(schema, "limits.width").dimension, units::length);
  EXPECT_THAT(boundKey(schema, "limits.side").choices, ElementsAre("left", "right"));
  const Deck deck = Deck::parse("limits: {largest: 5, width: 2 cm}", "deck.yaml", {}, schema);
  EXPECT_EQ(keys.read(deck).largest, 5.0);
  EXPECT_EQ(deck.quantity("limits.width"), 0.02);
  EXPECT_THAT(deck.strings("limits.names"), ElementsAre("a", "b"));
  EXPECT_TRUE(deck.boolean("limits.on"));
  EXPECT_THROW((void)Deck::parse("limits: {largest: 5}", "deck.yaml", {}, schema), InputError);
}

TEST(DeckKeys, AChoiceThatIsNotTheDefaultIsAMistake) {
  DeckKeys<BoundOptions> keys("part");
  EXPECT_THROW(keys.choice("colour", &BoundOptions::colour, {{"red", Colour::red}}, rules(), "Colour."),
               std::logic_error);
}

}  // namespace
}  // namespace lampblack::io
