// Changes that leave a picture as it was, made of the sketches in frames.h.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

namespace fs = std::filesystem;
constexpr uint32_t kSeed = 99;

/// Each sample off by up to half of `width`, as a share of itself.
Image noisy(const Image& image, double width) {
  const Noise noise(256, 128, kSeed);
  return changed(image, [&](int x, int y, int c, float v) {
    return double(v) * (1 + width * (noise(x, y, c) - 0.5));
  });
}

FileOptions compressed(const std::string& name) {
  FileOptions options;
  options.compression = name;
  return options;
}

FileOptions stored_as(const std::string& type) {
  FileOptions options;
  options.type = type;
  return options;
}

void add_files(CaseList& list) {
  const Image& day = list.frame("day");
  fs::copy_file(list.path(list.frame_file("day")), list.path("P01.exr"),
                fs::copy_options::overwrite_existing);
  list.add({"P01", false, "day", "same bytes", list.frame_file("day"), "P01.exr"});
  list.innocent("P02", "day", "another lossless compression (piz)", day, compressed("piz"));
  list.innocent("P03", "day", "no compression", day, compressed("none"));
  FileOptions tiles;
  tiles.tile = 64;
  list.innocent("P04", "day", "tiles instead of scanlines", day, tiles);
  FileOptions text;
  text.text = {{"Software", "other"}, {"DateTime", "2031:01:02 03:04:05"}};
  list.innocent("P05", "day", "other metadata", day, text);
  list.innocent("P06", "day", "half instead of float, values in range", day, stored_as("half"));
  Image reversed = changed(day, [&](int x, int y, int c, float) { return day.at(x, y, 2 - c); });
  reversed.channels = {"B", "G", "R"};
  list.innocent("P13", "day", "channels in another order, names right", reversed);
  FileOptions bottom_first;
  bottom_first.bottom_first = true;
  list.innocent("P25", "day", "scanlines stored bottom first", day, bottom_first);
  list.innocent("P38", "day", "half values carried in float", as_half(day));
  fs::create_directories(list.path("a b"));
  fs::copy_file(list.path(list.frame_file("day")), list.path("a b/\u00e9 1.exr"),
                fs::copy_options::overwrite_existing);
  fs::remove(list.path("P27.exr"));
  fs::create_symlink("a b/\u00e9 1.exr", list.path("P27.exr"));
  list.add({"P27", false, "day", "path with space and accent, symbolic link",
            list.frame_file("day"), "P27.exr"});
}

void add_rounding(CaseList& list) {
  const Image& day = list.frame("day");
  const Noise noise(256, 128, kSeed);
  list.innocent("P07", "day", "relative noise of 1e-6", noisy(day, 2e-6));
  list.innocent("P08", "day", "every sample one step of float32 up",
                changed(day, [](int, int, int, float v) { return std::nextafter(v, 1e9F); }));
  list.innocent("P09", "day", "relative noise of 2e-4", noisy(day, 4e-4));
  list.innocent("P10", "day", "gain of 0.03 %",
                changed(day, [](int, int, int, float v) { return v * 1.0003F; }));
  list.innocent("P17", "day", "0.6 % of the pixels off by up to 0.05 %",
                changed(day, [&](int x, int y, int, float v) {
                  if (noise(x, y, 0) >= 0.006) return double(v);
                  return double(v) * (1 + 0.001 * (noise(x, y, 1) - 0.5));
                }));
  list.innocent(
      "P18", "day", "one pixel off by 0.1 %",
      changed(day, [](int x, int y, int, float v) { return x == 60 && y == 60 ? v * 1.001F : v; }));
  list.innocent("P28", "day", "rim of the disc off by 0.05 %",
                changed(day, [&](int x, int y, int c, float v) {
                  const int d = sun_distance_squared(x, y);
                  if (d <= 6 || d > 12) return double(v);
                  return double(v) * (1 + 0.001 * (noise(x, y, c) - 0.5));
                }));
  list.innocent("P29", "day", "other order of operations in double",
                changed(day, [](int, int, int, float v) { return double(v) * 3 / 3; }));
  list.innocent("P30", "day", "other order of operations in float",
                changed(day, [](int, int, int, float v) { return 1 / (1 / v); }));
  list.innocent("P37", "day", "gain up and down by a power of two",
                changed(day, [](int, int, int, float v) { return v * 4 * 0.25F; }));
  list.innocent("P39", "day", "absolute noise of 5e-8",
                changed(day, [&](int x, int y, int c, float v) {
                  return double(v) + double(1e-7F) * (noise(x, y, c) - 0.5);
                }));
}

