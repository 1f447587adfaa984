#include "shadow/raster_choice.h"

#include "shadow/plan_settings.h"

namespace sundial {

namespace {

bool fitsBuffer(const Method& method, const Device& device) {
  return texelsOf(mapSizesOf(method)) * linearBytesPerTexel(*method.stages) <=
         device.limits().maxStorageBufferRange;
}

// Up to how many texels of all maps to a triangle of the scene the compute rasteriser is the faster one on a
// CPU driver: triangles cost the pipeline more, and texels less. Maps of what the camera sees leave triangles
// out and show the others larger. `sundial-bench-raster ratios` prints what this rests on.
double mostTexelsToATriangle(Volume volume) {
  switch (volume) {
    case Volume::scene:
      return 20;
    case Volume::frustum:
      return 8;
    case Volume::samples:
    case Volume::inscribed:
      return 4.1;
  }
  return 0;
}

}  // namespace

Method withRaster(Method method, const Device& device, std::uint64_t triangles) {
  if (!method.stages || method.settings.raster != Raster::automatic) return method;
  if (method.stages->storage == Storage::linear || keepsIds(method.stages->storage) ||
      method.stages->warp != Warp::none) {
    method.settings.raster = Raster::compute;
  } else if (method.stages->storage == Storage::moments || !device.isCpu() || !fitsBuffer(method, device)) {
    method.settings.raster = Raster::pipeline;
  } else {
    const double texels = static_cast<double>(texelsOf(mapSizesOf(method)));
    const bool few = texels <= mostTexelsToATriangle(method.stages->volume) * static_cast<double>(triangles);
    method.settings.raster = few ? Raster::compute : Raster::pipeline;
  }
  return method;
}

std::uint64_t linearBytesPerTexel(const Stages& stages) { return keepsIds(stages.storage) ? 8 : 4; }

bool isLinear(const Method& method) { return method.stages && method.settings.raster == Raster::compute; }

}  // namespace sundial
