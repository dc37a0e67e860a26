#pragma once
// The contexts that GL tests run on: every test on EGL and on OSMesa. Where one cannot be had the
// test fails, it never passes unseen.
#include <gtest/gtest.h>

#include "gpu/context.h"

namespace skylapse::gpu {

/// The context of a backend, made once for the whole program.
std::shared_ptr<Context> test_context(Backend backend);

class AnyContext : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    context_ = test_context(GetParam());
    ASSERT_NE(context_, nullptr);
  }
  std::shared_ptr<Context> context_;
};

inline std::string backend_name(const testing::TestParamInfo<Backend>& info) {
  return info.param == Backend::egl ? "Egl" : "OsMesa";
}

#define SKYLAPSE_ON_EVERY_CONTEXT(suite)                                                       \
  INSTANTIATE_TEST_SUITE_P(                                                                    \
      Gl, suite, testing::Values(skylapse::gpu::Backend::egl, skylapse::gpu::Backend::osmesa), \
      skylapse::gpu::backend_name)

}  // namespace skylapse::gpu
