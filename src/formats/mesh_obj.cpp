#include <tiny_obj_loader.h>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "formats/mesh_formats.h"
#include "geometry/mesh_checks.h"

namespace nephroid {
namespace {

std::string_view nextToken(std::string_view& rest) {
  const std::size_t begin = std::min(rest.find_first_not_of(" \t\r"), rest.size());
  const std::size_t end = std::min(rest.find_first_of(" \t\r", begin), rest.size());
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

[[noreturn]] void failAtLine(const std::string& source, std::size_t line, const std::string& what) {
  throw InputError(source + ":" + std::to_string(line) + ": " + what);
}

// tinyobjloader takes what is not a number for 0.
void requireNumbers(std::string_view rest, int count, const std::string& source, std::size_t line) {
  for (int i = 0; i < count; ++i) {
    std::string_view token = nextToken(rest);
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (token.empty() || error != std::errc{} || end != token.data() + token.size() ||
        !std::isfinite(value)) {
      failAtLine(source, line, "needs " + std::to_string(count) + " finite numbers");
    }
  }
}

struct ObjText {
  std::string geometry;                // the lines of vertices, normals, texture coordinates and faces
  std::vector<std::size_t> faceLines;  // line number of every face
};

// Only what we use goes on to tinyobjloader, and it has been looked at: other statements of the format carry
// sizes that it believes.
ObjText geometryOf(const std::string& bytes, const std::string& source) {
  ObjText text;
  text.geometry.reserve(bytes.size());
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < bytes.size(); ++number) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line(bytes.data() + begin, end - begin);
    begin = end + 1;
    std::string_view rest = line;
    const std::string_view keyword = nextToken(rest);
    if (keyword == "v" || keyword == "vn") {
      requireNumbers(rest, 3, source, number + 1);
    } else if (keyword == "vt") {
      requireNumbers(rest, 1, source, number + 1);
    } else if (keyword == "f") {
      std::string_view corners = rest;
      if (nextToken(corners).empty()) failAtLine(source, number + 1, "a face without vertices");
      text.faceLines.push_back(number + 1);
    } else {
      continue;
    }
    if (line.find('\0') != line.npos) failAtLine(source, number + 1, "not a text file");
    text.geometry.append(line).push_back('\n');
  }
  return text;
}

struct ObjReader {
  const std::string& source;
  const std::vector<std::size_t>& faceLines;
  std::vector<vec3> positions, normals;
  std::size_t face = 0;
  bool everyCornerHasNormal = true;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> vertices;  // (position, normal) to vertex of the mesh
  Mesh mesh;

  [[noreturn]] void fail(const std::string& what) const {
    failAtLine(source, face < faceLines.size() ? faceLines[face] : 0, what);
  }

  // From 1, or backwards from -1 for the last one so far; 0 where the file gives none.
  uint32_t resolve(int index, std::size_t count, const char* what) const {
    const int64_t i = index > 0 ? int64_t{index} - 1 : static_cast<int64_t>(count) + index;
    if (index == 0 || i < 0 || i >= static_cast<int64_t>(count)) {
      fail("the face refers to " + std::string(what) + " " + std::to_string(index) + "; there are " +
           std::to_string(count) + " before it, counted from 1");
    }
    return static_cast<uint32_t>(i);
  }

  uint32_t vertexOf(const tinyobj::index_t& corner) {
    const uint32_t position = resolve(corner.vertex_index, positions.size(), "vertex");
    uint32_t normal = kNone;
    if (corner.normal_index != 0) {
      normal = resolve(corner.normal_index, normals.size(), "normal");
    } else {
      everyCornerHasNormal = false;
    }
    const auto [entry, isNew] =
        vertices.try_emplace({position, normal}, static_cast<uint32_t>(mesh.positions.size()));
    if (isNew) {
      mesh.positions.push_back(positions[position]);
      mesh.normals.push_back(normal == kNone ? vec3(0) : normals[normal]);
    }
    return entry->second;
  }

  void addFace(const tinyobj::index_t* corners, int count) {
    if (count < 3) fail("a face of " + std::to_string(count) + " vertices; it needs 3 or more");
    const uint32_t first = vertexOf(corners[0]);
    uint32_t previous = vertexOf(corners[1]);
    for (int i = 2; i < count; ++i) {
      const uint32_t next = vertexOf(corners[i]);
      mesh.triangles.emplace_back(first, previous, next);
      previous = next;
    }
    ++face;
  }
};

tinyobj::callback_t callbacks() {
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* reader, float x, float y, float z, float) {
    static_cast<ObjReader*>(reader)->positions.emplace_back(x, y, z);
  };
  callback.normal_cb = [](void* reader, float x, float y, float z) {
    static_cast<ObjReader*>(reader)->normals.emplace_back(x, y, z);
  };
  callback.index_cb = [](void* reader, tinyobj::index_t* corners, int count) {
    static_cast<ObjReader*>(reader)->addFace(corners, count);
  };
  return callback;
}

}  // namespace

Mesh readObj(const std::string& bytes, const std::string& source, Faces faces) {
  const ObjText text = geometryOf(bytes, source);
  if (text.faceLines.empty())
    throw InputError(source + ": has no faces; an OBJ file needs lines \"v x y z\" and \"f i j k\"");
  ObjReader reader{source, text.faceLines, {}, {}, 0, true, {}, {}};
  std::istringstream stream(text.geometry);
  std::string warning, error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &reader, nullptr, &warning, &error)) {
    throw InputError(source + ": " + error);
  }
  if (!reader.everyCornerHasNormal) reader.mesh.normals.clear();
  finishMesh(reader.mesh, source, faces);
  return std::move(reader.mesh);
}

}  // namespace nephroid
