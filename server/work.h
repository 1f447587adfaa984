// Work as counts: what stands beside times, and carries over to other machines.
#pragma once

#include <string>

namespace sundial {

// Pipeline statistics; they repeat exactly.
struct Work {
  std::string name;  // "vertices", "primitives", "fragments", "invocations", "rays"; "scenes": primitives
                     // over the scene's; "by_compute": 1 where the compute rasteriser drew
  double count = 0;
};

}  // namespace sundial
