#pragma once
// Random numbers by counter: number n of path p of a stream is a pure function of (seed, stream, p,
// n), so the same paths come out on any number of threads and in any order.
#include <array>
#include <cstdint>

namespace skylapse::sky::monte_carlo {

/// Philox4x32 with ten rounds (Salmon, Moraes, Dror & Shaw 2011, "Parallel random numbers: as easy
/// as 1, 2, 3", table 2): a keyed mixing of 128 bits. The known answers of its authors are a test.
inline std::array<uint32_t, 4> philox(std::array<uint32_t, 4> counter,
                                      std::array<uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const uint64_t a = uint64_t{0xD2511F53} * counter[0];
    const uint64_t b = uint64_t{0xCD9E8D57} * counter[2];
    counter = {uint32_t(b >> 32) ^ counter[1] ^ key[0], uint32_t(b),
               uint32_t(a >> 32) ^ counter[3] ^ key[1], uint32_t(a)};
    key[0] += 0x9E3779B9;  // golden ratio
    key[1] += 0xBB67AE85;  // sqrt(3) - 1
  }
  return counter;
}

/// The numbers of one path, in order. Streams are for pixels.
class PathRandom {
 public:
  PathRandom(uint64_t seed, uint64_t path, uint32_t stream = 0)
      : key_{uint32_t(seed), uint32_t(seed >> 32)}, path_(path), stream_(stream) {}

  /// Uniform in (0, 1), 0 and 1 excluded; steps of 2^-53.
  double uniform() {
    if (used_ == 2) refill();
    const uint64_t bits = uint64_t(block_[2 * used_]) << 32 | block_[2 * used_ + 1];
    ++used_;
    return (double(bits >> 12) + 0.5) * 0x1p-52;
  }

 private:
  void refill() {
    block_ = philox({uint32_t(path_), uint32_t(path_ >> 32), next_++, stream_}, key_);
    used_ = 0;
  }

  std::array<uint32_t, 2> key_;
  uint64_t path_;
  uint32_t stream_;
  uint32_t next_ = 0;
  std::array<uint32_t, 4> block_{};
  int used_ = 2;
};

}  // namespace skylapse::sky::monte_carlo
