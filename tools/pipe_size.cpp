#include "tools/pipe_size.h"

#include <fcntl.h>

namespace pipeline {

#ifdef F_SETPIPE_SZ

void enlarge_pipe(int descriptor) {
  constexpr int kPipeSize = 1 << 20;
  // No pipe has the size -1; a refusal leaves the pipe as it was.
  const int size = ::fcntl(descriptor, F_GETPIPE_SZ);
  if (size >= 0 && size < kPipeSize) ::fcntl(descriptor, F_SETPIPE_SZ, kPipeSize);
}

#else

void enlarge_pipe(int /*descriptor*/) {}

#endif

}  // namespace pipeline
