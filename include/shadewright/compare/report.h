// What `shadewright compare` found, as data, and its three written forms: JSON (the contract), CSV and one HTML page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shadewright/allocation.h"
#include "shadewright/scene/scene.h"

namespace shadewright::compare {

/// Section 6 of the architecture. All counts are pixels of this image, or of all frames' images.
struct ErrorFigures {
  uint64_t wrong = 0, compared = 0, image_pixels = 0;
  double fraction = 0;  ///< wrong / compared
  double match = 1;     ///< 1 - wrong / image_pixels
  uint64_t false_shadow = 0, false_lit = 0;
  uint64_t interior_false_shadow = 0, interior_false_lit = 0;
  std::optional<double> oracle_fraction;  ///< none where the technique has no oracle (null in JSON)
  uint64_t edge_pixels = 0;
  uint64_t boundary_pixels = 0;  ///< compared pixels within 3 pixels of a true edge: what boundary_fraction is of
  double boundary_fraction = 0;
  double mean_absolute = 0;
  std::optional<double> flicker;  ///< none without a camera path
};

struct StageTime {
  std::string name;
  double median = 0;  ///< milliseconds
};

/// Milliseconds over the repeats, or over the frames of a path.
struct Timing {
  double median = 0, min = 0, max = 0;
  std::vector<StageTime> stages;
};

/// One frame of a path.
struct FrameFigures {
  uint64_t wrong = 0;
  double flicker = 0;       ///< against the frame before; 0 in the first
  double milliseconds = 0;  ///< the technique alone; of the first frame, with compiling its shaders
};

struct TechniqueResult {
  std::string technique;  ///< as the user typed it
  std::string spec;       ///< canonical
  ErrorFigures error;
  Timing milliseconds;             ///< the technique alone
  double frame_milliseconds = 0;   ///< with the camera pass, median
  std::vector<Allocation> memory;  ///< along a path: of the frame that had most
  /// One value is written as a number, more as an array. Over a path each value is the frames' largest.
  std::map<std::string, std::vector<double>> counters;
  std::vector<FrameFigures> frames;  ///< along a path, in order; empty for a single view
  // PNGs, relative to the report's folder; empty = none.
  std::string image;       ///< the shaded picture
  std::string mask;        ///< visibility, black to white
  std::string difference;  ///< wrong pixels in colour, transparent elsewhere: the page lays it over the grey truth
  std::vector<std::string> debug;  ///< debug images that were asked for

  uint64_t memory_bytes() const;
};

/// What was compared when it was more than one view.
struct ReportPath {
  std::string name;  ///< of the camera path; empty: the camera keeps still
  uint32_t frames = 0;
  double first_time = 0, last_time = 0;  ///< seconds
  uint32_t pictured = 0;                 ///< the frame that pictures, camera and light are of
  bool light_moves = false;
};

struct Report {
  std::string scene_name;
  uint64_t triangles = 0, instances = 0;
  std::string device_name, device_type;
  uint32_t width = 0, height = 0;
  Camera camera;  ///< in the scene file's coordinates, as the light
  Light light;
  std::optional<ReportPath> path;
  double reference_milliseconds = 0, reference_lit_fraction = 0;
  double camera_pass_milliseconds = 0;
  std::string reference_image, reference_mask;
  std::vector<std::string> notes;  ///< e.g. the camera that was chosen, refused combinations, warnings
  std::vector<TechniqueResult> results;
};

/// The JSON of the contract (schema "shadewright.compare/1"), with two spaces of indentation and a final newline.
std::string to_json(const Report& report);
/// Reads what `to_json` wrote; unknown keys are ignored. InputError for anything else, naming `name`.
Report from_json(const std::string& text, const std::string& name);
/// One row a result, with a header line.
std::string to_csv(const Report& report);

/// One HTML page without any outside reference: `folder` holds the PNGs that the report names; they are embedded.
/// `before`, if given, adds what changed against an earlier report.
std::string to_html(const Report& report, const std::filesystem::path& folder, const Report* before = nullptr);

/// What changed between two reports, a line a technique, for the terminal (`compare --against`).
std::string describe_changes(const Report& before, const Report& after);

}  // namespace shadewright::compare
