#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/scene/camera.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tools/rim/command_line.h"
#include "tools/rim/tool.h"

namespace pipeline {

/// `--digits` and `--precision`: the calculation and the printing of coordinates.
class NumberOptions {
 public:
  explicit NumberOptions(CommandLine& options);

  [[nodiscard]] NumberFormat format() const;
  /// A rounder for coordinates whose vertices come from `file`.
  [[nodiscard]] CoordinateRounder rounder(const std::string& file) const;
  /// Makes `rounder` keep within its rounding error, and returns that error, to be added to bounds. A
  /// UsageError unless the precision is extended.
  [[nodiscard]] ErrorBound kept_bounds(CoordinateRounder& rounder) const;

 private:
  std::string digits_ = std::to_string(NumberFormat().decimals);
  Precision precision_ = Precision::extended;
};

/// The camera as options, and `--scene`, which takes it from a scene file.
class CameraOptions {
 public:
  /// The parts of the camera that a tool uses.
  enum class Parts { position_and_projection, projection };

  CameraOptions(CommandLine& options, Parts parts);

  /// The argument of --scene.
  [[nodiscard]] NamedFile scene() const { return file_or_stream("--scene", scene_path_, kStandardInput); }
  /// The camera from the options; parts missing there come from the scene, and parts missing in both from
  /// `header`. An InputError, located at the option or in the scene, if a part is wrong.
  [[nodiscard]] CameraParameters camera(const CameraParameters& header, const Tool& tool) const;

 private:
  // By option name, as they stand on the command line.
  std::map<std::string, std::vector<std::string>> words_;
  std::string scene_path_;
};

/// `--light`, an additional light, and `--light-at`, which moves one of the text's lights.
class LightOption {
 public:
  explicit LightOption(CommandLine& options);

  /// The option that is given; empty if neither is.
  [[nodiscard]] std::string name() const {
    return !words_.empty() ? "--light" : !at_.empty() ? "--light-at" : "";
  }
  /// Moves or adds the light, if given; an error names the option if a number is wrong.
  void apply_to(Appearance& appearance) const;

 private:
  std::vector<std::string> words_, at_;
};

/// The projection as options, `--scene`, and `--aspect`, the meaning of a perspective's aspect.
class ProjectionOptions {
 public:
  explicit ProjectionOptions(CommandLine& options);

  [[nodiscard]] NamedFile scene() const { return camera_.scene(); }
  /// The projection from the options, else from the scene, else from the text's header. An InputError if
  /// there is none.
  [[nodiscard]] Located<Projection> projection(const StageReader& reader, const Tool& tool) const;

 private:
  CameraOptions camera_;
  std::optional<AspectRule> aspect_;  // none: the perspective's own
};

}  // namespace pipeline
