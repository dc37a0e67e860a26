// Files that cannot be read, and files that say of themselves what is not so.
#include <fstream>
#include <iterator>

#include "diff_cases/case_list.h"
#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A file of each format, and what is left of it when a disk was full.
void add_truncated(CaseList& list) {
  const Image& day = list.frame("day");
  const Image& png = list.frame("png");
  const auto cut = [&](const std::string& extension, const Image& image, double share) {
    const std::string whole = "frames/whole." + extension;
    write_image(list.path(whole), image);
    const std::string bytes = bytes_of(list.path(whole));
    const std::string id = extension + ".cut" + std::to_string(int(100 * share)) + "%";
    const std::string file = id + "." + extension;
    write_bytes(list.path(file), bytes.substr(0, size_t(share * double(bytes.size()))));
    list.add({id, true, "day",
              "." + extension + " cut short at " + std::to_string(int(100 * share)) + " %", whole,
              file, "4"});
  };
  for (const double share : {0.02, 0.5, 0.95}) {
    cut("exr", day, share);
    cut("hdr", day, share);
    cut("tif", day, share);
    cut("png", png, share);
    cut("jpg", png, share);
  }
}

void add_no_pictures(CaseList& list) {
  const auto file = [&](const std::string& id, const std::string& what, const std::string& bytes,
                        const std::string& extension) {
    write_bytes(list.path(id + extension), bytes);
    const std::string a = list.frame_file(extension == ".png" ? "png" : "day");
    list.add({id, true, "day", what, a, id + extension, "4"});
  };
  file("file.empty", "empty file", "", ".exr");
  file("file.text", "a text called .exr", "no space left on device\n", ".exr");
  file("file.page", "a page of a proxy called .png",
       "<!DOCTYPE html><html><body>502 Bad Gateway</body></html>", ".png");
  file("file.header", "an EXR of nothing but its magic number", std::string("\x76\x2f\x31\x01", 4),
       ".exr");
  std::filesystem::create_directories(list.path("file.folder"));
  list.add({"file.folder", true, "day", "a folder in place of a file", list.frame_file("day"),
            "file.folder", "3,4"});
  std::filesystem::remove(list.path("file.dangling.exr"));
  const std::filesystem::path dangling = list.path("file.dangling");
  std::filesystem::create_directories(dangling);
  write_bytes(dangling / "f.0001.exr", "");
  std::filesystem::create_directories(list.path("file.reference"));
  std::filesystem::copy_file(list.path(list.frame_file("day")),
                             list.path("file.reference/f.0001.exr"),
                             std::filesystem::copy_options::overwrite_existing);
  list.add({"file.folder-empty-frame", true, "day", "an empty file in a folder", "file.reference",
            "file.dangling", "4"});
  std::filesystem::create_directories(list.path("file.nothing"));
  list.add({"file.folder-empty", true, "day", "a folder without pictures", "file.reference",
            "file.nothing", "2,4"});
}

/// The same pixels with another tale.
void add_tales(CaseList& list) {
  const Image& noon = list.frame("noon");
  const auto floats = [&](const std::string& id, const std::string& what,
                          std::vector<std::pair<std::string, float>> values) {
    FileOptions options;
    options.compression = "none";
    options.floats = std::move(values);
    list.sabotage("tale." + id, "noon", what, noon, options);
  };
  const auto text = [&](const std::string& id, const std::string& what, const std::string& name,
                        const std::string& value) {
    FileOptions options;
    options.compression = "none";
    options.text = {{name, value}};
    list.sabotage("tale." + id, "noon", what, noon, options);
  };
  floats("sun", "says that the sun is a degree higher", {{"skylapse:sunElevation", 61.585F}});
  floats("sun-azimuth", "says that the sun is a tenth of a degree further west",
         {{"skylapse:sunAzimuth", 149.091F}});
  floats("units", "says that 1.0 is 1 cd/m^2", {{"whiteLuminance", 1.0F}});
  floats("heading", "says that it looks south", {{"skylapse:heading", 180.0F}});
  text("projection", "says that it is a cube", "skylapse:projection", "cube");
  text("space", "says that its colours are ACEScg", "skylapse:colorSpace", "acescg");
  text("content", "says that the disc is not in it", "skylapse:content", "sky without disc");
  text("time", "says that it is a minute later", "skylapse:utc", "2026-06-21T10:01:00.000000Z");
  text("day", "says that it is a year later", "skylapse:utc", "2027-06-21T10:00:00.000000Z");
}

}  // namespace

void add_bad_files(CaseList& list) {
  add_truncated(list);
  add_no_pictures(list);
  add_tales(list);
}

}  // namespace skylapse::diff_cases
