#include "gpu/buffer.h"

#include <gmock/gmock.h>

#include <numeric>

#include "gpu/any_context.h"
#include "gpu/functions.h"

namespace skylapse::gpu {
namespace {

using AnyBuffer = AnyContext;

TEST_P(AnyBuffer, ReadsWhatWasWritten) {
  std::vector<float> values(1000);
  std::iota(values.begin(), values.end(), 0.5f);
  std::vector<float> read(values.size());
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const Buffer buffer = Buffer::of(gl, values);
    const float changed = -1;
    buffer.write(gl, 8, sizeof changed, &changed);
    buffer.read(gl, 0, buffer.bytes(), read.data());
    return Done{};
  });
  ASSERT_TRUE(status.ok()) << status.error().message;
  values[2] = -1;
  EXPECT_EQ(read, values);
}

TEST_P(AnyBuffer, NewMemoryIsZero) {
  std::vector<float> read(100, 1.0f);
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const Buffer buffer = Buffer::create(gl, 400);
    buffer.read(gl, 0, 400, read.data());
    return Done{};
  });
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_THAT(read, testing::Each(0.0f));
}

TEST_P(AnyBuffer, EmptyListCanBeBound) {
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const Buffer buffer = Buffer::of(gl, std::vector<float>{});
    buffer.bind_storage(gl, 0);
    buffer.bind_uniform(gl, 1);
    return Done{};
  });
  EXPECT_TRUE(status.ok()) << status.error().message;
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyBuffer);

}  // namespace
}  // namespace skylapse::gpu