void add_other_frames(CaseList& list) {
  const auto same = [&](const std::string& id, const std::string& frame, const std::string& what) {
    list.add({id, false, frame, what, list.frame_file(frame), list.frame_file(frame)});
  };
  const Image& night = list.frame("night");
  list.innocent("P15", "night", "negative zeros",
                changed(night, [](int, int, int, float v) { return v == 0 ? -0.0F : v; }));
  list.innocent("P16", "night", "denormals in place of zero",
                changed(night, [](int, int, int, float v) { return v == 0 ? 1e-39F : v; }));
  same("P19", "black", "two black frames");
  same("P20", "dark", "identical night frames, more than half of them exactly zero");
  list.innocent("P21", "dark", "the same with relative noise of 1e-5",
                noisy(list.frame("dark"), 2e-5));
  same("P22", "one", "a single pixel, identical");
  list.innocent("P23", "tiny", "5x3 pixels, noise of 1e-6", noisy(list.frame("tiny"), 2e-6));
  list.innocent("P24", "huge", "disc of 1e10 in both, noise of 1e-6",
                noisy(list.frame("huge"), 2e-6));
  list.innocent("P40", "grey", "constant frame, noise of 1e-6", noisy(list.frame("grey"), 2e-6));
}

void add_display(CaseList& list) {
  const Image& png = list.frame("png");
  const Noise noise(256, 128, kSeed);
  list.innocent("P11", "png", "0.3 % of the pixels off by one code value",
                changed(png, [&](int x, int y, int, float v) {
                  if (noise(x, y, 0) >= 0.003) return v;
                  return std::clamp(v + (noise(x, y, 1) < 0.5 ? 1.0F : -1.0F), 0.0F, 255.0F);
                }));
  FileOptions level;
  level.numbers = {{"png:compressionLevel", 1}};
  list.innocent("P12", "png", "PNG compressed less", png, level);
  list.innocent("P14", "png", "same code values held in 16 bits", png, stored_as("uint16"));
  FileOptions chunks;
  chunks.text = {{"oiio:ColorSpace", "sRGB"}};
  list.innocent("P26", "png", "PNG with another set of chunks", png, chunks);
  Image one = png;
  one.at(5, 5, 0) += 1;
  list.innocent("P36", "png", "one sample off by one code value", one);
}

void add_sequences(CaseList& list) {
  const auto copy = [&](const std::string& id) {
    fs::remove_all(list.path(id));
    fs::copy(list.path("frames/seq"), list.path(id), fs::copy_options::recursive);
    return list.path(id);
  };
  const auto rewritten = [&](const std::string& id, const FileOptions& options) {
    fs::create_directories(list.path(id));
    for (int i = 1; i <= 8; ++i)
      write_image(list.path(id) / ("f.000" + std::to_string(i) + ".exr"), sequence_frame(i),
                  options);
  };
  const auto add = [&](const std::string& id, const std::string& what) {
    list.add({id, false, "seq", what, "frames/seq", id});
  };
  std::ofstream(copy("P31") / "manifest.json") << "{}\n";
  fs::create_directory(list.path("P31/thumbs"));
  add("P31", "a manifest and a folder beside the frames");
  for (const auto& file : fs::directory_iterator(copy("P32")))
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24 * 9000));
  add("P32", "file times differ");
  rewritten("P33", compressed("zips"));
  add("P33", "every frame compressed otherwise");
  rewritten("P34", stored_as("half"));
  add("P34", "every frame in half");
  fs::remove(list.path("P35"));
  fs::create_directory_symlink("frames/seq", list.path("P35"));
  add("P35", "folder given through a link");
}

}  // namespace

void add_plain_innocents(CaseList& list) {
  add_files(list);
  add_rounding(list);
  add_other_frames(list);
  add_display(list);
  add_sequences(list);
}

}  // namespace skylapse::diff_cases
