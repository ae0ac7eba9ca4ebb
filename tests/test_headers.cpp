// Empty: it only precompiles the headers for the tests, see CMakeLists.txt.
