#include "libpipeline/text/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>

#include "libpipeline/text/text_writer.h"
#include "tests/text/temporary_folder.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

namespace fs = std::filesystem;

void write_text(const OutputFile& file, const std::string& text) {
  TextWriter writer(file.descriptor(), "file");
  writer.append(text);
  writer.flush();
}

void write_and_commit(const std::string& path, const std::string& text) {
  OutputFile file(path);
  write_text(file, text);
  file.commit();
}

mode_t mode_of(const std::string& path) {
  struct stat status = {};
  return ::lstat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

/// Sets the umask during a test.
class Umask {
 public:
  explicit Umask(mode_t mask) : before_(::umask(mask)) {}
  ~Umask() { ::umask(before_); }
  Umask(const Umask&) = delete;
  Umask& operator=(const Umask&) = delete;

 private:
  mode_t before_;
};

/// Runs a test as nobody if root started it, since permissions do not stop root. The real user changes, too,
/// because access() checks it. Processes of other users are not affected.
class Unprivileged {
 public:
  Unprivileged() : was_root_(::geteuid() == 0), is_(!was_root_ || ::setresuid(kNobody, kNobody, 0) == 0) {}
  ~Unprivileged() {
    if (was_root_ && is_) {
      EXPECT_EQ(::setresuid(0, 0, 0), 0);
    }
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;
  explicit operator bool() const { return is_; }

 private:
  static constexpr uid_t kNobody = 65534;
  bool was_root_, is_;
};

/// Calls `check` in a process that sees nothing but the folder: no /proc, no /dev. False if the system does
/// not let this user start one.
bool in_a_bare_root(const TemporaryFolder& folder, const std::function<void()>& check) {
  constexpr int kNotPermitted = 77;
  std::cout.flush();
  const pid_t child = ::fork();
  if (child == 0) {
    const auto enter = [&] { return ::chroot(folder.path("").c_str()) == 0 && ::chdir("/") == 0; };
    if (!enter() && !(::unshare(CLONE_NEWUSER) == 0 && enter())) ::_exit(kNotPermitted);
    try {
      check();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    std::cout.flush();
    ::_exit(testing::Test::HasFailure() ? 1 : 0);
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNotPermitted) return false;
  EXPECT_EQ(WEXITSTATUS(status), 0);
  return true;
}

TEST(OutputFile, WithoutCommitTheOldFileStaysAndNothingElse) {
  const TemporaryFolder folder;
  folder.write("out", "old");
  {
    OutputFile file(folder.path("out"));
    write_text(file, "new");
    EXPECT_EQ(folder.read("out"), "old");
  }
  EXPECT_EQ(folder.read("out"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, WithoutCommitThereIsNoFileAlsoAfterClose) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.path("out"));
    file.close();
    EXPECT_FALSE(fs::exists(folder.path("out")));
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

/// True where the system supports files without a name.
bool has_unnamed_files(const TemporaryFolder& folder) {
  const int descriptor = ::open(folder.path("").c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600);
  if (descriptor >= 0) ::close(descriptor);
  return descriptor >= 0 && fs::exists("/proc/self/fd");
}

TEST(OutputFile, HasNoNameBeforeItsCommit) {
  const TemporaryFolder folder;
  if (!has_unnamed_files(folder)) GTEST_SKIP() << "this file system has no files without a name";
  OutputFile file(folder.path("out"));
  write_text(file, "new");
  EXPECT_EQ(folder.file_count(), 0u);
}

/// Leaves the process one more descriptor: too few for a file without a name.
class OneMoreDescriptor {
 public:
  OneMoreDescriptor() {
    EXPECT_EQ(::getrlimit(RLIMIT_NOFILE, &before_), 0);
    const int next_descriptor = ::open("/dev/null", O_RDONLY);
    ::close(next_descriptor);
    const rlimit one_more = {static_cast<rlim_t>(next_descriptor) + 1, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &one_more), 0);
  }
  ~OneMoreDescriptor() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  OneMoreDescriptor(const OneMoreDescriptor&) = delete;
  OneMoreDescriptor& operator=(const OneMoreDescriptor&) = delete;

 private:
  rlimit before_ = {};
};

/// An output file that has a temporary name before its commit, as on systems without unnamed files.
std::unique_ptr<OutputFile> named_from_the_beginning(const std::string& path) {
  const OneMoreDescriptor limit;
  return std::make_unique<OutputFile>(path);
}

/// The first temporary name this process would choose.
std::string first_temporary_name() {
  return ".pipeline-" + std::to_string(::getpid()) + "-0";
}

TEST(OutputFile, ASignalsHandlerRemovesTheTemporaryNameAndNothingElse) {
  const TemporaryFolder folder;
  const auto file = named_from_the_beginning(folder.path("out"));
  EXPECT_EQ(folder.file_count(), 1u);
  EXPECT_TRUE(remove_unfinished());
  EXPECT_EQ(folder.file_count(), 0u);
  named_from_the_beginning(folder.path("committed"))->commit();
  folder.write("gone", "another's, after ours went");
  { const auto gone = named_from_the_beginning(folder.path("gone")); }
  remove_unfinished();
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(OutputFile, AFileUnderTheTemporaryNameStaysAsItIs) {
  const TemporaryFolder folder;
  folder.write("precious", "another's");
  fs::create_symlink("precious", folder.path(first_temporary_name()));
  const auto file = named_from_the_beginning(folder.path("out"));
  write_text(*file, "new");
  file->commit();
  EXPECT_EQ(folder.read("precious"), "another's");
  EXPECT_TRUE(fs::is_symlink(folder.path(first_temporary_name())));
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.file_count(), 3u);
}

TEST(OutputFile, AFileUnderTheTemporaryNameOfItsReplacementStaysAsItIs) {
  const TemporaryFolder folder;
  folder.write("out", "old");
  folder.write(first_temporary_name(), "another's");
  write_and_commit(folder.path("out"), "new");
  EXPECT_EQ(folder.read(first_temporary_name()), "another's");
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(OutputFile, WithoutAFreeTemporaryNameNothingIsReplacedOrRemoved) {
  const TemporaryFolder folder;
  folder.write("out", "old");
  for (int i = 0; i < 1000; ++i)
    folder.write(".pipeline-" + std::to_string(::getpid()) + "-" + std::to_string(i), "another's");
  const auto message = [&](const std::string& what) {
    return "cannot " + what + " " + folder.path("out") + ": File exists";
  };
  EXPECT_EQ(message_of([&] { write_and_commit(folder.path("out"), "new"); }), message("replace"));
  EXPECT_EQ(message_of([&] { named_from_the_beginning(folder.path("out")); }), message("open"));
  EXPECT_EQ(folder.read("out"), "old");
  EXPECT_EQ(folder.file_count(), 1001u);
}

TEST(OutputFile, WithoutASecondDescriptorItHasATemporaryNameBeforeItsCommit) {
  const TemporaryFolder folder;
  const auto opened = named_from_the_beginning(folder.path("out"));
  OutputFile& file = *opened;
  write_text(file, "new");
  EXPECT_EQ(folder.file_count(), 1u);
  EXPECT_FALSE(fs::exists(folder.path("out")));
  file.commit();
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, WithoutProcItHasATemporaryNameBeforeItsCommit) {
  const TemporaryFolder folder;
  const bool is_permitted = in_a_bare_root(folder, [] {
    OutputFile file("/out");
    write_text(file, "new");
    EXPECT_TRUE(fs::exists("/" + first_temporary_name()));
    EXPECT_FALSE(fs::exists("/out"));
    file.commit();
  });
  if (!is_permitted) GTEST_SKIP() << "this user may not change the root folder";
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, AFileThatAppearedMeanwhileIsReplaced) {
  const TemporaryFolder folder;
  OutputFile file(folder.path("out"));
  write_text(file, "new");
  folder.write("out", "another's");
  file.commit();
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, ANameMayBeAsLongAsTheSystemAllows) {
  const TemporaryFolder folder;
  write_and_commit(folder.path(std::string(255, 'n')), "text");
  EXPECT_EQ(folder.read(std::string(255, 'n')), "text");
}

TEST(OutputFile, ANewFileHasThePermissionsTheUmaskLeaves) {
  const TemporaryFolder folder;
  const Umask mask(026);
  write_and_commit(folder.path("out"), "text");
  EXPECT_EQ(mode_of(folder.path("out")), 0640u);
}

TEST(OutputFile, AReplacedFileKeepsItsPermissions) {
  const TemporaryFolder folder;
  folder.write("out", "old");
  const Umask mask(077);
  for (const mode_t mode : {0664u, 0600u, 0777u}) {
    ::chmod(folder.path("out").c_str(), mode);
    write_and_commit(folder.path("out"), "new");
    EXPECT_EQ(mode_of(folder.path("out")), mode);
  }
}

TEST(OutputFile, AWriteProtectedFileIsNotReplaced) {
  const Unprivileged user;
  if (!user) GTEST_SKIP() << "root may not become another user here";
  const TemporaryFolder folder;
  folder.write("out", "old");
  ::chmod(folder.path("out").c_str(), 0444);
  EXPECT_EQ(message_of([&] { OutputFile file(folder.path("out")); }),
            "cannot open " + folder.path("out") + ": Permission denied");
}

TEST(OutputFile, ASymbolicLinkStaysAndItsFileIsReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("inner"));
  folder.write("inner/file", "old");
  fs::create_symlink("inner/other", folder.path("link"));
  fs::create_symlink("file", folder.path("inner/other"));
  write_and_commit(folder.path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_TRUE(fs::is_symlink(folder.path("inner/other")));
  EXPECT_EQ(folder.read("inner/file"), "new");
}

TEST(OutputFile, ASymbolicLinkToNothingGetsItsFile) {
  const TemporaryFolder folder;
  fs::create_symlink(folder.path("file"), folder.path("link"));
  write_and_commit(folder.path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_EQ(folder.read("file"), "new");
}

/// Links named link-1, link-2 ... that lead, one to the next, to the file "out".
void make_chain(const TemporaryFolder& folder, int length) {
  for (int i = 1; i <= length; ++i)
    fs::create_symlink(i < length ? "link-" + std::to_string(i + 1) : "out",
                       folder.path("link-" + std::to_string(i)));
}

TEST(OutputFile, FollowsAsManyLinksAsTheSystem) {
  constexpr int kMaxLinks = 40;  // path_resolution(7)
  const TemporaryFolder longest, too_long;
  make_chain(longest, kMaxLinks);
  make_chain(too_long, kMaxLinks + 1);
  longest.write("out", "old");
  too_long.write("out", "old");
  ASSERT_EQ(longest.read("link-1"), "old");
  ASSERT_EQ(too_long.read("link-1"), "");
  write_and_commit(longest.path("link-1"), "new");
  EXPECT_EQ(longest.read("out"), "new");
  EXPECT_EQ(message_of([&] { OutputFile file(too_long.path("link-1")); }),
            "cannot open " + too_long.path("link-1") + ": Too many levels of symbolic links");
}

TEST(OutputFile, ANamedPipeIsWrittenDirectly) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("fifo").c_str(), 0600), 0);
  const int reader = ::open(folder.path("fifo").c_str(), O_RDONLY | O_NONBLOCK);
  char text[8] = {};
  write_and_commit(folder.path("fifo"), "text");
  EXPECT_EQ(::read(reader, text, sizeof text), 4);
  EXPECT_EQ(std::string(text), "text");
  EXPECT_TRUE(fs::is_fifo(folder.path("fifo")));
  ::close(reader);
}

TEST(OutputFile, AnOpenFileOfTheProcessIsWrittenFromWhereItStands) {
  const TemporaryFolder folder;
  const int descriptor = ::open(folder.path("out").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(descriptor, "first, ", 7), 7);
  write_and_commit("/dev/fd/" + std::to_string(descriptor), "second, ");
  ASSERT_EQ(::write(descriptor, "third", 5), 5);
  ::close(descriptor);
  EXPECT_EQ(folder.read("out"), "first, second, third");
}

TEST(OutputFile, ANumberTooLargeForADescriptorIsAName) {
  for (const std::string number : {"2147483648", "4294967297"})  // 2^31, 2^32 + 1
    EXPECT_EQ(message_of([&] { OutputFile file("/dev/fd/" + number); }),
              "cannot open /dev/fd/" + number + ": No such file or directory");
}

TEST(OutputFile, StandardOutputAndErrorNeedNoFilesInDev) {
  const TemporaryFolder folder;
  folder.write("out", "");
  const bool is_permitted = in_a_bare_root(folder, [] {
    const int file = ::open("/out", O_WRONLY | O_APPEND);
    const int output = ::dup(STDOUT_FILENO), error = ::dup(STDERR_FILENO);
    ::dup2(file, STDOUT_FILENO);
    write_and_commit("/dev/stdout", "first, ");
    EXPECT_TRUE(place_of("/dev/stdout") == place_of("/out"));
    ::dup2(output, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    write_and_commit("/dev/stderr", "second");
    EXPECT_TRUE(place_of("/dev/stderr") == place_of("/out"));
    ::dup2(error, STDERR_FILENO);
  });
  if (!is_permitted) GTEST_SKIP() << "this user may not change the root folder";
  EXPECT_EQ(folder.read("out"), "first, second");
}

/// Closes standard input during a test, so that the next file gets descriptor 0.
class NoStandardInput {
 public:
  NoStandardInput() : before_(::dup(STDIN_FILENO)) { ::close(STDIN_FILENO); }
  ~NoStandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  NoStandardInput(const NoStandardInput&) = delete;
  NoStandardInput& operator=(const NoStandardInput&) = delete;

 private:
  int before_;
};

TEST(OutputFile, AProgramStartedMeanwhileDoesNotInheritIt) {
  const TemporaryFolder folder;
  const auto is_inherited = [](const OutputFile& file) {
    return (::fcntl(file.descriptor(), F_GETFD) & FD_CLOEXEC) == 0;
  };
  for (const std::string& path : {folder.path("out"), std::string("/dev/null"), std::string("/dev/stdout")})
    EXPECT_FALSE(is_inherited(OutputFile(path))) << path;
  EXPECT_FALSE(is_inherited(*named_from_the_beginning(folder.path("out"))));
}

TEST(OutputFile, ZeroIsADescriptorLikeAnyOther) {
  const TemporaryFolder folder;
  const NoStandardInput closed;
  for (const std::string old : {"", "old"}) {
    if (!old.empty()) folder.write("out", old);
    write_and_commit(folder.path("out"), "new");
    EXPECT_EQ(folder.read("out"), "new");
    const auto file = named_from_the_beginning(folder.path("out"));
    EXPECT_EQ(file->descriptor(), 0);
    write_text(*file, "newer");
    file->commit();
    EXPECT_EQ(folder.read("out"), "newer");
  }
  OutputFile device("/dev/null");
  EXPECT_EQ(device.descriptor(), 0);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, LeavesNoDescriptorOpen) {
  const TemporaryFolder folder;
  const auto open_count = [] { return std::distance(fs::directory_iterator("/dev/fd"), {}); };
  const auto before = open_count();
  for (const std::string& path : {folder.path("out"), std::string("/dev/null"), std::string("/dev/stdout")}) {
    { const OutputFile without_commit(path); }
    EXPECT_EQ(open_count(), before) << path;
    for (int i = 0; i < 2; ++i) write_and_commit(path, "");
    EXPECT_EQ(open_count(), before) << path;
  }
  named_from_the_beginning(folder.path("out"));
  EXPECT_EQ(open_count(), before);
}

TEST(OutputFile, APlaceTakenMeanwhileIsAnErrorAndNothingIsLeft) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.path("out"));
    fs::create_directory(folder.path("out"));
    EXPECT_EQ(message_of([&] { file.commit(); }),
              "cannot replace " + folder.path("out") + ": Is a directory");
  }
  EXPECT_EQ(folder.file_count(), 1u);
}

}  // namespace
}  // namespace pipeline
