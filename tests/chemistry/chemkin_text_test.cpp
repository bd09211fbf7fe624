// Numbers and lines of CHEMKIN files.
#include "chemistry/chemkin/chemkin_text.hpp"

#include <gtest/gtest.h>

#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;

TEST(ChemkinText, FortranNumbers) {
  const std::pair<const char*, double> numbers[] = {{"1", 1},
                                                    {" -2.5 ", -2.5},
                                                    {"+3.", 3},
                                                    {".5", 0.5},
                                                    {"0.", 0},
                                                    {"1e3", 1e3},
                                                    {"1.E+03", 1e3},
                                                    {"1.d+05", 1e5},
                                                    {"-1.5D-02", -0.015},
                                                    {"1.0-300", 1e-300},
                                                    {"1.25+10", 1.25e10},
                                                    {"1.2E 05", 1.2e5},
                                                    {"1e-999", 0},
                                                    {"0.12345678E+02", 12.345678}};
  for (const auto& [text, value] : numbers) EXPECT_EQ(fortranNumber(text).value_or(-77), value) << text;
  for (const char* text : {"", " ", "-", ".", "e5", "1e", "1e+", "1.2E+ 5", "1.2.3", "1 2", "0x10", "inf", "nan",
                           "1e999", "1e5x", "1,5", "--1", "1e5.0"})
    EXPECT_FALSE(fortranNumber(text)) << text;
}

TEST(ChemkinText, LinesKeepTheirNumbers) {
  const ChemkinSource source(
      {"a", "\xef\xbb\xbf! First author,\tJ. Chem. 1 (2000)\r\n!  second line !!\r\n\r\n A B ! x\n\n\tC \rD\n\f\n\fE"});
  EXPECT_EQ(source.heading(), "First author, J. Chem. 1 (2000)\n second line");
  ASSERT_EQ(source.lines().size(), 4U);
  EXPECT_EQ(source.lines()[0].text, " A B");
  EXPECT_EQ(source.lines()[0].number, 4);
  EXPECT_EQ(source.lines()[1].number, 6);
  EXPECT_EQ(source.lines()[2].text, "D");
  EXPECT_EQ(source.lines()[2].number, 7);
  EXPECT_EQ(source.lines()[3].text, " E") << "the end of a printed page is a blank";
}

}  // namespace
