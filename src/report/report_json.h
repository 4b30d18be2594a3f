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

// The name of a file of the report: what it shows is the reference or a technique, through the camera
// (`sensor` none) or on a sensor.
std::string reportFileName(const Comparison& comparison, const std::string& what,
                           std::optional<std::size_t> sensor, const std::string& extension);

// What a report.json says of itself, and how a folder is known to be a report.
inline constexpr const char* kReportFormat = "nephroid report 1";

// report.json. Numbers that there are none of are null. `files`: all that the report consists of.
std::string reportJson(const Comparison& comparison, const ComparisonErrors& errors,
                       const std::vector<std::string>& files);

}  // namespace nephroid
