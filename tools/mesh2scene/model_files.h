#pragma once

#include <assimp/IOSystem.hpp>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace pipeline {

/// The files that assimp may open for a model: the model itself, and regular files in or below its folder. No
/// step of a path leads out of that, neither `..` nor a link. Nothing is written.
class ModelFiles : public Assimp::IOSystem {
 public:
  /// Reads a model and changes to its folder, that of the path as it is; or reads standard input if `path` is
  /// "-", which has no folder and no other files. All files together may have so many megabytes.
  ModelFiles(const std::string& path, std::size_t megabytes);

  /// The model's, for assimp.
  [[nodiscard]] const std::string& base_name() const { return base_name_; }
  [[nodiscard]] std::string_view model() const { return contents_.at(base_name_); }
  /// Names the first file that was not opened because it is not the model's; empty if there is none.
  [[nodiscard]] std::string refusal() const;

  /// A UsageError if one of the files is standard output's.
  void expect_separate_output() const;

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* file) override;
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  bool CreateDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  void take_room(std::size_t bytes, const std::string& name);
  std::string_view read_standard_input();
  std::string_view map(int descriptor, const std::string& name);

  std::string base_name_, refused_, output_;  // files that were not opened, the output as one of them
  std::size_t megabytes_;
  std::size_t room_;  // in bytes, for further files
  bool has_folder_ = false;
  std::string standard_input_;
  std::map<std::string, std::string_view> contents_;  // of the files opened, by assimp's names
};

}  // namespace pipeline
