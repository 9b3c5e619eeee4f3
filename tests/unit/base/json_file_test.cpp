#include "engine/base/json_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/message_of.hpp"
#include "support/process.hpp"

namespace repose::test {
namespace {

using Json = nlohmann::ordered_json;

std::string fault_of(const std::string& text) {
  return message_of([&] { parse_json(text, "a.json"); });
}

TEST(JsonFile, KeepsKeysInTheirOrder) {
  EXPECT_EQ(parse_json(R"({"b": 1, "a": [true, null, "x"]})", "a.json").dump(),
            R"({"b":1,"a":[true,null,"x"]})");
}

TEST(JsonFile, NamesLineAndColumnOfAnError) {
  const std::string message = fault_of("{\n  \"a\": 1,\n  \"b\": 2,,\n}");
  EXPECT_TRUE(message.starts_with("a.json: line 3, column 10: is not JSON: syntax error")) << message;
  EXPECT_NE(message.find("unexpected ','"), std::string::npos) << message;
  EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
}

TEST(JsonFile, NamesTheEndOfATextThatStops) {
  const std::string message = fault_of("{\"a\": [1, 2");
  EXPECT_TRUE(message.starts_with("a.json: line 1, column 12: is not JSON: ")) << message;
  EXPECT_NE(message.find("end of input"), std::string::npos) << message;
}

TEST(JsonFile, RefusesAnEmptyText) {
  EXPECT_TRUE(fault_of("").starts_with("a.json: line 1, column 1: is not JSON: ")) << fault_of("");
}

TEST(JsonFile, RefusesWordsThatJsonLacks) {
  for (const char* word : {"NaN", "Infinity", "-inf", "+1", "0x10", "'a'", "1.", ".5", "True"})
    EXPECT_TRUE(fault_of(std::string("{\"a\": ") + word + "}").starts_with("a.json: line 1, column "))
        << word;
}

TEST(JsonFile, RefusesANumberThatNoDoubleHolds) {
  const std::string message = fault_of("{\"a\":\n 1e999}");
  EXPECT_TRUE(message.starts_with("a.json: line 2, column ")) << message;
  EXPECT_NE(message.find("1e999"), std::string::npos) << message;
}

TEST(JsonFile, NamesEveryKeyThatIsGivenTwice) {
  EXPECT_EQ(fault_of(R"({"a": 1, "b": [{"c": 1}, {"d": 1, "d": 2}], "a": 2})"),
            "a.json: /b/1/d: is given twice\na.json: /a: is given twice");
  EXPECT_EQ(fault_of(R"({"a": {"x": 1}, "b": {"x": 1}})"), "");
}

TEST(JsonFile, RefusesNestingThatNoCaseNeeds) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_NE(fault_of(deep).find("is nested deeper than 64"), std::string::npos);
  EXPECT_EQ(fault_of(std::string(64, '[') + std::string(64, ']')), "");
}

TEST(JsonFile, RefusesInvalidUtf8) {
  EXPECT_TRUE(fault_of("{\"a\": \"\xff\"}").starts_with("a.json: line 1, column "))
      << fault_of("{\"a\": \"\xff\"}");
}

TEST(JsonFile, ReadsPastTheByteOrderMark) {
  EXPECT_EQ(parse_json("\xEF\xBB\xBF{\"a\": 1}", "a.json")["a"], 1);
}

TEST(JsonFile, NamesAFileThatCannotBeOpened) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of([] { read_json("no/such.json"); }), "no/such.json: cannot be opened");
  EXPECT_EQ(message_of([&] { read_json(folder.path()); }), folder.path().string() + ": cannot be opened");
  EXPECT_EQ(message_of([] { read_json(std::string(5000, 'a')); }),
            std::string(5000, 'a') + ": cannot be opened");
}

TEST(JsonFile, ShowsValuesOnOneShortLine) {
  EXPECT_EQ(shown(Json::parse(R"({ "a": [1, 2.5, "x"] })")), R"({"a":[1,2.5,"x"]})");
  EXPECT_EQ(shown(Json(std::string(100, 'a'))), "\"" + std::string(59, 'a') + "…");
  EXPECT_EQ(shown(Json(std::string(58, 'a') + "µµ")),
            "\"" + std::string(58, 'a') + "…");  // no half character
  EXPECT_EQ(shown(Json(std::numeric_limits<double>::infinity())), "inf");
  EXPECT_EQ(shown(Json("\xff")), "\"\xEF\xBF\xBD\"");  // the replacement character
}

TEST(JsonPointer, SplitsAndEscapesAsItsStandardSays) {
  // The pointers of RFC 6901, section 5.
  using Parts = std::vector<std::string>;
  EXPECT_EQ(pointer_parts(""), Parts{});
  EXPECT_EQ(pointer_parts("/foo/0"), (Parts{"foo", "0"}));
  EXPECT_EQ(pointer_parts("/"), Parts{""});
  EXPECT_EQ(pointer_parts("/a~1b"), Parts{"a/b"});
  EXPECT_EQ(pointer_parts("/m~0n"), Parts{"m~n"});
  EXPECT_FALSE(pointer_parts("foo").has_value());
  EXPECT_FALSE(pointer_parts("/~2").has_value());
  EXPECT_FALSE(pointer_parts("/~").has_value());
  EXPECT_EQ(pointer_to("/x", "a/b~c"), "/x/a~1b~0c");
}

TEST(JsonPointer, FindsValues) {
  const Json json = Json::parse(R"({"foo": ["bar", "baz"], "a/b": 1})");
  EXPECT_EQ(value_at(json, ""), &json);
  ASSERT_NE(value_at(json, "/foo/1"), nullptr);
  EXPECT_EQ(*value_at(json, "/foo/1"), "baz");
  EXPECT_EQ(*value_at(json, "/a~1b"), 1);
  for (const char* absent : {"/bar", "/foo/2", "/foo/01", "/foo/-", "/foo/0/x", "foo"})
    EXPECT_EQ(value_at(json, absent), nullptr) << absent;
}

}  // namespace
}  // namespace repose::test
