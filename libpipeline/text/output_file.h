#pragma once

#include <string>

namespace pipeline {

/// A file that appears complete or not at all: it is written beside its place, in the same folder, and
/// put into it by `commit`. Without `commit` (an exception, say) what was written is removed and a file
/// that was there before stays as it was. Every failure is an IoError that names the path as given.
///
/// Where the file system can (O_TMPFILE), the file has no name until `commit`: nothing is left of it even if
/// the process is killed. A link cannot take an older file's place, so then it gets a temporary name and is
/// renamed at once; a process killed between these two calls leaves the complete file under the temporary
/// name. Elsewhere it has that name from the beginning, and a killed process leaves what was written so far.
///
/// A new file gets the permissions a plain creat gives, a replaced one keeps its own; one that must not be
/// written is not replaced either. A symbolic link stays, the file it points at is replaced. What exists and
/// is no regular file (a device, a pipe) and /dev/stdout and the like are written directly.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Open for writing until `close`.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Ends the writing; the last moment at which the system may say that data were lost. With several files,
  /// close all before the first is committed.
  void close();
  /// Closes the file, if that was not done yet, and puts it in its place.
  void commit();

 private:
  void open_directly(int own_descriptor);
  void open_beside(bool exists, unsigned mode);
  [[nodiscard]] bool open_unnamed(const std::string& folder, unsigned mode);
  void link_into_place();
  [[nodiscard]] std::string temporary_name(int attempt) const;

  std::string path_;
  std::string target_;          // where the symbolic links lead
  std::string temporary_path_;  // empty if there is nothing to rename or to remove
  int descriptor_ = -1;
  int unnamed_ = -1;  // a file without a name, open until it gets one
};

}  // namespace pipeline
