// Files of several parts, compressions that lose something, and formats of coarser steps.
#include <OpenImageIO/imageio.h>

#include <limits>
#include <stdexcept>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"
#include "diff_cases/render.h"

namespace skylapse::diff_cases {
namespace {

struct Part {
  std::string name;
  Image image;
};

/// An EXR file of several parts.
void write_parts(const std::filesystem::path& path, const std::vector<Part>& parts,
                 const std::string& compression, int tile = 0) {
  std::vector<OIIO::ImageSpec> specs;
  for (const Part& part : parts) {
    OIIO::ImageSpec spec(part.image.width, part.image.height, part.image.channel_count(),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = part.image.channels;
    spec.full_width = parts[0].image.width;  // parts share a display window
    spec.full_height = parts[0].image.height;
    spec.attribute("oiio:subimagename", part.name);
    spec.attribute("compression", compression);
    if (tile > 0) spec.tile_width = spec.tile_height = tile;
    specs.push_back(spec);
  }
  const auto out = OIIO::ImageOutput::create(path.string());
  bool fine = out && out->open(path.string(), int(specs.size()), specs.data());
  for (size_t i = 0; fine && i < parts.size(); ++i) {
    if (i > 0) fine = out->open(path.string(), specs[i], OIIO::ImageOutput::AppendSubimage);
    fine = fine && out->write_image(OIIO::TypeDesc::FLOAT, parts[i].image.samples.data());
  }
  if (!fine || !out->close())
    throw std::runtime_error(path.string() + ": " + (out ? out->geterror() : OIIO::geterror()));
}

Image gained(const Image& a, float by) {
  return changed(a, [by](int, int, int, float v) { return v * by; });
}

/// The sky, the sky without its disc, and a small preview, in one file.
void add_parts(CaseList& list) {
  const Image sky = list.frame("day");
  DaySketch sketch;
  sketch.disc = 0;
  const Image no_disc = day_sketch(sketch), preview = cropped(sky, 100, 20, 64, 32);
  const std::vector<Part> whole{{"sky", sky}, {"no_disc", no_disc}, {"preview", preview}};
  const std::string a = "frames/parts.exr";
  write_parts(list.path(a), whole, "zip");
  const auto add = [&](bool sabotage, const std::string& id, const std::string& what,
                       const std::vector<Part>& parts, const std::string& compression = "zip",
                       int tile = 0) {
    const std::string b = "parts." + id + ".exr";
    write_parts(list.path(b), parts, compression, tile);
    list.add({"parts." + id, sabotage, "3 parts", what, a, b});
  };
  add(false, "again", "the same parts written again", whole);
  add(false, "piz", "the same parts compressed otherwise", whole, "piz");
  add(false, "tiles", "the same parts in tiles", whole, "zip", 32);
  const auto with = [&](size_t which, const Image& image) {
    std::vector<Part> parts = whole;
    parts[which].image = image;
    return parts;
  };
  add(true, "first", "first part 1 % brighter", with(0, gained(sky, 1.01F)));
  add(true, "second", "second part 2 % brighter", with(1, gained(no_disc, 1.02F)));
  Image spoilt = no_disc;
  spoilt.at(30, 30, 1) *= 1.05F;
  add(true, "second-sample", "one sample of the second part 5 % brighter", with(1, spoilt));
  spoilt.at(30, 30, 1) = std::numeric_limits<float>::quiet_NaN();
  add(true, "second-nan", "one NaN sample in the second part", with(1, spoilt));
  add(true, "second-first", "second part holds what the first does", with(1, sky));
  add(true, "preview", "preview, of another size, 2 % brighter", with(2, gained(preview, 1.02F)));
  add(true, "missing", "second part missing", {whole[0], whole[2]});
  add(true, "missing-last", "last part missing", {whole[0], whole[1]});
  add(true, "alone", "first part alone", {whole[0]});
}

FileOptions compressed(const std::string& compression, const std::string& type = {}) {
  FileOptions options;
  options.compression = compression;
  options.type = type;
  return options;
}

/// B44 leaves floats as they are. DWAA at its usual 45 takes up to 1.9 % off rows of a twilight,
/// and a disc of 5e4 becomes infinite or another light: as broken as any other loss of this size.
void add_lossy_exr(CaseList& list) {
  for (const std::string frame : {"noon", "twilight", "view"}) {
    const Image& image = list.frame(frame);
    list.innocent(frame + ".b44-float", frame, "compressed by b44, which leaves floats as they are",
                  image, compressed("b44"));
    list.innocent(frame + ".b44a-float", frame, "compressed by b44a, likewise", image,
                  compressed("b44a"));
    if (frame == "view") continue;
    list.sabotage(frame + ".dwaa45", frame, "compressed by dwaa 45", image, compressed("dwaa:45"));
    list.sabotage(frame + ".dwab45", frame, "compressed by dwab 45", image, compressed("dwab:45"));
    list.sabotage(frame + ".dwaa300", frame, "compressed by dwaa 300", image,
                  compressed("dwaa:300"));
  }
  list.innocent("view.b44-half", "view", "halves compressed by b44: a smooth sky",
                list.frame("view"), compressed("b44", "half"));
  list.sabotage("noon.b44-half", "noon", "halves compressed by b44: the disc is gone",
                list.frame("noon"), compressed("b44", "half"));
  write_image(list.path("frames/dwaa.exr"), list.frame("view"), compressed("dwaa:45"));
  Image decoded = read_image(list.path("frames/dwaa.exr"));
  write_image(list.path("frames/dwaa_decoded.exr"), decoded, compressed("zip"));
  list.add({"formats.dwaa-zip", false, "view", "dwaa and what it decodes to", "frames/dwaa.exr",
            "frames/dwaa_decoded.exr"});
}

/// JPEGs of one frame. Those decoded and encoded once more at the same quality are the same
/// picture; qualities of 50 and less show blocks. Between 80 and 92 it is a matter of taste.
void add_jpeg(CaseList& list) {
  const Image& screen = list.frame("screen");
  const std::string a = "frames/screen92.jpg";
  write_image(list.path(a), screen, compressed("jpeg:92"));
  Image decoded = read_image(list.path(a));
  decoded.attributes_of.clear();
  const auto add = [&](bool sabotage, const std::string& id, const std::string& what,
                       const Image& image, int quality) {
    const std::string b = "jpeg." + id + ".jpg";
    write_image(list.path(b), image, compressed("jpeg:" + std::to_string(quality)));
    list.add({"jpeg." + id, sabotage, "screen", what, a, b});
  };
  add(false, "again92", "JPEG 92 decoded and encoded at 92", decoded, 92);
  add(false, "again95", "JPEG 92 decoded and encoded at 95", decoded, 95);
  add(true, "again50", "JPEG 92 decoded and encoded at 50", decoded, 50);
  add(true, "again20", "JPEG 92 decoded and encoded at 20", decoded, 20);
  add(true, "first50", "JPEG 50 of the same frame", screen, 50);
  add(true, "first20", "JPEG 20 of the same frame", screen, 20);
  add(true, "brighter", "JPEG 92 of the frame, two code values brighter",
      changed(screen, [](int, int, int, float v) { return v > 253 ? 255.0F : v + 2; }), 92);
}

/// The frames of skies.yaml as the program writes them in RGBE, against its floats.
void add_rgbe(CaseList& list, const std::filesystem::path& program) {
  render({program,
          "skies",
          list.path("renders/rgbe"),
          {"--set", "outputs=[{image: \"{camera}_{time}.hdr\"}]"},
          {}});
  for (const std::string camera : {"map", "fisheye", "view", "cube"})
    for (const std::string time : {"100000", "183000", "194000"}) {
      const std::string frame = camera + "_" + time;
      list.add({"rgbe." + frame, false, frame, "RGBE as rendered, against floats",
                "renders/skies/" + frame + ".exr", "renders/rgbe/" + frame + ".hdr"});
    }
  Image dim = gained(read_image(list.path("renders/skies/view_183000.exr")), 0.98F);
  dim.attributes_of.clear();
  write_image(list.path("rgbe.dim.hdr"), dim);
  list.add({"rgbe.dim", true, "view_183000", "RGBE 2 % darker, against floats",
            "renders/skies/view_183000.exr", "rgbe.dim.hdr"});
}

}  // namespace

void add_file_kinds(CaseList& list, const std::filesystem::path& program) {
  add_parts(list);
  add_lossy_exr(list);
  add_jpeg(list);
  add_rgbe(list, program);
}

}  // namespace skylapse::diff_cases
