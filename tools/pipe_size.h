#pragma once

namespace pipeline {

/// Lets the pipe behind a file descriptor hold 1 MiB, where the system can do that and allows it, so that the
/// stages of a pipe seldom wait for each other. What is no pipe, and a larger pipe, stay as they are.
void enlarge_pipe(int descriptor);

}  // namespace pipeline
