// The page of a report: a single HTML file that needs no other file and no network.
#pragma once

#include <string>
#include <vector>

#include "report/report_pictures.h"

namespace nephroid {

struct ReportPictures {
  SidePictures view;
  std::vector<SidePictures> sensors;
};

// `numbers` is a report.json; the pictures are of the same comparison.
std::string reportPage(const std::string& scene, const std::string& numbers, const ReportPictures& pictures);

}  // namespace nephroid
