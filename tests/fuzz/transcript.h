#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>

#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"
#include "libpipeline/text/text_writer.h"
#include "tests/fuzz/require.h"
#include "tests/text/text_input.h"

namespace pipeline {

/// The result of a text: the written text, and the error it ended with, if any.
struct Transcript {
  std::string written;
  std::string mistake;
  friend bool operator==(const Transcript&, const Transcript&) = default;
};

/// Reads a text and writes its result.
using Work = std::function<void(TextReader&, TextWriter&)>;

/// Requires that the line and column of an error lie in the text, or just after it.
inline void require_location_within(const SourceLocation& location, std::string_view text) {
  const auto line_count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  require(location.line >= 1 && location.line <= line_count + 1, "a mistake is on a line of the text");
  for (std::size_t i = 1; i < location.line && !text.empty(); ++i)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  require(location.column <= std::min(text.find('\n'), text.size()) + 1, "a mistake is within its line");
}

inline Transcript transcript(int descriptor, std::string_view text, const Work& work) {
  TextReader reader(descriptor, "in");
  TextWriter writer;
  Transcript result;
  try {
    work(reader, writer);
  } catch (const InputError& error) {
    require_location_within(error.location(), text);
    result.mistake = error.what();
  }
  result.written = writer.collected();
  return result;
}

/// A short text that a reader gets in pieces. A socket buffers it completely, so no thread need send it.
class WaitingPieces {
 public:
  WaitingPieces(std::string_view text, std::size_t piece_size) {
    int ends[2];
    require(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) == 0, "there are sockets");
    descriptor_ = ends[0];
    for (; !text.empty(); text.remove_prefix(std::min(piece_size, text.size())))
      require(::send(ends[1], text.data(), std::min(piece_size, text.size()), MSG_DONTWAIT) > 0,
              "a text is short");
    ::close(ends[1]);
  }
  ~WaitingPieces() { ::close(descriptor_); }
  WaitingPieces(const WaitingPieces&) = delete;
  WaitingPieces& operator=(const WaitingPieces&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// The transcript of `work` on the text; requires that it is the same if the text comes in pieces.
inline Transcript transcript(std::string_view text, const Work& work) {
  const TextFile file(text);
  Transcript whole = transcript(file.descriptor(), text, work);
  const WaitingPieces pieces(text, text.size() / 3 + 1);
  require(transcript(pieces.descriptor(), text, work) == whole, "the sizes of blocks change nothing");
  return whole;
}

}  // namespace pipeline
