// Content addresses: SHA-256 as 64 hexadecimal digits, of fields. Server and client compute them alike, so
// that a client knows what a server will call its files before it has sent them.
//
// A scene's files: the field "files", the main file's content, then each other file's name (its URI as the
// main file writes it) and content, sorted by name.
#pragma once

#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sundial {

class ContentDigest {
 public:
  ContentDigest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  // A field of its own: its length goes in first, so that no two lists of fields look alike.
  void add(std::string_view field) {
    begin(field.size());
    update(field);
  }

  // The same in pieces, of `size` bytes together.
  void begin(std::uint64_t size) { update(std::to_string(size) + ":"); }
  void update(std::string_view piece) {
    check(EVP_DigestUpdate(context_.get(), piece.data(), piece.size()) == 1);
  }

  // Call once, last.
  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[bytes[i] >> 4];
      text += "0123456789abcdef"[bytes[i] & 15];
    }
    return text;
  }

 private:
  static void check(bool good) {
    if (!good) throw std::runtime_error("libcrypto can't compute SHA-256");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace sundial
