#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/image_io.h"

namespace nephroid {
namespace {

constexpr uint64_t kMaximumPixels = uint64_t{1} << 28;

struct AttributeWriter {
  Imf::Header& header;
  const std::string& name;
  void operator()(const std::string& value) const { header.insert(name, Imf::StringAttribute(value)); }
  void operator()(float value) const { header.insert(name, Imf::FloatAttribute(value)); }
  void operator()(int value) const { header.insert(name, Imf::IntAttribute(value)); }
};

Imf::Slice floatSlice(const float* values, const Image& image, int originX = 0, int originY = 0) {
  return Imf::Slice::Make(Imf::FLOAT, values, Imath::V2i(originX, originY), image.width, image.height);
}

InputError unreadable(const std::filesystem::path& path, const Iex::BaseExc& error) {
  std::string reason = error.what();
  for (char& c : reason)
    if (c == '\n') c = ' ';
  return InputError("cannot read '" + path.string() + "' as OpenEXR: " + reason);
}

}  // namespace

void writeExr(const std::filesystem::path& path, const Image& image,
              const std::vector<ImageAttribute>& attributes) {
  AtomicFile file(path);
  try {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const ImageAttribute& attribute : attributes)
      std::visit(AttributeWriter{header, attribute.name}, attribute.value);
    Imf::FrameBuffer pixels;
    for (const ImageChannel& channel : image.channels) {
      header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
      pixels.insert(channel.name, floatSlice(channel.values.data(), image));
    }
    Imf::OutputFile output(file.temporary().c_str(), header);
    output.setFrameBuffer(pixels);
    output.writePixels(static_cast<int>(image.height));
  } catch (const Iex::BaseExc& error) {
    throw RuntimeFailure("cannot write '" + path.string() + "': " + error.what());
  }
  file.commit();
}

Image readExr(const std::filesystem::path& path) {
  try {
    Imf::InputFile input(path.c_str());
    const Imath::Box2i window = input.header().dataWindow();
    const uint64_t width = uint64_t(int64_t{window.max.x} - window.min.x + 1);
    const uint64_t height = uint64_t(int64_t{window.max.y} - window.min.y + 1);
    if (width > kMaximumPixels || height > kMaximumPixels / width)
      throw InputError("'" + path.string() + "' says it is " + std::to_string(width) + " x " +
                       std::to_string(height) + "; at most 2^28 pixels are read");
    Image image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    const Imf::ChannelList& channels = input.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) image.channel(channel.name());
    Imf::FrameBuffer pixels;
    for (const ImageChannel& channel : image.channels)
      pixels.insert(channel.name, floatSlice(channel.values.data(), image, window.min.x, window.min.y));
    input.setFrameBuffer(pixels);
    input.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const Iex::BaseExc& error) {
    throw unreadable(path, error);
  }
}

std::vector<ImageAttribute> readExrAttributes(const std::filesystem::path& path) {
  std::vector<ImageAttribute> attributes;
  if (!std::filesystem::exists(path)) return attributes;
  try {
    const Imf::InputFile input(path.c_str());
    const Imf::Header& header = input.header();
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
      const Imf::Attribute& attribute = entry.attribute();
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
        attributes.push_back({entry.name(), text->value()});
      else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
        attributes.push_back({entry.name(), number->value()});
      else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute))
        attributes.push_back({entry.name(), whole->value()});
    }
  } catch (const Iex::BaseExc& error) {
    throw unreadable(path, error);
  }
  return attributes;
}

}  // namespace nephroid
