// The entry point of libFuzzer for one target, named at compile time.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  skylapse::fuzz::SKYLAPSE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
