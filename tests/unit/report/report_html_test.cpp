#include "tools/report/report_html.hpp"

#include <gtest/gtest.h>

#include "unit/report/report_fixture.hpp"

namespace repose::report {
namespace {

TEST(ReportHtml, EscapesWhatCouldBeMarkup) {
  EXPECT_EQ(escaped("<script>a && \"b\" 'c'</script>"),
            "&lt;script&gt;a &amp;&amp; &quot;b&quot; &#39;c&#39;&lt;/script&gt;");
  EXPECT_EQ(typeset("<b>"), "&lt;b&gt;");
}

TEST(ReportHtml, SetsSymbolsAndPowers) {
  EXPECT_EQ(typeset("α = 56.6 e^0.01 μr^-0.084 μs^0.25"),
            "<i>α</i>\u00a0=\u00a056.6 <i>e</i><sup>0.01</sup> <i>μ</i><sub>r</sub><sup>−0.084</sup> "
            "<i>μ</i><sub>s</sub><sup>0.25</sup>");
  EXPECT_EQ(typeset("nothing ^ here"), "nothing ^ here");
}

// The test vectors of RFC 4648, section 10.
TEST(ReportHtml, CodesBase64LikeTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(ReportHtml, TakesPicturesIn) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.png") << "foobar";
  EXPECT_EQ(data_address(folder.path() / "a.png"), "data:image/png;base64,Zm9vYmFy");
  EXPECT_THROW(data_address(folder.path() / "missing.png"), std::runtime_error);
  EXPECT_THROW(data_address(folder.path() / "a.tiff"), std::runtime_error);
}

}  // namespace
}  // namespace repose::report
