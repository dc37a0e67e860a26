#pragma once
// The list of cases and the folder they are written into.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "diff_cases/image.h"

namespace skylapse::diff_cases {

/// A pair of files or folders and what a comparison should say to it.
struct Case {
  std::string id;
  bool sabotage = false;  // must fail; else: must pass
  std::string frame;      // "day", "rendered noon"
  std::string what;       // "whole frame 2 % brighter"
  std::string a, b;       // below the folder of the list
  std::string exits =
      {};  // exit codes that are right, "0,1"; empty: 2 of sabotages, 0,1 of innocents
  std::string options = {};  // of the comparison; empty: the default settings
};

class CaseList {
 public:
  explicit CaseList(std::filesystem::path folder);

  /// Files of a case: B's pixels against those of the frame `name` (frame()).
  void sabotage(const std::string& id, const std::string& name, const std::string& what,
                const Image& b, const FileOptions& options = {});
  void innocent(const std::string& id, const std::string& name, const std::string& what,
                const Image& b, const FileOptions& options = {});

  /// A case of files that are there already, or of folders.
  void add(Case entry);

  /// A frame by name; A of every case made of it is one file, frames/NAME.exr (or .png).
  const Image& frame(const std::string& name);
  /// Makes an image known as a frame; writes it, or takes a file below the folder.
  void add_frame(const std::string& name, const Image& image, const FileOptions& options = {});
  void add_frame_file(const std::string& name, const std::string& file);
  [[nodiscard]] const std::string& frame_file(const std::string& name) const;

  [[nodiscard]] std::filesystem::path path(const std::string& below) const {
    return folder_ / below;
  }
  [[nodiscard]] const std::vector<Case>& cases() const { return cases_; }
  /// list.tsv: id, kind, frame, what, a, b, exits, options.
  void write_list() const;

 private:
  void add_image(bool sabotage, const std::string& id, const std::string& name,
                 const std::string& what, const Image& b, const FileOptions& options);
  std::filesystem::path folder_;
  struct Frame {
    Image image;
    std::string file;
  };
  std::map<std::string, Frame> frames_;
  std::vector<Case> cases_;
};

void add_plain_sabotages(CaseList& list);
void add_plain_innocents(CaseList& list);
/// The same kinds of damage in other amounts and places, on sketches and on rendered skies.
void add_damages(CaseList& list);
void add_more_innocents(CaseList& list);
/// Files that cannot be read, and files that say something else of themselves.
void add_bad_files(CaseList& list);
/// Rendered skies as frames "noon", "evening", "twilight", "fisheye", "view", "cube", "large",
/// "small", "screen", and a time lapse in renders/minutes; and what became of them when they were
/// rendered otherwise. `program` is skylapse.
void render_frames(CaseList& list, const std::filesystem::path& program);
void add_renders(CaseList& list, const std::filesystem::path& program);
void add_time_lapses(CaseList& list);
/// Files of several parts, lossy compressions, RGBE beside floats.
void add_file_kinds(CaseList& list, const std::filesystem::path& program);

}  // namespace skylapse::diff_cases
