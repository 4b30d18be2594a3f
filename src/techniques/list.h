// Every technique by the TechniqueInfo that its folder exports. The first is used where none is named.
#pragma once

// Of a program that is linked with a registry of its own; this library has none.
#ifndef NEPHROID_FURTHER_TECHNIQUES
#define NEPHROID_FURTHER_TECHNIQUES(TECHNIQUE)
#endif

#define NEPHROID_TECHNIQUES(TECHNIQUE) \
  TECHNIQUE(kAutomatic)                \
  TECHNIQUE(kIlluminationTextures)     \
  TECHNIQUE(kIrradianceVolume)         \
  TECHNIQUE(kLightVolumes)             \
  TECHNIQUE(kSlicedImages)             \
  TECHNIQUE(kNoCaustics)               \
  NEPHROID_FURTHER_TECHNIQUES(TECHNIQUE)
