// PLY, text and binary. Not left to Assimp, which makes room for whatever the counts of a file say before it
// looks at how much of the file there is.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "formats/mesh_file.h"
#include "formats/mesh_formats.h"
#include "geometry/mesh_checks.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostHeaderLines = 1000;
constexpr std::size_t kMostCornersOfAFace = 65536;

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::array<std::pair<std::string_view, NumberType>, 16> kTypeNames{
    {{"char", NumberType::int8},
     {"int8", NumberType::int8},
     {"uchar", NumberType::uint8},
     {"uint8", NumberType::uint8},
     {"short", NumberType::int16},
     {"int16", NumberType::int16},
     {"ushort", NumberType::uint16},
     {"uint16", NumberType::uint16},
     {"int", NumberType::int32},
     {"int32", NumberType::int32},
     {"uint", NumberType::uint32},
     {"uint32", NumberType::uint32},
     {"float", NumberType::float32},
     {"float32", NumberType::float32},
     {"double", NumberType::float64},
     {"float64", NumberType::float64}}};

struct Property {
  std::string name;
  NumberType type = NumberType::float32;
  bool isList = false;
  NumberType countType = NumberType::uint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class PlyFormat { ascii, littleEndian, bigEndian };

class PlyReader {
 public:
  PlyReader(const std::string& bytes, const std::string& source) : bytes_(bytes), source_(source) {}

  Mesh read() {
    readHeader();
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face") {
        readFaces(element);
      } else {
        for (std::size_t i = 0; i < element.count; ++i) {
          for (const Property& property : element.properties) readValues(property);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(oneLine(source_ + ": " + what)); }

  NumberType typeNamed(const std::string& name) const {
    for (const auto& [known, type] : kTypeNames) {
      if (name == known) return type;
    }
    fail("\"" + name + "\" is no type of a PLY property");
  }

  std::vector<std::string> headerLine(std::size_t number) {
    const std::size_t end = bytes_.find('\n', position_);
    if (end == std::string::npos || number > kMostHeaderLines)
      fail("the PLY header does not end with \"end_header\"");
    std::istringstream line(bytes_.substr(position_, end - position_));
    position_ = end + 1;
    return {std::istream_iterator<std::string>(line), {}};
  }

  void readHeader() {
    if (headerLine(1) != std::vector<std::string>{"ply"}) fail("does not begin with \"ply\"");
    bool hasFormat = false;
    for (std::size_t number = 2;; ++number) {
      const std::vector<std::string> words = headerLine(number);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() == 3) {
        readFormat(words[1]);
        hasFormat = true;
      } else if (words[0] == "element" && words.size() == 3) {
        elements_.push_back({words[1], countIn(words[2]), {}});
      } else if (words[0] == "property" && !elements_.empty()) {
        readProperty(words);
      } else {
        fail("line " + std::to_string(number) + " is not one of a PLY header");
      }
    }
    if (!hasFormat) fail("the PLY header has no format");
    // Every property is a byte at least, so that a count larger than the file is wrong, and is found before
    // any room is made.
    for (const Element& element : elements_) {
      if (element.count > 0 && (element.properties.empty() || element.count > bytes_.size() - position_)) {
        fail("ends before the " + std::to_string(element.count) + " of \"" + element.name +
             "\" that its header announces");
      }
    }
  }

  void readFormat(const std::string& format) {
    if (format == "ascii") {
      format_ = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      format_ = PlyFormat::littleEndian;
    } else if (format == "binary_big_endian") {
      format_ = PlyFormat::bigEndian;
    } else {
      fail("\"" + format +
           "\" is no PLY format; it must be ascii, binary_little_endian or binary_big_endian");
    }
  }

  void readProperty(const std::vector<std::string>& words) {
    Property property;
    property.name = words.back();
    if (words.size() == 5 && words[1] == "list") {
      property.isList = true;
      property.countType = typeNamed(words[2]);
      property.type = typeNamed(words[3]);
    } else if (words.size() == 3) {
      property.type = typeNamed(words[1]);
    } else {
      fail("a property of a PLY header is \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    }
    elements_.back().properties.push_back(property);
  }

  std::size_t countIn(const std::string& word) const {
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || end != word.data() + word.size())
      fail("\"" + word + "\" is no count of elements");
    return count;
  }

  template <class Value>
  double binary() {
    if (sizeof(Value) > bytes_.size() - position_) fail("ends before the elements that its header announces");
    std::array<char, sizeof(Value)> raw;
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(Value));
    position_ += sizeof(Value);
    const bool isNative =
        (format_ == PlyFormat::littleEndian) == (std::endian::native == std::endian::little);
    if (!isNative) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<Value>(raw));
  }

