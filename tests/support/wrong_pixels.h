// How many pixels of small pictures are wrong, for tests that compare methods.
#pragma once

#include "support/rendering.h"

namespace sundial::test {

class WrongPixelsTest : public RendererTest {
 protected:
  // Share of wrong pixels, by method.
  static std::map<std::string, double> wrong(std::string_view scene, std::string_view view,
                                             std::string_view light,
                                             std::initializer_list<std::string_view> methods) {
    const auto held = builtin(scene);
    return wrong(held, viewOf(*held, view), lightOf(*held, light), methods);
  }

  static std::map<std::string, double> wrong(const std::shared_ptr<const Scene>& scene, const View& view,
                                             const Light& light,
                                             std::initializer_list<std::string_view> methods) {
    std::map<std::string, double> shares;
    const auto renderings = render(jobOf(scene, view, light, {320, 320}, methods, {}, true));
    auto method = methods.begin();
    for (const Rendering& r : renderings) shares[std::string(*method++)] = 1 - r.result.measures->pixelMatch;
    return shares;
  }
};

}  // namespace sundial::test
