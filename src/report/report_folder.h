// A report on disk: index.html, report.json, and the images as EXR and PNG.
#pragma once

#include <filesystem>

#include "report/comparison.h"

namespace nephroid {

// To be called before the work. Throws InputError where the folder holds files that are not from a report,
// RuntimeFailure where the folder cannot be created.
void checkReportFolder(const std::filesystem::path& folder);

// Writes the report completely or not at all, and replaces an old report. Throws as checkReportFolder does.
void writeReport(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace nephroid
