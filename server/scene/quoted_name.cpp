#include "scene/quoted_name.h"

namespace sundial {

std::string quotedName(std::string_view name) {
  constexpr std::size_t kMaxBytes = 60;
  std::string result = "'";
  if (name.size() > kMaxBytes) {
    std::size_t end = kMaxBytes;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
    result += name.substr(0, end);
    result += "...";
  } else {
    result += name;
  }
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return result + "'";
}

}  // namespace sundial
