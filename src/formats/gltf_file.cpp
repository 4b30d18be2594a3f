#include "formats/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "formats/mesh_file.h"

namespace nephroid {
namespace {

constexpr std::uintmax_t kLargestGltfFile = (std::uintmax_t{1} << 32) - 1;  // a GLB's own limit
constexpr int kDeepestNesting = 200;
constexpr std::size_t kMostElements = std::size_t{1} << 27;

// The parser goes into itself for every level.
void requireShallow(std::string_view json, const std::string& source) {
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inText) {
      if (c == '\\') ++i;
      if (c == '"') inText = false;
    } else if (c == '"') {
      inText = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepestNesting) throw InputError(source + ": nested deeper than 200 levels");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// The first chunk of a GLB.
std::string_view jsonOf(std::string_view bytes) {
  std::size_t length = 0;
  for (std::size_t i = 16; bytes.size() > 20 && i-- > 12;)
    length = length << 8 | static_cast<unsigned char>(bytes[i]);
  return bytes.size() > 20 ? bytes.substr(20, length) : std::string_view();
}

bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
  try {
    const std::string bytes = readFile(path, kLargestGltfFile);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const InputError& wrong) {
    if (error) *error += wrong.what();
    return false;
  }
}

// Images are decoded when a material asks for them; what is in a buffer has not been checked at this point.
bool keepImage(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
               const unsigned char* bytes, int size, void* user) {
  auto& images = *static_cast<std::vector<std::vector<unsigned char>>*>(user);
  if (image->bufferView >= 0 || index < 0 || size <= 0) return true;
  if (images.size() <= static_cast<std::size_t>(index)) images.resize(static_cast<std::size_t>(index) + 1);
  images[static_cast<std::size_t>(index)].assign(bytes, bytes + size);
  return true;
}

// Later versions of tinygltf have one more callback.
template <class Callbacks>
Callbacks fileCallbacks() {
  Callbacks callbacks{};
  callbacks.FileExists = [](const std::string& path, void*) {
    return std::filesystem::is_regular_file(path);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = readWholeFile;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path, void*) {
      std::error_code error;
      *size = static_cast<std::size_t>(std::filesystem::file_size(path, error));
      return !error;
    };
  }
  return callbacks;
}

// Extensions without which we still read a file right: those we know, and those that only change the looks.
void requireKnownExtensions(const GltfFile& file) {
  static const std::array kKnown{
      "KHR_lights_punctual",       "KHR_materials_transmission", "KHR_materials_ior",
      "KHR_materials_volume",      "KHR_materials_dispersion",   "KHR_materials_emissive_strength",
      "KHR_mesh_quantization",     "KHR_texture_transform",      "KHR_materials_unlit",
      "KHR_materials_clearcoat",   "KHR_materials_sheen",        "KHR_materials_specular",
      "KHR_materials_iridescence", "KHR_materials_anisotropy",   "KHR_materials_variants",
      "KHR_node_visibility"};
  for (const std::string& extension : file.model.extensionsRequired) {
    if (std::find(kKnown.begin(), kKnown.end(), extension) == kKnown.end()) {
      file.fail("requires the extension \"" + extension +
                "\", which is not supported; convert the file without it");
    }
  }
}

struct Bytes {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};

Bytes bufferView(const GltfFile& file, int index) {
  const auto& model = file.model;
  const auto& view = model.bufferViews[gltfIndex(file, index, model.bufferViews.size(), "buffer view")];
  const auto& buffer = model.buffers[gltfIndex(file, view.buffer, model.buffers.size(), "buffer")];
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset) {
    file.fail("buffer view " + std::to_string(index) + " reaches past the end of its buffer of " +
              std::to_string(buffer.data.size()) + " bytes");
  }
  return {buffer.data.data() + view.byteOffset, view.byteLength};
}

template <class Component>
double component(const unsigned char* bytes, bool isNormalized) {
  Component value;
  std::memcpy(&value, bytes, sizeof value);
  if constexpr (std::is_integral_v<Component>) {
    const double largest = std::numeric_limits<Component>::max();
    if (isNormalized) return std::max(static_cast<double>(value) / largest, -1.0);
  }
  return static_cast<double>(value);
}

