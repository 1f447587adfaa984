// "NAME[,key=value]...": how command lines and sweeps write a method.
#pragma once

#include <string>
#include <string_view>

#include "sundial/error.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial::client {

// Errors: INVALID_ARGUMENT for an empty name or key, a part without '=', a key given twice. Whether the
// method and its parameters exist is for the server to say.
Expected<v1::MethodChoice> parseMethodChoice(std::string_view text);

// The inverse, keys in order: the name of a method in reports.
std::string methodLabel(const v1::MethodChoice&);

}  // namespace sundial::client
