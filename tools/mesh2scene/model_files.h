#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pipeline {

/// The files that a model may consist of: the model itself, and regular files in or below its folder. No step
/// of a path, neither `..` nor a link, may lead out of the folder. Nothing is written.
class ModelFiles {
 public:
  /// Reads a model and changes to the folder of `path`, as given; or reads standard input if `path` is "-",
  /// which has no folder and no other files. All files together may have at most `megabytes`, and none
  /// may be standard output or one of `written`.
  ModelFiles(const std::string& path, std::size_t megabytes, const std::vector<std::string>& written);

  [[nodiscard]] std::string_view model() const { return model_; }
  /// The bytes of the model and all other files that were read.
  [[nodiscard]] std::size_t size() const { return megabytes_ * 1'000'000 - room_; }
  /// The bytes of another file; nothing if it is not opened. If the path leads nowhere, its last part is
  /// tried in the model's folder. A UsageError if it is an output.
  std::optional<std::string_view> read(const std::string& file);
  /// Names the first file not opened because the model must not use it; empty if there is none.
  [[nodiscard]] std::string refusal() const;

 private:
  void take_room(std::size_t bytes, const std::string& name);
  std::string_view read_standard_input();
  std::string_view map(int descriptor, const std::string& name);

  using Inode = std::pair<std::uint64_t, std::uint64_t>;  // and its device
  std::map<Inode, std::string> outputs_;
  std::map<Inode, std::string_view> mapped_;
  std::string_view model_;
  std::string refused_;  // the file that refusal() names
  std::size_t megabytes_;
  std::size_t room_;  // in bytes, for further files
  bool has_folder_ = false;
  std::string standard_input_;
};

}  // namespace pipeline
