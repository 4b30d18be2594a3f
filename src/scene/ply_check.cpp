#include "scene/ply_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace nephroid {
namespace {

constexpr uint64_t kMostVerticesOfAFace = 65536;
constexpr uint64_t kMostElements = uint64_t{1} << 28;

struct Property {
  std::size_t size = 0;       // bytes of a value
  std::size_t countSize = 0;  // bytes of the number before a list; 0: no list
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class PlyFormat { ascii, littleEndian, bigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;  // first byte after it
};

class PlyChecker {
 public:
  PlyChecker(const std::string& bytes, const std::string& source) : bytes_(bytes), source_(source) {}

  void check() {
    readHeader();
    if (std::none_of(header_.elements.begin(), header_.elements.end(),
                     [](const Element& e) { return e.name == "face" && e.count > 0; })) {
      fail("has no faces");
    }
    position_ = header_.end;
    for (const Element& element : header_.elements) {
      for (uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip(element, property);
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(source_ + ": " + what); }

  std::size_t sizeOf(const std::string& type) const {
    static const std::array<std::pair<const char*, std::size_t>, 16> kSizes{{{"char", 1},
                                                                             {"int8", 1},
                                                                             {"uchar", 1},
                                                                             {"uint8", 1},
                                                                             {"short", 2},
                                                                             {"int16", 2},
                                                                             {"ushort", 2},
                                                                             {"uint16", 2},
                                                                             {"int", 4},
                                                                             {"int32", 4},
                                                                             {"uint", 4},
                                                                             {"uint32", 4},
                                                                             {"float", 4},
                                                                             {"float32", 4},
                                                                             {"double", 8},
                                                                             {"float64", 8}}};
    for (const auto& [name, size] : kSizes) {
      if (type == name) return size;
    }
    fail("\"" + type + "\" is no type of a PLY property");
  }

  void readHeader() {
    bool hasFormat = false;
    for (std::size_t line = 1;; ++line) {
      const std::size_t end = bytes_.find('\n', header_.end);
      if (end == std::string::npos || line > 1000) fail("the PLY header does not end with \"end_header\"");
      std::istringstream words(bytes_.substr(header_.end, end - header_.end));
      header_.end = end + 1;
      std::string keyword;
      words >> keyword;
      if (line == 1 && keyword != "ply") fail("does not begin with \"ply\"");
      if (keyword == "end_header") break;
      if (keyword == "format") {
        readFormat(words);
        hasFormat = true;
      } else if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count)) fail("an element in the PLY header has no count");
        if (element.count > kMostElements)
          fail("has " + std::to_string(element.count) + " of \"" + element.name +
               "\"; at most 2^28 are read");
        header_.elements.push_back(element);
      } else if (keyword == "property") {
        readProperty(words);
      }
    }
    if (!hasFormat) fail("the PLY header has no format");
  }

  void readFormat(std::istringstream& words) {
    std::string format;
    words >> format;
    if (format == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::littleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::bigEndian;
    } else {
      fail("\"" + format + "\" is no PLY format");
    }
  }

  void readProperty(std::istringstream& words) {
    if (header_.elements.empty()) fail("a property in the PLY header belongs to no element");
    std::string type, countType, valueType;
    words >> type;
    Property property;
    if (type == "list") {
      words >> countType >> valueType;
      property = {sizeOf(valueType), sizeOf(countType)};
      if (countType.rfind("float", 0) == 0 || countType == "double")
        fail("the count of a list must be a whole number");
    } else {
      property.size = sizeOf(type);
    }
    header_.elements.back().properties.push_back(property);
  }

  std::string_view nextWord() {
    const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (position_ < bytes_.size() && isSpace(bytes_[position_])) ++position_;
    const std::size_t begin = position_;
    while (position_ < bytes_.size() && !isSpace(bytes_[position_])) ++position_;
    if (begin == position_) fail("ends before the elements its header announces");
    return std::string_view(bytes_).substr(begin, position_ - begin);
  }

  void advance(uint64_t size) {
    if (size > bytes_.size() - position_) fail("ends before the elements its header announces");
    position_ += size;
  }

  uint64_t binaryCount(std::size_t size) {
    const std::size_t begin = position_;
    advance(size);
    uint64_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = header_.format == PlyFormat::bigEndian ? begin + i : begin + size - 1 - i;
      count = count << 8 | static_cast<unsigned char>(bytes_[at]);
    }
    return count;
  }

  uint64_t asciiCount() {
    const std::string_view word = nextWord();
    uint64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || end != word.data() + word.size())
      fail("the count of a list must be a whole number");
    return count;
  }

  void skip(const Element& element, const Property& property) {
    const bool isText = header_.format == PlyFormat::ascii;
    uint64_t values = 1;
    if (property.countSize > 0) values = isText ? asciiCount() : binaryCount(property.countSize);
    if (values > kMostVerticesOfAFace)
      fail("a list of \"" + element.name + "\" has " + std::to_string(values) + " values");
    if (!isText) return advance(values * property.size);
    for (uint64_t i = 0; i < values; ++i) nextWord();
  }

  const std::string& bytes_;
  const std::string& source_;
  PlyHeader header_;
  std::size_t position_ = 0;
};

}  // namespace

void requirePlausiblePly(const std::string& bytes, const std::string& source) {
  PlyChecker(bytes, source).check();
}

}  // namespace nephroid
