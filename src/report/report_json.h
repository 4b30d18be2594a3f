// The numbers of a report.
#pragma once

#include <string>
#include <vector>

#include "report/comparison.h"

namespace nephroid {

struct ComparisonErrors {
  std::vector<Errors> view;
  std::vector<std::vector<Errors>> sensors;
};

ComparisonErrors errorsOf(const Comparison& comparison);

// The name of a file of the report. `what`: the reference or a technique. `sensor`: index of the sensor; none
// for the camera.
std::string reportFileName(const Comparison& comparison, const std::string& what,
                           std::optional<std::size_t> sensor, const std::string& extension);

// The format entry in report.json, by which a folder is recognized as a report.
inline constexpr const char* kReportFormat = "nephroid report 1";

// The text of report.json. NaN and missing numbers are null. `files`: all files of the report.
std::string reportJson(const Comparison& comparison, const ComparisonErrors& errors,
                       const std::vector<std::string>& files);

}  // namespace nephroid
