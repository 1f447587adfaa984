// CRC-32C (Castagnoli), the checksum of ImageEnd: one definition for the server and for clients.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace sundial {

namespace detail {

// kCrc32c[k][b]: what byte b does to the remainder when k more bytes follow it.
inline constexpr auto kCrc32c = [] {
  std::array<std::array<std::uint32_t, 256>, 8> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ ((remainder & 1) ? 0x82f63b78u : 0u);
    table[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < table.size(); ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[k - 1][byte];
      table[k][byte] = (before >> 8) ^ table[0][before & 0xff];
    }
  }
  return table;
}();

// Eight bytes a step from eight tables. Takes and gives the remainder itself, not its complement.
constexpr std::uint32_t crc32cByTable(std::span<const std::byte> data, std::uint32_t remainder) {
  const auto& t = kCrc32c;
  for (; data.size() >= 8; data = data.subspan(8)) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::uint32_t mixed =
          std::to_integer<std::uint32_t>(data[i]) ^ (i < 4 ? (remainder >> (8 * i)) & 0xff : 0u);
      next ^= t[7 - i][mixed];
    }
    remainder = next;
  }
  for (const std::byte byte : data) {
    remainder = (remainder >> 8) ^ t[0][(remainder ^ std::to_integer<std::uint32_t>(byte)) & 0xff];
  }
  return remainder;
}

#if defined(__x86_64__) && defined(__GNUC__)
#define SUNDIAL_CRC32C_INSTRUCTION 1
// The processor's own instruction, several times as fast.
__attribute__((target("sse4.2"))) inline std::uint32_t crc32cByInstruction(std::span<const std::byte> data,
                                                                           std::uint32_t remainder) {
  std::uint64_t wide = remainder;
  for (; data.size() >= 8; data = data.subspan(8)) {
    std::uint64_t word;
    std::memcpy(&word, data.data(), sizeof(word));
    wide = __builtin_ia32_crc32di(wide, word);
  }
  remainder = static_cast<std::uint32_t>(wide);
  for (const std::byte byte : data) {
    remainder = __builtin_ia32_crc32qi(remainder, std::to_integer<unsigned char>(byte));
  }
  return remainder;
}
#endif

}  // namespace detail

// The checksum of `data`; or, given the checksum `crc` of what came before it, of both together.
inline std::uint32_t crc32c(std::span<const std::byte> data, std::uint32_t crc = 0) {
#ifdef SUNDIAL_CRC32C_INSTRUCTION
  static const bool instruction = __builtin_cpu_supports("sse4.2") != 0;
  if (instruction) return ~detail::crc32cByInstruction(data, ~crc);
#endif
  return ~detail::crc32cByTable(data, ~crc);
}

}  // namespace sundial
