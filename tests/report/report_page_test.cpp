// The report's page in a real browser. Skipped where there is no Chromium.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "core/image_io.h"
#include "report/report_folder.h"
#include "support/example_comparison.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

std::string findBrowser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

class ReportPage : public testing::Test {
 protected:
  void SetUp() override {
    browser_ = findBrowser();
    if (browser_.empty()) GTEST_SKIP() << "there is no Chromium (Debian's package 'chromium')";
    writeReport(folder_ / "report", exampleComparison());
  }

  // Opens the page from disk, without a network; what the browser says goes to the files `out` and `err`.
  void open(const std::string& options) const {
    const std::string at = folder_.path().string();
    const std::string command =
        "HOME='" + at + "' timeout 120 " + browser_ +
        " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars --no-first-run"
        " --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --user-data-dir='" +
        at + "/profile' --virtual-time-budget=10000 " + options + " 'file://" + at +
        "/report/index.html' >'" + at + "/out' 2>'" + at + "/err' </dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << readAll(folder_ / "err");
  }

  std::size_t colorsIn(const std::string& screenshot) const {
    const ByteImage image = readPng(folder_ / screenshot);
    std::set<std::array<uint8_t, 3>> colors;
    for (std::size_t i = 0; i < image.bytes.size(); i += image.components)
      colors.insert({image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]});
    return colors.size();
  }

  TemporaryFolder folder_;
  std::string browser_;
};

TEST_F(ReportPage, ShowsItsNumbers) {
  open("--dump-dom");
  const std::string dom = readAll(folder_ / "out");
  EXPECT_NE(dom.find("data-ready=\"true\""), std::string::npos);
  EXPECT_EQ(dom.find("data-error"), std::string::npos);
  const std::string errors = readAll(folder_ / "err");
  EXPECT_EQ(errors.find(":CONSOLE"), std::string::npos) << errors;
  EXPECT_NE(dom.find("<h1 id=\"title\">ring &lt;/script&gt;.toml</h1>"), std::string::npos);
  for (const char* shown : {"<td rowspan=\"4\">98.3 ms</td>", "<td rowspan=\"4\">1.25 s</td>", "64 MiB",
                            "64 passes of 1\u202f048\u202f576 photons, noise 2 %", "caustics seen directly",
                            "data-technique=\"none\""})
    EXPECT_NE(dom.find(shown), std::string::npos) << shown;
  // The flux ratio of caustics that are not drawn.
  EXPECT_NE(dom.find("<td class=\"layer\">caustics</td><td>0.0000</td>"), std::string::npos);
}

TEST_F(ReportPage, NeedsNothingBesideItself) {
  const std::string page = readAll(folder_ / "report/index.html");
  for (const char* outside : {"http:", "https:", "src=\"/", "@import", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(ReportPage, IsNotBlankOnAScreenAndOnAPhone) {
  for (const auto& [name, size] : {std::pair("wide.png", "1280,720"), std::pair("narrow.png", "500,900")}) {
    open("--screenshot='" + (folder_ / name).string() + "' --window-size=" + size);
    EXPECT_GT(colorsIn(name), 100u) << name;
  }
}

}  // namespace
}  // namespace nephroid
