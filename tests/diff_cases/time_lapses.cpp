// Sequences: a slow time lapse rendered by the program, spoilt in single frames and in their order.
#include <cstdio>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

namespace fs = std::filesystem;
constexpr int kFrames = 12;

std::string name_of(int i) {
  char text[16];
  std::snprintf(text, sizeof text, "f.%04d.exr", i);
  return text;
}

/// Folders of the frames of a time lapse, made from those of renders/minutes.
class Lapses {
 public:
  explicit Lapses(CaseList& list) : list_(list) {
    for (int i = 1; i <= kFrames; ++i)
      frames_.push_back(read_image(list.path("renders/minutes/" + name_of(i))));
  }

  /// The files of other moments under the names of this one: frame i holds what source(i) held.
  template <class Source>
  void files(const std::string& id, const std::string& what, Source source) {
    const fs::path folder = fresh(id);
    for (int i = 1; i <= kFrames; ++i)
      if (const int from = source(i); from > 0)
        fs::copy_file(list_.path("renders/minutes/" + name_of(from)), folder / name_of(i));
    list_.add({"lapse." + id, true, "minutes", what, "renders/minutes", "lapse." + id});
  }

  /// Pictures by frame(i, reference); the files say of themselves what those of the reference say.
  template <class Frame>
  void pictures(bool sabotage, const std::string& id, const std::string& what, Frame frame) {
    const fs::path folder = fresh(id);
    FileOptions quick;
    quick.compression = "none";
    for (int i = 1; i <= kFrames; ++i) {
      Image image = frame(i, frames_[size_t(i - 1)]);
      image.attributes_of = frames_[size_t(i - 1)].attributes_of;
      write_image(folder / name_of(i), image, quick);
    }
    list_.add({"lapse." + id, sabotage, "minutes", what, "renders/minutes", "lapse." + id});
  }

  [[nodiscard]] const Image& frame(int i) const { return frames_[size_t(i - 1)]; }

 private:
  fs::path fresh(const std::string& id) {
    const fs::path folder = list_.path("lapse." + id);
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }
  CaseList& list_;
  std::vector<Image> frames_;
};

Image gained(const Image& a, double by) {
  return changed(a, [by](int, int, int, float v) { return v * by; });
}

void add_broken(Lapses& lapses) {
  const auto order = [&](const std::string& id, const std::string& what, auto source) {
    lapses.files(id, what, source);
    lapses.pictures(true, id + "-pixels", what + ", pixels alone",
                    [&](int i, const Image&) { return lapses.frame(source(i)); });
  };
  order("stale", "one frame is the one before it", [](int i) { return i == 7 ? 6 : i; });
  order("stale-last", "the last frame is the one before it",
        [](int i) { return i == 12 ? 11 : i; });
  order("swapped", "two neighbours exchanged", [](int i) { return i == 4 ? 5 : i == 5 ? 4 : i; });
  order("far-swapped", "two frames far apart exchanged", [](int i) {
    return i == 2 ? 10 : i == 10 ? 2 : i;
  });
  order("late", "all frames a minute late", [](int i) { return i == 1 ? 1 : i - 1; });
  order("reversed", "backwards", [](int i) { return kFrames + 1 - i; });
  order("frozen", "the first frame throughout", [](int) { return 1; });
  lapses.files("missing", "one frame missing", [](int i) { return i == 6 ? 0 : i; });
  lapses.files("missing-end", "the last two frames missing", [](int i) { return i > 10 ? 0 : i; });
  const auto light = [&](const std::string& id, const std::string& what, auto gain) {
    lapses.pictures(true, id, what, [&](int i, const Image& a) { return gained(a, gain(i)); });
  };
  light("flash", "one frame 0.3 % brighter", [](int i) { return i == 6 ? 1.003 : 1.0; });
  light("flicker", "frames 0.2 % brighter and darker in turn",
        [](int i) { return i % 2 == 0 ? 1.002 : 0.998; });
  light("drift", "1 % brighter in the course of the sequence",
        [](int i) { return 1 + 0.01 * (i - 1) / (kFrames - 1); });
  lapses.pictures(true, "one-bad-pixel", "one pixel of one frame black", [](int i, const Image& a) {
    return changed(
        a, [&](int x, int y, int, float v) { return i == 9 && x == 100 && y == 30 ? 0.0F : v; });
  });
}

void add_sound(CaseList& list, Lapses& lapses) {
  lapses.pictures(false, "noise", "relative noise of 1e-5, another one in each frame",
                  [](int i, const Image& a) {
                    const Noise noise(a.width, a.height, uint32_t(i));
                    return changed(a, [&](int x, int y, int c, float v) {
                      return v * (1 + 2e-5 * (noise(x, y, c) - 0.5));
                    });
                  });
  lapses.pictures(false, "gain", "all frames 0.05 % brighter",
                  [](int, const Image& a) { return gained(a, 1.0005); });
  // A sky in which nothing moves: its frames repeat in the reference too.
  for (const char* const name : {"static.a", "static.b"}) {
    const fs::path folder = list.path(name);
    fs::create_directories(folder);
    FileOptions options;
    options.compression = name == std::string("static.a") ? "zip" : "none";
    for (int i = 1; i <= 4; ++i) write_image(folder / name_of(i), list.frame("day"), options);
  }
  list.add({"static.same", false, "day", "a sky in which nothing moves", "static.a", "static.b"});
}

}  // namespace

void add_time_lapses(CaseList& list) {
  Lapses lapses(list);
  add_broken(lapses);
  add_sound(list, lapses);
}

}  // namespace skylapse::diff_cases
