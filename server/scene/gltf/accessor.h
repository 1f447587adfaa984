// Reads accessors: strided, sparse, quantised.
#pragma once

#include <string_view>

#include "scene/gltf/buffer_data.h"

namespace sundial::gltf {

// Errors of all: dataLoss, invalidArgument or resourceExhausted, naming the accessor.
class AccessorReader {
 public:
  AccessorReader(const Document&, BufferData&, Budget&);

  std::uint64_t count(int accessor) const;
  unsigned components(int accessor) const;  // 1 to 4, 9 or 16

  // Of unsigned scalars.
  Result<std::vector<std::uint32_t>> indices(int accessor);

  // Elements `which` of the accessor (each < count), or all of them, `components` floats each; integers are
  // normalised where the accessor says so. Refuses an accessor of another shape.
  Result<std::vector<float>> floats(int accessor, unsigned components,
                                    std::optional<std::span<const std::uint32_t>> which);

 private:
  template <class T>
  Result<std::vector<T>> all(int accessor);

  const Document& document_;
  BufferData& data_;
  Budget& budget_;
};

}  // namespace sundial::gltf
