#include "sweep/pictures.h"

#include <algorithm>

#include "image/encode.h"
#include "image/overlay.h"
#include "page/plan_picture.h"

namespace sundial::sweep {
namespace {

namespace fs = std::filesystem;
constexpr unsigned kMostPixels = 512;  // wide
constexpr std::size_t kMostBytes = 25'000;
constexpr unsigned kPlanCells = 180;

bool isGrey(const std::uint8_t* pixel) { return pixel[0] == pixel[1] && pixel[1] == pixel[2]; }

// Each pixel the mean of a block of `picture`, an RGB one. With `keepMarks` a block with any colour in it is
// the mean of what has colour: a single wrong pixel stays one.
image::Picture shrunk(const image::Picture& picture, bool keepMarks) {
  const unsigned block = (picture.width + kMostPixels - 1) / kMostPixels;
  if (block <= 1) return picture;
  image::Picture small{std::max(picture.width / block, 1u), std::max(picture.height / block, 1u), 3, {}};
  for (unsigned y = 0; y < small.height; ++y)
    for (unsigned x = 0; x < small.width; ++x) {
      unsigned sum[2][3] = {}, count[2] = {};  // grey, coloured
      for (unsigned dy = 0; dy < block && y * block + dy < picture.height; ++dy)
        for (unsigned dx = 0; dx < block; ++dx) {
          const std::size_t at = std::size_t{y * block + dy} * picture.width + x * block + dx;
          const std::uint8_t* pixel = &picture.pixels[3 * at];
          const bool marked = keepMarks && !isGrey(pixel);
          for (int c = 0; c < 3; ++c) sum[marked][c] += pixel[c];
          ++count[marked];
        }
      const bool marked = count[1] > 0;
      for (const unsigned channel : sum[marked])
        small.pixels.push_back(static_cast<std::uint8_t>(channel / count[marked]));
    }
  return small;
}

std::string encodeSmall(const image::Picture& picture) {
  std::string bytes;
  for (const int quality : {85, 70, 55, 40}) {
    bytes = image::encodeJpeg(picture, quality);
    if (bytes.size() <= kMostBytes) break;
  }
  return bytes;
}

}  // namespace

std::vector<image::OutputFile> makePictures(const Case& one, const client::Rendering& rendering,
                                            const fs::path& folder) {
  const client::MethodRendering& method = rendering.methods.front();
  const client::Image& colour = *method.find(v1::COLOUR);
  const image::Picture error =
      image::errorOverlay(colour, *method.find(v1::VISIBILITY), *method.find(v1::REFERENCE));
  return {{folder / (one.id + ".jpg"), encodeSmall(shrunk(image::toPicture(colour), false))},
          {folder / (one.id + "-error.jpg"), encodeSmall(shrunk(error, true))},
          {folder / (one.id + "-plan.svg"),
           page::planPicture(method, rendering.accepted.view(), rendering.accepted.light(), kPlanCells)}};
}

v1::SweepImages pictureNames(const std::vector<image::OutputFile>& pictures, const fs::path& results) {
  const auto seen = [&](const fs::path& path) {
    return fs::absolute(path).lexically_normal().lexically_relative(
        fs::absolute(results).lexically_normal().parent_path());
  };
  v1::SweepImages names;
  names.set_picture(seen(pictures[0].path).generic_string());
  names.set_error(seen(pictures[1].path).generic_string());
  names.set_plan(seen(pictures[2].path).generic_string());
  return names;
}

}  // namespace sundial::sweep
