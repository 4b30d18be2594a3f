#include "report/report_folder.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "report/report_json.h"
#include "report/report_page.h"
#include "report/report_pictures.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "index.html";
constexpr const char* kNumbers = "report.json";

// Names of the files that the report in a folder consists of; none where there is no report.
std::vector<std::string> filesOfReport(const fs::path& folder) {
  std::ifstream stream(folder / kNumbers);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || json.value("format", "") != kReportFormat || !json.contains("files")) return {};
  std::vector<std::string> files;
  for (const auto& file : json["files"])
    if (file.is_string()) files.push_back(file);
  return files;
}

class ImageFiles {
 public:
  ImageFiles(const Comparison& comparison, const fs::path& folder)
      : comparison_(comparison), folder_(folder) {}

  void write(const SideBySide& side, const SidePictures& pictures, std::optional<std::size_t> sensor) {
    const PictureView& view = pictures.views.front();
    write("reference", side.reference.image, side.reference.attributes, view.reference, sensor);
    for (std::size_t i = 0; i < side.techniques.size(); ++i) {
      const TechniqueResult& technique = side.techniques[i];
      write(technique.stats.technique, technique.image, technique.attributes, view.techniques[i], sensor);
    }
  }

  const std::vector<std::string>& names() const { return names_; }

 private:
  void write(const std::string& what, const Image& image, const std::vector<ImageAttribute>& attributes,
             const ByteImage& picture, std::optional<std::size_t> sensor) {
    names_.push_back(reportFileName(comparison_, what, sensor, ".exr"));
    writeExr(folder_ / names_.back(), image, attributes);
    names_.push_back(reportFileName(comparison_, what, sensor, ".png"));
    writePng(folder_ / names_.back(), picture);
  }

  const Comparison& comparison_;
  const fs::path& folder_;
  std::vector<std::string> names_;
};

}  // namespace

void checkReportFolder(const fs::path& folder) {
  checkFolderWritable(folder);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  const std::vector<std::string> known = filesOfReport(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          "the folder '" + folder.string() + "' holds '" + name +
          "', which is no part of a report; name a new folder, an empty one or that of a report");
  }
}

void writeReport(const fs::path& folder, const Comparison& comparison) {
  checkReportFolder(folder);
  const ComparisonErrors errors = errorsOf(comparison);
  AtomicFolder written(folder);
  ImageFiles images(comparison, written.temporary());
  ReportPictures pictures;
  pictures.view = picturesOf(comparison.view, errors.view, comparison.toneMapping);
  images.write(comparison.view, pictures.view, std::nullopt);
  for (std::size_t i = 0; i < comparison.sensors.size(); ++i) {
    pictures.sensors.push_back(picturesOf(comparison.sensors[i], errors.sensors[i], comparison.toneMapping));
    images.write(comparison.sensors[i], pictures.sensors.back(), i);
  }
  std::vector<std::string> files{kPage, kNumbers};
  files.insert(files.end(), images.names().begin(), images.names().end());
  const std::string numbers = reportJson(comparison, errors, files);
  writeFileAtomically(written.temporary() / kNumbers, numbers);
  writeFileAtomically(written.temporary() / kPage, reportPage(comparison.scene, numbers, pictures));
  written.commit();
}

}  // namespace nephroid
