#include "scene/gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>

#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

Result<glm::dmat4> localTransform(const tinygltf::Node& node) {
  glm::dmat4 m(1);
  if (!node.matrix.empty()) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row)
        m[column][row] = node.matrix[static_cast<std::size_t>(4 * column + row)];
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
      return invalid("its matrix is not affine, the last row must be 0 0 0 1: export the file again");
    return m;
  }
  if (!node.rotation.empty()) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(q) > 0))
      return invalid("its rotation is 0 0 0 0, no unit quaternion: export the file again");
    m = glm::mat4_cast(glm::normalize(q));
  }
  if (!node.scale.empty())
    for (int axis = 0; axis < 3; ++axis) m[axis] *= node.scale[static_cast<std::size_t>(axis)];
  if (!node.translation.empty())
    m[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  return m;
}

// A free name: "name", "name 2", ...
class Names {
 public:
  std::string make(const std::string& wanted, const std::string& fallback) {
    const std::string base = wanted.empty() ? fallback : wanted;
    std::size_t& count = counts_[base];  // remembered: thousands of lamps may share a name
    std::string name = count++ == 0 ? base : fmt::format("{} {}", base, count);
    while (!taken_.insert(name).second) name = fmt::format("{} {}", base, ++count);
    return name;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> counts_;
};

// Where a node's camera or light points: along its -z.
Result<glm::dvec3> axis(const glm::dmat4& worldFromNode, const glm::dvec3& direction) {
  const glm::dvec3 v = glm::dmat3(worldFromNode) * direction;
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length))
    return invalid("its transform leaves it no direction: repair it");
  return v / length;
}

class Placer {
 public:
  Placer(const tinygltf::Model& model, std::uint64_t maxInstances)
      : model_(model), maxInstances_(maxInstances), visited_(model.nodes.size(), false) {}

  Result<Placed> place() {
    // A stack of our own: a chain of a million nodes is no reason to overflow the thread's.
    std::vector<Pending> stack;
    const std::vector<int> roots = rootNodes();
    for (auto it = roots.rbegin(); it != roots.rend(); ++it) stack.push_back({*it, glm::dmat4(1)});
    while (!stack.empty()) {
      const auto [index, worldFromParent] = stack.back();
      stack.pop_back();
      const auto i = static_cast<std::size_t>(index);
      const tinygltf::Node& node = model_.nodes[i];
      const auto named = [&](const Error& error) {
        return fail(error.code, fmt::format("nodes[{}] {}: {}", i, quotedName(node.name), error.message));
      };
      if (visited_[i])
        return named(
            {ErrorCode::invalidArgument,
             "it has two parents or is its own ancestor, but nodes must form a tree: export the file "
             "again"});
      visited_[i] = true;
      const Result<glm::dmat4> local = localTransform(node);
      if (!local) return named(local.error());
      const glm::dmat4 worldFromNode = worldFromParent * *local;
      if (auto ok = visit(node, worldFromNode); !ok) return named(ok.error());
      for (auto it = node.children.rbegin(); it != node.children.rend(); ++it)
        stack.push_back({*it, worldFromNode});
    }
    return std::move(placed_);
  }

 private:
  struct Pending {
    int node;
    glm::dmat4 worldFromParent;
  };

  std::vector<int> rootNodes() const {
    if (!model_.scenes.empty())
      return model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes;
    std::vector<bool> isChild(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
      if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
  }

  Result<void> visit(const tinygltf::Node& node, const glm::dmat4& worldFromNode) {
    // A scale of 0 is how files hide things.
    const bool hidden = glm::dmat3(worldFromNode) == glm::dmat3(0);
    if (node.mesh >= 0 && !hidden) {
      if (placed_.instances.size() >= maxInstances_)
        return fail(
            ErrorCode::resourceExhausted,
            fmt::format("there are more than {} instances: split the scene or raise the server's limit",
                        maxInstances_));
      const std::string& name =
          node.name.empty() ? model_.meshes[static_cast<std::size_t>(node.mesh)].name : node.name;
      placed_.instances.push_back({name, static_cast<std::size_t>(node.mesh), worldFromNode});
    }
    if (node.camera >= 0)
      if (auto ok = addCamera(node, worldFromNode); !ok) return ok;
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end())
      return addLight(node, static_cast<std::size_t>(light->second.Get("light").GetNumberAsInt()),
                      worldFromNode);
    return {};
  }

  Result<void> addCamera(const tinygltf::Node& node, const glm::dmat4& worldFromNode) {
    const tinygltf::Camera& camera = model_.cameras[static_cast<std::size_t>(node.camera)];
    if (camera.type != "perspective") return {};
    const Result<glm::dvec3> forward = axis(worldFromNode, glm::dvec3(0, 0, -1));
    if (!forward) return std::unexpected(forward.error());
    const Result<glm::dvec3> up = axis(worldFromNode, glm::dvec3(0, 1, 0));
    if (!up) return std::unexpected(up.error());
    const double yfov = glm::degrees(camera.perspective.yfov);
    if (!(yfov > 0 && yfov < 180))
      return invalid(fmt::format("its camera's yfov is {} degrees, but must be between 0 and 180", yfov));
    View view;
    view.eye = glm::dvec3(worldFromNode[3]);
    view.target = view.eye + *forward;
    view.up = *up;
    view.verticalFovDegrees = yfov;
    placed_.views.push_back({viewNames_.make(node.name.empty() ? camera.name : node.name, "camera"), view});
    return {};
  }

  Result<void> addLight(const tinygltf::Node& node, std::size_t index, const glm::dmat4& worldFromNode) {
    const tinygltf::Light& from = model_.lights[index];
    const Result<glm::dvec3> direction = axis(worldFromNode, glm::dvec3(0, 0, -1));
    if (!direction) return std::unexpected(direction.error());
    Light light;
    light.direction = *direction;
    light.position = glm::dvec3(worldFromNode[3]);
    if (from.type == "directional") {
      light.kind = LightKind::directional;
      light.position = glm::dvec3(0);
    } else if (from.type == "point") {
      light.kind = LightKind::point;
    } else if (from.type == "spot") {
      light.kind = LightKind::spot;
      const double outer = from.spot.outerConeAngle;
      if (!(outer > 0 && outer <= glm::half_pi<double>() + 1e-6))
        return invalid(
            fmt::format("its light's outerConeAngle is {}, but must be above 0 and at most pi/2", outer));
      light.coneDegrees = std::min(2 * glm::degrees(outer), 170.0);
    } else {
      return invalid(
          fmt::format("its light's type {} is not directional, point or spot", quotedName(from.type)));
    }
    placed_.lights.push_back({lightNames_.make(node.name.empty() ? from.name : node.name, "light"), light});
    return {};
  }

  const tinygltf::Model& model_;
  std::uint64_t maxInstances_;
  std::vector<bool> visited_;
  Placed placed_;
  Names viewNames_, lightNames_;
};

}  // namespace

Result<Placed> placeNodes(const tinygltf::Model& model, std::uint64_t maxInstances) {
  return Placer(model, maxInstances).place();
}

}  // namespace sundial::gltf
