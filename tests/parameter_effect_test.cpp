// Every parameter, and every row, changes something: none is read and forgotten, none is another under a new
// name.
#include <array>
#include <set>

#include "support/rendering.h"

namespace sundial::test {
namespace {

struct Effect {
  const char *parameter, *method, *otherwise;  // the same but for the parameter's value
};

// Of trees, which have holes, slopes, depth and gaps.
constexpr std::array kEffects = {
    Effect{"texels", "sm,texels=256", "sm,texels=256x300"},
    Effect{"bias_texels", "sm,texels=256", "sm,texels=256,bias_texels=5"},
    Effect{"bias_world", "sm,texels=256", "sm,texels=256,bias_world=0.5"},
    Effect{"volume", "pssm,texels=256", "pssm,texels=256,volume=samples"},
    Effect{"partition", "sdsm-log,texels=256", "sdsm-log,texels=256,partition=kmeans"},
    Effect{"warp", "dv,texels=256", "dv,texels=256,warp=non-orthogonal"},
    Effect{"focus", "sdsm-log,texels=256", "sdsm-log,texels=256,focus=snapped"},
    Effect{"resolution", "dv,texels=2048", "dv,texels=2048,resolution=estimated,percentile=20"},
    Effect{"storage", "spsm,texels=256", "spsm,texels=256,storage=depth-id"},
    Effect{"lookup", "sm,texels=256", "sm,texels=256,lookup=pcf"},
    Effect{"kernel", "sm,texels=256,lookup=pcf", "sm,texels=256,lookup=pcf,kernel=5"},
    Effect{"recovery", "spsm,texels=256", "spsm,texels=256,recovery=off"},
    Effect{"positions", "spsm,texels=256,recovery=edges", "spsm,texels=256,recovery=edges,positions=4"},
    Effect{"exponents", "evsm,texels=256", "evsm,texels=256,exponents=10:2"},
    Effect{"blur", "evsm,texels=256", "evsm,texels=256,blur=1"},
    Effect{"bleed_reduction", "evsm,texels=256", "evsm,texels=256,bleed_reduction=0.6"},
    Effect{"least_deviation", "evsm,texels=256", "evsm,texels=256,least_deviation=0.5"},
    Effect{"anisotropy", "evsm,texels=256", "evsm,texels=256,anisotropy=1"},
    Effect{"near", "pssm,texels=256,lambda=1", "pssm,texels=256,lambda=1,near=5"},
    Effect{"percentile", "ferko,texels=2048", "ferko,texels=2048,percentile=20"},
    Effect{"finest", "ferko,texels=2048,percentile=5", "ferko,texels=2048,percentile=5,finest=1"},
    Effect{"window", "notw,texels=256", "notw,texels=256,window=4"},
    Effect{"even", "notw,texels=256", "notw,texels=256,even=0.6"},
    Effect{"power", "notw,texels=256", "notw,texels=256,power=1"},
    Effect{"analysis", "rtw,texels=256", "rtw,texels=256,analysis=forward"},
    Effect{"weights", "rtw,texels=256", "rtw,texels=256,weights=0:1:1:0:0"},
    Effect{"splits", "csm,texels=256", "csm,texels=256,splits=2:9:100"},
    Effect{"choose", "sdsm-log,texels=256,choose=depth", "sdsm-log,texels=256,choose=tightest"},
    Effect{"blend", "pssm,texels=256,choose=depth", "pssm,texels=256,choose=depth,blend=0.4"},
    Effect{"partitions", "sdsm-log,texels=256", "sdsm-log,texels=256,partitions=2"},
    Effect{"lambda", "pssm,texels=256", "pssm,texels=256,lambda=1"},
    Effect{"tile_sizes", "iasm", "iasm,tile_sizes=256:128:64:64"},
    Effect{"extent", "iasm", "iasm,extent=40"},
    Effect{"placement", "iasm", "iasm,placement=column"},
    Effect{"importance_gain", "iasm-fitted", "iasm-fitted,importance_gain=0"},
    Effect{"importance_range", "iasm-fitted", "iasm-fitted,importance_range=1"},
};

// What the parameter is there for beyond the picture: how the same picture comes about.
const std::set<std::string_view> kOfTheWayAlone = {"plan", "raster", "cull"};

class Parameters : public RendererTest {
 protected:
  // How lit each pixel is, and from which maps.
  static std::string trees(std::string_view method) {
    static const auto scene = builtin("trees?count=60");
    const auto renderings = render(jobOf(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), {240, 160},
                                         {method}, {Aov::visibility}));
    const Rendering& made = renderings.front();
    const std::vector<std::byte>& bytes = made.images.at(Aov::visibility).bytes;
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const PlanView& view : made.plan)
      text.append(reinterpret_cast<const char*>(&view.shadowFromWorld), sizeof view.shadowFromWorld);
    return text;
  }
};

TEST_F(Parameters, EachChangesThePicture) {
  for (const Effect& e : kEffects)
    EXPECT_TRUE(trees(e.method) != trees(e.otherwise)) << e.parameter << ": " << e.otherwise;
}

TEST_F(Parameters, NoneIsLeftOut) {
  std::set<std::string_view> held = kOfTheWayAlone;
  for (const Effect& e : kEffects) held.insert(e.parameter);
  for (const MethodRow& row : methodTable())
    for (const Parameter& p : parametersOf(row)) EXPECT_TRUE(held.contains(p.name)) << p.name;
}

TEST_F(Parameters, EachRowHasAPictureOfItsOwn) {
  std::map<std::string, std::string_view> seen;
  for (const MethodRow& row : methodTable()) {
    // These differ where something moves, where there is nothing to round, and where depth has a gap.
    if (row.name == "iasm-delayed" || row.name == "shadow-volumes" || row.name == "sdsm-adaptive") continue;
    const auto [place, isNew] = seen.emplace(trees(row.name), row.name);
    EXPECT_TRUE(isNew) << row.name << " and " << place->second;
  }
}

}  // namespace
}  // namespace sundial::test
