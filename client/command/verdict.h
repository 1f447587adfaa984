// Whether a named stability case came out as it must.
#pragma once

#include "sundial/v1/sundial.pb.h"

namespace sundial::command {

// flip_rate, pop, texel_jump, wrong_rate, bleed, drawn or wrong_pixels. Throws a Failure for another: of a
// newer server.
double measureOf(const v1::StabilityResult&, const std::string& measure);

// `results`, and `twin` where the case has one, are in the order of its methods. See StabilityCase in the
// contract for the rules.
v1::CaseVerdict judge(const v1::StabilityCase&,
                      const google::protobuf::RepeatedPtrField<v1::StabilityResult>& results,
                      const google::protobuf::RepeatedPtrField<v1::StabilityResult>& twin);

}  // namespace sundial::command
