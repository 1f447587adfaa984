// A warped map by the vertex shader, by tessellation, and by the warp's inverse.
#pragma once

namespace sundial::bench {

// Prints a table of times over sm's, `runs` runs each (0: no times), and of what is wrong. Throws
// std::runtime_error where the device has no tessellation shaders.
void printTessellation(unsigned runs);

}  // namespace sundial::bench
