#include "gpu/context.h"

#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <thread>

#include "gpu/any_context.h"
#include "gpu/backends.h"
#include "gpu/buffer.h"
#include "gpu/functions.h"
#include "gpu/program.h"
#include "gpu/self_test.h"

extern char** environ;

namespace skylapse::gpu {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_P(AnyContext, Computes) {
  const Status status = self_test(*context_);
  EXPECT_TRUE(status.ok()) << status.error().message;
}

TEST_P(AnyContext, SaysWhatItIs) {
  const ContextInfo& info = context_->info();
  EXPECT_THAT(info.backend, HasSubstr(GetParam() == Backend::egl ? "EGL" : "OSMesa"));
  EXPECT_FALSE(info.vendor.empty());
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_THAT(info.version, testing::StartsWith("4."));
  EXPECT_GE(info.max_texture_3d, 2048);  // what OpenGL 4.5 promises
  ASSERT_FALSE(info.attempts.empty());
  EXPECT_EQ(info.attempts.back().what, info.backend);
  EXPECT_EQ(info.attempts.back().reason, "");
}

TEST_P(AnyContext, WorkRunsOnOneThreadThatIsNotTheCallers) {
  std::array<std::thread::id, 2> seen;
  for (auto& id : seen)
    ASSERT_TRUE(context_->run([&](const Functions&) -> Status {
      id = std::this_thread::get_id();
      return Done{};
    }));
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_NE(seen[0], std::this_thread::get_id());
}

TEST_P(AnyContext, WorkMayRunMoreWork) {
  const Status status = context_->run([&](const Functions&) -> Status {
    return context_->run([](const Functions&) -> Status { return Done{}; });
  });
  EXPECT_TRUE(status.ok());
}

TEST_P(AnyContext, MistakeInGlBecomesAnErrorThatNamesTheRenderer) {
  const Status status = context_->run([](const Functions& gl) -> Status {
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 100000, 0);
    return Done{};
  });
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr(context_->info().renderer));
  EXPECT_THAT(status.error().message, HasSubstr("glBindBufferBase"));
  EXPECT_TRUE(context_->run([](const Functions&) -> Status { return Done{}; }).ok())
      << "the error stays with the work that made it";
}

TEST_P(AnyContext, MistakeWhileAShaderIsSetUpNamesItsFile) {
  const Status status = context_->run([](const Functions& gl) -> Status {
    const auto program = Program::create(gl, "entry/self_test.comp");
    if (!program) return program.error();
    program->dispatch(gl, {1 << 30});
    return Done{};
  });
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("shaders/entry/self_test.comp: "));
}

TEST_P(AnyContext, ManyThreadsMayAskAtOnce) {
  std::vector<std::thread> threads;
  std::array<bool, 8> ok{};
  for (bool& result : ok)
    threads.emplace_back([&result, this] { result = self_test(*context_).ok(); });
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(ok, testing::Each(true));
}

TEST_P(AnyContext, TwoContextsAtOnceDoNotDisturbEachOther) {
  std::vector<std::thread> threads;
  std::array<bool, 3> ok{};
  for (bool& result : ok)
    threads.emplace_back([&result] {
      const auto context = Context::create(GetParam());
      result = context.ok() && self_test(**context).ok() && self_test(**context).ok();
    });
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(ok, testing::Each(true));
  EXPECT_TRUE(self_test(*context_).ok()) << "the end of one context does not end another";
}

TEST_P(AnyContext, TwoProcessesAtOnceDoNotDisturbEachOther) {
  const std::string filter = std::string("--gtest_filter=Gl/AnyContext.Computes/") +
                             (GetParam() == Backend::egl ? "Egl" : "OsMesa");
  std::array<pid_t, 2> children{};
  for (pid_t& child : children) {
    std::string program = "/proc/self/exe", argument = filter;
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    ASSERT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ), 0);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

TEST_P(AnyContext, ObjectsMayBeLetGoOfOnAnyThreadAndAfterTheContext) {
  Buffer survivor;
  {
    const auto context = Context::create(GetParam());
    ASSERT_TRUE(context.ok());
    Buffer temporary;
    ASSERT_TRUE((*context)->run([&](const Functions& gl) -> Status {
      temporary = Buffer::create(gl, 16);
      survivor = Buffer::create(gl, 16);
      return Done{};
    }));
  }
  EXPECT_EQ(survivor.bytes(), 16u);
}

TEST_P(AnyContext, LastReferenceMayBeLetGoOfByItsOwnWork) {
  auto created = Context::create(GetParam());
  ASSERT_TRUE(created.ok());
  auto context = std::move(created).value();
  std::weak_ptr<Context> watcher = context;
  context->post([keep = context](const Functions&) mutable { keep.reset(); });
  context.reset();
  for (int i = 0; i < 500 && !watcher.expired(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(watcher.expired());
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyContext);

TEST(ContextCreation, AutomaticTakesSurfacelessEglWhereItWorks) {
  const auto context = Context::create(Backend::automatic);
  ASSERT_TRUE(context.ok()) << context.error().message;
  EXPECT_EQ((*context)->info().attempts.front().what, "EGL surfaceless");
}

TEST(ContextCreation, WithoutEglAutomaticTakesOsMesaAndSaysWhy) {
  const auto context = create_context(
      Backend::automatic, {.egl = "libskylapse-no-such-egl.so", .osmesa = "libOSMesa.so.8"});
  ASSERT_TRUE(context.ok()) << context.error().message;
  const ContextInfo& info = (*context)->info();
  EXPECT_EQ(info.backend, "OSMesa");
  ASSERT_EQ(info.attempts.size(), 2u);
  EXPECT_EQ(info.attempts[0].what, "EGL");
  EXPECT_THAT(info.attempts[0].reason, HasSubstr("libskylapse-no-such-egl.so"));
}

TEST(ContextCreation, WithoutGlSaysWhatToInstall) {
  const Libraries none{.egl = "libskylapse-no-such-egl.so",
                       .osmesa = "libskylapse-no-such-osmesa.so"};
  const auto any = create_context(Backend::automatic, none);
  ASSERT_FALSE(any.ok());
  EXPECT_EQ(any.error().code, ErrorCode::missing_backend);
  EXPECT_THAT(any.error().hint, HasSubstr("libegl1"));
  EXPECT_THAT(any.error().hint, HasSubstr("libgl1-mesa-dri"));
  EXPECT_THAT(any.error().hint, HasSubstr("libosmesa6"));
  const auto osmesa = create_context(Backend::osmesa, none);
  ASSERT_FALSE(osmesa.ok());
  EXPECT_THAT(osmesa.error().hint, HasSubstr("libosmesa6"));
  EXPECT_THAT(osmesa.error().hint, Not(HasSubstr("libegl1")));
}

TEST(ContextCreation, LibraryThatIsNoGlIsPassedOver) {
  const auto context = create_context(Backend::osmesa, {.egl = "", .osmesa = "libm.so.6"});
  ASSERT_FALSE(context.ok());
  EXPECT_THAT(context.error().message, HasSubstr("libm.so.6"));
  EXPECT_FALSE(create_context(Backend::egl, {.egl = "libm.so.6", .osmesa = ""}).ok());
}

}  // namespace
}  // namespace skylapse::gpu
