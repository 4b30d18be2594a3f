// The layout of a light transport table (Iwasaki 2005, section 6). Written once for C++ and GLSL.
//
// There is one block of 32-bit words for each vertex in each band; all vertices of the first band come first.
// With D directions a block has
//
//   3 D words    exit position in the bounding box (3 x 16 bits), direction in the octahedral map
//                (2 x 16 bits), transmittance (16 bits)
//   D / 2 words  path length inside (16 bits each), as a part of the longest path
//   D / 4 words  path code (8 bits each): 7 bits of the signature (0: the ray is lost), 1 bit: occluded
//
// The octahedral map is almost uniform, while the angles of the paper are dense at the poles. It needs no
// trigonometry. Its error is at most 6.5e-5 of a unit vector (0.0065 %; the paper states 0.0143 %).
#ifndef NEPHROID_TRANSPORT_TABLE_ENTRY_H
#define NEPHROID_TRANSPORT_TABLE_ENTRY_H

#include "core/octahedral.h"
#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kCodeLost = 0u;
SHARED_CONSTANT uint kCodeSignatures = 127u;  // 1..127
SHARED_CONSTANT uint kCodeOccluded = 128u;

// Everything that a look-up needs besides the words.
struct TableLayout {
  uint vertices;
  uint bands;  // 1, or 3 where the index of refraction has three values
  uint rings;
  uint azimuths;
  uint blockWords;  // 32-bit words of one vertex in one band
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
  float transmittance;  // 0..1, Fresnel, of all boundaries but the entry
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
