#include "io/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "core/modules.hpp"
#include "io/report.hpp"
#include "io/run_record.hpp"

namespace lampblack::io {
namespace {

using testing::HasSubstr;

TEST(Json, EscapesWhatHasToBeEscaped) {
  EXPECT_EQ(jsonString("a \"b\" \\ \n\t\r\x01"), R"("a \"b\" \\ \n\t\r\u0001")");
  EXPECT_EQ(jsonString("µm °C 炎"), "\"µm °C 炎\"");
}

TEST(Json, ReplacesBytesThatAreNotUtf8) {
  const std::string replaced = "\"\xEF\xBF\xBD\"";
  EXPECT_EQ(jsonString("\xff"), replaced);
  EXPECT_EQ(jsonString("\xc3"), replaced);
  EXPECT_EQ(jsonString("\xc0\xaf"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

TEST(Json, WritesNumbersThatReadBackExactly) {
  for (const double number : {0.1, 1.0 / 3.0, 6.02214076e23, -1e-308, 5e-324}) {
    JsonWriter json;
    json.value(number);
    EXPECT_EQ(std::strtod(json.text().c_str(), nullptr), number);
  }
  JsonWriter json;
  json.beginArray().value(std::numeric_limits<double>::quiet_NaN()).value(std::int64_t{-3}).value(true).endArray();
  EXPECT_EQ(json.text(), "[\n  null,\n  -3,\n  true\n]");
}

TEST(Json, NestsAndTakesRawText) {
  JsonWriter json;
  json.beginObject().field("a", 1).key("b").beginObject().endObject().key("c").raw("{\n  \"d\": 2\n}").endObject();
  EXPECT_EQ(json.text(), "{\n  \"a\": 1,\n  \"b\": {},\n  \"c\": {\n    \"d\": 2\n  }\n}");
}

TEST(RunRecord, SaysHowTheRunWent) {
  RunRecord record;
  record.status = RunStatus::failed;
  record.message = "the \"step\" failed";
  record.libraries = {{"PETSc", "3.18.5"}};
  record.stages = {{"chemistry", 1.0, 2.0, 3.0}};
  const std::string json = toJson(record);
  EXPECT_THAT(json, HasSubstr("\"status\": \"failed\""));
  EXPECT_THAT(json, HasSubstr(R"("message": "the \"step\" failed")"));
  EXPECT_THAT(json, HasSubstr("\"PETSc\": \"3.18.5\""));
  EXPECT_THAT(json, HasSubstr("\"maximum_s\": 3"));
  EXPECT_THAT(json, HasSubstr("\"deck\": null"));
  EXPECT_THAT(utcNow(), testing::MatchesRegex("20[0-9][0-9]-[0-9][0-9]-[0-9][0-9]T[0-9:]*Z"));
}

TEST(Report, HasStagesSharesAndRates) {
  ClosingReport report;
  report.ranks = 2;
  report.cells = 1000;
  report.steps = 50;
  report.wallTime = 100.0;
  report.peakMemoryPerRank = 1.5 * 1024 * 1024 * 1024;
  report.stages = {{"flow", 9.0, 10.0, 11.0}, {"chemistry", 60.0, 70.0, 80.0}};
  report.imbalances = {{"chemistry", 1.43, 1.02}};
  const std::string text = formatReport(report);
  EXPECT_LT(text.find("chemistry"), text.find("flow"));
  EXPECT_THAT(text, HasSubstr("70.0\n"));
  EXPECT_THAT(text, HasSubstr("other                        20.000"));
  EXPECT_THAT(text, HasSubstr("1.43    1.02"));
  EXPECT_THAT(text, HasSubstr("1000 cells x 50 steps on 2 ranks in 1 min 40 s: 500 cell-steps/s\n"));
  report.earlierSteps = 7000;
  EXPECT_THAT(formatReport(report), HasSubstr("x 50 steps on 2 ranks in 1 min 40 s: 500 cell-steps/s, after 7000 steps "
                                              "before the restart\n"));
  EXPECT_THAT(text, HasSubstr("Peak memory per rank: 1.5 GiB"));
}

TEST(Report, FormatsDurationsAndSizes) {
  EXPECT_EQ(formatDuration(3.214), "3.21 s");
  EXPECT_EQ(formatDuration(42.0), "42 s");
  EXPECT_EQ(formatDuration(245.0), "4 min 05 s");
  EXPECT_EQ(formatDuration(7380.0), "2 h 03 min");
  EXPECT_EQ(formatBytes(512.0), "512 B");
  EXPECT_EQ(formatBytes(340.0 * 1024 * 1024), "340 MiB");
}

}  // namespace
}  // namespace lampblack::io
