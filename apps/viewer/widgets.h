// Small parts that the panels are built from.
#pragma once

#include <string>

#include "core/shared_language.h"

namespace nephroid {

std::string formatted(const char* format, double value);

// Draws the text at the right end of a column. `width`: units of the panels.
void textAtRight(const std::string& text, float width);

// A text that is shown while the pointer rests on the last item.
void tooltip(const std::string& text);

// "volume-kilobytes" as "Volume kilobytes".
std::string spelledOut(const std::string& name);

// Each returns whether the user changed the value. `help` is the tooltip: what the value is, with its unit.
bool slider(const char* label, float& value, float low, float high, const char* format, const char* help,
            bool isLogarithmic = false);
bool dragMeters(const char* label, vec3& value, const char* help);
// Shows a color as its strength (the largest channel) and a tint. `most`: the upper end of the strength's
// slider.
bool colorAndStrength(const char* id, const char* strengthLabel, vec3& value, float most, const char* format,
                      const char* help);
bool color(const char* label, vec3& value, const char* help);

}  // namespace nephroid
