// Which sheets of light are cut further: those whose light, where it lands, is off by the most.
#pragma once

#include "beams/ray_mesh/light_sheets.h"
#include "beams/ray_mesh/widened_beams.h"

namespace nephroid {

// What a sheet leaves where it lands.
struct Landing {
  vec3 flux{0};         // lm
  float luminance = 0;  // lm
  float area = 0;       // m2
  float width = 0;      // m, across its longest side
  float longest = 0;    // m
  float point = 0;      // m, side of a receiver's point there: of a pixel of the picture, or of the sensor's
  float detail = 0;     // m, of a receiver's point, or of what the lamp's size leaves
  vec2 blur{0};         // m, standard deviations of the lamp's image, the least first
  bool isMirrored = false;  // its corners have changed sides: light is past an odd number of folds
  bool isWanted = true;
};

// Sums over the sheets that meet at a node. Double, so that what is taken away leaves nothing.
struct Around {
  double flux = 0;             // lm
  double incident = 0;         // lm, before any boundary took of it
  double area = 0;             // m2
  uint32_t count[2] = {0, 0};  // of those that are not mirrored, and of those that are
  float density() const { return area > 0 ? float(flux / area) : 0; }
  float bundling() const { return area > 0 ? float(incident / area) : 0; }
  bool isFold() const { return count[0] > 0 && count[1] > 0; }
};

class Refinement {
 public:
  // All must outlive this.
  Refinement(LightSheets& sheets, const RayMeshSettings& settings, SheetMemory& memory);

  // Cuts sheets that landed until they are within the error asked for, or a bound is met.
  void run(std::vector<Sheet>& landed, Progress& progress);

  // Of sheets that were changed from outside.
  void describeAnew(const std::vector<Sheet>& landed);

  // Adds their beams to `mesh`.
  void emit(const std::vector<Sheet>& landed, RayMesh& mesh);

 private:
  LandedBeam beamOf(const Sheet& sheet, const Landing& landing) const;
  BeamCopies copiesOf(const Sheet& sheet, const Landing& landing) const;
  vec2 blurOf(const Sheet& sheet) const;
  BeamShift shiftOf(const Sheet& sheet) const;
  void describe(const std::vector<Sheet>& landed);
  void include(const Sheet& sheet, const Landing& landing, int sign);
  Landing landingOf(const Sheet& sheet) const;
  double allowedSquares();
  void describeLit();
  double judge(const std::vector<Sheet>& landed);
  double errorSquares(const Sheet& sheet, const Landing& landing) const;
  float steepness(const Sheet& sheet, const Landing& landing) const;
  double chanceSquares(const std::vector<Sheet>& landed) const;
  float pathRadius(const Sheet& sheet, const Landing& landing) const;
  void settleChaotic(std::vector<Sheet>& landed);
  bool cutWorst(std::vector<Sheet>& landed, double squares, Progress& progress);
  bool isFull(const std::vector<Sheet>& landed);

  LightSheets& sheets_;
  const RayMeshSettings& settings_;
  SheetMemory& memory_;
  std::vector<Landing> landings_;
  std::vector<Around> around_;  // by node
  float litArea_ = 0;           // m2
  double litPoints_ = 0;        // the same, in receivers' points
  double mean_ = 0;             // lm/m2, of the points
  uint64_t mostBeams_ = 0;      // those of the settings, or more where casters have many triangles
  double allowed_ = 0;          // as allowedSquares
  std::vector<double> errors_;  // squared, times the points that have them
};

}  // namespace nephroid
