#include "web/page.hpp"

#include <gmock/gmock.h>

#include "support/made_map.hpp"
#include "web/map_page.hpp"
#include "web/packed.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kHostile = "</script><script>alert(1)</script><img src=x onerror=\"alert(2)\">";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

TEST(Page, TakesNoTextForMarkup) {
  const std::string plain = page_html("map", {{"key", "value"}}, {});
  const std::string hostile = page_html(kHostile, {{"key", kHostile}, {kHostile, "{{title}}"}}, {});
  for (const char* tag : {"<script", "</script", "<img", "<!--"}) {
    EXPECT_EQ(count(hostile, tag), count(plain, tag)) << tag;
  }
  EXPECT_THAT(hostile, HasSubstr("&lt;/script&gt;&lt;script&gt;alert(1)"));
  EXPECT_THAT(hostile, HasSubstr("{{title}}"));  // marks in what was filled in are text
  EXPECT_THAT(page_html("map", {{"key", "\xff"}}, {}), HasSubstr("\\ufffd"));  // no UTF-8
}

TEST(Page, FetchesNothing) {
  const std::string html = page_html("map", Json::object(), {});
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("unsafe-inline")));
  // Of the frame; scripts are run under that policy.
  const std::string frame = html.substr(0, html.find("<script>"));
  EXPECT_THAT(frame, Not(HasSubstr("src=")));
  EXPECT_THAT(frame, Not(HasSubstr("@import")));
  EXPECT_EQ(count(frame, "href="), 1U);
  EXPECT_THAT(frame, HasSubstr("href=\"data:,\""));
}

TEST(Page, AsksItsOwnServerAloneWhereItIsLive) {
  EXPECT_THAT(page_html("map", Json::object(), {}, PageKind::live),
              HasSubstr("; connect-src 'self'\""));
  EXPECT_THAT(page_html("map", Json::object(), {}), Not(HasSubstr("connect-src")));
}

TEST(Page, OfAnEmptyMapAndOfOneVoxel) {
  UncertaintyMap map(0.1);
  EXPECT_EQ(MapPage("empty", map, std::nullopt).faces(), 0U);
  map.set(key_from_origin(0, 0, 0), occupied(0.5F));
  map.finish_writing();
  const MapPage page("one", map, std::nullopt);
  EXPECT_EQ(page.faces(), 6U);
  EXPECT_EQ(page.rectangles(), 6U);
  EXPECT_THAT(page.html(), HasSubstr("\"occupied_voxels\":1,"));
}

TEST(Packed, RectanglesAreFourNumbersEach) {
  EXPECT_EQ(packed_rectangles({}), "");
  // What zlib makes of 3, 2, 1 and 31 | 6 << 5 | 5 << 10, checked with Python's zlib.
  const FaceRectangle rectangle{{3, 2, 1}, FaceNormal::plus_z, 32, 7};
  EXPECT_EQ(packed_rectangles(std::vector{rectangle}), "eJxjZmBiYGS4LwIAAgIA+g==");
}

TEST(Packed, ASurfaceIsItsSetsOneAfterTheOther) {
  EXPECT_EQ(packed_surface({}), "");
  const SurfaceMesh mesh{.seen = {{{{3, 2, 1}, FaceNormal::plus_z, 2, 1}}, {7, 8}, 2},
                         .backs = {{{{6, 5, 4}, FaceNormal::plus_x, 1, 1}}, {9}, 1},
                         .frontier = {{{{1, 1, 1}, FaceNormal::minus_x, 1, 1}}, {}, 1}};
  // What zlib makes of 1, 1, 1 in four bytes each; 3, 2, 1, 1 | 5 << 10; 6, 5, 4, 1 << 10; 1, 1, 1,
  // 0; and 7, 8, 9 in one byte each, checked with Python's zlib.
  EXPECT_EQ(packed_surface(mesh), "eJxjZGBgYIRiZgYmIM0owsbAysDCwMDCCOIBxdk5OAEESwBN");
}

}  // namespace
}  // namespace nbvopt::test
