#include "gpu/self_test.h"

#include <fmt/format.h>

#include "gpu/buffer.h"
#include "gpu/functions.h"
#include "gpu/program.h"

namespace skylapse::gpu {

Status self_test(Context& context) {
  return context.run([](const Functions& gl) -> Status {
    constexpr int kCount = 100;
    const auto program = Program::create(gl, "entry/self_test.comp");
    if (!program) return program.error();
    std::vector<float> values(kCount);
    for (int i = 0; i < kCount; ++i) values[i] = float(i);
    const Buffer buffer = Buffer::of(gl, values);
    buffer.bind_storage(gl, 0);
    program->dispatch(gl, {groups_for(kCount, 32)});
    buffer.read(gl, 0, buffer.bytes(), values.data());
    for (int i = 0; i < kCount; ++i)
      if (values[i] != float(i * i + i))
        return Error{ErrorCode::internal,
                     fmt::format("the driver computes {}^2 + {} = {}", i, i, values[i])};
    return Done{};
  });
}

}  // namespace skylapse::gpu
