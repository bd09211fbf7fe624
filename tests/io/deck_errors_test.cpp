// Every way a deck can be wrong, and what the message says: file, line, key, what was expected, what was found.
#include <fmt/format.h>

#include <ctime>
#include <filesystem>

#include "core/modules.hpp"
#include "core/nearest_name.hpp"
#include "tests/io/sample_deck.hpp"

namespace lampblack::io {
namespace {

using test::messageOf;
using test::sampleWith;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(DeckErrors, AnUnknownKeyNamesTheNearestAndShowsTheLine) {
  EXPECT_EQ(messageOf(sampleWith("    velocity: 20", "    velocty: 20")),
            "cases/sample/deck.yaml:11:5: boundaries.fuel.velocty: unknown key 'velocty'; did you mean 'velocity'? "
            "Known here: type, velocity, temperature, composition\n"
            "    11 |     velocty: 20 cm/s\n"
            "       |     ^~~~~~~");
}

TEST(DeckErrors, AMisspeltRequiredKeyIsMisspeltRatherThanMissing) {
  EXPECT_THAT(messageOf(sampleWith("problem: flow", "probelm: flow")), HasSubstr("did you mean 'problem'?"));
}

TEST(DeckErrors, AKeyThatIsRightElsewhereSaysWhere) {
  EXPECT_THAT(messageOf(test::sampleText + "cells: 3\n"), HasSubstr("did you mean 'mesh.z[].cells'?"));
  EXPECT_THAT(messageOf(sampleWith("    type: inlet\n", "    type: inlet\n    mechanism: gas.yaml\n")),
              HasSubstr("unknown key 'mechanism'; 'mechanism' stands at the top of the deck, not in a section."));
}

// Names of other programs, and sections that this kind of deck has not.
TEST(DeckErrors, WordsOfAKeyOrKeysOfASectionTellWhatWasMeant) {
  EXPECT_THAT(messageOf(sampleWith("    velocity: 20", "    inlet_velocity: 20")),
              HasSubstr("did you mean 'velocity'?"));
  EXPECT_THAT(messageOf(test::sampleText + "schedule: {end: 40 ms}\n"), HasSubstr("did you mean 'time'?"));
  EXPECT_THAT(messageOf(test::sampleText + "mesh_size: {end: 40 ms}\n"), HasSubstr("did you mean 'mesh'?"));
  EXPECT_THAT(messageOf(test::sampleText + "solver: {type: gmres}\n"), HasSubstr("unknown key 'solver'. Known here"));
  EXPECT_EQ(nameOfSameWords("connecting_rod", {"rod", "rods"}), "rod");
  EXPECT_EQ(nameOfSameWords("viscosity", {"eddy_viscosity_ratio", "ratio"}), "eddy_viscosity_ratio");
  EXPECT_EQ(nameOfSameWords("maximum_step", {"step", "first", "maximum"}), "");
  EXPECT_EQ(nameOfSameWords("x", {"x_min"}), "");
}

// As who comes from other programs, or does not know where YAML wants quotes, writes a deck.
TEST(DeckErrors, WhatANewcomerWritesIsAnsweredByWhatToWrite) {
  DeckSchema schema;
  schema.add(stringKey("gas.composition", "Mole fractions.").optional())
      .add(quantityKey("gas.temperature", units::temperature, "Temperature.").optional())
      .add(quantityKey("wall.temperature", units::temperature, "Temperature.").optional())
      .add(choiceKey("reactor.type", {"stirred", "plug_flow"}, "Kind.").optional())
      .add(quantityKey("time.end", units::time, "End.").optional())
      .add(integerKey("particles.sectional.sections", "Sections.").optional())
      .add(choiceKey("particles.description", {"sectional"}, "Kind.").optional())
      .add(choiceKey("methods.*.type", {"dsmc"}, "Kind.").optional())
      .calledElsewhere({{"psr", "stirred"}, {"pfr", "plug_flow"}, {"psr", "perfectly_stirred"}, {"T", "temperature"}});
  const auto refused = [&](const std::string& text) { return test::refusalOf(schema, text); };
  EXPECT_THAT(refused("gas: {composition: {H2: 2, O2: 1}}\n"),
              HasSubstr("expected a text, found a map; write it in quotes, \"H2: 2, O2: 1\""));
  EXPECT_THAT(refused("gas: {composition: {file: h2.yaml, phase: gas}}\n"),
              AllOf(HasSubstr("expected a text, found a map"), Not(HasSubstr("quotes"))));
  EXPECT_THAT(refused("mesh: {z: [{to: 5 mm, cells: 3]}\n"), AllOf(HasSubstr("not YAML"), Not(HasSubstr("quotes"))));
  EXPECT_THAT(refused("gas: {composition: H2:2,O2:1}\n"),
              HasSubstr("unknown key 'O2:1'; a text with a comma in it stands in quotes, \"H2: 2, O2: 1\"."));
  EXPECT_THAT(
      refused("gas: {composition: H2: 2, O2: 1}\n"),
      HasSubstr("this is not YAML: end of map flow not found; a text with ': ' or a comma in it stands in quotes"));
  EXPECT_THAT(refused("gas: {temperature: 300 K}\n\ttime: {end: 1 s}\n"),
              HasSubstr("YAML indents by blanks, no tabulators"));
  for (const std::string slip : {"time 1 ms", "time:1 ms"})
    EXPECT_THAT(refused("gas:\n" + slip + "\nwall: {temperature: 300 K}\n"),
                HasSubstr("'key: value', which the line before lacks: '" + slip + "'"));
  EXPECT_THAT(refused("gas:\n  pressure 1 atm\n  temperature: 300 K\n"),
              HasSubstr("which the line before lacks: 'pressure 1 atm'"));
  for (const std::string goesOn :
       {"title: a long\n  text that goes on\n bad: [\n", "title: a long\n  text that goes on\n  bad: [\n",
        "gas:\n    text that goes on\n  bad: [\n"})
    EXPECT_THAT(refused(goesOn), AllOf(HasSubstr("not YAML"), Not(HasSubstr("the line before lacks")))) << goesOn;
  EXPECT_THAT(refused("gas: {temperature: 300 K}\n  wall: x\n"), Not(HasSubstr("the line before lacks")));
  EXPECT_THAT(refused("reactor: {type: PSR}\n"), HasSubstr("found 'PSR'; did you mean 'stirred'?"));
  EXPECT_THAT(refused("time: {end: 1,5 ms}\n"), HasSubstr("unknown key '5 ms'; a number has a decimal point, 1.5."));
  EXPECT_THAT(refused("gas: {T: 300 K}\n"), HasSubstr("unknown key 'T'; did you mean 'temperature'?"));
  EXPECT_THAT(refused("gas: {t: 300 K}\n"), Not(HasSubstr("; did you mean 'temperature'?")));
  EXPECT_THAT(refused("reactor: {type: pfr}\n"), HasSubstr("did you mean 'plug_flow'?"));
  EXPECT_THAT(refused("time: 1 ms\n"), HasSubstr("expected a map of keys, such as {end: 1 ms}, found '1 ms'"));
  EXPECT_THAT(refused("particles: {sections: 20}\n"), HasSubstr("did you mean 'particles.sectional.sections'?"));
  EXPECT_THAT(refused("temperature: 300 K\n"), HasSubstr("did you mean 'gas.temperature' or 'wall.temperature'?"));
  EXPECT_THAT(refused("methods: [dsmc]\n"),
              HasSubstr("expected a map of names, each with its keys, 'NAME: {type: ...}', found a list of 1"));
}

TEST(DeckErrors, AnUnknownKeyLikeNothingListsWhatIsKnown) {
  EXPECT_THAT(messageOf(test::sampleText + "zzzzzz: 3\n"),
              AllOf(HasSubstr("unknown key 'zzzzzz'. Known here: problem, mechanism")));
}

TEST(DeckErrors, AMissingKeySaysWhatBelongsThereAndWhere) {
  EXPECT_THAT(messageOf(sampleWith("    type: inlet\n    velocity: 20 cm/s", "    velocity: 20 cm/s")),
              AllOf(StartsWith("cases/sample/deck.yaml:9:3: boundaries.fuel.type: this key is missing"),
                    HasSubstr("one of: inlet, outlet, wall"), HasSubstr("9 |   fuel:")));
  EXPECT_THAT(messageOf(sampleWith("time:\n  end: 40 ms\n", "")), HasSubstr("time.end: this key is missing"));
}

TEST(DeckErrors, ARequiredSectionMayNotBeMissingOrEmpty) {
  EXPECT_THAT(messageOf("problem: flow\nmechanism: m\nmesh: {z: [{to: 1, cells: 1}]}\ntime: {end: 1}\n"),
              HasSubstr("boundaries: this section is missing or empty. Named boundaries."));
  EXPECT_THAT(messageOf("problem: flow\nmechanism: m\nmesh: {}\n"), HasSubstr("deck.yaml:3:1: mesh: this section"));
}

// In the order of the deck, each with its line; a section with an unknown key may have meant what it misses.
TEST(DeckErrors, AllMistakesAreToldInOneGo) {
  std::string text = sampleWith("    velocity: 20 cm/s", "    velocty: 20 cm/s");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("cells: 30", "cells: 0");
  replace("298 K", "298 m");
  replace("type: outlet", "type: outlt");
  replace("  end: 40 ms", "  edn: 40 ms");
  const std::string message = messageOf(text, {"seed=1.5"});
  std::size_t at = 0;
  for (const char* part :
       {"deck.yaml:7:25: mesh.z[1].cells: expected an integer from 1",
        "\n     7 |     - {to: 8 mm, cells: 0}\n       |",
        "\ncases/sample/deck.yaml:11:5: boundaries.fuel.velocty: unknown key",
        "deck.yaml:16:18: boundaries.oxidiser.temperature", "deck.yaml:20:19: boundaries.outside.type: expected one of",
        "deck.yaml:22:3: time.edn: unknown key", "\n--set seed=1.5: seed: expected an integer"}) {
    const std::size_t next = message.find(part, at);
    ASSERT_NE(next, std::string::npos) << part << " is not behind the others in\n" << message;
    at = next;
  }
  EXPECT_THAT(message, Not(HasSubstr("time.end")));
  EXPECT_THAT(messageOf(sampleWith("time:\n  end: 40 ms\n", "seed: 1.5\n")),
              AllOf(HasSubstr("seed: expected an integer"),
                    HasSubstr("\ncases/sample/deck.yaml: time.end: this key is missing")));
}

TEST(DeckErrors, NotMoreThanTenMistakesAreTold) {
  std::string text = test::sampleText;
  for (int i = 0; i < 9; ++i) text += fmt::format("unknown{}: 1\n", i);
  EXPECT_THAT(messageOf(text), AllOf(HasSubstr("'unknown8'"), Not(HasSubstr("may be more"))));
  for (int i = 9; i < 12; ++i) text += fmt::format("unknown{}: 1\n", i);
  EXPECT_THAT(messageOf(text), AllOf(HasSubstr("'unknown9'"), Not(HasSubstr("'unknown10'")),
                                     HasSubstr("\nthese are 10 mistakes; there may be more")));
}

TEST(DeckErrors, TheCaretStandsAtTheItemOfAList) {
  EXPECT_THAT(messageOf(test::sampleText + "gravity: [1 m, 2 m/s^2, 3 K]\n"),
              AllOf(HasSubstr(":23:11: gravity[0]: "), HasSubstr(":23:25: gravity[2]: ")));
  const Deck deck = test::sampleDeck({}, test::sampleText + "output: {fields: [velocity, heat, pressure, heat]}\n");
  EXPECT_THAT(std::string(deck.error("output.fields", "'heat' is no field; these are: 'velocity'").what()),
              HasSubstr("deck.yaml:23:45: output.fields: 'heat'"));
  EXPECT_THAT(std::string(deck.error("output.fields", "expected fewer").what()),
              HasSubstr("deck.yaml:23:10: output.fields"));
}

TEST(DeckErrors, AWrongDimensionSaysBoth) {
  EXPECT_THAT(messageOf(sampleWith("velocity: 20 cm/s", "velocity: 20 cm")),
              AllOf(StartsWith("cases/sample/deck.yaml:11:15: boundaries.fuel.velocity: expected a velocity (for "
                               "instance '20 cm/s'), found '20 cm', a length"),
                    HasSubstr("\n       |               ^~~~~")));
}

TEST(DeckErrors, AValueOutOfRangeSaysTheRange) {
  EXPECT_THAT(messageOf(sampleWith("298 K", "-3 K")), HasSubstr("expected a temperature above 0 K, found '-3 K'"));
  EXPECT_THAT(messageOf(sampleWith("O2: 25 %", "O2: 125 %")),
              HasSubstr("expected a number from 0 to 1, found '125 %'"));
  EXPECT_THAT(messageOf(sampleWith("cells: 10", "cells: 0")), HasSubstr("expected an integer from 1 to 100000"));
}

TEST(DeckErrors, ABoundIsInTheRangeUnlessItIsExclusive) {
  DeckSchema schema;
  schema.add(numberKey("open", "Without its ends.").above(0).below(1).byDefault("0.5"))
      .add(numberKey("closed", "With them.").atLeast(0).atMost(1).byDefault("0.5"))
      .add(integerKey("count", "Without its end.").below(4).byDefault("1"));
  const auto accepts = [&](const std::string& setting) {
    try {
      (void)Deck::parse("{}", "deck.yaml", {setting}, schema);
    } catch (const InputError& error) {
      return false;
    }
    return true;
  };
  for (const char* good : {"open=1e-300", "open=0.999999999", "closed=0", "closed=1", "count=3"})
    EXPECT_TRUE(accepts(good)) << good;
  for (const char* bad : {"open=0", "open=1", "closed=-1e-300", "closed=1.000001", "count=4", "count=5"})
    EXPECT_FALSE(accepts(bad)) << bad;
}

TEST(DeckErrors, AValueOfAnotherTypeSaysWhatWasExpected) {
  EXPECT_THAT(messageOf(sampleWith("cells: 10", "cells: 10.5")),
              HasSubstr("mesh.z[0].cells: expected an integer from 1 to 100000, found '10.5'"));
  EXPECT_THAT(messageOf(sampleWith("40 ms", "soon")),
              HasSubstr("expected a time (for instance '10 us'), found 'soon'"));
  EXPECT_THAT(messageOf(sampleWith("40 ms", "[1, 2]")), HasSubstr("found a list of 2"));
  EXPECT_THAT(messageOf(sampleWith("40 ms", "{a: 2}")), HasSubstr("found a map"));
  EXPECT_THAT(messageOf(sampleWith("40 ms", "")),
              HasSubstr("time.end: expected a time (for instance '10 us') above 0 s, "
                        "found nothing"));
  EXPECT_THAT(messageOf(test::sampleText + "  adaptive: maybe\n"), HasSubstr("expected true or false, found 'maybe'"));
  EXPECT_THAT(messageOf(test::sampleText + "gravity: [1, 2]\n"), HasSubstr("expected a list of 3"));
  EXPECT_THAT(messageOf(test::sampleText + "gravity: [1, 2, 1 m]\n"),
              HasSubstr("gravity[2]: expected an acceleration"));
  EXPECT_THAT(messageOf(test::sampleText + "output: {fields: temperature}\n"), HasSubstr("expected a list"));
  EXPECT_THAT(messageOf(sampleWith("  fuel:\n    type: inlet\n", "  fuel: 3\n  b:\n    type: inlet\n")),
              HasSubstr("boundaries.fuel: expected a map of keys, found '3'"));
  EXPECT_THAT(messageOf(sampleWith("  fuel:\n    type: inlet\n", "  fuel: inlet\n  b:\n    type: inlet\n")),
              HasSubstr("boundaries.fuel: expected a map of keys, such as {type: inlet}, found 'inlet'"));
  EXPECT_THAT(messageOf(sampleWith("{to: 2 mm, cells: 10}", "7")),
              HasSubstr("mesh.z[0]: expected a map of keys, found '7'"));
}

TEST(DeckErrors, NotANumberAndInfinityAreRefused) {
  for (const char* bad : {".nan", "nan", "inf", "-inf", ".inf", "1e400"}) {
    EXPECT_THAT(messageOf(sampleWith("40 ms", bad)), HasSubstr("time.end: ")) << bad;
  }
}

TEST(DeckErrors, AWrongChoiceNamesTheNearest) {
  EXPECT_THAT(messageOf(sampleWith("type: outlet", "type: outlt")),
              HasSubstr("expected one of: inlet, outlet, wall, found 'outlt'; did you mean 'outlet'?"));
}

TEST(DeckErrors, ARepeatedKeyNamesBothLines) {
  EXPECT_THAT(messageOf(test::sampleText + "problem: reactor\n"),
              AllOf(StartsWith("cases/sample/deck.yaml:23:1: problem: this key is given twice; first in line 2"),
                    HasSubstr("23 | problem: reactor")));
  EXPECT_THAT(messageOf(sampleWith("{to: 2 mm, cells: 10}", "{to: 2 mm, cells: 10, to: 3 mm}")),
              HasSubstr("mesh.z[0].to: this key is given twice"));
}

TEST(DeckErrors, BadYamlSaysWhere) {
  EXPECT_THAT(messageOf("problem: flow\nmesh: [1, 2\n"),
              AllOf(StartsWith("cases/sample/deck.yaml:"), HasSubstr("this is not YAML")));
  EXPECT_THAT(messageOf("problem: flow\n\tmesh: 1\n"), HasSubstr("cases/sample/deck.yaml:2:"));
}

TEST(DeckErrors, WhatDecksDoNotUseIsRefused) {
  EXPECT_THAT(messageOf("a: &x 1\nb: *x\n"), HasSubstr("anchors"));
  EXPECT_THAT(messageOf("a: !!int 1\n"), HasSubstr("tags"));
  EXPECT_THAT(messageOf("problem: flow\n---\nproblem: flow\n"), HasSubstr("several YAML documents"));
  EXPECT_THAT(messageOf(""), HasSubstr("the deck is empty"));
  EXPECT_THAT(messageOf("# only a comment\n"), HasSubstr("the deck is empty"));
  EXPECT_THAT(messageOf("- 1\n- 2\n"), HasSubstr("expected a map of keys, found a list of 2"));
  EXPECT_THAT(messageOf("just words"), HasSubstr("expected a map of keys, found 'just words'"));
  EXPECT_THAT(messageOf(std::string("a\0b", 3)), HasSubstr("not a text file"));
  EXPECT_THAT(messageOf(sampleWith("  fuel:", "  fu.el:")),
              HasSubstr("a name may not contain '.', '[' or ']'; write '_'"));
}

TEST(DeckErrors, AFileThatIsNotThereOrIsAFolder) {
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      (void)Deck::load(path, {}, test::sampleSchema());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("/nowhere/deck.yaml"), "/nowhere/deck.yaml: there is no such file; expected a deck");
  EXPECT_THAT(message(std::filesystem::temp_directory_path()), HasSubstr("this is a folder"));
  // Read to its end, it would never come to one.
  EXPECT_THAT(message("/dev/zero"), HasSubstr("/dev/zero: this is no regular file"));
}

TEST(DeckErrors, ALongLineIsCutAroundTheCaret) {
  const std::string before(5000, 'a'), after(5000, 'b');
  const std::string text = "problem: flow\nmesh: {" + before + ": 1, zzzzzz: 3, " + after + ": 1}\n";
  const std::string message = messageOf(text);
  for (std::size_t from = 0; from < message.size();) {
    const std::size_t end = std::min(message.find('\n', from), message.size());
    EXPECT_LT(end - from, 250U) << message.substr(from, end - from);
    from = end + 1;
  }
  const std::string found = messageOf(sampleWith("cells: 10", "cells: 10" + before));
  EXPECT_LT(found.size(), 600U) << found;
  // The caret still stands under what it means, in a line of characters of two bytes too.
  std::string accents;
  for (int i = 0; i < 300; ++i) accents += "µ";
  EXPECT_THAT(messageOf("problem: flow\nmechanism: \"" + accents + "\" ? 1\n"), Not(HasSubstr("\xb5\n")));
  const std::string wrong = messageOf("problem: flow\nmechanism: m # " + before + "\nmesh: {z: [{to: " + "soon" +
                                      ", cells: 1}]} # " + before + "\n");
  EXPECT_THAT(wrong, HasSubstr("     3 | mesh: {z: [{to: soon, cells: 1}]} # aaa"));
  EXPECT_THAT(wrong, HasSubstr("\n       |                 ^~~~"));
  EXPECT_THAT(messageOf(test::sampleText, {"time.end=" + before}), HasSubstr("--set time.end=aaa"));
  // And where the line is cut in front of it.
  std::string items;
  for (int i = 0; i < 40; ++i) items += "{to: 1 mm, cells: 1}, ";
  const std::string late = messageOf("problem: flow\nmechanism: m\nmesh: {z: [" + items + "{to: soon, cells: 1}]}\n");
  const std::size_t line = late.find('\n') + 1, marks = late.find('\n', line) + 1;
  ASSERT_THAT(late, HasSubstr("...")) << late;
  EXPECT_EQ(late.find("soon, cells", line) - line, late.find("^~~~", marks) - marks) << late;
}

TEST(DeckErrors, DeepNestingIsAMistakeOfTheDeck) {
  for (const std::size_t depth : {600U, 100000U}) {
    EXPECT_THAT(messageOf("problem: flow\nmesh: " + std::string(depth, '[') + std::string(depth, ']') + "\n"),
                AllOf(StartsWith("cases/sample/deck.yaml:2:"), HasSubstr("nested too deeply")));
    EXPECT_THAT(messageOf(test::sampleText, {"mesh=" + std::string(depth, '[')}), HasSubstr("nested too deeply"));
  }
}

TEST(DeckErrors, AHundredThousandKeysAreReadAtOnce) {
  std::string text = test::sampleText;
  for (int i = 0; i < 100000; ++i) text += "unknown" + std::to_string(i) + ": 1\n";
  const auto start = std::clock();
  EXPECT_THAT(messageOf(text), HasSubstr("unknown key 'unknown0'"));
  // Searching the keys before it for each of them took half a minute.
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
}

TEST(DeckErrors, AnIntegerBeyondExactFloatingPoint) {
  EXPECT_THAT(
      messageOf(sampleWith("time:", "seed: 1e18\ntime:")),
      HasSubstr("seed: expected an integer, found '1e18': integers above 9007199254740992 have to be written in "
                "digits"));
  for (const char* tooLarge : {"1e30", "9223372036854775808", "-1e30"})
    EXPECT_THAT(messageOf(sampleWith("time:", std::string("seed: ") + tooLarge + "\ntime:")),
                HasSubstr("which is too large: integers end at 9223372036854775807"))
        << tooLarge;
}

TEST(DeckErrors, ControlCharactersAreNotSentToTheConsole) {
  const std::string message = messageOf("problem: flow\nmesh: {zz\x1b[2Jz: 3} # \r x\n");
  for (const char c : {'\x1b', '\r'}) EXPECT_EQ(message.find(c), std::string::npos) << message;
}

TEST(DeckErrors, ABracketOfAnOverrideIsClosed) {
  EXPECT_THAT(messageOf(test::sampleText, {"mesh.z[0=3"}), HasSubstr("a bracket of the key is not closed"));
}

TEST(DeckErrors, AListIsMarkedByItsFirstCharacterAlone) {
  EXPECT_THAT(messageOf(sampleWith("40 ms", "[1, 2]")),
              testing::EndsWith("\n    22 |   end: [1, 2]\n       |        ^"));
}

TEST(DeckErrors, TheCaretStandsUnderTheWordWithTabsAndAccents) {
  EXPECT_THAT(messageOf("problem: flow\nmechanism: \"µµ\"   \t\nmesh: {z: [{to: µ, cells: 1}]}\n"),
              HasSubstr("     3 | mesh: {z: [{to: µ, cells: 1}]}\n       |                 ^"));
}

}  // namespace
}  // namespace lampblack::io
