// Prints how many GB/s one thread reads from memory, how many it copies (read and written together), and the
// clock in GHz: what limits a program that does little with much data. After the STREAM benchmark of J. D.
// McCalpin.
//
// usage: memory_bandwidth MIB

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

namespace {

/// Of CPU time, so that other load takes less off the result.
template <typename Work>
double best_seconds(const Work& work) {
  double best = 1e300;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

/// Keeps the compiler from leaving out what a value took.
template <typename Value>
void use(Value& value) {
  asm volatile("" : "+m"(value) : : "memory");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::size_t byte_count = static_cast<std::size_t>(std::atoi(argv[1])) << 20;
  std::vector<std::uint64_t> from(byte_count / 8, 1), to(byte_count / 8, 2);
  const double read_seconds = best_seconds([&] {
    std::uint64_t sums[8] = {};
    for (std::size_t i = 0; i + 8 <= from.size(); i += 8)
      for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += from[i + lane];
    use(sums);
  });
  const double copy_seconds = best_seconds([&] {
    std::memcpy(to.data(), from.data(), byte_count);
    use(to);
  });
  // Each addition waits for the one before it, which takes one cycle.
  constexpr std::uint64_t kAdditions = 200'000'000;
  const double chain_seconds = best_seconds([] {
    std::uint64_t sum = 0;
    for (std::uint64_t i = 0; i < kAdditions; ++i) {
      sum += 1;
      asm volatile("" : "+r"(sum));
    }
  });
  const double bytes = static_cast<double>(byte_count);
  std::printf("%.3f %.3f %.3f\n", bytes / read_seconds / 1e9, 2 * bytes / copy_seconds / 1e9,
              static_cast<double>(kAdditions) / chain_seconds / 1e9);
}
