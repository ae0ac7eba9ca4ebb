#include "libpipeline/text/text_writer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "libpipeline/text/error.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

/// The sizes of the blocks that `use` writes. A packet socket keeps the boundaries between writes.
template <typename Use>
std::vector<std::size_t> block_sizes_of(Use&& use) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return {};
  std::vector<std::size_t> sizes;
  std::thread receiver([&] {
    std::vector<char> block(1 << 20);
    for (ssize_t size = 0; (size = ::read(ends[1], block.data(), block.size())) > 0;)
      sizes.push_back(static_cast<std::size_t>(size));
  });
  TextWriter writer(ends[0], "out.txt");
  use(writer);
  ::shutdown(ends[0], SHUT_WR);
  receiver.join();
  ::close(ends[0]);
  ::close(ends[1]);
  return sizes;
}

class FullDevice {
 public:
  FullDevice() : descriptor_(::open("/dev/full", O_WRONLY | O_CLOEXEC)) {}
  ~FullDevice() { ::close(descriptor_); }
  FullDevice(const FullDevice&) = delete;
  FullDevice& operator=(const FullDevice&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

TEST(WriteAll, GivesTheReasonOfAFailure) {
  EXPECT_EQ(try_write_all(FullDevice().descriptor(), "abc"), ENOSPC);
  EXPECT_EQ(message_of([] { write_all(FullDevice().descriptor(), "abc", "out.bmp"); }),
            "cannot write out.bmp: No space left on device");
}

TEST(TextWriter, WritesNothingBeforeItIsFlushed) {
  const TextFile file("");
  TextWriter writer(file.descriptor(), "out.txt");
  writer.append("abc");
  EXPECT_EQ(file.whole_text(), "");
  EXPECT_EQ(writer.bytes_written(), 0u);
  writer.flush();
  EXPECT_EQ(file.whole_text(), "abc");
}

TEST(TextWriter, WritesNothingOnDestruction) {
  const TextFile file("");
  { TextWriter(file.descriptor(), "out.txt").append("abc"); }
  EXPECT_EQ(file.whole_text(), "");
}

TEST(TextWriter, ReservedRoomCountsAsFarAsItIsCommitted) {
  const TextFile file("");
  TextWriter writer(file.descriptor(), "out.txt");
  char* const out = writer.reserve(100);
  std::copy_n("abc", 3, out);
  writer.commit(out + 3);
  writer.append("d");
  writer.flush();
  EXPECT_EQ(file.whole_text(), "abcd");
}

TEST(TextWriter, KeepsEveryByteInItsOrder) {
  const TextFile file("");
  TextWriter writer(file.descriptor(), "out.txt");
  std::string expected;
  const auto append = [&](const std::string& text) {
    writer.append(text);
    expected += text;
  };
  for (int i = 0; i < 50000; ++i) append(std::to_string(i) + "\n");
  for (const std::size_t length : {32767u, 32768u, 65535u, 65536u, 1000000u}) {
    append("before");
    append(std::string(length, 'x'));
  }
  append("after");
  writer.flush();
  EXPECT_TRUE(file.whole_text() == expected);
  EXPECT_EQ(writer.bytes_written(), expected.size());
}

TEST(TextWriter, WritesBlocksOfAtMostWhatAPipeHolds) {
  const auto sizes = block_sizes_of([](TextWriter& writer) {
    for (int i = 0; i < 100000; ++i) writer.append("0.1234567\n");
    writer.append(std::string(200000, 'x'));
    writer.flush();
  });
  EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 65536u);
}

TEST(TextWriter, WaitsUntilABlockIsFull) {
  const auto sizes = block_sizes_of([](TextWriter& writer) {
    for (int i = 0; i < 65536; ++i) writer.append("0.1234567\n");
    writer.flush();
  });
  EXPECT_LE(sizes.size(), 21u);  // 655360 bytes are 10 blocks; each may leave a few bytes for the next write
}

TEST(TextWriter, GoesOnAfterShortAndInterruptedWrites) {
  // Signals without SA_RESTART interrupt a write to a full pipe before or after its first byte.
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::fcntl(ends[1], F_SETPIPE_SZ, 4096);
  std::string received;
  sigset_t alarm_only;
  ::sigemptyset(&alarm_only);
  ::sigaddset(&alarm_only, SIGALRM);
  ::pthread_sigmask(SIG_BLOCK, &alarm_only, nullptr);  // inherited by the receiver
  std::thread receiver([&] {
    char block[1000];
    for (ssize_t size = 0; (size = ::read(ends[0], block, sizeof block)) > 0;) {
      received.append(block, static_cast<std::size_t>(size));
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  ::sigaction(SIGALRM, &action, nullptr);
  const itimerval often = {{0, 500}, {0, 500}};
  ::setitimer(ITIMER_REAL, &often, nullptr);
  ::pthread_sigmask(SIG_UNBLOCK, &alarm_only, nullptr);

  const std::string text = [] {
    std::string numbers;
    for (int i = 0; i < 40000; ++i) numbers += std::to_string(i) + "\n";
    return numbers;
  }();
  TextWriter writer(ends[1], "out.txt");
  writer.append(text);
  writer.flush();

  const itimerval never = {};
  ::setitimer(ITIMER_REAL, &never, nullptr);
  ::close(ends[1]);
  receiver.join();
  ::close(ends[0]);
  EXPECT_TRUE(received == text) << received.size() << " of " << text.size() << " bytes";
}

TEST(TextWriter, ADiskThatFillsInTheMiddleOfABlockIsAnError) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const TextFile file("");
  TextWriter writer(file.descriptor(), "out.txt");
  const rlimit small = {100000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = message_of([&] { writer.append(std::string(150000, 'x')), writer.flush(); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(error, "cannot write out.txt: File too large");
  EXPECT_EQ(file.whole_text().size(), 100000u);
}

TEST(TextWriter, AFullDiskIsAnErrorThatNamesTheFileAndTheReason) {
  const FullDevice full;
  TextWriter writer(full.descriptor(), "out.txt");
  writer.append("abc");
  EXPECT_EQ(message_of([&] { writer.flush(); }), "cannot write out.txt: No space left on device");
  TextWriter longer(full.descriptor(), "out.txt");
  EXPECT_EQ(message_of([&] { longer.append(std::string(100000, 'x')); }),
            "cannot write out.txt: No space left on device");
}

TEST(TextWriter, AFullDiskIsAnErrorAlsoBeforeTheLastBlock) {
  const FullDevice full;
  TextWriter writer(full.descriptor(), "out.txt");
  for (int i = 0; i < 3; ++i) writer.append(std::string(30000, 'x'));
  EXPECT_EQ(message_of([&] { writer.append("y"); }), "cannot write out.txt: No space left on device");
}

TEST(TextWriter, MayOnlyCollect) {
  TextWriter writer;
  for (int i = 0; i < 3; ++i) writer.append(std::string(100000, 'x'));
  writer.flush();
  EXPECT_EQ(writer.collected(), std::string(300000, 'x'));
}

TEST(TextWriter, WhatCouldNotBeWrittenIsNotTriedAgain) {
  const FullDevice full;
  TextWriter writer(full.descriptor(), "out.txt");
  writer.append("abc");
  EXPECT_THROW(writer.flush(), IoError);
  EXPECT_NO_THROW(writer.flush());
}

TEST(TextWriter, AClosedReaderIsABrokenPipe) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::close(ends[0]);
  TextWriter writer(ends[1], "out.txt");
  writer.append("abc");
  try {
    writer.flush();
    FAIL() << "no error";
  } catch (const IoError& error) {
    EXPECT_EQ(error.error_number(), EPIPE);
  }
  ::close(ends[1]);
}

}  // namespace
}  // namespace pipeline
