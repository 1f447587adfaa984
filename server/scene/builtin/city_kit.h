// The meshes that the city places again and again.
#pragma once

#include <array>

#include "scene/builtin/builtin.h"
#include "scene/builtin/city_buildings.h"

namespace sundial::builtin {

struct TenementMesh {
  std::uint32_t row, corner;  // meshes: between neighbours, and beside a street
  double height;              // of its walls
  bool isFlat;
};

struct CityKit {
  std::uint32_t paint;                     // the material that shows vertex colours
  std::array<TenementMesh, 11> tenements;  // by rising height
  std::array<std::uint32_t, 3> towers;
  std::array<std::uint32_t, 4> trees, vehicles;
  std::array<std::uint32_t, 4> roofs;  // what stands on flat ones
  std::uint32_t antennas, hall, lamp, trafficLight, bench, bollards, shelter, planter, wire;
};

constexpr double kWireSpan = 36;

CityKit addCityKit(SceneBuilder&, Random&);
std::uint32_t addPainted(SceneBuilder&, std::string name, Shape, std::uint32_t paint);

}  // namespace sundial::builtin
