// Whatever bytes a scene or mesh file holds, loading it ends in a scene or in an InputError.
#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include "formats/load.h"
#include "formats/mesh_file.h"
#include "support/scratch_files.h"

namespace nephroid {
namespace {

constexpr int kMutations = 400;

const std::string kObj =
    "# tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\no a\ng b c\nusemtl d\n"
    "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf -4 -1 -2\nf 2 3 4\n";

const std::string kPlyHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n";

const std::string kAsciiPly = "ply\nformat ascii 1.0\ncomment c\n" + kPlyHeader +
                              "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

template <class Value>
void put(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

std::string binaryPly() {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + kPlyHeader;
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(bytes, value);
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    put(bytes, uint8_t{3});
    for (const int32_t index : face) put(bytes, index);
  }
  return bytes;
}

const std::string kGltfJson =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[1,2],"scale":[1,2,1]},)"
    R"({"camera":0,"translation":[0,0,5]},{"extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[0,0,0,1]}],)"
    R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],)"
    R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":3,"spot":{"outerConeAngle":0.3}}]}},)"
    R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,1,1,1]},)"
    R"("extensions":{"KHR_materials_ior":{"ior":1.5}}}],"textures":[{"source":0}],"images":[{"bufferView":2,"mimeType":"image/png"}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":72}],)"
    R"("buffers":[{"byteLength":132)";

std::string binaryPart() {
  std::string bytes;
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(bytes, value);
  for (const int index : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) put(bytes, static_cast<uint8_t>(index));
  const unsigned char png[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    0x0d, 0x49, 0x48, 0x44, 0x52, 0, 0,
      0,    1,    0,    0,    0,    1,    8,    6,    0,    0,    0,    0x1f, 0x15, 0xc4, 0x89, 0,    0, 0,
      0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0xf8, 0xcf, 0xf0, 0x1f, 0,    5,    0x82, 2, 0x7f,
      0xe7, 0x2f, 0x21, 0x80, 0,    0,    0,    0,    0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82, 0, 0};
  bytes.append(reinterpret_cast<const char*>(png), 72);
  return bytes;
}

std::string glb() {
  std::string json = kGltfJson + "}]}";
  while (json.size() % 4 != 0) json += ' ';
  const std::string binary = binaryPart();
  std::string bytes = "glTF";
  put(bytes, uint32_t{2});
  put(bytes, static_cast<uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  put(bytes, static_cast<uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

// Vertices and faces of one object, in the chunks of the format.
std::string chunk3ds(uint16_t id, const std::string& body) {
  std::string bytes;
  put(bytes, id);
  put(bytes, static_cast<uint32_t>(6 + body.size()));
  return bytes + body;
}

std::string file3ds() {
  std::string vertices, faces;
  put(vertices, uint16_t{4});
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(vertices, value);
  put(faces, uint16_t{4});
  for (const int index : {0, 2, 1, 7, 0, 1, 3, 7, 0, 3, 2, 7, 1, 2, 3, 7})
    put(faces, static_cast<uint16_t>(index));
  const std::string mesh = chunk3ds(0x4100, chunk3ds(0x4110, vertices) + chunk3ds(0x4120, faces));
  return chunk3ds(0x4d4d, chunk3ds(0x3d3d, chunk3ds(0x4000, std::string("t\0", 2) + mesh)));
}

const std::string kToml = R"([camera]
position = [0, 1.5, 3]
target = [0, 0.4, 0]
[environment]
ambient = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = [1.5, 1.51, 1.52]
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
segments = 8
[[object]]
material = "glass"
shape = "water"
grid = [4, 4]
waves = [{amplitude = 0.1, wavelength = 1, direction = [1, 0], speed = 0.25}]
[[light]]
type = "spot"
position = [2, 4, 1]
direction = [0, -1, 0]
intensity = [100, 1, 2]
[medium]
extinction = 0.05
phase = "nishita"
[[sensor]]
name = "floor"
corner = [-2, 0, -2]
u = [4, 0, 0]
v = [0, 0, 4]
resolution = [8, 8]
)";

// Bytes changed, cut out, doubled, the end cut off, and numbers replaced by worse ones.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n ? random() % n : 0; };
  static const std::vector<std::string> kWorse{
      "-1", "0", "4294967295", "99999999999999999999", "1e999", "nan", "inf", "-0.0", "2147483647", "\"", "[",
      "{",  "}", "\n",         std::string(1, '\0'),   "\xff"};
  for (std::size_t times = 1 + below(4); times > 0; --times) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, 1 + below(16));
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(32)));
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes.insert(at, kWorse[below(kWorse.size())]);
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        const std::size_t end = bytes.find_first_not_of("0123456789.", digit);
        bytes.replace(digit, std::min(end, bytes.size()) - digit, kWorse[below(kWorse.size())]);
      }
    }
  }
  return bytes;
}

struct FileCase {
  const char* name;
  std::string bytes;
};

class Robustness : public ScratchFiles, public testing::WithParamInterface<FileCase> {};

TEST_P(Robustness, EndsInASceneOrAnInputError) {
  const std::string name = GetParam().name;
  const std::string& good = GetParam().bytes;
  const auto load = [&](const std::string& bytes) {
    const auto path = write(name, bytes);
    const std::string extension = path.extension().string();
    if (extension == ".toml" || extension == ".gltf" || extension == ".glb") {
      loadScene(path);
    } else {
      loadMeshFile(path);
    }
  };
  ASSERT_NO_THROW(load(good));
  std::mt19937 random(20240607);
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string bytes =
        i < 100 ? good.substr(0, good.size() * static_cast<std::size_t>(i) / 100) : mutated(good, random);
    try {
      load(bytes);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      write("failing-" + name, bytes);
      FAIL() << "mutation " << i << ": " << error.what();
    }
  }
  EXPECT_GT(refused, kMutations / 5);
}

INSTANTIATE_TEST_SUITE_P(Files, Robustness,
                         testing::Values(FileCase{"t.toml", kToml}, FileCase{"t.obj", kObj},
                                         FileCase{"a.ply", kAsciiPly}, FileCase{"b.ply", binaryPly()},
                                         FileCase{"t.3ds", file3ds()}, FileCase{"t.glb", glb()}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace nephroid