using ReadComponent = double (*)(const unsigned char*, bool);

ReadComponent readerOf(const GltfFile& file, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return component<int8_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return component<uint8_t>;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return component<int16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return component<uint16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return component<uint32_t>;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return component<float>;
    default:
      file.fail("an accessor has the component type " + std::to_string(type) + ", which does not exist");
  }
}

// `count` elements of `elementSize` bytes every `stride` bytes from `offset` fit into the view.
void requireFits(const GltfFile& file, const Bytes& view, std::size_t offset, std::size_t elementSize,
                 std::size_t stride, std::size_t count, const std::string& name) {
  const bool fits = offset <= view.size && elementSize <= view.size - offset &&
                    (count - 1) <= (view.size - offset - elementSize) / stride;
  if (!fits)
    file.fail(name + " reaches past the end of its buffer view of " + std::to_string(view.size) + " bytes");
}

void readSparse(const GltfFile& file, const tinygltf::Accessor& accessor, const std::string& name,
                ReadComponent read, std::size_t componentSize, GltfNumbers& numbers) {
  if (accessor.sparse.count <= 0) return;
  const auto count = static_cast<std::size_t>(accessor.sparse.count);
  const auto& indices = accessor.sparse.indices;
  const auto& values = accessor.sparse.values;
  const ReadComponent readIndex = readerOf(file, indices.componentType);
  const auto indexSize = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(indices.componentType)));
  const std::size_t elementSize = numbers.components * componentSize;
  const Bytes indexBytes = bufferView(file, indices.bufferView),
              valueBytes = bufferView(file, values.bufferView);
  const auto indexOffset = static_cast<std::size_t>(indices.byteOffset);
  const auto valueOffset = static_cast<std::size_t>(values.byteOffset);
  requireFits(file, indexBytes, indexOffset, indexSize, indexSize, count, name + " (sparse indices)");
  requireFits(file, valueBytes, valueOffset, elementSize, elementSize, count, name + " (sparse values)");
  for (std::size_t i = 0; i < count; ++i) {
    const double index = readIndex(indexBytes.data + indexOffset + i * indexSize, false);
    if (!(index >= 0 && index < static_cast<double>(numbers.count())))
      file.fail(name + " has a sparse index out of range");
    for (std::size_t k = 0; k < numbers.components; ++k) {
      numbers.values[static_cast<std::size_t>(index) * numbers.components + k] =
          read(valueBytes.data + valueOffset + i * elementSize + k * componentSize, accessor.normalized);
    }
  }
}

double linearFromSrgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Texture linearTexture(const GltfFile& file, const tinygltf::Image& image) {
  const std::size_t depth = image.bits == 16 ? 2 : 1,
                    texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.component != 4 || image.image.size() != texels * 4 * depth)
    file.fail("an image could not be decoded");
  Texture texture;
  texture.name = image.name.empty() ? image.uri : image.name;
  texture.width = static_cast<uint32_t>(image.width);
  texture.height = static_cast<uint32_t>(image.height);
  texture.texels.resize(texels);
  for (std::size_t i = 0; i < texels; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const unsigned char* bytes = image.image.data() + (4 * i + k) * depth;
      const double value = depth == 2 ? component<uint16_t>(bytes, true) : component<uint8_t>(bytes, true);
      texture.texels[i][static_cast<int>(k)] = static_cast<float>(k < 3 ? linearFromSrgb(value) : value);
    }
  }
  return texture;
}

}  // namespace

void GltfFile::fail(const std::string& what) const {
  throw InputError(oneLine(source + ": " + what));
}

std::size_t gltfIndex(const GltfFile& file, int index, std::size_t count, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= count) {
    file.fail("refers to " + std::string(what) + " " + std::to_string(index) + "; there are " +
              std::to_string(count));
  }
  return static_cast<std::size_t>(index);
}

