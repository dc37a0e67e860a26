#include "diff_cases/case_list.h"

#include <fstream>
#include <stdexcept>

#include "diff_cases/frames.h"

namespace skylapse::diff_cases {
namespace {

std::string extension(const Image& image) { return image.bits == 32 ? ".exr" : ".png"; }

}  // namespace

CaseList::CaseList(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_ / "frames");
  const Image day = day_sketch();
  add_frame("day", day);
  add_frame("night", night_sketch());
  add_frame("dark", night_sketch(50));
  add_frame("black", Image(256, 128));
  add_frame("grey", Image(256, 128, 0.4F));
  DaySketch bright;
  bright.gain = 20;
  add_frame("bright", day_sketch(bright));
  DaySketch huge;
  huge.disc = 1e10;
  add_frame("huge", day_sketch(huge));
  add_frame("one", cropped(day, 0, 0, 1, 1));
  add_frame("tiny", cropped(day, 178, 40, 5, 3));
  add_frame("png", display_of(day));
  std::filesystem::create_directories(folder_ / "frames/seq");
  for (int i = 1; i <= 8; ++i)
    write_image(folder_ / ("frames/seq/f.000" + std::to_string(i) + ".exr"), sequence_frame(i));
}

void CaseList::add_frame(const std::string& name, const Image& image, const FileOptions& options) {
  frames_[name] = {image, "frames/" + name + extension(image)};
  write_image(folder_ / frame_file(name), image, options);
}

void CaseList::add_frame_file(const std::string& name, const std::string& file) {
  frames_[name] = {read_image(folder_ / file), file};
}

const Image& CaseList::frame(const std::string& name) {
  const auto found = frames_.find(name);
  if (found == frames_.end()) throw std::runtime_error("no frame is called " + name);
  return found->second.image;
}

const std::string& CaseList::frame_file(const std::string& name) const {
  return frames_.at(name).file;
}

void CaseList::add_image(bool sabotage, const std::string& id, const std::string& name,
                         const std::string& what, const Image& b, const FileOptions& options) {
  const std::string file = id + extension(b);
  write_image(folder_ / file, b, options);
  add({id, sabotage, name, what, frame_file(name), file});
}

void CaseList::sabotage(const std::string& id, const std::string& name, const std::string& what,
                        const Image& b, const FileOptions& options) {
  add_image(true, id, name, what, b, options);
}

void CaseList::innocent(const std::string& id, const std::string& name, const std::string& what,
                        const Image& b, const FileOptions& options) {
  add_image(false, id, name, what, b, options);
}

void CaseList::add(Case entry) {
  for (const Case& other : cases_)
    if (other.id == entry.id) throw std::runtime_error("two cases are called " + entry.id);
  for (const std::string& file : {entry.a, entry.b})
    if (!std::filesystem::exists(path(file))) throw std::runtime_error("no file " + file);
  if (entry.exits.empty()) entry.exits = entry.sabotage ? "2" : "0,1";
  cases_.push_back(std::move(entry));
}

void CaseList::write_list() const {
  std::ofstream out(folder_ / "list.tsv");
  out << "id\tkind\tframe\twhat\ta\tb\texits\toptions\n";
  for (const Case& c : cases_)
    out << c.id << '\t' << (c.sabotage ? "sabotage" : "innocent") << '\t' << c.frame << '\t'
        << c.what << '\t' << c.a << '\t' << c.b << '\t' << c.exits << '\t' << c.options << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write list.tsv");
}

}  // namespace skylapse::diff_cases
