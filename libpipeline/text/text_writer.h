#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace pipeline {

/// Writes all bytes to a file descriptor, in as many calls as needed. Returns 0, or the errno value of the
/// call that failed.
int try_write_all(int descriptor, std::string_view bytes);

/// try_write_all, but a failure is an IoError that names `path`.
void write_all(int descriptor, std::string_view bytes, const std::string& path);

/// Buffers text and writes it in blocks of at most 64 KiB, the capacity of a pipe: larger blocks would make
/// the stages of a pipeline wait for each other. A failed write is an IoError; the destructor writes nothing.
class TextWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `file` names it in messages.
  TextWriter(int descriptor, std::string file);
  /// A writer that buffers all text and never writes it.
  TextWriter() = default;

  void append(std::string_view text);
  /// Room for at least `size` characters; `commit` marks the end of the filled ones.
  char* reserve(std::size_t size);
  void commit(const char* end) { end_ = static_cast<std::size_t>(end - buffer_.get()); }
  /// Writes the buffered text, unless this writer has no descriptor.
  void flush();
  [[nodiscard]] std::string_view collected() const { return {buffer_.get(), end_}; }

  [[nodiscard]] std::size_t bytes_written() const { return bytes_written_; }

 private:
  void write(std::string_view text);

  static constexpr int kNowhere = -1;
  int descriptor_ = kNowhere;
  std::string file_;
  std::unique_ptr<char[]> buffer_;  // uninitialized: characters are written before they are read
  std::size_t buffer_size_ = 0;
  std::size_t end_ = 0;
  std::size_t bytes_written_ = 0;
};

}  // namespace pipeline
