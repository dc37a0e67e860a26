// Changes that leave every picture as it was, on sketches and on rendered skies.
#include <algorithm>
#include <cmath>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

namespace fs = std::filesystem;

FileOptions quick() {
  FileOptions options;
  options.compression = "none";
  return options;
}

Image noisy(const Image& a, double amplitude, uint32_t seed) {
  const Noise noise(a.width, a.height, seed);
  return changed(a, [&](int x, int y, int c, float v) {
    return v * (1 + 2 * amplitude * (noise(x, y, c) - 0.5));
  });
}

void add_rounding(CaseList& list, const std::string& frame) {
  const Image& a = list.frame(frame);
  const auto add = [&](const std::string& id, const std::string& what, const Image& b) {
    list.innocent(frame + "." + id, frame, what, b, quick());
  };
  add("noise1e-6", "relative noise of 1e-6", noisy(a, 1e-6, 11));
  add("noise1e-5", "relative noise of 1e-5", noisy(a, 1e-5, 12));
  add("noise1e-4", "relative noise of 1e-4", noisy(a, 1e-4, 13));
  add("noise3e-4", "relative noise of 3e-4", noisy(a, 3e-4, 14));
  add("gain+0.05%", "gain of 0.05 %",
      changed(a, [](int, int, int, float v) { return v * 1.0005; }));
  add("gain-0.05%", "gain of -0.05 %",
      changed(a, [](int, int, int, float v) { return v * 0.9995; }));
  add("ulp-down", "every sample one step of float32 down",
      changed(a, [](int, int, int, float v) { return std::nextafter(v, 0.0F); }));
  add("pixel+0.1%", "one pixel off by 0.1 %", changed(a, [&](int x, int y, int, float v) {
        return v * (x == a.width / 3 && y == a.height / 3 ? 1.001 : 1.0);
      }));
  add("bf-sums", "multiplied and divided by 3",
      changed(a, [](int, int, int, float v) { return v * 3.0F / 3.0F; }));
}

void add_files(CaseList& list, const std::string& frame) {
  const Image& a = list.frame(frame);
  const auto add = [&](const std::string& id, const std::string& what, const FileOptions& options) {
    list.innocent(frame + "." + id, frame, what, a, options);
  };
  for (const char* const name : {"rle", "zips", "zip", "piz"}) {
    FileOptions options;
    options.compression = name;
    add(name, std::string("compressed by ") + name, options);
  }
  FileOptions pxr24;
  pxr24.compression = "pxr24";
  add("pxr24", "compressed by pxr24: floats keep 24 bits", pxr24);
  FileOptions tiles = quick();
  tiles.tile = 32;
  add("tiles", "tiles of 32x32", tiles);
  FileOptions bottom = quick();
  bottom.bottom_first = true;
  add("bottom-first", "scanlines stored bottom first", bottom);
  FileOptions notes = quick();
  notes.text = {{"Software", "farm 7"},
                {"DateTime", "2030:02:03 04:05:06"},
                {"owner", "ci"},
                {"comments", "frame of a test"}};
  add("notes", "other notes in the file", notes);
  FileOptions bare = quick();
  for (const char* const name : {"skylapse:fingerprint", "skylapse:exposureEv100", "ExposureTime",
                                 "FNumber", "isoSpeed", "utcOffset"})
    bare.without.emplace_back(name);
  add("fewer-notes", "some notes left out", bare);
}

