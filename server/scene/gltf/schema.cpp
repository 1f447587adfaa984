#include "scene/gltf/schema.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

using nlohmann::json;

enum class Kind {
  string,
  boolean,
  size,     // an integer, 0 to 2^53
  small,    // an integer, 0 to 2^31 - 1: tinygltf keeps it in an int
  number,   // finite as a float
  numbers,  // an array of `length` of them
  index,    // of an element of the array at `target`
  indices,  // an array of them
  strings,  // an array
};

struct Rule {
  std::string_view path;  // from the document's root; '*' is any key or element
  Kind kind;
  bool required = false;
  std::string_view target = {};  // index, indices
  std::size_t length = 0;        // numbers
};

constexpr bool kRequired = true, kOptional = false;

constexpr Rule kRules[] = {
    {"asset/version", Kind::string, kRequired},
    {"extensionsRequired", Kind::strings},
    {"scene", Kind::index, kOptional, "scenes"},
    {"scenes/*/name", Kind::string},
    {"scenes/*/nodes", Kind::indices, kOptional, "nodes"},

    {"nodes/*/name", Kind::string},
    {"nodes/*/children", Kind::indices, kOptional, "nodes"},
    {"nodes/*/mesh", Kind::index, kOptional, "meshes"},
    {"nodes/*/camera", Kind::index, kOptional, "cameras"},
    {"nodes/*/matrix", Kind::numbers, kOptional, {}, 16},
    {"nodes/*/translation", Kind::numbers, kOptional, {}, 3},
    {"nodes/*/rotation", Kind::numbers, kOptional, {}, 4},
    {"nodes/*/scale", Kind::numbers, kOptional, {}, 3},
    {"nodes/*/extensions/KHR_lights_punctual/light", Kind::index, kRequired,
     "extensions/KHR_lights_punctual/lights"},

    {"meshes/*/name", Kind::string},
    {"meshes/*/primitives/*/mode", Kind::small},
    {"meshes/*/primitives/*/indices", Kind::index, kOptional, "accessors"},
    {"meshes/*/primitives/*/material", Kind::index, kOptional, "materials"},
    {"meshes/*/primitives/*/attributes/*", Kind::index, kOptional, "accessors"},

    {"accessors/*/bufferView", Kind::index, kOptional, "bufferViews"},
    {"accessors/*/byteOffset", Kind::size},
    {"accessors/*/componentType", Kind::small, kRequired},
    {"accessors/*/normalized", Kind::boolean},
    {"accessors/*/count", Kind::size, kRequired},
    {"accessors/*/type", Kind::string, kRequired},
    {"accessors/*/sparse/count", Kind::small, kRequired},
    {"accessors/*/sparse/indices/bufferView", Kind::index, kRequired, "bufferViews"},
    {"accessors/*/sparse/indices/byteOffset", Kind::small},
    {"accessors/*/sparse/indices/componentType", Kind::small, kRequired},
    {"accessors/*/sparse/values/bufferView", Kind::index, kRequired, "bufferViews"},
    {"accessors/*/sparse/values/byteOffset", Kind::small},

    {"bufferViews/*/buffer", Kind::index, kRequired, "buffers"},
    {"bufferViews/*/byteOffset", Kind::size},
    {"bufferViews/*/byteLength", Kind::size, kRequired},
    {"bufferViews/*/byteStride", Kind::size},
    {"bufferViews/*/extensions/EXT_meshopt_compression/buffer", Kind::index, kRequired, "buffers"},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteOffset", Kind::size},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteLength", Kind::size, kRequired},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteStride", Kind::size, kRequired},
    {"bufferViews/*/extensions/EXT_meshopt_compression/count", Kind::size, kRequired},
    {"bufferViews/*/extensions/EXT_meshopt_compression/mode", Kind::string, kRequired},
    {"bufferViews/*/extensions/EXT_meshopt_compression/filter", Kind::string},
    {"buffers/*/uri", Kind::string},
    {"buffers/*/byteLength", Kind::size, kRequired},

    {"materials/*/name", Kind::string},
    {"materials/*/doubleSided", Kind::boolean},
    {"materials/*/alphaMode", Kind::string},
    {"materials/*/alphaCutoff", Kind::number},
    {"materials/*/pbrMetallicRoughness/baseColorFactor", Kind::numbers, kOptional, {}, 4},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/index", Kind::index, kRequired, "textures"},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/texCoord", Kind::small},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset",
     Kind::numbers,
     kOptional,
     {},
     2},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation",
     Kind::number},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale",
     Kind::numbers,
     kOptional,
     {},
     2},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/texCoord",
     Kind::small},
    {"textures/*/source", Kind::index, kOptional, "images"},
    {"textures/*/sampler", Kind::index, kOptional, "samplers"},
    {"samplers/*/wrapS", Kind::small},
    {"samplers/*/wrapT", Kind::small},
    {"images/*/name", Kind::string},
    {"images/*/uri", Kind::string},
    {"images/*/mimeType", Kind::string},
    {"images/*/bufferView", Kind::index, kOptional, "bufferViews"},

    {"cameras/*/name", Kind::string},
    {"cameras/*/type", Kind::string, kRequired},
    {"cameras/*/perspective/yfov", Kind::number, kRequired},
    {"extensions/KHR_lights_punctual/lights/*/name", Kind::string},
    {"extensions/KHR_lights_punctual/lights/*/type", Kind::string, kRequired},
    {"extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Kind::number},
    {"extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Kind::number},
};

// The rules as a tree over the parts of their paths.
struct Node {
  const Rule* rule = nullptr;
  std::map<std::string, std::unique_ptr<Node>, std::less<>> children;

  bool isArray() const { return children.contains("*") && !isMap; }
  bool isMap = false;  // '*' stands for any key of an object
};

Node buildTree() {
  Node root;
  for (const Rule& rule : kRules) {
    Node* node = &root;
    std::string_view rest = rule.path;
    while (!rest.empty()) {
      const std::size_t slash = rest.find('/');
      const std::string part(rest.substr(0, slash));
      if (part == "*" && rest.size() == 1 && rule.path.find("attributes/*") != std::string_view::npos)
        node->isMap = true;
      std::unique_ptr<Node>& child = node->children[part];
      if (!child) child = std::make_unique<Node>();
      node = child.get();
      rest = slash == std::string_view::npos ? std::string_view{} : rest.substr(slash + 1);
    }
    node->rule = &rule;
  }
  return root;
}

const json* find(const json& document, std::string_view path) {
  const json* node = &document;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    if (!node->is_object()) return nullptr;
    const auto it = node->find(path.substr(0, slash));
    if (it == node->end()) return nullptr;
    node = &*it;
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  }
  return node;
}

