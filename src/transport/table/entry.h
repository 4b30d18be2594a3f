// What a light transport table stores of one ray, and where (Iwasaki 2005, section 6), once for C++ and GLSL.
//
// A block of words for every vertex of every band, bands outermost. In a block, D being the number of
// directions:
//   3 D words      exit position 3 x 16 bits in the bounding box, direction 2 x 16 bits octahedral,
//   transmittance 16 bits D / 2 words    path length inside, 16 bits each, in units of the longest D / 4
//   words    path code, 8 bits each: the signature's 7 bits (0: the ray is lost), then 1 bit: occluded
// The octahedral map is uniform where the paper's angles crowd at the poles, and needs no trigonometry: its
// error is at most 6.5e-5 of a unit vector (0.0065 %; the paper states 0.0143 %).
#ifndef NEPHROID_TRANSPORT_TABLE_ENTRY_H
#define NEPHROID_TRANSPORT_TABLE_ENTRY_H

#include "core/octahedral.h"
#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kCodeLost = 0u;
SHARED_CONSTANT uint kCodeSignatures = 127u;  // 1..127
SHARED_CONSTANT uint kCodeOccluded = 128u;

// All a look-up must know besides the words.
struct TableLayout {
  uint vertices;
  uint bands;  // 1, or 3 where the index of refraction has three values
  uint rings;
  uint azimuths;
  uint blockWords;  // of one vertex in one band
  vec3 ior;         // of the bands
  float pathScale;  // m, in mesh space: the longest path inside
  vec3 boxMinimum;  // m, the mesh's bounding box
  vec3 boxExtent;   // m
};

// One stored ray, in mesh space.
struct TableEntry {
  vec3 position;        // m
  float pathLength;     // m
  vec3 direction;       // unit
  float transmittance;  // Fresnel, of all boundaries but the entry
  uint code;
};

SHARED_FUNCTION uint blockWordsFor(uint directions) {
  return 3u * directions + (directions + 1u) / 2u + (directions + 3u) / 4u;
}

SHARED_FUNCTION float fromUnorm16(uint code) {
  return float(code) * (1.0f / 65535.0f);
}

SHARED_END

#endif
