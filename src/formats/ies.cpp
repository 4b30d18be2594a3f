#include "formats/ies.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "formats/mesh_file.h"

namespace nephroid {
namespace {

constexpr std::uintmax_t kLargestIesFile = std::uintmax_t{16} << 20;  // bytes
constexpr double kLargestNumber = 1e12;

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) || c == '\0' || c == '\x1a';  // DOS ends a file with ^Z
}

bool isDelimiter(char c) {
  return isBlank(c) || c == ',';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

std::string spelled(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::optional<double> numberIn(std::string_view token) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

// The text of a file, read as lines and then as numbers that flow over lines.
class IesText {
 public:
  IesText(std::string_view text, std::string source) : rest_(text), source_(std::move(source)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(oneLine(source_ + ":" + std::to_string(line_) + ": " + what));
  }

  bool isAtEnd() const { return rest_.empty(); }
  std::size_t bytesLeft() const { return rest_.size(); }

  std::string_view nextLine() {
    line_ = nextLine_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    drop(end);
    if (!rest_.empty()) drop(lineBreak());
    return line;
  }

  double number(const std::string& what, double lowest = -kLargestNumber, double highest = kLargestNumber) {
    const std::string_view token = nextToken();
    if (token.empty()) fail("ends before " + what);
    const auto value = numberIn(token);
    if (!value)
      fail("\"" + std::string(token.substr(0, 40)) + "\" stands for " + what + "; it must be a number");
    if (!(*value >= lowest && *value <= highest)) {
      fail(what + " is " + spelled(*value) + "; it must be from " + spelled(lowest) + " to " +
           spelled(highest));
    }
    return *value;
  }

  uint32_t wholeNumber(const std::string& what, double lowest, double highest) {
    const double value = number(what, lowest, highest);
    if (value != std::floor(value)) fail(what + " is " + spelled(value) + "; it must be a whole number");
    return static_cast<uint32_t>(value);
  }

  double factor(const std::string& what) {
    const double value = number(what, 0);
    if (value == 0) fail(what + " is 0; it must be more");
    return value;
  }

  // How many of something follow, each at least a digit and a blank.
  uint32_t count(const std::string& what, double lowest) {
    return wholeNumber(what, lowest, std::max(lowest, static_cast<double>(bytesLeft()) / 2));
  }

  bool hasFurtherNumber() { return numberIn(nextToken()).has_value(); }

 private:
  std::size_t lineBreak() const { return rest_.substr(0, 2) == "\r\n" ? 2 : 1; }

  void drop(std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      const bool isHalfOfBreak = rest_[i] == '\r' && i + 1 < rest_.size() && rest_[i + 1] == '\n';
      if (rest_[i] == '\n' || (rest_[i] == '\r' && !isHalfOfBreak)) ++nextLine_;
    }
    rest_.remove_prefix(bytes);
  }

  std::string_view nextToken() {
    std::size_t begin = 0;
    while (begin < rest_.size() && isDelimiter(rest_[begin])) ++begin;
    drop(begin);
    if (!rest_.empty()) line_ = nextLine_;
    std::size_t size = 0;
    while (size < rest_.size() && !isDelimiter(rest_[size])) ++size;
    const std::string_view token = rest_.substr(0, size);
    drop(size);
    return token;
  }

  std::string_view rest_;
  std::string source_;
  std::size_t line_ = 1;      // of what was read last
  std::size_t nextLine_ = 1;  // of what is read next
};

// The year of the standard in a file's first line, such as "IESNA:LM-63-2002" or "IESNA91"; 1986 had none.
int standardYear(std::string_view firstLine) {
  const std::string line = upper(trimmed(firstLine));
  if (line.rfind("IES", 0) != 0) return 1986;
  std::size_t begin = line.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(line[begin - 1]))) --begin;
  int year = 0;
  std::from_chars(line.data() + begin, line.data() + line.size(), year);
  return year < 100 ? 1900 + year : year;
}

// The value of a TILT= line; empty for any other.
std::string tiltIn(std::string_view line) {
  std::string_view rest = trimmed(line);
  if (upper(rest.substr(0, 4)) != "TILT") return "";
  rest = trimmed(rest.substr(4));
  if (rest.empty() || rest.front() != '=') return "";
  return std::string(trimmed(rest.substr(1)));
}

// From the first line through the TILT section; returns the standard's year.
int readHeader(IesText& text) {
  const std::string_view first = text.nextLine();
  const int year = standardYear(first);
  std::string tilt = tiltIn(first);
  while (tilt.empty()) {
    if (text.isAtEnd()) text.fail("has no line TILT=NONE or TILT=INCLUDE; an LM-63 file needs one");
    tilt = tiltIn(text.nextLine());
  }
  if (upper(tilt) == "NONE") return year;
  if (upper(tilt) != "INCLUDE") {
    text.fail("TILT=" + tilt.substr(0, 80) +
              " names another file, which is not read; it must be TILT=NONE or TILT=INCLUDE");
  }
  text.wholeNumber("the lamp-to-luminaire geometry", 1, 3);
  const uint32_t count = text.count("the number of tilt angles", 0);
  for (uint32_t i = 0; i < count; ++i) text.number("a tilt angle", -360, 360);
  for (uint32_t i = 0; i < count; ++i) text.number("a tilt factor", 0);
  return year;
}

