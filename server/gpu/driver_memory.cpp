#include "gpu/driver_memory.h"

#include <malloc.h>

namespace sundial {

void keepFreedMemory() {
  constexpr int kBlock = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kBlock);
  mallopt(M_TRIM_THRESHOLD, kBlock);
}

}  // namespace sundial
