#include "papers/curves.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace nephroid {
namespace {

constexpr float kWidth = 420, kHeight = 300, kMargin = 56;  // pixels, of one chart
constexpr const char* kLeftColor = "#1f5fa8";
constexpr const char* kRightColor = "#b8501e";

float largest(const Curve& curve, int axis) {
  float most = 0;
  for (const vec2 point : curve.points) most = std::max(most, point[axis]);
  return most > 0 ? most : 1;
}

// Up to the next 1, 2 or 5 with zeros.
float rounded(float value) {
  const float power = std::pow(10.0f, std::floor(std::log10(value)));
  for (const float step : {1.0f, 2.0f, 5.0f})
    if (value <= step * power) return step * power;
  return 10 * power;
}

class Drawing {
 public:
  Drawing(std::ostringstream& svgText, float leftEdge) : svg_(svgText), left_(leftEdge) {}

  void draw(const Chart& chart) {
    const float xMost = std::max(largest(chart.left, 0), largest(chart.right, 0));
    text(left_ + kWidth / 2, 20, "middle", "#000", chart.title);
    text(left_ + kWidth / 2, kHeight - 10, "middle", "#000", chart.xName);
    svg_ << "<rect x='" << left_ + kMargin << "' y='" << kMargin << "' width='" << kWidth - 2 * kMargin
         << "' height='" << kHeight - 2 * kMargin << "' fill='none' stroke='#888'/>\n";
    for (const float part : {0.0f, 0.5f, 1.0f})
      text(left_ + kMargin + part * (kWidth - 2 * kMargin), kHeight - kMargin + 16, "middle", "#000",
           number(part * xMost));
    drawCurve(chart.left, xMost, kLeftColor, false);
    drawCurve(chart.right, xMost, kRightColor, true);
  }

 private:
  static std::string number(float value) {
    std::ostringstream out;
    out << std::setprecision(3) << value;
    return out.str();
  }

  void text(float x, float y, const char* anchor, const char* color, const std::string& words) {
    svg_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "' fill='" << color << "'>"
         << words << "</text>\n";
  }

  void drawCurve(const Curve& curve, float xMost, const char* color, bool isRight) {
    const float yMost = rounded(largest(curve, 1));
    const float edge = isRight ? left_ + kWidth - kMargin + 6 : left_ + kMargin - 6;
    const char* anchor = isRight ? "start" : "end";
    text(isRight ? left_ + kWidth - 6 : left_ + 6, kMargin - 14, isRight ? "end" : "start", color,
         curve.name);
    for (const float part : {0.0f, 0.5f, 1.0f})
      text(edge, kHeight - kMargin - part * (kHeight - 2 * kMargin) + 4, anchor, color, number(part * yMost));
    svg_ << "<polyline fill='none' stroke='" << color << "' stroke-width='2' points='";
    for (const vec2 point : curve.points)
      svg_ << left_ + kMargin + point.x / xMost * (kWidth - 2 * kMargin) << ','
           << kHeight - kMargin - point.y / yMost * (kHeight - 2 * kMargin) << ' ';
    svg_ << "'/>\n";
  }

  std::ostringstream& svg_;
  float left_;
};

}  // namespace

std::string chartsSvg(const std::vector<Chart>& charts) {
  std::ostringstream svg;
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kWidth * float(charts.size()) << "' height='"
      << kHeight
      << "' font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='#fff'/>\n";
  for (std::size_t i = 0; i < charts.size(); ++i) Drawing(svg, kWidth * float(i)).draw(charts[i]);
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace nephroid
