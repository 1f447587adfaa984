// The named cases.
#include "stability/cases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/load.h"

namespace sundial {
namespace {

TEST(StabilityCases, NameWhatIsThere) {
  for (const StabilityCase& row : stabilityCases()) {
    SCOPED_TRACE(row.name);
    for (const std::string_view name : {row.scene, row.twinScene}) {
      if (name.empty()) continue;
      ASSERT_TRUE(name.starts_with("builtin:"));
      const auto scene = makeBuiltin(name.substr(8));
      ASSERT_TRUE(scene) << scene.error().message;
      const auto has = [](const auto& all, std::string_view wanted) {
        return std::ranges::any_of(all, [&](const auto& one) { return one.name == wanted; });
      };
      EXPECT_EQ(row.path.empty(), !row.view.empty());
      EXPECT_TRUE(row.path.empty() || has(scene->paths, row.path));
      EXPECT_TRUE(row.view.empty() || has(scene->views, row.view));
      EXPECT_TRUE(has(scene->lights, row.light));
    }
  }
}

}  // namespace
}  // namespace sundial
