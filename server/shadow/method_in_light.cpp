#include "shadow/method_in_light.h"

#include <fmt/format.h>

namespace sundial {

Result<Method> methodInLight(const Method& method, LightKind light) {
  if (!method.stages) return method;
  const Partition partition = method.stages->partition;
  if (light != LightKind::point) {
    if (partition == Partition::cube)
      return invalid(
          fmt::format("method {}: partition=cube surrounds a point light: use partition=single in this one",
                      method.label()));
    return method;
  }
  if (partition == Partition::cube) return method;
  if (partition != Partition::single)
    return invalid(
        fmt::format("method {}: partition={} cuts a map that looks one way, and a point light "
                    "shines all around: use partition=cube, as sm, dv, msf, ferko, rtw, notw, id and spsm do",
                    method.label(), stageChoice(*method.stages, "partition")));
  std::map<std::string, std::string> wanted = method.wanted;
  wanted["partition"] = "cube";
  return chooseMethod(method.row->name, wanted);
}

}  // namespace sundial
