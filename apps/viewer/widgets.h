// Small pieces that panels are made of.
#pragma once

#include <string>

#include "core/shared_language.h"

namespace nephroid {

std::string formatted(const char* format, double value);

// In a column so wide (units).
void textAtRight(const std::string& text, float width);

// Shown while the pointer rests on the last item.
void tooltip(const std::string& text);

// "volume-kilobytes" as "Volume kilobytes".
std::string spelledOut(const std::string& name);

// Each returns whether it was changed. What they are about is told with its unit in the tooltip.
bool slider(const char* label, float& value, float low, float high, const char* format, const char* help,
            bool isLogarithmic = false);
bool dragMetres(const char* label, vec3& value, const char* help);
// A light's or surface's strength with its color apart: `most` is the end of the slider.
bool colorAndStrength(const char* id, const char* strengthLabel, vec3& value, float most, const char* format,
                      const char* help);
bool color(const char* label, vec3& value, const char* help);

}  // namespace nephroid
