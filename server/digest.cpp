#include "digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>

namespace sundial {

namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  // A field of its own: its length goes in first, so that no two lists of fields look alike.
  void add(std::string_view field) {
    const std::string length = fmt::format("{}:", field.size());
    check(EVP_DigestUpdate(context_.get(), length.data(), length.size()) == 1);
    check(EVP_DigestUpdate(context_.get(), field.data(), field.size()) == 1);
  }
  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", bytes[i]);
    return text;
  }

 private:
  static void check(bool good) {
    if (!good) throw std::runtime_error("libcrypto can't compute SHA-256");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string digestOf(const SceneFiles& scene) {
  Sha256 hash;
  hash.add("files");
  if (const auto main = scene.files.find(scene.main); main != scene.files.end()) hash.add(main->second);
  for (const auto& [name, content] : scene.files) {  // a map: sorted by name
    if (name == scene.main) continue;
    hash.add(name);
    hash.add(content);
  }
  return hash.hexadecimal();
}

std::string digestOfBuiltin(std::string_view canonicalReference) {
  Sha256 hash;
  hash.add("builtin");
  hash.add(canonicalReference);
  return hash.hexadecimal();
}

}  // namespace sundial
