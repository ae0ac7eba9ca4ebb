#include "libpipeline/text/text_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

constexpr std::size_t kBlockSize = std::size_t{1} << 16;
// Texts from this length on are written from where they are.
constexpr std::size_t kLongText = kBlockSize / 2;

}  // namespace

TextWriter::TextWriter(int descriptor, std::string file)
    : descriptor_(descriptor), file_(std::move(file)), buffer_(2 * kBlockSize) {}

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
  if (end_ >= kBlockSize) flush();
  if (buffer_.size() - end_ < size) buffer_.resize(end_ + size);
  return buffer_.data() + end_;
}

void TextWriter::commit(const char* end) {
  end_ = static_cast<std::size_t>(end - buffer_.data());
}

void TextWriter::flush() {
  if (descriptor_ == kNowhere) return;
  const std::string_view text = collected();
  end_ = 0;
  write(text);
}

void TextWriter::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), std::min(text.size(), kBlockSize));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw IoError("write", file_, errno);
    text.remove_prefix(static_cast<std::size_t>(count));
    bytes_written_ += static_cast<std::size_t>(count);
  }
}

}  // namespace pipeline
