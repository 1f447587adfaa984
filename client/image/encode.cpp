#include "image/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>

namespace sundial::image {
namespace {

// `name` chooses the format by its extension. `format` unknown: the pixels are as the spec's channels say.
std::string encode(const char* name, const OIIO::ImageSpec& spec, OIIO::TypeDesc format, const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput sink(bytes);
  const auto check = [&](bool good, const std::string& why) {
    if (!good) throw std::runtime_error(fmt::format("can't encode {}: {}", name + 2, why));
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name, &sink);
  check(output != nullptr, OIIO::geterror());
  check(output->open(name, spec) && output->write_image(format, pixels) && output->close(),
        output->geterror());
  return {bytes.begin(), bytes.end()};
}

float linearFromSrgb(std::uint8_t value) {
  const float s = static_cast<float>(value) / 255;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

// The names and type of an image's channels in an OpenEXR file.
struct Layer {
  std::span<const char* const> names;
  OIIO::TypeDesc type;
};

Layer layerOf(v1::Aov aov) {
  static constexpr std::array kColour{"R", "G", "B", "A"};
  static constexpr std::array kVisibility{"visibility.V"};
  static constexpr std::array kReference{"reference.V"};
  static constexpr std::array kPosition{"position.X", "position.Y", "position.Z"};
  static constexpr std::array kNormal{"normal.X", "normal.Y", "normal.Z"};
  static constexpr std::array kId{"id.instance", "id.triangle"};
  static constexpr std::array kView{"view.I"};
  static constexpr std::array kClass{"class.I"};
  switch (aov) {
    case v1::COLOUR:
      return {kColour, OIIO::TypeFloat};
    case v1::VISIBILITY:
      return {kVisibility, OIIO::TypeFloat};
    case v1::REFERENCE:
      return {kReference, OIIO::TypeFloat};
    case v1::POSITION:
      return {kPosition, OIIO::TypeFloat};
    case v1::NORMAL:
      return {kNormal, OIIO::TypeFloat};
    case v1::ID:
      return {kId, OIIO::TypeUInt32};
    case v1::VIEW:
      return {kView, OIIO::TypeUInt32};
    case v1::CLASS:
      return {kClass, OIIO::TypeUInt32};
    default:
      return {{}, OIIO::TypeUnknown};
  }
}

// The colour's bytes become floats; the others are 32 bits wide already.
std::string channelBytes(const client::Image& image) {
  if (image.aov != v1::COLOUR) return image.bytes;
  std::vector<float> linear(image.bytes.size());
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const auto byte = static_cast<std::uint8_t>(image.bytes[i]);
    linear[i] = i % 4 == 3 ? static_cast<float>(byte) / 255 : linearFromSrgb(byte);
  }
  std::string bytes(linear.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), linear.data(), bytes.size());
  return bytes;
}

OIIO::ImageSpec specOf(const Picture& picture) {
  OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height),
                       static_cast<int>(picture.channels), OIIO::TypeUInt8);
  if (picture.channels == 4) spec["oiio:UnassociatedAlpha"] = 1;
  return spec;
}

}  // namespace

std::optional<FileType> fileType(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".png") return FileType::png;
  if (extension == ".jpg" || extension == ".jpeg") return FileType::jpg;
  if (extension == ".exr") return FileType::exr;
  return std::nullopt;
}

std::string encodePng(const Picture& picture) {
  return encode("x.png", specOf(picture), OIIO::TypeUInt8, picture.pixels.data());
}

std::string encodeJpeg(const Picture& picture, int quality) {
  OIIO::ImageSpec spec = specOf(picture);
  spec["Compression"] = fmt::format("jpeg:{}", quality);
  spec["jpeg:subsampling"] = "4:4:4";
  return encode("x.jpg", spec, OIIO::TypeUInt8, picture.pixels.data());
}

std::string encodeExr(const client::MethodRendering& rendering) {
  constexpr std::size_t kChannelBytes = 4;
  OIIO::ImageSpec spec(OIIO::TypeFloat);
  std::vector<std::string> layers;
  for (const client::Image& image : rendering.images) {
    const Layer layer = layerOf(image.aov);
    spec.width = spec.full_width = static_cast<int>(image.width);
    spec.height = spec.full_height = static_cast<int>(image.height);
    spec.channelnames.insert(spec.channelnames.end(), layer.names.begin(), layer.names.end());
    spec.channelformats.insert(spec.channelformats.end(), layer.names.size(), layer.type);
    layers.push_back(channelBytes(image));
  }
  spec.nchannels = static_cast<int>(spec.channelnames.size());
  spec.alpha_channel = 3;
  spec["compression"] = "zip";
  spec["DateTime"] = "1970:01:01 00:00:00";  // or the library writes the time of day

  // Pixel by pixel, the layers in turn.
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::string interleaved;
  interleaved.reserve(pixels * static_cast<std::size_t>(spec.nchannels) * kChannelBytes);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (const std::string& layer : layers) {
      const std::size_t stride = layer.size() / pixels;
      interleaved.append(layer, pixel * stride, stride);
    }
  return encode("x.exr", spec, OIIO::TypeUnknown, interleaved.data());
}

}  // namespace sundial::image
