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
  /// Makes an image known as a frame.
  void add_frame(const std::string& name, const Image& image, const FileOptions& options = {});
  [[nodiscard]] std::string frame_file(const std::string& name) const;

  [[nodiscard]] std::filesystem::path path(const std::string& below) const {
    return folder_ / below;
  }
  [[nodiscard]] const std::vector<Case>& cases() const { return cases_; }
  /// list.tsv: id, kind, frame, what, a, b.
  void write_list() const;

 private:
  void add_image(bool sabotage, const std::string& id, const std::string& name,
                 const std::string& what, const Image& b, const FileOptions& options);
  std::filesystem::path folder_;
  std::map<std::string, Image> frames_;
  std::vector<Case> cases_;
};

void add_plain_sabotages(CaseList& list);
void add_plain_innocents(CaseList& list);

}  // namespace skylapse::diff_cases
