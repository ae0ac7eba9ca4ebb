#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>

namespace pipeline {

/// The place that an output goes to or an input comes from: a regular file, a pipe, or a name in a folder
/// that has no such file yet.
struct FilePlace {
  dev_t device = 0;
  ino_t inode = 0;   // of the file; of the folder if the file does not exist
  std::string name;  // empty if the file exists

  bool operator==(const FilePlace&) const = default;
};

/// The place of the file `path`: links are followed, so all names of a file give one place. Nothing if
/// opening will fail, or for a device or a socket, which several outputs may share. An IoError if symbolic
/// links form a cycle, and for a descriptor that is not open: another file might get it later.
std::optional<FilePlace> place_of(const std::string& path);

/// True if an OutputFile `path` would be a new file or replace a regular one; others are written to directly.
bool is_replaced(const std::string& path);

/// Notes a path that this process is about to make and that must not be left if it fails or is ended by a
/// signal: a file, or a folder of such files.
void add_unfinished(const std::string& path);
/// Keeps all noted paths: each is complete.
void keep_unfinished();
/// Removes the noted paths and the temporary files of all OutputFiles, the last one first; true if there were
/// any. A handler of SIGINT, SIGTERM and SIGHUP may call it.
bool remove_unfinished() noexcept;

/// A file that appears complete or not at all: it is written without a name, or under a temporary one in the
/// same folder, and `commit` gives it its name. Without `commit` (an exception, say) the data are removed and
/// an existing file stays as it was. Every failure is an IoError that names the path as given. Where the file
/// system supports it (O_TMPFILE), the file has no name until `commit`: nothing is left of it even if the
/// process is killed. A link cannot replace an existing file, so then the new file gets a temporary name and
/// is renamed at once; a process killed between these two calls leaves the complete file under the temporary
/// name. On other file systems it has the temporary name from the beginning, and a killed process leaves the
/// data written so far.
/// A new file gets the permissions that creat would set, a replaced file keeps its own; a read-only file is
/// not replaced. A symbolic link stays, and the file it points at is replaced. An existing file that is not
/// regular (a device, a pipe), /dev/stdout and the like are written directly.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Open for writing until `close`.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Ends writing: the last moment at which the system may report lost data. When writing several files,
  /// close all of them before committing the first.
  void close();
  /// Closes the file if it is still open, and gives it its name.
  void commit();

 private:
  void open_directly(int own_descriptor);
  void open_beside(bool exists, unsigned mode);
  [[nodiscard]] bool open_unnamed(const std::string& folder, unsigned mode);
  void link_into_place();
  void make_temporary(const std::function<bool(const std::string&)>& make);
  [[nodiscard]] std::string temporary_name(int attempt) const;

  std::string path_;
  std::string target_;          // where the symbolic links lead
  std::string temporary_path_;  // empty if there is nothing to rename or remove
  int descriptor_ = -1;
  int unnamed_ = -1;  // a file without a name, open until it gets one
};

}  // namespace pipeline
