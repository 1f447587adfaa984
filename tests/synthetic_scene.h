// Discs floating above a plane in the sun, in closed form: pictures, plans and numbers that look like a
// renderer's, for tests of the client.
#pragma once

#include <string>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::test {

// Defaults filled in as a server does.
v1::Accepted acceptedOf(const v1::RenderRequest&);

class SyntheticScene {
 public:
  explicit SyntheticScene(const v1::RenderRequest&);

  std::string image(const v1::MethodChoice&, v1::Aov) const;  // bytes as the contract lays them out
  v1::Plan plan(const v1::MethodChoice&) const;  // one view; two for "csm", none for "ray-traced"
  v1::Result result(const v1::MethodChoice&) const;

 private:
  struct Sample {
    double x = 0, z = 0;  // on the plane y = 0
    bool hit = false;     // the plane is seen here, within 20 m
    bool lit = false;     // by the reference
  };
  std::uint32_t viewOf(const v1::MethodChoice&, const Sample&) const;
  bool visible(const v1::MethodChoice&, const Sample&) const;

  v1::RenderRequest request_;
  std::vector<Sample> samples_;
};

}  // namespace sundial::test
