// Skies rendered by the program, and what became of them when they were rendered otherwise.
#include <algorithm>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"
#include "diff_cases/render.h"

namespace skylapse::diff_cases {
namespace {

namespace fs = std::filesystem;

class Renders {
 public:
  Renders(CaseList& list, fs::path program) : list_(list), program_(std::move(program)) {}

  /// renders/NAME of scenes/SCENE.yaml.
  void render(const std::string& name, const std::string& scene,
              std::vector<std::string> options = {}, std::vector<std::string> environment = {}) {
    skylapse::diff_cases::render({program_, scene, list_.path("renders/" + name),
                                  std::move(options), std::move(environment)});
  }

  /// The picture of another render, in a file that says of itself what the reference says.
  void pixels_alone(const std::string& id, const std::string& frame, const std::string& what,
                    const std::string& other) {
    Image b = read_image(list_.path(other));
    b.attributes_of = list_.path(list_.frame_file(frame));
    FileOptions quick;
    quick.compression = "none";
    list_.sabotage(id, frame, what + ", pixels alone", b, quick);
  }

 private:
  CaseList& list_;
  fs::path program_;
};

/// The noon map rendered with something else in the scene: as it comes, and its pixels alone.
void add_other_scenes(CaseList& list, Renders& renders) {
  struct Change {
    std::string id, what;
    std::vector<std::string> set;
  };
  const std::vector<Change> changes{
      {"sun+0.1", "sun moved by 0.1 deg", {"time.at=2026-03-20T12:00:28+01:00"}},
      {"sun+0.25", "a minute later", {"time.at=2026-03-20T12:01+01:00"}},
      {"day+1", "a day later", {"time.at=2026-03-21T12:00+01:00"}},
      {"month+1", "a month later", {"time.at=2026-04-20T12:00+01:00"}},
      {"no-disc", "sun's disc left out", {"sky.sun_disc=off"}},
      {"turbidity", "turbidity 2.6 for 2.5", {"air.turbidity=2.6"}},
      {"albedo", "ground albedo 0.21 for 0.2", {"air.ground_albedo=0.21"}},
      {"flux", "disc with another flux", {"sky.solar_flux=conserving"}},
  };
  for (const Change& c : changes) {
    std::vector<std::string> options;
    for (const std::string& s : c.set) options.insert(options.end(), {"--set", s});
    renders.render("noon-" + c.id, "noon", options);
    for (const char* const size : {"small", "large"}) {
      const std::string other = "renders/noon-" + c.id + "/" + size + ".exr";
      const std::string id = std::string(size) + "." + c.id;
      renders.pixels_alone(id, size, c.what, other);
      if (size == std::string("small"))
        list.add({id + "-as-is", true, size, c.what, list.frame_file(size), other});
    }
  }
  renders.render("noon-acescg", "noon", {"--set", "color.space=acescg"});
  renders.pixels_alone("small.acescg", "small", "colours in ACEScg, said to be Rec. 709",
                       "renders/noon-acescg/small.exr");
  list.add({"small.acescg-as-is", true, "small", "colours in ACEScg", list.frame_file("small"),
            "renders/noon-acescg/small.exr"});
}

/// The same skies by other arithmetic, threads and orders of work.
void add_same_scenes(CaseList& list, Renders& renders) {
  struct Way {
    std::string id, what;
    std::vector<std::string> options, environment;
  };
  const std::vector<Way> ways{
      {"again", "rendered again", {}, {}},
      {"one-thread", "one thread", {"--jobs", "1"}, {"LP_NUM_THREADS=0"}},
      {"four-threads", "four threads", {"--jobs", "4"}, {"LP_NUM_THREADS=4"}},
      {"osmesa", "OSMesa for EGL", {"--backend", "osmesa"}, {}},
      {"vectors-128", "llvmpipe with vectors of 128 bits", {}, {"LP_NATIVE_VECTOR_WIDTH=128"}},
      {"vectors-512", "llvmpipe with vectors of 512 bits", {}, {"LP_NATIVE_VECTOR_WIDTH=512"}},
  };
  for (const Way& way : ways) {
    renders.render("skies-" + way.id, "skies", way.options, way.environment);
    list.add({"skies." + way.id, false, "12 skies", way.what, "renders/skies",
              "renders/skies-" + way.id});
  }
  for (const char* const shard : {"1/2", "2/2"})
    renders.render("skies-shards", "skies", {"--shard", shard});
  list.add({"skies.shards", false, "12 skies", "rendered in two shards", "renders/skies",
            "renders/skies-shards"});
  renders.render("skies-resumed", "skies", {"--frames", "1-5"});
  renders.render("skies-resumed", "skies");
  list.add({"skies.resumed", false, "12 skies", "rendered in two runs", "renders/skies",
            "renders/skies-resumed"});
  list.add({"skies.manifests", false, "12 skies", "by their manifests",
            "renders/skies/manifest.json", "renders/skies-again/manifest.json"});
  renders.render("minutes-again", "minutes", {"--jobs", "1"});
  list.add({"lapse.again", false, "minutes", "rendered again by one thread", "renders/minutes",
            "renders/minutes-again"});
  renders.render("noon-again", "noon", {"--jobs", "1"});
  list.add({"noon.again", false, "2 maps", "rendered again by one thread", "renders/noon",
            "renders/noon-again"});
}

}  // namespace

void render_frames(CaseList& list, const fs::path& program) {
  fs::create_directories(list.path("renders"));
  Renders renders(list, program);
  renders.render("skies", "skies");
  renders.render("noon", "noon");
  renders.render("minutes", "minutes");
  const auto frame = [&](const std::string& name, const std::string& file) {
    list.add_frame_file(name, "renders/" + file);
  };
  frame("noon", "skies/map_100000.exr");
  frame("evening", "skies/map_183000.exr");
  frame("twilight", "skies/map_194000.exr");
  frame("fisheye", "skies/fisheye_183000.exr");
  frame("view", "skies/view_183000.exr");
  frame("cube", "skies/cube_100000.exr");
  frame("screen", "skies/view_183000.png");
  frame("large", "noon/large.exr");
  frame("small", "noon/small.exr");
}

void add_renders(CaseList& list, const fs::path& program) {
  Renders renders(list, program);
  add_other_scenes(list, renders);
  add_same_scenes(list, renders);
}

}  // namespace skylapse::diff_cases
