#include "libpipeline/text/text_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

constexpr std::size_t kFlushedSize = std::size_t{1} << 16;
// A text of at least this length is written without being copied.
constexpr std::size_t kLongText = kFlushedSize / 2;

}  // namespace

int try_write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  if (const int error = try_write_all(descriptor, bytes)) throw IoError("write", path, error);
}

TextWriter::TextWriter(int descriptor, std::string file) : descriptor_(descriptor), file_(std::move(file)) {
  reserve(2 * kFlushedSize);
}

void TextWriter::append(std::string_view text) {
  if (descriptor_ != kNowhere && text.size() >= kLongText) {
    flush();
    return write(text);
  }
  char* const out = reserve(text.size());
  std::memcpy(out, text.data(), text.size());
  commit(out + text.size());
}

char* TextWriter::reserve(std::size_t size) {
  if (end_ >= kFlushedSize) flush();
  if (buffer_size_ - end_ < size) {
    const std::size_t larger_size = std::max(end_ + size, 2 * buffer_size_);
    std::unique_ptr<char[]> larger = std::make_unique_for_overwrite<char[]>(larger_size);
    std::copy_n(buffer_.get(), end_, larger.get());
    buffer_ = std::move(larger);
    buffer_size_ = larger_size;
  }
  return buffer_.get() + end_;
}

void TextWriter::flush() {
  if (descriptor_ == kNowhere) return;
  const std::string_view text = collected();
  end_ = 0;
  write(text);
}

void TextWriter::write(std::string_view text) {
  while (!text.empty()) {
    const std::string_view block = text.substr(0, kFlushedSize);
    write_all(descriptor_, block, file_);
    text.remove_prefix(block.size());
    bytes_written_ += block.size();
  }
}

}  // namespace pipeline
