#include "report/report_page.h"

#include <nlohmann/json.hpp>

#include "core/image_io.h"
#include "report/false_color.h"
#include "report_page_texts.h"

namespace nephroid {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLegendSteps = 32;

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8u | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63u] : '=';
  }
  return text;
}

Json uriOf(const ByteImage& image) {
  return "data:image/png;base64," + base64(encodePng(image));
}

Json scaleJson(const std::optional<ColorScale>& scale) {
  if (!scale) return {};
  return {{"signed", scale->isSigned}, {"bound", scale->bound}, {"unit", scale->unit}};
}

Json sideJson(const SidePictures& pictures) {
  Json views = Json::array(), maps = Json::array();
  for (const PictureView& view : pictures.views) {
    Json techniques = Json::array();
    for (const ByteImage& technique : view.techniques) techniques.push_back(uriOf(technique));
    views.push_back({{"name", view.name},
                     {"scale", scaleJson(view.scale)},
                     {"reference", uriOf(view.reference)},
                     {"techniques", techniques}});
  }
  for (const std::vector<ErrorMap>& ofTechnique : pictures.maps) {
    Json list = Json::array();
    for (const ErrorMap& map : ofTechnique)
      list.push_back({{"name", map.name}, {"scale", scaleJson(map.scale)}, {"image", uriOf(map.picture)}});
    maps.push_back(list);
  }
  return {{"views", views}, {"maps", maps}};
}

std::string cssColor(const SrgbColor& color) {
  return "rgb(" + std::to_string(color[0]) + " " + std::to_string(color[1]) + " " + std::to_string(color[2]) +
         ")";
}

Json legendsJson() {
  Json magnitude = Json::array(), sign = Json::array();
  for (int i = 0; i <= kLegendSteps; ++i) {
    const float part = float(i) / float(kLegendSteps);
    magnitude.push_back(cssColor(magnitudeColor(part)));
    sign.push_back(cssColor(signedColor(2 * part - 1)));
  }
  return {{"magnitude", magnitude}, {"signed", sign}, {"none", cssColor(kNoValueColor)}};
}

// JSON inside a script element: nothing in it may end the element.
std::string insideScript(std::string json) {
  for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3)
    json.replace(at, 2, "<\\/");
  for (std::size_t at = 0; (at = json.find("<!", at)) != std::string::npos; at += 6)
    json.replace(at, 2, "<\\u0021");
  return json;
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

}  // namespace

std::string reportPage(const std::string& scene, const std::string& numbers, const ReportPictures& pictures) {
  Json shown{{"view", sideJson(pictures.view)}, {"sensors", Json::array()}, {"legends", legendsJson()}};
  for (const SidePictures& sensor : pictures.sensors) shown["sensors"].push_back(sideJson(sensor));
  const std::pair<std::string, std::string> parts[] = {
      {"TITLE", escaped(scene)},
      {"STYLE", report_page_css},
      {"NUMBERS", insideScript(numbers)},
      {"PICTURES", insideScript(shown.dump(-1, ' ', false, Json::error_handler_t::replace))},
      {"SCRIPT", report_page_js}};
  std::string page(report_page_html);
  std::size_t at = 0;
  for (const auto& [name, text] : parts) {
    const std::string mark = "{{" + name + "}}";
    at = page.find(mark, at);
    page.replace(at, mark.size(), text);
    at += text.size();
  }
  return page;
}

}  // namespace nephroid
