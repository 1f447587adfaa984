// A group of a specification, checked and with everything filled in that can be without a server.
#pragma once

#include <filesystem>

#include "sundial/error.h"
#include "sundial/v1/sweep.pb.h"

namespace sundial::sweep {

// It then has a size; points and seed where something moves; views and keys with up and field of view; and of
// every path a name, and keys instead of a file (looked for from `folder`), whose frames are the group's
// where it has any. Errors: INVALID_ARGUMENT names the field; NOT_FOUND for an unreadable file.
client::Expected<v1::SweepGroup> complete(v1::SweepGroup, const std::filesystem::path& folder);

}  // namespace sundial::sweep
