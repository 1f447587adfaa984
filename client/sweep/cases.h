// From a sweep's specification to its cases.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sundial/error.h"
#include "sundial/scene_files.h"
#include "sundial/v1/sundial.pb.h"
#include "sundial/v1/sweep.pb.h"

namespace sundial::sweep {

// A rendering by one method, and where something moves a run along its path: what is repeated and reported as
// a unit.
struct Case {
  std::string id;                   // SweepLine.case
  std::string scene;                // as the specification writes it
  std::string viewName, lightName;  // what reports call them; empty: the scene's default
  v1::RenderRequest request;        // asks for measures and no images
  // Where the camera, the light or both move: as this says, with what stands still. `request` then lacks a
  // view and a light that move: the answer to this has those of the first frame.
  std::optional<v1::StabilityRequest> along;
  std::string pathName, lightPathName;  // what reports call them; empty: it stands still
};

struct Cases {
  std::vector<Case> list;                           // in the order that SweepSpec documents, each id once
  std::map<std::string, client::SceneFiles> files;  // of local scenes, by what requests call them
};

// Errors: NOT_FOUND for an unreadable file, INVALID_ARGUMENT with line and column for what is no
// specification.
client::Expected<v1::SweepSpec> readSpec(const std::filesystem::path&);

// Local scenes and paths are looked for from `folder`. Errors: INVALID_ARGUMENT names the group and the
// field; NOT_FOUND for an unreadable file.
client::Expected<Cases> expand(const v1::SweepSpec&, const std::filesystem::path& folder);

// A part of a sweep: the same cases whatever the order of the specification.
struct Shard {
  unsigned index = 1, count = 1;  // index in [1, count]
  bool has(const Case&) const;
};

}  // namespace sundial::sweep