GltfFile openGltf(const std::filesystem::path& path) {
  const std::string bytes = readFile(path, kLargestGltfFile);
  GltfFile file;
  file.source = oneLine(path.string());
  const bool isBinary = bytes.compare(0, 4, "glTF") == 0;
  requireShallow(isBinary ? jsonOf(bytes) : bytes, file.source);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepImage, &file.images);
  loader.SetFsCallbacks(fileCallbacks<tinygltf::FsCallbacks>());
  std::string error, warning;
  bool isRead = false;
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string directory = path.parent_path().string();
  try {
    isRead = isBinary
                 ? loader.LoadBinaryFromMemory(&file.model, &error, &warning,
                                               reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                               directory)
                 : loader.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size, directory);
  } catch (const std::exception& exception) {
    file.fail("not glTF 2.0: " + std::string(exception.what()));
  }
  if (!isRead) file.fail("not glTF 2.0" + (error.empty() ? "" : ": " + error));
  if (file.model.asset.version.rfind("2.", 0) != 0) {
    file.fail("is glTF " + file.model.asset.version + "; it must be 2.0");
  }
  requireKnownExtensions(file);
  return file;
}

GltfNumbers readGltfNumbers(const GltfFile& file, int index, std::size_t fewestComponents,
                            std::size_t mostComponents) {
  const auto& accessor =
      file.model.accessors[gltfIndex(file, index, file.model.accessors.size(), "accessor")];
  const std::string name = "accessor " + std::to_string(index);
  const ReadComponent read = readerOf(file, accessor.componentType);
  const auto componentSize = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
  GltfNumbers numbers;
  numbers.components = static_cast<std::size_t>(
      std::max(0, tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type))));
  if (numbers.components < fewestComponents || numbers.components > mostComponents) {
    file.fail(name + " has " + std::to_string(numbers.components) + " components; what uses it needs " +
              std::to_string(fewestComponents));
  }
  if (accessor.count == 0) file.fail(name + " is empty");
  if (accessor.count > kMostElements)
    file.fail(name + " has " + std::to_string(accessor.count) + " elements; at most 2^27 are read");
  if (accessor.bufferView < 0) {
    numbers.values.resize(accessor.count * numbers.components);
  } else {
    const Bytes view = bufferView(file, accessor.bufferView);
    const std::size_t given =
        file.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::size_t elementSize = numbers.components * componentSize, stride = given ? given : elementSize;
    requireFits(file, view, accessor.byteOffset, elementSize, stride, accessor.count, name);
    numbers.values.resize(accessor.count * numbers.components);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      for (std::size_t k = 0; k < numbers.components; ++k) {
        numbers.values[i * numbers.components + k] =
            read(view.data + accessor.byteOffset + i * stride + k * componentSize, accessor.normalized);
      }
    }
  }
  if (accessor.sparse.isSparse) readSparse(file, accessor, name, read, componentSize, numbers);
  return numbers;
}

std::vector<uint32_t> readGltfIndices(const GltfFile& file, int index) {
  const auto& accessor =
      file.model.accessors[gltfIndex(file, index, file.model.accessors.size(), "accessor")];
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) file.fail("indices must be whole numbers");
  const GltfNumbers numbers = readGltfNumbers(file, index, 1, 1);
  std::vector<uint32_t> indices;
  indices.reserve(numbers.values.size());
  for (const double value : numbers.values) {
    if (!(value >= 0)) file.fail("an index is negative");
    indices.push_back(static_cast<uint32_t>(value));
  }
  return indices;
}

Texture readGltfImage(const GltfFile& file, int index) {
  tinygltf::Image image = file.model.images[gltfIndex(file, index, file.model.images.size(), "image")];
  Bytes bytes;
  if (image.bufferView >= 0) {
    bytes = bufferView(file, image.bufferView);
  } else if (static_cast<std::size_t>(index) < file.images.size()) {
    bytes = {file.images[static_cast<std::size_t>(index)].data(),
             file.images[static_cast<std::size_t>(index)].size()};
  }
  const std::string name =
      "image " + std::to_string(index) + (image.uri.empty() ? "" : " (" + image.uri + ")");
  if (bytes.size == 0) file.fail(name + " is not there");
  if (bytes.size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    file.fail(name + " is too large");
  std::string error, warning;
  if (!tinygltf::LoadImageData(&image, index, &error, &warning, 0, 0, bytes.data,
                               static_cast<int>(bytes.size), nullptr)) {
    file.fail(name + " could not be decoded; it must be PNG or JPEG");
  }
  return linearTexture(file, image);
}

}  // namespace nephroid