  double number(NumberType type) {
    if (format_ == PlyFormat::ascii) return textNumber();
    switch (type) {
      case NumberType::int8:
        return binary<int8_t>();
      case NumberType::uint8:
        return binary<uint8_t>();
      case NumberType::int16:
        return binary<int16_t>();
      case NumberType::uint16:
        return binary<uint16_t>();
      case NumberType::int32:
        return binary<int32_t>();
      case NumberType::uint32:
        return binary<uint32_t>();
      case NumberType::float32:
        return binary<float>();
      case NumberType::float64:
        break;
    }
    return binary<double>();
  }

  double textNumber() {
    position_ = std::min(bytes_.find_first_not_of(" \t\r\n", position_), bytes_.size());
    if (position_ == bytes_.size()) fail("ends before the elements that its header announces");
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", position_), bytes_.size());
    double value = 0;
    const auto [rest, error] = std::from_chars(bytes_.data() + position_, bytes_.data() + end, value);
    if (error != std::errc{} || rest != bytes_.data() + end) {
      fail("\"" + bytes_.substr(position_, std::min<std::size_t>(end - position_, 40)) + "\" is no number");
    }
    position_ = end;
    return value;
  }

  // The value of a property, or those of its list.
  const std::vector<double>& readValues(const Property& property) {
    double count = 1;
    if (property.isList) count = number(property.countType);
    if (!(count >= 0 && count <= kMostCornersOfAFace && count == std::floor(count))) {
      fail("a list has a count of " + std::to_string(count) + "; it must be a whole number up to " +
           std::to_string(kMostCornersOfAFace));
    }
    values_.resize(static_cast<std::size_t>(count));
    for (double& value : values_) value = number(property.type);
    return values_;
  }

  void readVertices(const Element& element) {
    const std::array<std::string_view, 6> names{"x", "y", "z", "nx", "ny", "nz"};
    const auto has = [&](std::string_view name) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [&](const Property& property) { return property.name == name && !property.isList; });
    };
    if (!has("x") || !has("y") || !has("z")) fail("its vertices need the properties x, y and z");
    const bool hasNormals = has("nx") && has("ny") && has("nz");
    for (std::size_t i = 0; i < element.count; ++i) {
      std::array<float, 6> vertex{};
      for (const Property& property : element.properties) {
        const std::vector<double>& values = readValues(property);
        const auto name = std::find(names.begin(), names.end(), property.name);
        if (name != names.end() && !property.isList) {
          vertex[static_cast<std::size_t>(name - names.begin())] = static_cast<float>(values[0]);
        }
      }
      mesh_.positions.emplace_back(vertex[0], vertex[1], vertex[2]);
      if (hasNormals) mesh_.normals.emplace_back(vertex[3], vertex[4], vertex[5]);
    }
  }

  void readFaces(const Element& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        const std::vector<double>& values = readValues(property);
        const bool isCorners =
            property.isList && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (isCorners) addFace(values, i);
      }
    }
  }

  void addFace(const std::vector<double>& corners, std::size_t face) {
    for (const double corner : corners) {
      if (!(corner >= 0 && corner <= std::numeric_limits<uint32_t>::max())) {
        fail("face " + std::to_string(face) + " refers to a vertex that is none");
      }
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      mesh_.triangles.emplace_back(static_cast<uint32_t>(corners[0]), static_cast<uint32_t>(corners[k - 1]),
                                   static_cast<uint32_t>(corners[k]));
    }
  }

  const std::string& bytes_;
  const std::string& source_;
  PlyFormat format_ = PlyFormat::ascii;
  std::vector<Element> elements_;
  std::size_t position_ = 0;
  std::vector<double> values_;  // of the property read last
  Mesh mesh_;
};

}  // namespace

Mesh readPly(const std::string& bytes, const std::string& source, Faces faces) {
  Mesh mesh = PlyReader(bytes, source).read();
  finishMesh(mesh, source, faces);
  return mesh;
}

}  // namespace nephroid
