#include "report/html.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/html_text.hpp"

namespace nbvopt::test {
namespace {

TEST(Html, EscapesWhatIsMarkup) {
  EXPECT_EQ(html_escaped("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
}

TEST(Html, TablesAreAsPeopleSeeThem) {
  const TextTable table{
      {{"key", "who"}, {"machine", ""}, {"", "<figure>"}},
      {{"a|b", 1.0, 1234.4}, {"c", 2.0, std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_EQ(to_html(table),
            "<table>\n"
            "<tr><th class=\"text\">who</th><th>&lt;figure&gt;</th></tr>\n"
            "<tr><td class=\"text\">a|b</td><td>1,234</td></tr>\n"
            "<tr><td class=\"text\">c</td><td>-</td></tr>\n"
            "</table>\n");
}

TEST(Html, ImagesStandWithinThePage) {
  EXPECT_EQ(html_image("foo", "\"room\""),
            "<img alt=\"&quot;room&quot;\" src=\"data:image/png;base64,Zm9v\">\n");
}

}  // namespace
}  // namespace nbvopt::test