std::vector<float> readAngles(IesText& text, uint32_t count, const std::string& what, double lowest,
                              double highest) {
  std::vector<float> angles;
  angles.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    angles.push_back(static_cast<float>(text.number(what, lowest, highest)));
    if (i > 0 && !(angles[i] > angles[i - 1])) {
      text.fail(what + " " + spelled(angles[i]) + " follows " + spelled(angles[i - 1]) +
                "; the angles must ascend");
    }
  }
  return angles;
}

// Type C closes the circle, by symmetry or as far as it was measured. Returns whether 360 is 0 again and was
// left out.
bool leavesOutLastPlane(const IesText& text, const std::vector<float>& angles) {
  if (angles.size() == 1) return false;
  const float first = angles.front(), last = angles.back();
  const bool isWhole = first == 0 && (last == 90 || last == 180 || last == 360);
  if (isWhole || (first == 90 && last == 270)) return false;
  float widest = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  if (first == 0 && last > 180 && 360 - last <= 1.001f * widest) return true;
  text.fail("the horizontal angles go from " + spelled(first) + " to " + spelled(last) +
            "; type C must have one, or from 0 to 90, 180 or 360, or from 90 to 270");
}

void requireAxisOfTypeAOrB(const IesText& text, const std::vector<float>& angles, const std::string& what) {
  if (angles.size() < 2 || angles.front() > 0 || angles.back() <= 0) {
    text.fail("the " + what + " angles go from " + spelled(angles.front()) + " to " + spelled(angles.back()) +
              "; types A and B must have two or more, from 0 or below 0 to above 0");
  }
}

// What stands between the TILT section and the angles.
struct Layout {
  uint32_t verticals = 0;
  uint32_t horizontals = 0;
  PhotometryType type = PhotometryType::c;
  double scale = 1;  // of the candela values
};

Layout readLayout(IesText& text, int year) {
  Layout layout;
  text.number("the number of lamps", 0);
  text.number("the lumens per lamp");
  layout.scale = text.factor("the candela multiplier");
  layout.verticals = text.count("the number of vertical angles", 2);
  layout.horizontals = text.count("the number of horizontal angles", 1);
  if (static_cast<double>(layout.verticals) * layout.horizontals >
      static_cast<double>(text.bytesLeft()) / 2) {
    text.fail(std::to_string(layout.verticals) + " vertical by " + std::to_string(layout.horizontals) +
              " horizontal angles are more than the rest of the file holds");
  }
  constexpr std::array kTypes{PhotometryType::c, PhotometryType::b, PhotometryType::a};
  layout.type = kTypes[text.wholeNumber("the photometric type", 1, 3) - 1];
  text.wholeNumber("the units type", 1, 2);
  for (const char* side : {"width", "length", "height"}) text.number("the luminous " + std::string(side));
  layout.scale *= text.factor("the ballast factor");
  // LM-63-2002 leaves this place for future use, and LM-63-2019 tells by it how the file was made.
  const double ballastLampFactor = text.number("the ballast-lamp photometric factor", 0);
  if (year < 2002) layout.scale *= ballastLampFactor;
  text.number("the input watts");
  return layout;
}

// The candela values as fractions of their peak.
void readValues(IesText& text, const Layout& layout, Profile& profile) {
  const std::size_t count = std::size_t{layout.verticals} * layout.horizontals;
  profile.fractions.reserve(count + layout.verticals);
  for (std::size_t i = 0; i < count; ++i) {
    const double candela = layout.scale * text.number("a candela value", 0);
    if (candela > kLargestNumber)
      text.fail("a value is " + spelled(candela) + " cd; it must be at most 1e12");
    profile.fractions.push_back(static_cast<float>(candela));
  }
  if (text.hasFurtherNumber()) {
    text.fail("a number follows the " + std::to_string(count) + " candela values of " +
              std::to_string(layout.verticals) + " vertical by " + std::to_string(layout.horizontals) +
              " horizontal angles");
  }
  profile.peak = *std::max_element(profile.fractions.begin(), profile.fractions.end());
  if (profile.peak < 1e-6f) {
    text.fail("the brightest value is " + spelled(profile.peak) + " cd; it must be 1e-6 or more");
  }
  for (float& value : profile.fractions) value /= profile.peak;
}

}  // namespace

Profile readIes(const std::string& bytes, const std::string& source) {
  std::string_view whole(bytes);
  if (whole.substr(0, 3) == "\xef\xbb\xbf") whole.remove_prefix(3);
  IesText text(whole, source);
  const Layout layout = readLayout(text, readHeader(text));
  const bool isTypeC = layout.type == PhotometryType::c;
  Profile profile;
  profile.name = source;
  profile.type = layout.type;
  profile.verticalAngles =
      readAngles(text, layout.verticals, "the vertical angle", isTypeC ? 0 : -90, isTypeC ? 180 : 90);
  if (!isTypeC) requireAxisOfTypeAOrB(text, profile.verticalAngles, "vertical");
  profile.horizontalAngles =
      readAngles(text, layout.horizontals, "the horizontal angle", isTypeC ? 0 : -90, isTypeC ? 360 : 90);
  if (!isTypeC) requireAxisOfTypeAOrB(text, profile.horizontalAngles, "horizontal");
  const bool isOpen = isTypeC && leavesOutLastPlane(text, profile.horizontalAngles);
  readValues(text, layout, profile);
  if (isOpen) {
    profile.horizontalAngles.push_back(360);
    for (uint32_t i = 0; i < layout.verticals; ++i) profile.fractions.push_back(profile.fractions[i]);
  }
  return profile;
}

Profile loadIes(const std::filesystem::path& file) {
  return readIes(readFile(file, kLargestIesFile), oneLine(file.string()));
}

}  // namespace nephroid
