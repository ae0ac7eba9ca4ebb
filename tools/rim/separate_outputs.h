#pragma once

#include <string>
#include <vector>

namespace pipeline {

/// A file that a run reads or writes.
struct NamedFile {
  std::string name;          // the option or operand that gives its path
  std::string path;          // empty if there is no such file
  bool is_in_place = false;  // an output and an input that are both in place may be one file
};

inline const NamedFile kStandardInput = {"standard input", "/dev/stdin"};
inline const NamedFile kStandardOutput = {"standard output", "/dev/stdout"};
inline const NamedFile kStandardError = {"standard error", "/dev/stderr"};

/// The file of an option or operand whose "-" means `stream`.
inline NamedFile file_or_stream(const std::string& name, const std::string& path, const NamedFile& stream) {
  return path == "-" ? stream : NamedFile{name, path};
}

/// Throws a UsageError if an output of a run would share a regular file or a pipe with another output (one
/// would replace the other, or both would mix) or with an input. Devices may be shared. Standard output and
/// standard error may be one file or pipe, and an output may replace an input if both are in place.
void expect_separate(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

}  // namespace pipeline
