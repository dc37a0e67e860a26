#include "pipeline/library/web_page.h"

#include <gtest/gtest.h>

using namespace skylapse::pipeline;

namespace {

TEST(WebPage, PutsEachPartInThePlaceOfItsMark) {
  EXPECT_EQ(filled_page("a<!--x-->b<!--y-->c", {{"y", "2"}, {"x", "1"}, {"z", "3"}}), "a1b2c");
}

TEST(WebPage, APartMayHoldMarksOfPartsThatAreInAlready) {
  EXPECT_EQ(filled_page("<!--x--><!--y-->", {{"x", "1"}, {"y", "<!--x-->"}}), "1<!--x-->");
}

TEST(WebPage, DataNeverClosesItsScript) {
  const std::string element = data_element(R"({"title":"</script><script>alert(1)</script>"})");
  EXPECT_EQ(element.find("</script>"), element.size() - 9);
  EXPECT_NE(element.find("\\u003c/script>"), std::string::npos);
}

TEST(WebPage, HasItsFilesCompiledIn) {
  for (const char* name :
       {"base.css", "dom.js", "gallery.css", "gallery.html", "gallery.js", "panorama.js"})
    EXPECT_FALSE(web_text(name).empty()) << name;
  EXPECT_TRUE(web_text("other.js").empty());
  for (const char* mark : {"<!--style-->", "<!--data-->", "<!--script-->"})
    EXPECT_NE(web_text("gallery.html").find(mark), std::string::npos) << mark;
}

TEST(WebPage, PagesShareStyleAndScript) {
  EXPECT_NE(style_element("x{}").find(web_text("base.css")), std::string::npos);
  EXPECT_NE(script_element("f()").find(web_text("dom.js")), std::string::npos);
}

}  // namespace
