#include "shadow/raster_choice.h"

#include "shadow/plan_settings.h"

namespace sundial {

namespace {

bool fitsBuffer(const Method& method, const Device& device) {
  return texelsOf(mapSizesOf(method)) * linearBytesPerTexel(*method.stages) <=
         device.limits().maxStorageBufferRange;
}

}  // namespace

Method withRaster(Method method, const Device& device, std::uint64_t triangles) {
  if (!method.stages || method.settings.raster != Raster::automatic) return method;
  if (method.stages->storage == Storage::linear || keepsIds(method.stages->storage)) {
    method.settings.raster = Raster::compute;
  } else if (method.stages->storage == Storage::moments || !fitsBuffer(method, device)) {
    method.settings.raster = Raster::pipeline;
  } else {
    method.settings.raster = triangles == 0 ? Raster::compute : Raster::pipeline;
  }
  return method;
}

std::uint64_t linearBytesPerTexel(const Stages& stages) { return keepsIds(stages.storage) ? 8 : 4; }

bool isLinear(const Method& method) { return method.stages && method.settings.raster == Raster::compute; }

}  // namespace sundial
