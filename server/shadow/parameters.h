// The parameters of methods: which there are, what they may be, and what they set.
#pragma once

#include "shadow/method.h"

namespace sundial {

// Those that these stages read, with the row's defaults: a parameter that no stage reads isn't there.
std::vector<Parameter> parametersFor(const MethodRow&, const std::optional<Stages>&);
// Whatever stages read it.
std::optional<Parameter> knownParameter(std::string_view name);

// From a value for each of parametersFor(), none of them wrong.
Method::Settings settingsFrom(const std::map<std::string, std::string>& parameters, const Stages&);
// Why settings don't go together, one by one good as they are.
std::optional<std::string> whyInconsistent(const Stages&, const Method::Settings&);

}  // namespace sundial