/// The same frame in a file of another format. RGBE shares an exponent: its own rounding comes
/// first.
void add_formats(CaseList& list) {
  const Image& day = list.frame("day");
  const auto pair = [&](const std::string& id, const std::string& what, const std::string& a,
                        const std::string& b) {
    list.add({id, false, "day", what, a, b});
  };
  write_image(list.path("frames/day.tif"), day);
  pair("formats.exr-tif", "EXR and TIFF of the same floats", list.frame_file("day"),
       "frames/day.tif");
  write_image(list.path("frames/day.hdr"), day);
  Image again = read_image(list.path("frames/day.hdr"));
  again.attributes_of.clear();
  write_image(list.path("frames/again.hdr"), again);
  pair("formats.hdr-hdr", "RGBE written twice", "frames/day.hdr", "frames/again.hdr");
  write_image(list.path("frames/from_hdr.exr"), again);
  pair("formats.hdr-exr", "RGBE and its values in EXR", "frames/day.hdr", "frames/from_hdr.exr");

  const Image& png = list.frame("png");
  const auto filtered = [&](const std::string& id, int filter) {
    FileOptions options;
    options.numbers = {{"png:filter", filter}, {"png:compressionLevel", 9}};
    list.innocent("png." + id, "png", "PNG filter " + id, png, options);
  };
  filtered("none", 0x08);
  filtered("sub", 0x10);
  filtered("paeth", 0x80);
  write_image(list.path("frames/png.tif"), png);
  pair("formats.png-tif", "PNG and TIFF of the same code values", list.frame_file("png"),
       "frames/png.tif");
  FileOptions jpeg;
  jpeg.compression = "jpeg:92";
  write_image(list.path("frames/png.jpg"), png, jpeg);
  write_image(list.path("frames/png_again.jpg"), png, jpeg);
  pair("formats.jpg", "JPEG made twice", "frames/png.jpg", "frames/png_again.jpg");
  Image decoded = read_image(list.path("frames/png.jpg"));
  decoded.attributes_of.clear();
  write_image(list.path("frames/decoded.png"), decoded);
  pair("formats.jpg-png", "JPEG and what it decodes to", "frames/png.jpg", "frames/decoded.png");
}

void add_odd_sizes(CaseList& list) {
  const auto twice = [&](const std::string& name, const std::string& what, const Image& image,
                         double amplitude) {
    list.add_frame(name, image);
    list.innocent(name + ".noise", name, what, noisy(image, amplitude, 21), quick());
  };
  const Image& day = list.frame("day");
  twice("row", "one row of pixels, noise of 1e-5", cropped(day, 0, 50, 256, 1), 1e-5);
  twice("column", "one column of pixels, noise of 1e-5", cropped(day, 90, 0, 1, 128), 1e-5);
  twice("two", "2x1 pixels, noise of 1e-5", cropped(day, 0, 0, 2, 1), 1e-5);
  twice("odd", "127x63 pixels, noise of 1e-5", cropped(day, 3, 5, 127, 63), 1e-5);
  twice("white", "all samples 1, noise of 1e-6", Image(64, 32, 1), 1e-6);
  twice("subnormal", "all samples 1e-39, identical", Image(64, 32, 1e-39F), 0);
  twice("brightest", "all samples 1e37, noise of 1e-6", Image(64, 32, 1e37F), 1e-6);
  twice("faintest", "all samples 1e-30, noise of 1e-6", Image(64, 32, 1e-30F), 1e-6);
  Image lit(64, 32);
  for (int c = 0; c < 3; ++c) lit.at(20, 10, c) = 5;
  twice("lonely", "one bright pixel on black, noise of 1e-5", lit, 1e-5);
  Image below = day;
  below.at(3, 3, 2) = -1e-6F;
  twice("slightly-negative", "a sample of -1e-6 in both", below, 1e-6);
  DaySketch sketch;
  sketch.width = 4096;
  sketch.height = 2048;
  const Image large = day_sketch(sketch);
  list.add_frame("4k", large, quick());
  list.innocent("4k.noise", "4k", "4096x2048 pixels, relative noise of 1e-5",
                noisy(large, 1e-5, 23), quick());
}

}  // namespace

void add_more_innocents(CaseList& list) {
  for (const char* const frame :
       {"day", "night", "noon", "evening", "twilight", "fisheye", "view", "cube"})
    add_rounding(list, frame);
  for (const char* const frame : {"noon", "twilight", "cube"}) add_files(list, frame);
  add_formats(list);
  add_odd_sizes(list);
  // A screen of the same frame, a few samples rounded the other way.
  const Image& screen = list.frame("screen");
  const Noise noise(screen.width, screen.height, 31);
  list.innocent("screen.rounding", "screen", "0.5 % of the samples off by one code value",
                changed(screen, [&](int x, int y, int c, float v) {
                  if (noise(x, y, c) >= 0.005) return v;
                  return std::clamp(v + (x % 2 == 0 ? 1.0F : -1.0F), 0.0F, 255.0F);
                }));
}

}  // namespace skylapse::diff_cases
