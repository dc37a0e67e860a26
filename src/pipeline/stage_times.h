#pragma once
#include <array>
#include <chrono>
#include <string_view>

namespace skylapse::pipeline {

/// Where a frame's time goes; `atmosphere` is what is computed once for a frame, whatever its
/// pixels, and the wait for it; `product` is filtering and the like, without the sky it is fed
/// with.
enum class Stage { atmosphere, sky, disc, product, display, encode, write };
inline constexpr int kStageCount = 7;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{
    "atmosphere", "sky", "disc", "product", "display", "encode", "write"};

/// Milliseconds of each stage.
struct StageTimes {
  std::array<double, kStageCount> ms{};
  double& operator[](Stage stage) { return ms[static_cast<int>(stage)]; }
  double operator[](Stage stage) const { return ms[static_cast<int>(stage)]; }
  StageTimes& operator+=(const StageTimes& other) {
    for (int i = 0; i < kStageCount; ++i) ms[i] += other.ms[i];
    return *this;
  }
  [[nodiscard]] double total() const {
    double sum = 0;
    for (const double t : ms) sum += t;
    return sum;
  }
};

/// Adds the time from construction to destruction to one stage.
class StageTimer {
 public:
  StageTimer(StageTimes& times, Stage stage) : times_(times), stage_(stage) {}
  ~StageTimer() {
    times_[stage_] += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes& times_;
  Stage stage_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace skylapse::pipeline
