#include "gpu/any_context.h"

#include <map>

namespace skylapse::gpu {

std::shared_ptr<Context> test_context(Backend backend) {
  static std::map<Backend, std::shared_ptr<Context>> contexts;
  auto& context = contexts[backend];
  if (context == nullptr) {
    auto made = Context::create(backend);
    EXPECT_TRUE(made.ok()) << made.error().message << "; " << made.error().hint;
    if (made) context = *made;
  }
  return context;
}

}  // namespace skylapse::gpu
