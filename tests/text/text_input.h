#pragma once

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <exception>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

/// A text that is read from a descriptor, as from a file.
class TextFile {
 public:
  explicit TextFile(std::string_view text) : descriptor_(::memfd_create("text", MFD_CLOEXEC)) {
    while (!text.empty())
      text.remove_prefix(static_cast<std::size_t>(::write(descriptor_, text.data(), text.size())));
    ::lseek(descriptor_, 0, SEEK_SET);
  }
  ~TextFile() { ::close(descriptor_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// The complete text of the descriptor.
  [[nodiscard]] std::string whole_text() const {
    std::string text(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
    const ssize_t count = ::pread(descriptor_, text.data(), text.size(), 0);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
  }

 private:
  int descriptor_;
};

/// A descriptor that delivers one piece of text per read, as a slow neighbor in a pipe may do.
class TextInPieces {
 public:
  /// The state of the pipe after the last piece. `silence` is a neighbor that neither writes nor ends: a
  /// reader that reads on fails after two seconds instead of waiting forever.
  enum class Then { end, silence };

  explicit TextInPieces(std::vector<std::string> pieces, Then then = Then::end) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return;
    descriptor_ = ends[0];
    other_end_ = ends[1];
    const timeval patience = {.tv_sec = 2, .tv_usec = 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sender_ = std::thread([this, pieces = std::move(pieces), then] {
      for (const std::string& piece : pieces)
        if (::send(other_end_, piece.data(), piece.size(), MSG_NOSIGNAL) < 0) break;
      if (then == Then::end) ::shutdown(other_end_, SHUT_WR);
    });
  }
  ~TextInPieces() {
    ::shutdown(descriptor_, SHUT_RDWR);
    sender_.join();
    ::close(descriptor_);
    ::close(other_end_);
  }
  TextInPieces(const TextInPieces&) = delete;
  TextInPieces& operator=(const TextInPieces&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// The text cut into single bytes.
  static std::vector<std::string> bytes_of(std::string_view text) {
    std::vector<std::string> pieces;
    for (const char c : text) pieces.emplace_back(1, c);
    return pieces;
  }

 private:
  int descriptor_ = -1;
  int other_end_ = -1;
  std::thread sender_;
};

/// The message of the exception that `action` throws.
template <typename Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// A text, and the error that it causes, without the file's name; none if the text is correct.
struct Refusal {
  std::string text, error;
};
