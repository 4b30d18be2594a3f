// What the viewer can show in place of the picture and over it, by name.
#pragma once

#include <string>

#include "viewer_state.h"

namespace nephroid {

struct NamedView {
  const char* name;
  std::optional<Overlay> overlay;  // over the picture; without it, in its place:
  const char* pass = "";           // whose output it is
  const char* output = "";         // its name; empty: the first
};

// One of viewNames().
NamedView viewNamed(const std::string& name);

// The output that a view is, if the last frame has it.
const PassOutput* outputOf(const ViewerState& state, const std::string& pass, const std::string& output);

// Shows it from now on.
void showView(const NamedView& view, ViewerState& state);

}  // namespace nephroid
