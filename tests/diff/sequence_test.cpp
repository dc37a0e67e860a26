#include "diff/sequence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::diff {
namespace {

/// Frames of a sun that moves by `step` cells a frame, B with a gain of its own for each.
class Frames {
 public:
  Frames(int count, double step) : step_(step) {
    for (int i = 0; i < count; ++i) shown_.push_back(i), gain_.push_back(1);
  }
  Frames& shows(int frame, int other) { return shown_[size_t(frame)] = other, *this; }
  Frames& gain(int frame, double gain) { return gain_[size_t(frame)] = gain, *this; }

  [[nodiscard]] std::vector<TracedFrame> traced(double noise = 0) const {
    std::vector<TracedFrame> frames;
    for (size_t i = 0; i < shown_.size(); ++i) {
      TracedFrame f{fmt::format("f.{:04}.exr", i + 1), {}};
      f.trace.valid = true;
      f.trace.thumbnail_a = picture(double(i), 1, 0);
      f.trace.thumbnail_b = picture(shown_[i], gain_[i], noise * (i % 2 == 0 ? 1 : -1));
      const auto hash = [](double frame, double gain, double extra) {
        return uint64_t(1000 * frame + 1e6 * gain + 1e9 * extra) + 7;
      };
      f.trace.hash_a = hash(step_ > 0 ? double(i) : 0, 1, 0);
      f.trace.hash_b = hash(step_ > 0 ? shown_[i] : 0, gain_[i], noise * double(i + 1));
      f.trace.identical = f.trace.hash_a == f.trace.hash_b;
      f.trace.regions = {{"all", mean(f.trace.thumbnail_a), mean(f.trace.thumbnail_b)}};
      frames.push_back(std::move(f));
    }
    return frames;
  }

 private:
  double step_;
  std::vector<int> shown_;
  std::vector<double> gain_;

  [[nodiscard]] std::vector<float> picture(double frame, double gain, double noise) const {
    std::vector<float> cells;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 32; ++x) {
        const double d = std::pow(x - 8 - step_ * frame, 2) + std::pow(y - 6, 2);
        cells.push_back(
            float(gain * (1 + 5 / (1 + d / 4)) * (1 + noise * std::sin(12.9 * x + 78.2 * y))));
      }
    return cells;
  }
  static double mean(const std::vector<float>& cells) {
    double sum = 0;
    for (const float c : cells) sum += double(c);
    return sum / double(cells.size());
  }
};

std::vector<std::string> checks_of(const std::vector<TracedFrame>& frames) {
  std::vector<std::string> checks;
  for (const Finding& f : judge_sequence(frames, profile_limits(Profile::cross_renderer)))
    checks.push_back(f.check + " " + f.message.substr(0, f.message.find(' ')));
  return checks;
}

bool has(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

TEST(Sequence, TheSameFramesHaveNoFindings) {
  EXPECT_TRUE(checks_of(Frames(8, 0.5).traced()).empty());
  EXPECT_TRUE(checks_of(Frames(8, 0.5).traced(1e-5)).empty());
}

TEST(Sequence, ASkyThatStandsStillInBothIsNoRepetition) {
  EXPECT_TRUE(checks_of(Frames(8, 0).traced()).empty());
  EXPECT_TRUE(checks_of(Frames(8, 0).traced(5e-6)).empty());
}

TEST(Sequence, ExchangedFramesAreNamed) {
  const auto checks = checks_of(Frames(8, 0.5).shows(2, 3).shows(3, 2).traced());
  EXPECT_TRUE(has(checks, "sequence.order f.0003.exr"));
  EXPECT_TRUE(has(checks, "sequence.order f.0004.exr"));
}

TEST(Sequence, SlowFramesExchangedAreFoundBelowEveryPixelLimit) {
  // A step changes the light by a thousandth where it changes it most.
  const auto checks = checks_of(Frames(8, 0.002).shows(2, 3).shows(3, 2).traced());
  EXPECT_TRUE(has(checks, "sequence.order f.0003.exr"));
}

TEST(Sequence, ARepeatedFrameIsNamed) {
  const auto checks = checks_of(Frames(8, 0.5).shows(5, 4).traced());
  EXPECT_TRUE(has(checks, "sequence.repeated f.0006.exr"));
  EXPECT_FALSE(has(checks, "sequence.repeated f.0005.exr"));
  for (const std::string& check : checks)
    EXPECT_TRUE(check.find("flicker") == std::string::npos) << check << ": told already";
}

TEST(Sequence, AFrameThatFlickersIsFoundWithinItsOwnLimits) {
  // 0.19 % passes as a bias; between a frame darker and one brighter by that it flickers.
  const auto checks =
      checks_of(Frames(8, 0.5).gain(2, 0.9985).gain(3, 1.0019).gain(4, 0.9985).traced());
  EXPECT_TRUE(has(checks, "sequence.flicker f.0004.exr"));
  EXPECT_EQ(checks.size(), 1u) << "its neighbours look off by half as much, and are not";
}

TEST(Sequence, ASlowDriftIsNoFlicker) {
  Frames frames(12, 0.5);
  for (int i = 0; i < 12; ++i) frames.gain(i, 1 + 1e-4 * i);
  for (const std::string& check : checks_of(frames.traced()))
    EXPECT_TRUE(check.find("flicker") == std::string::npos) << check;
}

TEST(Sequence, FramesThatCouldNotBeComparedArePassedOver) {
  auto frames = Frames(5, 0.5).traced();
  frames[2].trace = {};
  EXPECT_TRUE(checks_of(frames).empty());
  EXPECT_TRUE(checks_of({}).empty());
}

}  // namespace
}  // namespace skylapse::diff
