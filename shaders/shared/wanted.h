// storage=triangle: which texels the lookups of a frame read, so that no others are packed.
#ifndef SUNDIAL_SHARED_WANTED_H
#define SUNDIAL_SHARED_WANTED_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

// Behind it: a bit a texel of the store, set where it is or was listed, and then the list.
struct WantedTexels {
  uint count;  // listed, to be packed next
  uint bitWords;
  uint moreReach;  // texels about its own that a lookup's second round reads; 0 where all is packed
};

SUNDIAL_CONST kWantedWordBits = 32u;
SUNDIAL_CONST kPackGroup = 64u;    // invocations of a workgroup
SUNDIAL_CONST kPackGroups = 256u;  // that share the list

SUNDIAL_SHARED_END
#endif
