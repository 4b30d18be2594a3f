// The list of techniques: the TechniqueInfo that each folder exports. The first one is the default.
#pragma once

// For programs that are built with their own registry; this library adds no techniques here.
#ifndef NEPHROID_FURTHER_TECHNIQUES
#define NEPHROID_FURTHER_TECHNIQUES(TECHNIQUE)
#endif

#define NEPHROID_TECHNIQUES(TECHNIQUE) \
  TECHNIQUE(kAdaptiveBeams)            \
  TECHNIQUE(kIlluminationTextures)     \
  TECHNIQUE(kIrradianceVolume)         \
  TECHNIQUE(kLightVolumes)             \
  TECHNIQUE(kSlicedImages)             \
  TECHNIQUE(kNoCaustics)               \
  NEPHROID_FURTHER_TECHNIQUES(TECHNIQUE)
