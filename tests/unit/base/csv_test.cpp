#include "engine/base/csv.hpp"

#include <gtest/gtest.h>

#include "engine/base/input_error.hpp"
#include "support/process.hpp"

namespace repose::test {
namespace {

using Row = std::vector<std::string>;

class Csv : public testing::Test {
 protected:
  CsvTable read(const std::string& text) {
    write_text(file(), text);
    Faults faults;
    CsvTable table = read_csv(file(), faults);
    faults.throw_if_any();
    return table;
  }
  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      std::string message = error.what();
      for (auto at = message.find(file().string()); at != std::string::npos;
           at = message.find(file().string()))
        message.replace(at, file().string().size(), "t.csv");
      return message;
    }
    return "";
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "table.csv"; }

 private:
  TemporaryFolder folder_;
};

TEST_F(Csv, ReadsHeaderRowsAndLineNumbers) {
  const CsvTable table = read("e_pp,mu_s\n0.1,0.2\n0.3,0.4\n");
  EXPECT_EQ(table.columns, (Row{"e_pp", "mu_s"}));
  EXPECT_EQ(table.rows, (std::vector<Row>{{"0.1", "0.2"}, {"0.3", "0.4"}}));
  EXPECT_EQ(table.lines, (std::vector<int>{2, 3}));
  EXPECT_EQ(table.file, file().string());
}

TEST_F(Csv, SkipsCommentsAndBlankLinesAndCountsThem) {
  const CsvTable table = read("# made by hand\n\na,b\n  \n# points\n1,2\n\n3,4");
  EXPECT_EQ(table.columns, (Row{"a", "b"}));
  EXPECT_EQ(table.rows, (std::vector<Row>{{"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(table.lines, (std::vector<int>{6, 8}));
}

TEST_F(Csv, TrimsCellsAndTakesTheLineEndsOfEverySystem) {
  const CsvTable table = read("a , b\r\n 1\t,  2 \r\n");
  EXPECT_EQ(table.columns, (Row{"a", "b"}));
  EXPECT_EQ(table.rows, (std::vector<Row>{{"1", "2"}}));
}

TEST_F(Csv, ReadsPastTheByteOrderMarkOfSpreadsheets) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "a,b\n1,2\n")
                .columns,
            (Row{"a", "b"}));
}

// The rules of RFC 4180, section 2, on quotes.
TEST_F(Csv, UnquotesCells) {
  const CsvTable table = read("name,\"a, b\"\n\"no. 13\",\"say \"\"ore\"\"\"\n\"\",x\n");
  EXPECT_EQ(table.columns, (Row{"name", "a, b"}));
  EXPECT_EQ(table.rows, (std::vector<Row>{{"no. 13", "say \"ore\""}, {"", "x"}}));
}

TEST_F(Csv, KeepsEmptyCells) { EXPECT_EQ(read("a,b,c\n,2,\n").rows, (std::vector<Row>{{"", "2", ""}})); }

TEST_F(Csv, FindsColumnsByName) {
  const CsvTable table = read("a,b\n1,2\n");
  EXPECT_EQ(table.column("b"), 1U);
  EXPECT_FALSE(table.column("B").has_value());
  EXPECT_FALSE(table.column("").has_value());
}

TEST_F(Csv, MayHoldNoRows) { EXPECT_TRUE(read("a,b\n").rows.empty()); }

TEST_F(Csv, NamesEveryRowThatDoesNotFitTheHeader) {
  EXPECT_EQ(fault("a,b\n1\n1,2\n1,2,3\n"),
            "t.csv: line 2 = 1 cells: must have 2 like the header\n"
            "t.csv: line 4 = 3 cells: must have 2 like the header");
}

TEST_F(Csv, KeepsTheOtherRowsSoThatTheirFaultsCanBeNamedToo) {
  write_text(file(), "a,b\n1\n1,2\n\"x\"y,2\n3,4\n");
  Faults faults;
  const CsvTable table = read_csv(file(), faults);
  EXPECT_EQ(faults.list().size(), 2U);
  EXPECT_EQ(table.rows, (std::vector<Row>{{"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(table.lines, (std::vector<int>{3, 5}));
}

TEST_F(Csv, NamesColumnsWithoutANameAndThoseGivenTwice) {
  EXPECT_EQ(fault("# x\na,,a\n1,2,3\n"),
            "t.csv: line 2: every column needs a name\n"
            "t.csv: line 2 = a: this column is named twice");
}

TEST_F(Csv, RefusesQuotesThatAreNotThoseOfAWholeCell) {
  EXPECT_EQ(fault("a,b\n2\"5,1\n\"open,1\n\"x\"y,2\n"),
            "t.csv: line 2: holds a quote inside a cell that does not begin with one\n"
            "t.csv: line 3: holds a quote that is not closed on its line\n"
            "t.csv: line 4: holds text behind the closing quote of a cell");
  EXPECT_EQ(read("a,b\n \"x\" , \"\"\n").rows, (std::vector<Row>{{"x", ""}}));
}

TEST_F(Csv, RefusesOtherSeparatorsInOneFault) {
  EXPECT_EQ(fault("a;b\n1;2\n3;4\n"), "t.csv: line 1 = a;b: cells must be separated by commas");
  EXPECT_EQ(fault("a\tb\n1\t2\n"), "t.csv: line 1 = a\tb: cells must be separated by commas");
}

TEST_F(Csv, RefusesAFileWithoutAHeader) {
  EXPECT_EQ(fault(""), "t.csv: holds no header line");
  EXPECT_EQ(fault("# only\n\n"), "t.csv: holds no header line");
}

TEST(CsvFile, RefusesAFileThatIsNotThere) {
  const TemporaryFolder folder;
  Faults faults;
  EXPECT_THROW(read_csv("no/such.csv", faults), InputError);
  EXPECT_THROW(read_csv(folder.path(), faults), InputError);
}

TEST(ParseNumber, TakesWhatIsANumberInFull) {
  EXPECT_EQ(parse_number("1.5e-3"), 1.5e-3);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number("-0.25"), -0.25);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("0.1"), 0.1);
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const char* cell : {"", " ", "+", "-", "1.5x", "1 2", "1,5", "abc", "nan", "inf", "-inf", "1e999",
                           "0x10", "+-5", "++5", "1e"})
    EXPECT_FALSE(parse_number(cell).has_value()) << '"' << cell << '"';
}

}  // namespace
}  // namespace repose::test
