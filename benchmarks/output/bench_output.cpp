// From scene-linear pixels to file bytes, one 1280 x 720 frame each.
//   build/release/bin/bench_output --benchmark_repetitions=5
// CPU times are of the calling thread; encoders with threads of their own (EXR) show in the gap
// between Time and what the machine spent.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "color/dither.h"
#include "output/image_writer.h"

namespace skylapse::output {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr size_t kPixels = size_t{kWidth} * kHeight;

/// A sky in exposed scene-linear values: blue gradient, aureole, a sun beyond white, dark ground.
const std::vector<float>& sky() {
  static const std::vector<float> frame = [] {
    std::vector<float> rgb;
    rgb.reserve(3 * kPixels);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float height = 1.0f - static_cast<float>(y) / 600.0f;
        const float off =
            std::hypot(static_cast<float>(x) - 400.5f, static_cast<float>(y) - 300.5f);
        const float glow = 0.3f + 4.0f * std::exp(-off / 50.0f) + (off < 4.0f ? 20000.0f : 0.0f);
        if (y >= 600)
          rgb.insert(rgb.end(), {0.07f, 0.06f, 0.03f});
        else
          rgb.insert(rgb.end(),
                     {glow * (0.9f - 0.5f * height), glow * (0.9f - 0.3f * height), glow});
      }
    return rgb;
  }();
  return frame;
}

struct Loaded {
  const ImageIo* io;
  double milliseconds;
};

const Loaded& loaded() {
  static const Loaded module = [] {
    const auto start = std::chrono::steady_clock::now();
    const auto io = open_image_io();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    return Loaded{io ? *io : nullptr, took.count()};
  }();
  return module;
}

const std::vector<float>& displayed() {
  static const std::vector<float> frame = [] {
    auto rgb = sky();
    if (auto t = loaded().io->display({"", "rec709", "sRGB", "ACES SDR"}))
      (*t)->apply(rgb.data(), kPixels);
    return rgb;
  }();
  return frame;
}

void show_view(benchmark::State& state, const char* view) {
  const auto transform = loaded().io->display({"", "rec709", "sRGB", view});
  std::vector<float> rgb;
  for (auto _ : state) {
    state.PauseTiming();
    rgb = sky();
    state.ResumeTiming();
    (*transform)->apply(rgb.data(), kPixels);
    benchmark::DoNotOptimize(rgb.data());
  }
  state.counters["Mpixel/s"] = benchmark::Counter(static_cast<double>(kPixels) * 1e-6,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void make_view(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(loaded().io->display({"", "rec709", "sRGB", "ACES SDR"}));
  state.counters["module load ms"] = loaded().milliseconds;
}

void quantise(benchmark::State& state) {
  std::vector<uint8_t> out(3 * kPixels);
  for (auto _ : state) {
    color::quantise_u8(displayed().data(), kWidth, kHeight, 1, out.data());
    benchmark::DoNotOptimize(out.data());
  }
}

void encode(benchmark::State& state, const char* format, SampleType type, const char* compression) {
  std::vector<uint8_t> u8(3 * kPixels);
  std::vector<uint16_t> u16(3 * kPixels);
  color::quantise_u8(displayed().data(), kWidth, kHeight, 1, u8.data());
  color::quantise_u16(displayed().data(), kWidth, kHeight, 1, u16.data());
  EncodeRequest request;
  request.format = format;
  request.width = kWidth;
  request.height = kHeight;
  request.type = type;
  request.compression = compression;
  request.pixels = type == SampleType::u8    ? static_cast<const void*>(u8.data())
                   : type == SampleType::u16 ? static_cast<const void*>(u16.data())
                                             : static_cast<const void*>(sky().data());
  size_t bytes = 0;
  for (auto _ : state) {
    const auto file = loaded().io->encode(request);
    if (!file) return state.SkipWithError(file.error().message.c_str());
    bytes = file->size();
  }
  state.counters["MB"] = static_cast<double>(bytes) * 1e-6;
}

void register_all() {
  const auto ms = benchmark::kMillisecond;
  benchmark::RegisterBenchmark("make ACES SDR transform", make_view)->Unit(ms);
  benchmark::RegisterBenchmark("view ACES SDR", show_view, "ACES SDR")->Unit(ms);
  benchmark::RegisterBenchmark("view Un-tone-mapped", show_view, "Un-tone-mapped")->Unit(ms);
  benchmark::RegisterBenchmark("dither to 8 bits", quantise)->Unit(ms)->UseRealTime();
  struct Case {
    const char* name;
    const char* format;
    SampleType type;
    const char* compression;
  };
  for (const Case& c :
       {Case{"png 8", "png", SampleType::u8, ""}, Case{"png 16", "png", SampleType::u16, ""},
        Case{"jpg 92", "jpg", SampleType::u8, ""},
        Case{"exr half zip", "exr", SampleType::half_float, "zip"},
        Case{"exr half piz", "exr", SampleType::half_float, "piz"},
        Case{"exr half dwaa", "exr", SampleType::half_float, "dwaa"},
        Case{"exr half none", "exr", SampleType::half_float, "none"},
        Case{"exr float zip", "exr", SampleType::float32, "zip"},
        Case{"hdr", "hdr", SampleType::float32, ""},
        Case{"tif 8 zip", "tif", SampleType::u8, "zip"},
        Case{"tif float zip", "tif", SampleType::float32, "zip"}})
    benchmark::RegisterBenchmark(c.name, encode, c.format, c.type, c.compression)
        ->Unit(ms)
        ->UseRealTime();
}

}  // namespace
}  // namespace skylapse::output

int main(int argc, char** argv) {
  if (skylapse::output::loaded().io == nullptr) return 5;
  benchmark::Initialize(&argc, argv);
  skylapse::output::register_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
