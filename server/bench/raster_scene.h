// A built-in scene in which store passes of several methods are timed, or their maps compared.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shadow/frame.h"

namespace sundial::bench {

class RasterScene {
 public:
  // View and light by name; empty: the scene's first. Throws std::runtime_error for names that aren't there.
  RasterScene(const Device&, FramePipelines&, const std::string& scene, const std::string& view,
              const std::string& light);

  std::unique_ptr<Frame> frame(std::string_view text, MakeStore* make = makeStore) const;
  const Scene& scene() const { return *scene_; }

 private:
  const Device& device_;
  FramePipelines& pipelines_;
  std::shared_ptr<const Scene> scene_;
  ViewTarget target_;
  SceneBuffers buffers_;
  View view_;
  Light light_;
};

// Wall-clock milliseconds around the store pass of each frame, run by run in turn; all frames ran once
// before.
std::vector<std::vector<double>> storeTimes(const Device&, const std::vector<Frame*>&, int runs);
double median(std::vector<double>);
// Of pairs from the same run.
double ratio(const std::vector<double>& of, const std::vector<double>& to);

// What a map drawn by compute has against the pipeline's.
struct Differences {
  std::size_t covered = 0, missing = 0, added = 0;  // texels
  std::size_t far = 0;                              // deeper or higher by more than 1e-4
  // At the near plane by the pipeline alone: it divides by the area of a triangle that has none in floats,
  // and what is no number counts as the nearest. Not in `far`.
  std::size_t byZero = 0;
};
// Of a frame that keeps its maps in an image and one that keeps them in a buffer; both have run.
Differences differences(const Frame& image, const Frame& linear);

}  // namespace sundial::bench
