#pragma once

#include <map>
#include <string>
#include <vector>

#include "libpipeline/scene/camera.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tools/command_line.h"
#include "tools/tool.h"

namespace pipeline {

/// `--digits` and `--precision`: how coordinates are calculated and printed. Also takes `--threads`, which
/// changes nothing.
class NumberOptions {
 public:
  explicit NumberOptions(CommandLine& options);

  [[nodiscard]] NumberFormat format() const;
  /// A rounder for coordinates whose vertices come from `file`.
  [[nodiscard]] CoordinateRounder rounder(const std::string& file) const;

 private:
  std::string digits_ = "7";
  Precision precision_ = Precision::extended;
  int ignored_thread_count_ = 1;
};

/// The camera as options, and `--scene`, which takes it from a scene file.
class CameraOptions {
 public:
  /// Which parts of the camera a tool uses.
  enum class Parts { position_and_projection, projection };

  CameraOptions(CommandLine& options, Parts parts);

  /// The camera from the options, what they leave out from the scene, what that leaves out from `header`.
  /// What is wrong is an InputError whose place is the option or lies in the scene.
  [[nodiscard]] CameraParameters camera(const CameraParameters& header, const Tool& tool) const;

 private:
  std::map<std::string, std::vector<std::string>>
      words_;  // by option name, as they stand on the command line
  std::string scene_path_;
};

}  // namespace pipeline
