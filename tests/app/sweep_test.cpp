// Studies: which runs they mean, tables of results, and the fit of a convergence study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/shell/study/convergence_study.hpp"
#include "app/shell/study/sweep_jobs.hpp"
#include "app/shell/study/sweep_study.hpp"
#include "app/shell/study/sweep_table.hpp"
#include "core/modules.hpp"

namespace lampblack::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::ThrowsMessage;

SweepStudy studyOf(const std::string& text, const std::vector<std::string>& settings = {}) {
  return readStudy(Deck::parse(text, "/cases/study.yaml", {}, studySchema()), settings);
}

TEST(Study, EveryCombinationIsARunWithTheLastKeyFastest) {
  const SweepStudy study = studyOf(
      "study: s\ndeck: a/deck.yaml\nset: [time.end=1 s]\nvary:\n  - {key: initial.temperature, values: [900 K, 1 K]}\n"
      "  - {key: pressure, values: [1 atm, 2 bar]}\n",
      {"repeats=3"});
  ASSERT_EQ(study.runs.size(), 4U);
  EXPECT_EQ(study.runs[1].deck, "/cases/a/deck.yaml");
  EXPECT_THAT(study.runs[1].overrides,
              ElementsAre("time.end=1 s", "initial.temperature=900 K", "pressure=2 bar", "repeats=3"));
  EXPECT_THAT(study.runs[2].varied, ElementsAre(Pair("initial.temperature", "1 K"), Pair("pressure", "1 atm")));
  EXPECT_EQ(study.runs[1].name, "a_temperature-900_K_pressure-2_bar");
}

TEST(Study, DecksOfOneNameGetFoldersOfTheirOwn) {
  const SweepStudy study = studyOf("study: s\ndecks: [a/x.yaml, b/x.yaml, b/deck.yaml]\n");
  ASSERT_EQ(study.runs.size(), 3U);
  EXPECT_EQ(study.runs[0].name, "x");
  EXPECT_EQ(study.runs[1].name, "x_2");
  EXPECT_EQ(study.runs[2].name, "b");
}

TEST(Study, VariantsCombineWithWhatVaries) {
  const SweepStudy study = studyOf(
      "study: s\ndeck: x.yaml\nset: [a=0]\nchain: 2\nvariants:\n  - {name: slow, set: [left.u=1, right.u=1]}\n"
      "  - {name: fast, set: ['right.composition=O2: 1, N2: 3']}\nvary:\n  - {key: p, values: [1, 2]}\n");
  ASSERT_EQ(study.runs.size(), 4U);
  EXPECT_EQ(study.chain, 2U);
  EXPECT_EQ(study.runs[1].name, "x_slow_p-2");
  EXPECT_THAT(study.runs[1].overrides, ElementsAre("a=0", "left.u=1", "right.u=1", "p=2"));
  EXPECT_THAT(study.runs[2].varied, ElementsAre(Pair("variant", "fast"), Pair("p", "1")));
  // Text that YAML would take for a map is quoted.
  EXPECT_THAT(study.runs[2].overrides, ElementsAre("a=0", "right.composition=\"O2: 1, N2: 3\"", "p=1"));
  EXPECT_THAT([] { studyOf("study: s\ndeck: a.yaml\nvariants:\n  - {name: b, set: [c]}\n"); },
              ThrowsMessage<InputError>(HasSubstr("variants[0].set: expected assignments")));
  EXPECT_THAT([] { studyOf("study: s\ndeck: a.yaml\nvariants:\n  - {name: '/', set: [c=1]}\n"); },
              ThrowsMessage<InputError>(HasSubstr("variants[0].name: expected a name")));
}

TEST(Study, ContradictionsAreToldWithTheirPlace) {
  EXPECT_THAT([] { studyOf("study: s\n"); }, ThrowsMessage<InputError>(HasSubstr("nothing to run")));
  EXPECT_THAT([] { studyOf("study: s\ndeck: a.yaml\nset: [time.end]\n"); },
              ThrowsMessage<InputError>(HasSubstr("found 'time.end'")));
  EXPECT_THAT([] { studyOf("study: s\ndeck: a.yaml\nvary:\n  - {key: b, values: []}\n"); },
              ThrowsMessage<InputError>(HasSubstr("study.yaml:4")));
  EXPECT_THAT([] { studyOf("study: s\ndekc: a.yaml\n"); }, ThrowsMessage<InputError>(HasSubstr("did you mean 'deck'")));
  EXPECT_THAT([] { studyOf("study: s\nconvergence: {deck: a.yaml, particles: [100, 100]}\n"); },
              ThrowsMessage<InputError>(HasSubstr("twice")));
  EXPECT_THAT([] { studyOf("study: s\nconvergence: {deck: a.yaml, particles: [10, 100], product: 150}\n"); },
              ThrowsMessage<InputError>(HasSubstr("half of the product")));
  EXPECT_THAT([] { studyOf("study: s\nconvergence: {deck: a.yaml, particles: [8, 16], reference: {type: run}}\n"); },
              ThrowsMessage<InputError>(HasSubstr("'method'")));
}

