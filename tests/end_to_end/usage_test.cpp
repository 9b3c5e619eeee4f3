// What the program says of itself, and what it answers to a command line that it cannot follow.

#include <gtest/gtest.h>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

const std::vector<std::string> kVerbs = {"calibrate", "simulate", "sweep", "chart",  "status",
                                         "export",    "merge",    "fit",   "invert", "report",
                                         "stability", "shape",    "clump"};

TEST(Usage, HelpNamesEveryVerb) {
  const Finished help = repose({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string& verb : kVerbs) EXPECT_NE(help.out.find("\n  " + verb), std::string::npos) << verb;
}

TEST(Usage, EveryVerbHasHelpAndTakesJsonAndQuiet) {
  for (const std::string& verb : kVerbs) {
    const Finished help = repose({verb, "--help"});
    EXPECT_EQ(help.code, 0) << verb;
    EXPECT_NE(help.out.find("--json"), std::string::npos) << verb;
    EXPECT_NE(help.out.find("--quiet"), std::string::npos) << verb;
    EXPECT_EQ(help.err, "") << verb;
  }
}

TEST(Usage, VersionNamesTheEngine) {
  const Finished version = repose({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("repose 0.")) << version.out;
  EXPECT_NE(version.out.find("engine"), std::string::npos);
}

struct BadUsage {
  std::vector<std::string> arguments;
  std::string message;  ///< that standard error must hold
};

TEST(Usage, BadUsageEndsWithTwoAndSaysWhatIsWrong) {
  const std::vector<BadUsage> cases = {
      {{}, "subcommand is required"},
      {{"--nonsense"}, "--nonsense"},
      {{"simulate"}, "CASE is required"},
      {{"simulate", "a.json", "--seed", "first"}, "--seed"},
      {{"simulate", "a.json", "--frames", "many"}, "--frames"},
      {{"simulate", "a.json", "--unknown"}, "--unknown"},
      {{"sweep", "a.json"}, "--out is required"},
      {{"sweep", "a.json", "--out", "b", "--threads", "two"}, "--threads"},
      {{"status"}, "DIR is required"},
      {{"export", "study"}, "--csv is required"},
      {{"merge", "a", "b"}, "--into is required"},
      {{"fit"}, "SOURCE is required"},
      {{"fit", "a.csv", "--loss", "huber"}, "minimax"},
      {{"invert", "a.csv"}, "--angle is required"},
      {{"invert", "a.csv", "--angle", "steep"}, "--angle"},
      {{"calibrate", "a.json", "--out", "b"}, "--angle is required"},
      {{"calibrate", "a.json", "--angle", "30"}, "--out is required"},
      {{"report"}, "DIR is required"},
      {{"stability"}, "CASE is required"},
      {{"stability", "a.json"}, "--out is required"},
      {{"stability", "a.json", "--out", "b", "--scales", "one"}, "--scales"},
      {{"stability", "a.json", "--out", "b", "--precision", "fine"}, "--precision"},
      {{"simulate", "a.json", "--out", "--quiet"}, "needs a value, and '--quiet' is an option"},
      {{"export", "a", "--csv=", "--quiet"}, "--csv: needs a value"},
      {{"simulate", "a.json", "--seed", ""}, "--seed: needs a value"},
      {{"merge", "a", "--into", ""}, "--into: needs a value"},
      {{"simulate", ""}, "CASE: needs a value"},
  };
  for (const BadUsage& bad : cases) {
    const Finished answer = repose(bad.arguments);
    const std::string shown = ::testing::PrintToString(bad.arguments);
    EXPECT_EQ(answer.code, 2) << shown;
    EXPECT_EQ(answer.out, "") << shown;
    EXPECT_NE(answer.err.find(bad.message), std::string::npos) << shown << "\n" << answer.err;
  }
}

TEST(Usage, AnswersThatCannotBeWrittenAreAFault) {
  const TemporaryFolder folder;
  write_text(folder / "t.csv", "e_pp,mu_s,mu_r,angle_deg\n0.3,0.2,0.1,25\n0.3,0.4,0.1,30\n0.3,0.8,0.1,35\n");
  for (const std::string how : {"> /dev/full", ">&-"}) {
    const Finished answer = run("/bin/sh", {"-c", "exec \"$0\" \"$@\" " + how, REPOSE_PROGRAM, "fit",
                                            (folder / "t.csv").string(), "--json"});
    EXPECT_EQ(answer.code, 1) << how;
    EXPECT_NE(answer.err.find("standard output cannot be written"), std::string::npos) << answer.err;
  }
}

TEST(Usage, WithJsonBadUsageIsOneObjectToo) {
  const Finished answer = repose({"sweep", "--json", "nothing.json"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(Json::parse(answer.out).at("error").get<std::string>().find("--out"), std::string::npos);
}

}  // namespace
}  // namespace repose::test
