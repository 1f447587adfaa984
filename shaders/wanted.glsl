// The texels of packed triangles that lookups read (shared/wanted.h).
#ifndef SUNDIAL_WANTED_GLSL
#define SUNDIAL_WANTED_GLSL
#include "bindings.glsl"
#include "shared/wanted.h"

layout(set = 0, binding = kBindWanted, scalar) buffer WantedBlock {
  WantedTexels wanted;
  uint wantedWords[];
};

uint wantedTexel(uint item) { return wantedWords[wanted.bitWords + item]; }

void want(uint index) {
  const uint word = index / kWantedWordBits, bit = 1u << index % kWantedWordBits;
  // Neighbouring samples share texels: most are there already, and looking is cheaper than an atomic.
  if ((wantedWords[word] & bit) != 0 || (atomicOr(wantedWords[word], bit) & bit) != 0) return;
  wantedWords[wanted.bitWords + atomicAdd(wanted.count, 1)] = index;
}

#endif