TEST(StudyParts, EveryChainIsInOnePart) {
  const SweepStudy study =
      studyOf("study: s\ndeck: x.yaml\nchain: 2\nvary:\n  - {key: p, values: [1, 2, 3, 4, 5, 6, 7, 8, 9]}\n");
  for (const std::size_t parts : {1U, 2U, 3U, 5U, 8U}) {
    std::vector<std::string> names;
    for (std::size_t place = 1; place <= parts; ++place) {
      const SweepStudy part = partOf(study, {place, parts});
      EXPECT_TRUE(part.runs.empty() || names.size() % 2 == 0) << place << " of " << parts;
      EXPECT_LE(part.runs.size(), 2 * ((5 + parts - 1) / parts)) << place << " of " << parts;
      for (const SweepRun& run : part.runs) names.push_back(run.name);
    }
    ASSERT_EQ(names.size(), study.runs.size()) << parts;
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], study.runs[i].name);
  }
  const StudyPart part = readPart("3/10");
  EXPECT_EQ(part.place, 3U);
  EXPECT_EQ(part.count, 10U);
  for (const char* text : {"", "3", "0/2", "3/2", "1/2x", "1/", "/2", "-1/2"})
    EXPECT_THROW(readPart(text), InputError) << text;
}

TEST(StudyParts, TheScriptHasNoMoreJobsThanChains) {
  const SweepStudy study = studyOf("study: s\ndeck: x.yaml\nvary:\n  - {key: p, values: [1, 2, 3]}\n");
  const std::string script = jobsScript(study, {"/a b/study.yaml", "/out", {"--set", "it=isn't"}, 8, 4});
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-3\n#SBATCH --ntasks=4\n"));
  EXPECT_THAT(script, HasSubstr(" sweep '/a b/study.yaml' --out /out --set 'it=isn'\\''t' --part "
                                "\"$SLURM_ARRAY_TASK_ID/3\" --ranks 4\n"));
}

TEST(StudyTable, ResultsOfARecordAreNamedByTheirPath) {
  const auto results = resultsOf(
      R"({"status": "done", "results": {"a": {"b": 1.5e-3, "c \"d\"": "x, y"}, "list": [1, 2], "none": null, "e": -2}})");
  EXPECT_THAT(results, ElementsAre(Pair("a.b", "1.5e-3"), Pair("a.c \"d\"", "x, y"), Pair("e", "-2")));
  EXPECT_TRUE(resultsOf("{\"status\": \"running\"}").empty());
}

TEST(StudyTable, FailuresOfOneMessageAreToldTogetherTheMostFirst) {
  SweepStudy study;
  std::vector<RunOutcome> outcomes;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    study.runs.emplace_back().name = name;
    outcomes.push_back({RunFailure::numerics, "too stiff", 0.0, false});
  }
  outcomes[0] = {};
  outcomes[1] = {RunFailure::input, "no such gas", 0.0, false};
  EXPECT_EQ(failureSummary(study, outcomes),
            "c, d, e (numerics failed, and 1 more): too stiff\nb (wrong input): no such gas\n");
  EXPECT_EQ(failureSummary(study, std::vector<RunOutcome>(6)), "");
}

TEST(StudyTable, NumbersTooSmallForNormalOnesAreShown) {
  EXPECT_EQ(alignedText(TextTable{{"x"}, {{"1e-310"}, {"2.5"}}}), "x\n1e-310\n   2.5\n");
}

TEST(StudyTable, CsvIsReadAsItWasWritten) {
  const TextTable table{{"a", "b, c"}, {{"1", "he said \"no\""}, {"", "two\nlines"}}};
  const TextTable again = readCsv("# a comment\n" + csvText(table));
  EXPECT_EQ(again.columns, table.columns);
  EXPECT_EQ(again.rows, table.rows);
  EXPECT_THAT([] { readCsv("a,b\n1\n"); }, ThrowsMessage<InputError>(HasSubstr("line 2 has 1 fields")));
}

TEST(Convergence, ErrorsAreMeansOverTheTimesRelativeToTheReference) {
  const std::vector<double> mean{11, 36}, error{1, 2}, reference{10, 40};
  const MeanErrors errors = meanErrors(mean, error, reference, 4);
  EXPECT_NEAR(errors.error, 0.5 * (0.1 + 0.1), 1e-15);
  EXPECT_NEAR(errors.confidence, 3.29 * 0.5 * (0.1 + 0.05), 1e-15);
  EXPECT_NEAR(errors.scatter, 2 * 0.5 * (0.1 + 0.05), 1e-15);
}

}  // namespace
}  // namespace lampblack::app
