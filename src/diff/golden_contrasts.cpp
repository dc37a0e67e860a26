#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "diff/facts_of_file.h"
#include "diff/file_names.h"
#include "diff/golden_file.h"

namespace skylapse::diff {
namespace {

/// Groups up to this size are compared each with each.
constexpr size_t kEachWithEach = 12;

struct Scene {
  const Golden* golden = nullptr;
  PictureFacts facts;
};

/// Whether both say that they show the same.
bool shows_the_same(const PictureFacts& a, const PictureFacts& b) {
  if (a.file.utc.empty() || a.file.utc != b.file.utc || a.content != b.content) return false;
  const auto place = [](const PictureFacts& f) {
    return std::tuple(f.site, f.latitude_deg, f.longitude_deg, f.height_m, f.file.model);
  };
  if (place(a) != place(b)) return false;
  if (!a.view.camera || !b.view.camera) return a.projection == b.projection;
  return a.view.camera->projection == b.view.camera->projection &&
         a.view.camera->camera_to_enu == b.view.camera->camera_to_enu;
}

/// Which members of a group of `count` are held against each other.
std::set<std::pair<size_t, size_t>> chosen(size_t count, bool sequence) {
  std::set<std::pair<size_t, size_t>> pairs;
  const auto add = [&](size_t i, size_t j) {
    if (i != j) pairs.insert(std::minmax(i, j));
  };
  if (!sequence && count <= kEachWithEach) {
    for (size_t i = 0; i < count; ++i)
      for (size_t j = i + 1; j < count; ++j) add(i, j);
    return pairs;
  }
  for (size_t i = 0; i + 1 < count; ++i) add(i, i + 1);
  add(0, count - 1);
  add(0, count / 2);
  add(count / 2, count - 1);
  add(count / 4, 3 * count / 4);
  return pairs;
}

/// What can be held against each other: of one size, format and sequence; what is in no sequence
/// goes with what else is not, and each sequence's first with that.
using GroupKey = std::tuple<int, int, std::string, std::vector<std::string>, int>;

std::map<GroupKey, std::vector<size_t>> groups_of(const std::vector<Scene>& scenes) {
  std::vector<std::string> names;
  for (const Scene& scene : scenes) names.push_back(scene.golden->name);
  const auto sequences = sequences_of(names);
  std::map<GroupKey, std::vector<size_t>> groups;
  std::set<int> begun;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const FileFacts& file = scenes[i].facts.file;
    const auto key = [&](int sequence) {
      return GroupKey{file.width, file.height, file.format, file.channels, sequence};
    };
    groups[key(sequences[i])].push_back(i);
    if (sequences[i] >= 0 && begun.insert(sequences[i]).second) groups[key(-1)].push_back(i);
  }
  return groups;
}

}  // namespace

Result<std::vector<GoldenContrast>> golden_contrasts(const std::string& folder,
                                                     const std::vector<Golden>& goldens) {
  const auto io = output::open_image_io();
  if (!io) return io.error();
  std::vector<Scene> scenes;
  for (const Golden& golden : goldens) {
    const auto path = std::filesystem::path(folder) / golden.variants.front().file;
    const auto header = (*io)->read_header(path.native(), 0, ReadLimits{});
    if (!header) return header.error();
    scenes.push_back({&golden, facts_of_file(*header, nullptr)});
    scenes.back().facts.file.channels = header->channels;
  }
  std::vector<GoldenContrast> contrasts;
  for (const auto& [key, members] : groups_of(scenes)) {
    for (const auto& [i, j] : chosen(members.size(), std::get<4>(key) >= 0)) {
      const Scene &a = scenes[members[i]], &b = scenes[members[j]];
      if (shows_the_same(a.facts, b.facts)) continue;
      contrasts.push_back({a.golden->name, b.golden->name, a.golden->variants.front().file,
                           b.golden->variants.front().file});
    }
  }
  return contrasts;
}

}  // namespace skylapse::diff
