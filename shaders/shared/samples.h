// How compute passes over the view samples are cut up: as C++ dispatches them and shaders read them.
#ifndef SUNDIAL_SHARED_SAMPLES_H
#define SUNDIAL_SHARED_SAMPLES_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kSampleGroup = 64u;           // invocations of a workgroup
SUNDIAL_CONST kSamplesPerInvocation = 16u;  // a workgroup apart
SUNDIAL_CONST kPixelsPerMeasured = 4u;      // of a percentile of the pixels' sizes

SUNDIAL_SHARED_END
#endif