class Reducer {
 public:
  explicit Reducer(const json& document) : document_(document) {}

  Result<json> reduce(const Node& node, const json& value, const std::string& path) {
    if (node.rule) return checked(*node.rule, value, path);
    return node.isArray() ? array(*node.children.at("*"), value, path) : object(node, value, path);
  }

 private:
  Result<json> array(const Node& element, const json& value, const std::string& path) {
    if (!value.is_array()) return wrong(path, "an array", value);
    json result = json::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      Result<json> item = reduce(element, value[i], fmt::format("{}[{}]", path, i));
      if (!item) return item;
      result.push_back(std::move(*item));
    }
    return result;
  }

  Result<json> object(const Node& node, const json& value, const std::string& path) {
    if (!value.is_object()) return wrong(path, "an object", value);
    json result = json::object();
    const auto member = [&](const std::string& key, const Node& child, const json& from) -> Result<void> {
      Result<json> item =
          reduce(child, from, path.empty() ? key : fmt::format("{}.{}", path, quotedKey(key)));
      if (!item) return std::unexpected(item.error());
      result[key] = std::move(*item);
      return {};
    };
    if (node.isMap) {
      for (const auto& [key, from] : value.items())
        if (auto ok = member(key, *node.children.at("*"), from); !ok) return std::unexpected(ok.error());
      return result;
    }
    for (const auto& [key, child] : node.children) {
      const auto from = value.find(key);
      if (from != value.end()) {
        if (auto ok = member(key, *child, *from); !ok) return std::unexpected(ok.error());
      } else if (child->isMap || (child->rule && child->rule->required)) {
        return invalid(fmt::format("{}{}{} is missing: glTF requires it; export the file again", path,
                                   path.empty() ? "" : ".", key));
      }
    }
    return result;
  }

  Result<json> checked(const Rule& rule, const json& value, const std::string& path) {
    switch (rule.kind) {
      case Kind::string:
        if (!value.is_string()) return wrong(path, "a string", value);
        return value;
      case Kind::boolean:
        if (!value.is_boolean()) return wrong(path, "true or false", value);
        return value;
      case Kind::size:
        return integer(value, path, 9007199254740992.0);
      case Kind::small:
        return integer(value, path, 2147483647.0);
      case Kind::number:
        return number(value, path);
      case Kind::index:
        return index(rule, value, path);
      case Kind::numbers:
        if (!value.is_array() || value.size() != rule.length)
          return wrong(path, fmt::format("an array of {} numbers", rule.length), value);
        return each(value, path, [&](const json& v, const std::string& p) { return number(v, p); });
      case Kind::indices:
        if (!value.is_array()) return wrong(path, "an array of indices", value);
        return each(value, path, [&](const json& v, const std::string& p) { return index(rule, v, p); });
      case Kind::strings:
        if (!value.is_array()) return wrong(path, "an array of strings", value);
        return each(value, path, [&](const json& v, const std::string& p) -> Result<json> {
          if (!v.is_string()) return wrong(p, "a string", v);
          return v;
        });
    }
    return value;
  }

  template <class Check>
  Result<json> each(const json& value, const std::string& path, Check check) {
    json result = json::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      Result<json> item = check(value[i], fmt::format("{}[{}]", path, i));
      if (!item) return item;
      result.push_back(std::move(*item));
    }
    return result;
  }

  Result<json> number(const json& value, const std::string& path) {
    if (!value.is_number() || !std::isfinite(static_cast<float>(value.get<double>())))
      return wrong(path, "a finite number", value);
    return value;
  }

  // Some exporters write integers as 3.0.
  Result<json> integer(const json& value, const std::string& path, double max) {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0) || number > max || number != std::floor(number))
      return wrong(path, fmt::format("an integer, 0 to {:.0f}", max), value);
    return json(static_cast<std::uint64_t>(number));
  }

  Result<json> index(const Rule& rule, const json& value, const std::string& path) {
    Result<json> number = integer(value, path, 2147483647.0);
    if (!number) return number;
    const json* target = find(document_, rule.target);
    const std::size_t count = target && target->is_array() ? target->size() : 0;
    if (number->get<std::uint64_t>() >= count)
      return invalid(fmt::format("{} is {}, but there are {} {}: the file is damaged or was exported wrongly",
                                 path, number->get<std::uint64_t>(), count,
                                 rule.target.substr(rule.target.rfind('/') + 1)));
    return number;
  }

  static std::unexpected<Error> wrong(const std::string& path, std::string_view expected, const json& value) {
    std::string found = value.type_name();
    if (value.is_primitive()) found = quotedName(value.dump(-1, ' ', false, json::error_handler_t::replace));
    return invalid(fmt::format("{} must be {}, but is {}: the file is damaged or was exported wrongly",
                               path.empty() ? "the document" : path, expected, found));
  }

  static std::string quotedKey(const std::string& key) {
    const std::string safe = quotedName(key);
    return safe.substr(1, safe.size() - 2);
  }

  const json& document_;
};

}  // namespace

Result<json> reduceToSchema(const json& document) {
  const Node root = buildTree();
  return Reducer(document).reduce(root, document, "");
}

}  // namespace sundial::gltf
