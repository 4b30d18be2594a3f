// A report on disk: index.html, report.json, and the images as EXR and PNG.
#pragma once

#include <filesystem>

#include "report/comparison.h"

namespace nephroid {

// Throws InputError where the folder holds anything that no report has written, and RuntimeFailure where none
// can be made there; to be asked before the work.
void checkReportFolder(const std::filesystem::path& folder);

// There whole or not at all; takes the place of a report that was there. Throws as checkReportFolder does.
void writeReport(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace nephroid
