// Small texts of the program: numbers, bytes, progress bars.
#include <doctest/doctest.h>

#include "gridcull/service/progress.h"
#include "gridcull/service/svg_frame.h"
#include "gridcull/service/text.h"

using namespace gridcull;

TEST_CASE("pixels have one decimal and no trailing zero") {
  CHECK(px(1.0) == "1");
  CHECK(px(1.25) == "1.2");
  CHECK(px(-0.01) == "0");
  CHECK(px(-3.55) == "-3.5");
  CHECK(px(120.0) == "120");
}

TEST_CASE("text in SVG is escaped") { CHECK(escaped("a<b>&\"c\"") == "a&lt;b&gt;&amp;&quot;c&quot;"); }

TEST_CASE("what may not stand in XML is replaced") {
  CHECK(escaped("a\xff-\xc3\xa9.json") == "a\xef\xbf\xbd-\xc3\xa9.json");
  CHECK(escaped("cut \xc3") == "cut \xef\xbf\xbd");
  CHECK(escaped("a\x01\tb\x1f") == "a\xef\xbf\xbd\tb\xef\xbf\xbd");
}

TEST_CASE("numbers for people") {
  CHECK(number_text(2.0) == "2");
  CHECK(number_text(0.1 + 0.2) == "0.3");
  CHECK(bytes_text(999.0) == "999 bytes");
  CHECK(bytes_text(12345678.0) == "12.3 MB");
  CHECK(counted(1, "frame") == "1 frame");
  CHECK(counted(0, "frame") == "0 frames");
  CHECK(bounds_text({{0, 0, 0}, {100, 60.5, 0}}, 2) == "(0, 0) .. (100, 60.5)");
  CHECK(bounds_text({{0, 0, 1}, {100, 60.5, 2}}, 3) == "(0, 0, 1) .. (100, 60.5, 2)");
  CHECK(bounds_text({}, 2) == "nothing");
}

TEST_CASE("the progress bar fills up") {
  CHECK(progress_text("frames", 5, 10, 2.0, 10) == "[#####.....] 5/10 frames, 2 a second");
  CHECK(progress_text("frames", 10, 10, 0.0, 4) == "[####] 10/10 frames");
  CHECK(progress_text("frames", 20, 10, 0.0, 4) == "[####] 20/10 frames");
  CHECK(progress_text("frames", 7, std::nullopt, 7.0, 10) == "7 frames, 1 a second");
}
